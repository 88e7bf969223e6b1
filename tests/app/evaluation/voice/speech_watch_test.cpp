// Whether somebody speaks, by made vowels and by speech of espeak-ng, a room, and the program's own drill over
// simulated ways from the loudspeaker to the microphone (V-06).
#include "app/evaluation/voice/speech_watch.h"

#include <cstdlib>

#include "app/sound/sound_reader.h"
#include "app/sound/work_sound.h"
#include "tests/app/evaluation/voice/spoken.h"
#include "tests/scratch_folder.h"

namespace app {
namespace {

using Sound = std::vector<float>;

constexpr std::size_t kSecond = kVoiceRate_Hz;
constexpr std::int64_t kBegin_ns = 1'000'000'000'000;

/// Of a handpiece that runs for 4.5 of 6 s and cuts now and then, as the program makes it.
Sound drill(std::size_t seconds) {
  WorkSound synthesis(kVoiceRate_Hz);
  Sound made(seconds * kSecond);
  for (std::size_t n = 0; n < made.size(); n += 192) {
    const double t_s = static_cast<double>(n) / kVoiceRate_Hz;
    SoundControl control;
    const bool is_on = std::fmod(t_s, 6.0) < 4.5;
    control.spindle_Hz = is_on ? 667.0 - 80.0 * std::abs(std::sin(t_s)) : 0.0;
    control.cut = is_on && std::fmod(t_s, 2.0) < 1.3 ? 0.3 + 0.4 * std::abs(std::sin(3.0 * t_s)) : 0.0;
    control.cut_Hz = 2200.0;
    control.water = is_on ? 1.0 : 0.0;
    synthesis.render(control, std::span(made).subspan(n, std::min<std::size_t>(192, made.size() - n)));
  }
  return made;
}

Sound room(std::size_t seconds) {
  std::mt19937 random(11);
  std::normal_distribution<float> bell;
  Sound made(seconds * kSecond);
  float low = 0.0F;
  for (float& sample : made) low += 0.05F * (bell(random) - low), sample = 0.01F * low;
  return made;
}

/// From the loudspeaker to the microphone: straight, then off the walls.
void addEcho(Sound& heard, const Sound& played, double delay_ms, float gain, bool has_walls) {
  std::mt19937 random(7);
  std::normal_distribution<double> bell;
  std::vector<std::pair<std::size_t, float>> ways{{0, gain}};
  for (std::size_t n = 0; has_walls && n < 40; ++n) {
    const std::size_t late = n * 100 + random() % 100;
    ways.emplace_back(late,
                      gain * static_cast<float>(0.4 * bell(random) * std::exp(-static_cast<double>(late) / 1440.0)));
  }
  const auto delay = static_cast<std::size_t>(delay_ms * 48.0);
  for (const auto& [late, level] : ways)
    for (std::size_t n = delay + late; n < heard.size(); ++n) heard[n] += level * played[n - delay - late];
}

void add(Sound& to, const Sound& other, float gain, std::size_t from = 0) {
  for (std::size_t n = from; n < to.size() && n - from < other.size(); ++n) to[n] += gain * other[n - from];
}

struct Found {
  double speech_s = 0.0, green_s = 0.0, loudest_db = -200.0;
  std::vector<double> reminded_s;
};

/// Through the watch, with what is played in shared memory as the card's thread puts it there, piece by piece.
Found found(const Sound& heard, const Sound* played, double silence_s = 20.0) {
  Found found;
  PlayedSound memory;
  QuietWatch quiet(silence_s);
  quiet.begin(kBegin_ns);
  SpeechWatch watch(played != nullptr ? memory.descriptor() : -1,
                    {[&](const SpeechChange& change) { quiet.follow(change); },
                     [&](std::int64_t, double level_db) { found.loudest_db = std::max(found.loudest_db, level_db); }});
  constexpr std::size_t kPiece = 120, kFill = 480;
  for (std::size_t n = 0; n + kPiece <= heard.size(); n += kPiece) {
    const auto at_ns = kBegin_ns + static_cast<std::int64_t>(n * 1'000'000 / 48);
    if (played != nullptr && n % kFill == 0)
      memory.add(std::span(*played).subspan(n, std::min(kFill, played->size() - n)), kVoiceRate_Hz, at_ns);
    HeardBlock block;
    block.count = kPiece;
    std::copy_n(heard.begin() + static_cast<std::ptrdiff_t>(n), kPiece, block.samples.begin());
    block.t_ns = at_ns + 2'500'000;
    watch.add(block);
    if (quiet.isDue(block.t_ns)) found.reminded_s.push_back(static_cast<double>(block.t_ns - kBegin_ns) * 1e-9);
  }
  found.speech_s = watch.speech_s(), found.green_s = watch.green_s();
  return found;
}

TEST(SpeechWatch, ARoomIsQuietAndRemindsOnceInTwentySeconds) {
  const Found quiet = found(room(40), nullptr);
  EXPECT_DOUBLE_EQ(quiet.speech_s, 0.0);
  ASSERT_EQ(quiet.reminded_s.size(), 1u);
  EXPECT_NEAR(quiet.reminded_s[0], 20.0, 1.0);
}

TEST(SpeechWatch, TheProgramsOwnDrillIsNoSpeechWhereItIsToldOfIt) {
  const Sound played = drill(40);
  for (const double delay_ms : {5.0, 25.0, 60.0})
    for (const bool has_walls : {false, true}) {
      Sound heard = room(40);
      addEcho(heard, played, delay_ms, 0.6F, has_walls);
      const Found with = found(heard, &played);
      EXPECT_DOUBLE_EQ(with.speech_s, 0.0) << delay_ms << has_walls;
      ASSERT_EQ(with.reminded_s.size(), 1u) << delay_ms << has_walls;
      EXPECT_NEAR(with.reminded_s[0], 20.0, 1.0) << delay_ms << has_walls;
    }
  // It would be, else: so the far end is what does it.
  Sound heard = room(40);
  addEcho(heard, played, 25.0, 0.6F, true);
  EXPECT_GT(found(heard, nullptr).speech_s, 20.0);
}

TEST(SpeechWatch, TheLevelIsThatOfASine) {
  Sound sine(kSecond);
  for (std::size_t n = 0; n < sine.size(); ++n) sine[n] = 0.1F * std::sin(static_cast<float>(n) * 0.1308997F);  // 1 kHz
  // 20 log10(0.1) - 3.01 dB.
  EXPECT_NEAR(found(sine, nullptr).loudest_db, -23.01, 0.05);
}

/// Vowels that are made here, or sentences of espeak-ng.
class SpeechWatchSpoken : public testing::TestWithParam<bool> {
 protected:
  void SetUp() override {
    if (!GetParam()) {
      speech_ = tests::spoken(20);
      return;
    }
    const std::string first = scratch_.file("22.wav"), second = scratch_.file("48.wav");
    const std::string words =
        "I am looking for the edge of the crown now. I expect the bur to slip to the distal side, so I hold it a "
        "little "
        "firmer. Why has it done that? I can not see how deep I am. Now I go on with the trough, buccally, and keep "
        "away "
        "from the canal. It feels softer here than I would expect of cortical bone.";
    const std::string line = "espeak-ng -s 150 -w " + first + " '" + words + "' 2>/dev/null && sox " + first +
                             " -r 48000 -c 1 " + second + " 2>/dev/null";
    if (std::system(line.c_str()) != 0) GTEST_SKIP() << "espeak-ng or sox is not there: nobody says sentences";
    SoundReader reader(second, kVoiceRate_Hz);
    speech_.resize(20 * kSecond);
    reader.read(speech_);
  }
  Sound spoken(std::size_t seconds) const {
    Sound made(seconds * kSecond);
    for (std::size_t n = 0; n < made.size(); n += speech_.size()) add(made, speech_, 1.0F, n);
    return made;
  }

  tests::ScratchFolder scratch_;
  Sound speech_;
};
INSTANTIATE_TEST_SUITE_P(Vowels, SpeechWatchSpoken, testing::Values(false));
INSTANTIATE_TEST_SUITE_P(Sentences, SpeechWatchSpoken, testing::Values(true));

TEST_P(SpeechWatchSpoken, TalkingTenMinutesRemindsOfNothing) {
  const std::size_t seconds = GetParam() ? 600 : 120;
  Sound heard = room(seconds);
  add(heard, spoken(seconds), 0.3F);
  const Found talk = found(heard, nullptr);
  EXPECT_TRUE(talk.reminded_s.empty());
  EXPECT_GT(talk.speech_s, 0.9 * static_cast<double>(seconds));
  EXPECT_GT(talk.green_s, 0.2 * static_cast<double>(seconds));
}

TEST_P(SpeechWatchSpoken, SilenceIsToldTwentySecondsAfterTheLastWord) {
  Sound heard = room(60);
  add(heard, spoken(18), 0.3F);
  const Found talk = found(heard, nullptr);
  ASSERT_EQ(talk.reminded_s.size(), 1u);
  // The sound of the last word ends within the 18th second.
  EXPECT_NEAR(talk.reminded_s[0], 38.0, 1.0);
}

TEST_P(SpeechWatchSpoken, TalkingOverTheDrillIsNoSilence) {
  const Sound played = drill(60);
  for (const double delay_ms : {5.0, 60.0})
    for (const bool has_walls : {false, true}) {
      Sound heard = room(60);
      addEcho(heard, played, delay_ms, 0.6F, has_walls);
      add(heard, spoken(60), 0.5F);
      const Found talk = found(heard, &played);
      EXPECT_TRUE(talk.reminded_s.empty()) << delay_ms << has_walls;
      EXPECT_GT(talk.speech_s, 30.0) << delay_ms << has_walls;
    }
}

}  // namespace
}  // namespace app
