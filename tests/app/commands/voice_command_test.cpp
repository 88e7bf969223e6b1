// `molar voice` beside a session: time is told, the microphone is a file, no clock decides anything.

#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "app/evaluation/voice/speech_watch.h"
#include "app/evaluation/voice/voice_desk.h"
#include "app/evaluation/voice/voice_files.h"
#include "app/evaluation/voice/voice_track.h"
#include "app/text/usage_error.h"
#include "tests/app/evaluation/voice/spoken.h"
#include "tests/scratch_folder.h"

namespace app {
namespace {

constexpr std::int64_t kBegin_ns = 4'000'000'000'000, kFrame_ns = 16'000'000, kSecond_ns = 1'000'000'000;

const std::string kTemplate = R"(title = "T"
language = "en"
consent = "c.md"
silence_s = 20
[[task]]
id = "one"
say = "First"
time_box_s = 600
success = "time > 500 s"
)";

class VoiceCommand : public testing::Test {
 protected:
  VoiceCommand()
      : study_(studyTemplateFrom(kTemplate, "t.toml")),
        course_(study_, {"P07", "", 1, ""}, [this](const LogEvent& event) { events_.push_back(event); }) {
    std::filesystem::create_directory(session());
  }

  std::string session() const { return scratch_.file("P07-1"); }
  std::string folder() const { return session() + "/voice"; }
  void consent(bool to_audio) {
    course_.prepare({}, {now_ns_, {}});
    course_.enter(Phase::consent, {now_ns_, {}});
    for (const std::string_view stream : kConsentStreams) say(std::string(stream), stream != "audio" || to_audio);
    course_.enter(Phase::tasks, {now_ns_, {}});
  }
  void say(const std::string& stream, bool given) {
    ASSERT_FALSE(course_.take({now_ns_, {}, "participant", "consent", {{"stream", stream}, {"given", given}}}));
  }
  /// A session whose microphone hears this; a task has begun.
  VoiceDesk& begin(const std::vector<float>& sound) {
    tests::writeSound(scratch_.file("heard.flac"), sound);
    desk_.emplace(VoiceDesk::Parts{course_, microphoneFrom("file:" + scratch_.file("heard.flac")), study_.silence_s,
                                   true, -1, MOLAR_PROGRAM});
    desk_->begin(session(), seal_ ? &*seal_ : nullptr, {now_ns_, {}});
    course_.startTask({now_ns_, 0});
    return *desk_;
  }
  void goOn(double seconds) {
    const std::int64_t until_ns = now_ns_ + static_cast<std::int64_t>(seconds * 1e9);
    for (; now_ns_ < until_ns; now_ns_ += kFrame_ns, tick_ += 16) desk_->follow({now_ns_, tick_});
  }
  std::vector<const LogEvent*> ofType(const std::string& type) const {
    std::vector<const LogEvent*> found;
    for (const LogEvent& event : events_)
      if (event.type == type) found.push_back(&event);
    return found;
  }
  std::size_t files() const {
    std::error_code failed;
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(session(), failed))
      count += entry.is_regular_file() ? 1 : 0;
    return count;
  }

  tests::ScratchFolder scratch_;
  StudyTemplate study_;
  std::vector<LogEvent> events_;
  EvaluationCourse course_;
  std::optional<SessionSeal> seal_;
  std::optional<VoiceDesk> desk_;
  std::int64_t now_ns_ = kBegin_ns;
  std::uint64_t tick_ = 0;
};

TEST_F(VoiceCommand, RecordsSpeechAndSilenceWithTheirTimes) {
  consent(true);
  std::vector<float> sound = tests::spoken(30);
  // From 12 s on there is none.
  std::fill(sound.begin() + 12 * 48'000, sound.end(), 0.0F);
  VoiceDesk& desk = begin(sound);
  goOn(11.0);
  ASSERT_TRUE(desk.state(now_ns_));
  EXPECT_TRUE(desk.state(now_ns_)->speech);
  EXPECT_GT(desk.state(now_ns_)->level_db, kGreenFrom_db);
  EXPECT_DOUBLE_EQ(desk.state(now_ns_)->quiet_s, 0.0);
  EXPECT_EQ(desk.reminder(now_ns_), "");
  goOn(20.9);
  EXPECT_FALSE(desk.state(now_ns_)->reminder);
  goOn(1.0);
  EXPECT_TRUE(desk.state(now_ns_)->reminder);
  EXPECT_EQ(desk.reminder(now_ns_), "20 s quiet: What are you doing?");
  goOn(20.0);
  EXPECT_EQ(desk.reminder(now_ns_), "");
  desk.finish({now_ns_, {}});

  const auto silences = ofType("silence");
  ASSERT_EQ(silences.size(), 1u);
  EXPECT_NEAR(static_cast<double>(silences[0]->t_ns - kBegin_ns) * 1e-9, 32.3, 1.0);
  ASSERT_GE(ofType("speech.on").size(), 1u);
  EXPECT_LT(ofType("speech.on")[0]->t_ns, kBegin_ns + kSecond_ns);
  ASSERT_EQ(ofType("speech.off").size(), ofType("speech.on").size());
  const auto voice = ofType("voice");
  ASSERT_EQ(voice.size(), 1u);
  EXPECT_NEAR(*voice[0]->number("seconds"), static_cast<double>(now_ns_ - kBegin_ns) * 1e-9, 0.05);
  EXPECT_EQ(*voice[0]->number("segments"), std::ceil(*voice[0]->number("seconds") / 2.0));
  EXPECT_EQ(*voice[0]->number("gaps"), 0.0);
  EXPECT_NEAR(*voice[0]->number("drift_ppm"), 0.0, 1e-3);
  EXPECT_FALSE(voice[0]->number("delay_start_ms"));
  // The recording is what was heard, at its time and at its tick.
  auto track = VoiceTrack::of(session(), 1000.0);
  ASSERT_TRUE(track);
  std::vector<float> heard(48'000);
  track->read(track->frameAt(kBegin_ns + 5 * kSecond_ns), heard);
  for (std::size_t n = 0; n < heard.size(); ++n) ASSERT_NEAR(heard[n], sound[5 * 48'000 + n], 1.0 / 30'000.0) << n;
  const auto at_tick = track->timeOfTick(5001.0);
  ASSERT_TRUE(at_tick);
  EXPECT_NEAR(static_cast<double>(*at_tick - kBegin_ns) * 1e-9, 5.0, 0.001);
}

/// V-05, the whole chain by the clock: a microphone that is a file, the process that records it, the clock's map, the
/// ticks. Clicks every ten seconds are where they were, at the end as at the beginning.
class VoiceChainSoak : public VoiceCommand {
 protected:
  static std::int64_t clock_ns() { return std::chrono::steady_clock::now().time_since_epoch().count(); }
};

TEST_F(VoiceChainSoak, AClickIsAtItsTickAtTheStartAndAtTheEnd) {
  const char* const asked = std::getenv("MOLAR_SOAK_MINUTES");
  const int seconds = asked == nullptr ? 32 : std::max(1, std::atoi(asked)) * 60 + 2;
  constexpr int kEvery_s = 10, kRate_Hz = 48'000;
  constexpr std::int64_t kClick_s = 1;
  std::vector<float> sound(static_cast<std::size_t>(seconds) * kRate_Hz, 0.0F);
  for (int s = kClick_s; s < seconds; s += kEvery_s) sound[static_cast<std::size_t>(s) * kRate_Hz] = 0.9F;
  tests::writeSound(scratch_.file("heard.flac"), sound);
  now_ns_ = clock_ns();
  consent(true);
  desk_.emplace(VoiceDesk::Parts{course_, microphoneFrom("file:" + scratch_.file("heard.flac") + ",realtime"),
                                 study_.silence_s, false, -1, MOLAR_PROGRAM});
  desk_->begin(session(), nullptr, {now_ns_, {}});
  const std::int64_t first_tick_ns = now_ns_;
  const auto tickNow = [&] { return static_cast<std::uint64_t>((now_ns_ - first_tick_ns) / 1'000'000); };
  course_.startTask({now_ns_, 0});
  while (now_ns_ - first_tick_ns < static_cast<std::int64_t>(seconds) * kSecond_ns) {
    std::this_thread::sleep_for(std::chrono::milliseconds(16));
    now_ns_ = clock_ns();
    desk_->follow({now_ns_, tickNow()});
  }
  desk_->finish({now_ns_, tickNow()});
  const auto on = ofType("voice.on");
  ASSERT_EQ(on.size(), 1u);
  auto track = VoiceTrack::of(session(), 1000.0);
  ASSERT_TRUE(track);
  // Where each is found, by the map from samples to the clock.
  std::vector<double> off_ms;
  std::vector<float> heard(kRate_Hz);
  for (std::int64_t s = kClick_s; s * kRate_Hz + kRate_Hz < track->frames(); s += kEvery_s) {
    track->read(s * kRate_Hz - kRate_Hz / 2, heard);
    const auto loudest = std::ranges::max_element(heard) - heard.begin();
    ASSERT_GT(heard[static_cast<std::size_t>(loudest)], 0.5F) << s;
    const std::int64_t frame = s * kRate_Hz - kRate_Hz / 2 + loudest;
    const std::int64_t t_ns = on[0]->t_ns + s * kSecond_ns;
    off_ms.push_back(static_cast<double>(track->frameAt(t_ns) - frame) / 48.0);
    // And by its tick.
    const auto at_tick = track->timeOfTick(static_cast<double>(t_ns - first_tick_ns) / 1e6);
    ASSERT_TRUE(at_tick);
    EXPECT_NEAR(static_cast<double>(*at_tick - t_ns) / 1e6, 0.0, 5.0) << s;
  }
  ASSERT_GE(off_ms.size(), 2u);
  const auto [least, most] = std::ranges::minmax(off_ms);
  std::printf("%zu clicks in %d s: first %.1f ms off, last %.1f, from %.1f to %.1f\n", off_ms.size(), seconds,
              off_ms.front(), off_ms.back(), least, most);
  EXPECT_LT(std::max(std::abs(off_ms.front()), std::abs(off_ms.back())), 40.0);
  EXPECT_LT(std::abs(off_ms.back() - off_ms.front()), 10.0);
}

TEST_F(VoiceCommand, WithoutTheConsentNothingIsOpenedAndNoByteIsKept) {
  consent(false);
  VoiceDesk& desk = begin(tests::spoken(5));
  goOn(5.0);
  desk.finish({now_ns_, {}});
  EXPECT_FALSE(desk.state(now_ns_));
  EXPECT_EQ(desk.missing(), "");
  EXPECT_EQ(files(), 0u);
  EXPECT_TRUE(ofType("voice").empty());
  EXPECT_TRUE(ofType("voice.on").empty());
}

TEST_F(VoiceCommand, AWordTakenBackStopsItWithTheNextFrameAndDeletesAll) {
  consent(true);
  VoiceDesk& desk = begin(tests::spoken(10));
  goOn(7.0);
  EXPECT_GT(files(), 3u);
  say("audio", false);
  desk.follow({now_ns_, tick_});
  EXPECT_EQ(files(), 0u);
  EXPECT_FALSE(std::filesystem::exists(folder()));
  EXPECT_FALSE(desk.state(now_ns_));
  goOn(3.0);
  desk.finish({now_ns_, {}});
  EXPECT_EQ(files(), 0u);
  EXPECT_EQ(ofType("voice.deleted").size(), 1u);
  EXPECT_TRUE(ofType("voice").empty());
}

TEST_F(VoiceCommand, KilledItGoesOnAndTwoSecondsAtMostAreMissing) {
  consent(true);
  const std::vector<float> sound = tests::spoken(40);
  VoiceDesk& desk = begin(sound);
  std::mt19937 random(9);
  std::vector<std::int64_t> killed_ns;
  for (int n = 0; n < 3; ++n) {
    goOn(std::uniform_real_distribution<double>(1.2, 7.0)(random));
    kill(desk.process(), SIGKILL);
    killed_ns.push_back(now_ns_);
    desk.follow({now_ns_, tick_});
    while (!desk.isRecording()) desk.follow({now_ns_, tick_});
  }
  goOn(3.0);
  desk.finish({now_ns_, {}});
  EXPECT_EQ(ofType("voice.lost").size(), 3u);
  EXPECT_EQ(*ofType("voice")[0]->number("gaps"), 3.0);
  auto track = VoiceTrack::of(session(), 1000.0);
  ASSERT_TRUE(track);
  // All until two seconds before the first kill is what was heard.
  const auto until = track->frameAt(killed_ns[0] - 2 * kSecond_ns);
  if (until > 0) {
    std::vector<float> heard(static_cast<std::size_t>(until));
    track->read(0, heard);
    for (std::size_t n = 0; n < heard.size(); ++n) ASSERT_NEAR(heard[n], sound[n], 1.0 / 30'000.0) << n;
  }
  EXPECT_NEAR(static_cast<double>(track->frames()) / 48e3, static_cast<double>(now_ns_ - kBegin_ns) * 1e-9, 0.1);
}

TEST_F(VoiceCommand, WithAStudysKeysEachSegmentIsSealedAndTheKeyAloneOpensThem) {
  startSealing();
  const PrivateStudyKeys study(SecretKey::random()), other(SecretKey::random());
  seal_.emplace(study.publicKeys(), session(), "P07-1");
  consent(true);
  const std::vector<float> sound = tests::spoken(10);
  VoiceDesk& desk = begin(sound);
  goOn(4.5);
  // Also one that goes on for another.
  kill(desk.process(), SIGKILL);
  goOn(3.0);
  desk.finish({now_ns_, {}});
  for (const auto& entry : std::filesystem::directory_iterator(folder())) {
    std::ostringstream bytes;
    bytes << std::ifstream(entry.path()).rdbuf();
    EXPECT_EQ(bytes.str().find("fLaC"), std::string::npos) << entry.path();
    EXPECT_NE(entry.path().extension(), ".flac");
  }
  const auto opener = [](const OpenedSession& opened) {
    return [&opened](std::uint64_t number, std::string_view sealed) {
      return opened.open(SealedStream::audio, kVoiceTable, number, sealed);
    };
  };
  const OpenedSession mine(study, session(), "P07-1"), not_mine(other, session(), "P07-1");
  std::vector<float> heard(48'000);
  auto track = VoiceTrack::of(session(), 1000.0, opener(mine));
  ASSERT_TRUE(track);
  track->read(0, heard);
  for (std::size_t n = 0; n < heard.size(); ++n) ASSERT_NEAR(heard[n], sound[n], 1.0 / 30'000.0) << n;
  auto closed = VoiceTrack::of(session(), 1000.0, opener(not_mine));
  ASSERT_TRUE(closed);
  closed->read(0, heard);
  for (const float sample : heard) ASSERT_FLOAT_EQ(sample, 0.0F);
}

TEST_F(VoiceCommand, AWithdrawalDestroysTheKeyToo) {
  startSealing();
  const PrivateStudyKeys study(SecretKey::random());
  seal_.emplace(study.publicKeys(), session(), "P07-1");
  consent(true);
  VoiceDesk& desk = begin(tests::spoken(5));
  goOn(3.0);
  EXPECT_TRUE(std::filesystem::exists(sealedKeyPath(session(), SealedStream::audio)));
  say("audio", false);
  desk.follow({now_ns_, tick_});
  EXPECT_FALSE(std::filesystem::exists(sealedKeyPath(session(), SealedStream::audio)));
  EXPECT_TRUE(std::filesystem::exists(sealedKeyPath(session(), SealedStream::words)));
}

TEST_F(VoiceCommand, WhoEndsWithoutAWordLosesNothingButTheNewest) {
  consent(true);
  begin(tests::spoken(10));
  goOn(6.5);
  desk_.reset();
  auto track = VoiceTrack::of(session(), 1000.0);
  ASSERT_TRUE(track);
  EXPECT_GT(track->frames(), static_cast<std::int64_t>(4.5 * 48e3));
}

TEST_F(VoiceCommand, TenSecondsInTheGreenAreAskedForInTheWarmUp) {
  consent(true);
  VoiceDesk& desk = begin(tests::spoken(20));
  goOn(5.0);
  EXPECT_THAT(desk.missing(), testing::HasSubstr("of 10 s of speech in the green"));
  goOn(10.0);
  EXPECT_EQ(desk.missing(), "");
  EXPECT_TRUE(ofType("silence").empty());
  desk.finish({now_ns_, {}});
}

TEST(Microphone, IsNamedOrRefused) {
  const tests::ScratchFolder scratch;
  tests::writeSound(scratch.file("a,b.flac"), std::vector<float>(480, 0.0F));
  EXPECT_TRUE(microphoneFrom("none").is_none);
  EXPECT_TRUE(microphoneFrom("default").file.empty());
  const MicrophoneChoice choice = microphoneFrom("file:" + scratch.file("a,b.flac") + ",realtime");
  EXPECT_EQ(choice.file, scratch.file("a,b.flac"));
  EXPECT_TRUE(choice.is_realtime);
  for (const std::string& wrong :
       {std::string("file:"), std::string("file:none.wav"), std::string("mike"), std::string()})
    EXPECT_THROW(microphoneFrom(wrong), UsageError) << wrong;
}

}  // namespace
}  // namespace app
