#include "app/evaluation/voice/voice_desk.h"

#include <fcntl.h>
#include <unistd.h>

#include <filesystem>
#include <utility>

#include <fmt/core.h>

#include "app/evaluation/voice/clock_map.h"
#include "app/evaluation/voice/voice_files.h"
#include "app/text/message.h"

namespace app {
namespace {

namespace fs = std::filesystem;

constexpr double kGreen_s = 10.0, kFarApart_ms = 10.0;
constexpr std::int64_t kShown_ns = 8'000'000'000, kBetweenTicks_ns = 200'000'000;

}  // namespace

VoiceDesk::VoiceDesk(Parts parts) : parts_(std::move(parts)), quiet_(parts_.silence_s) {}

VoiceDesk::~VoiceDesk() {
  if (ticks_ >= 0) ::close(ticks_);
}

bool VoiceDesk::canHear() const {
  const MicrophoneChoice& microphone = parts_.microphone;
  return !microphone.is_none && (!parts_.steps || (!microphone.file.empty() && !microphone.is_realtime));
}

std::string VoiceDesk::plan() const {
  if (parts_.microphone.is_none) return "is not recorded";
  if (!canHear()) return "is not recorded where the ticks are the clock, but from a file";
  return parts_.microphone.file.empty() ? "is recorded where it is allowed" : "comes from a file";
}

void VoiceDesk::begin(const std::string& session, SessionSeal* seal, const Moment& at) {
  if (!canHear() || !parts_.course.allows("audio")) return;
  const MicrophoneChoice& microphone = parts_.microphone;
  folder_ = (fs::path(session) / kVoiceFolder).string();
  seal_ = seal;
  VoiceOptions options;
  options.folder = folder_, options.file = microphone.file, options.session = fs::path(session).filename().string();
  options.played = parts_.steps ? -1 : parts_.played, options.is_clock_told = parts_.steps;
  link_.emplace(std::move(options), seal != nullptr ? seal->key(SealedStream::audio) : nullptr, parts_.program);
  link_->start();
  starts_ = link_->starts();
  quiet_.begin(at.t_ns);
}

void VoiceDesk::follow(const Moment& at) {
  if (!link_) return;
  if (!parts_.course.allows("audio")) return withdraw(at);
  for (const VoiceWord& word : link_->update(at.t_ns)) take(word, at);
  if (link_->starts() != std::exchange(starts_, link_->starts())) {
    parts_.course.log(at, "system", "voice.lost", {{"starts", std::int64_t{starts_}}});
    printMessage("voice: its process ended and was started again, up to 2 s are missing");
  }
  if (!isRecording()) {
    if (!std::exchange(has_told_end_, true)) tellEnd(at);
    return;
  }
  remind(at);
  keepTick(at);
}

void VoiceDesk::tellEnd(const Moment& at, const std::string& why) {
  has_told_end_ = true;
  parts_.course.log(at, "system", "voice.off", {{"why", why}});
  printMessage("voice is not recorded: " + why);
}

void VoiceDesk::take(const VoiceWord& word, const Moment& at) {
  EvaluationCourse& course = parts_.course;
  if (word.kind == VoiceWord::Kind::began)
    course.log(at, "system", "voice.on",
               {{"from", std::string(parts_.microphone.file.empty() ? "microphone" : "file")}});
  if (word.kind == VoiceWord::Kind::trouble) {
    const std::string why(textOf(static_cast<VoiceTrouble>(word.number)));
    tellEnd(at, why);
  }
  if (word.kind == VoiceWord::Kind::level) {
    constexpr double kThousand = 1000.0;
    heard_.level_db = word.value;
    heard_.green_s = static_cast<double>(word.number) / kThousand;
  }
  if (word.kind != VoiceWord::Kind::speech) return;
  heard_.speech = word.number != 0;
  quiet_.follow({word.t_ns, heard_.speech});
  course.log({word.t_ns, {}}, "participant", heard_.speech ? "speech.on" : "speech.off");
}

/// During a task that is not held.
void VoiceDesk::remind(const Moment& at) {
  const TaskTemplate* const running = parts_.course.running();
  if (running != std::exchange(task_, running) || parts_.course.isPaused()) quiet_.begin(at.t_ns);
  if (running == nullptr || !quiet_.isDue(at.t_ns)) return;
  reminded_ns_ = at.t_ns;
  parts_.course.log(at, "system", "silence", {{"task", running->id}, {"quiet_s", quiet_.quiet_s(at.t_ns)}});
  printMessage(reminder(at.t_ns));
}

/// Ticks against the clock, some in a second: the map takes those that were told at once.
void VoiceDesk::keepTick(const Moment& at) {
  if (!at.tick || (tick_told_ns_ && at.t_ns - *tick_told_ns_ < kBetweenTicks_ns)) return;
  if (ticks_ < 0) {
    constexpr mode_t kOwnerAlone = 0600;
    const std::string path = (fs::path(folder_) / kVoiceTicks).string();
    ticks_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, kOwnerAlone);
    if (ticks_ < 0 || ::write(ticks_, kClockHeader.data(), kClockHeader.size()) < 0) return;
  }
  tick_told_ns_ = at.t_ns;
  const std::string line = clockLine({*at.tick + 1, at.t_ns, 0});
  // Without it the sound is not found by tick; the log has the times of what happened.
  if (::write(ticks_, line.data(), line.size()) < 0) return;
}

void VoiceDesk::withdraw(const Moment& at) {
  link_.reset();
  heard_ = {};
  if (seal_ != nullptr) seal_->destroy(SealedStream::audio);
  if (ticks_ >= 0) ::close(std::exchange(ticks_, -1));
  std::error_code failed;
  fs::remove_all(folder_, failed);
  parts_.course.log(at, "system", failed ? "voice.not_deleted" : "voice.deleted");
  printMessage(failed ? folder_ + ": cannot be deleted, delete it by hand: the participant took the word back"
                      : "the voice is not allowed any more: nothing is recorded, and what was is deleted");
}

void VoiceDesk::finish(const Moment& at) {
  follow(at);
  if (!link_) return;
  std::vector<VoiceWord> last;
  const VoiceFigures figures = link_->finish(last);
  for (const VoiceWord& word : last) take(word, at);
  link_.reset();
  constexpr std::array<const char*, std::tuple_size_v<VoiceFigures>> kNames{
      "seconds", "segments", "gaps", "drift_ppm", "speech_s", "delay_start_ms", "delay_end_ms", "processor_s"};
  std::vector<std::pair<std::string, LogValue>> data;
  for (std::size_t n = 0; n < figures.size(); ++n) {
    // Where the ticks are the clock, two runs give the same log.
    const bool is_measured = n == static_cast<std::size_t>(VoiceFigure::processor_s);
    const bool is_whole =
        n == static_cast<std::size_t>(VoiceFigure::segments) || n == static_cast<std::size_t>(VoiceFigure::gaps);
    if (!figures[n] || (is_measured && parts_.steps)) continue;
    data.emplace_back(kNames[n], is_whole ? LogValue(static_cast<std::int64_t>(*figures[n])) : LogValue(*figures[n]));
  }
  const auto start = figures[static_cast<std::size_t>(VoiceFigure::delay_start_ms)];
  const auto end = figures[static_cast<std::size_t>(VoiceFigure::delay_end_ms)];
  if (start && end && std::abs(*start - *end) > kFarApart_ms) {
    data.emplace_back("light", std::string("amber"));
    printMessage(
        fmt::format("voice: its delay was {:.0f} ms at the start and {:.0f} at the end (amber)", *start, *end));
  }
  if (!data.empty()) parts_.course.log(at, "system", "voice", std::move(data));
}

std::optional<VoiceState> VoiceDesk::state(std::int64_t now_ns) const {
  if (!isRecording()) return {};
  VoiceState state = heard_;
  state.quiet_s = quiet_.quiet_s(now_ns);
  state.reminder = quiet_.isReminding();
  return state;
}

std::string VoiceDesk::reminder(std::int64_t now_ns) const {
  if (!quiet_.isReminding() || now_ns - reminded_ns_ > kShown_ns) return "";
  return fmt::format("{:.0f} s quiet: What are you doing?", parts_.silence_s);
}

std::string VoiceDesk::missing() const {
  if (!isRecording() || heard_.green_s >= kGreen_s) return "";
  return fmt::format("{:.0f} of {:.0f} s of speech in the green: {}", heard_.green_s, kGreen_s,
                     heard_.level_db > -9.0 ? "further from the microphone" : "speak aloud, nearer to the microphone");
}

}  // namespace app
