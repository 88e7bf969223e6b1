#include "app/evaluation/voice/microphone.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <span>

#include "app/evaluation/voice/speech_detector.h"
#include "app/sound/sound_input.h"
#include "app/sound/sound_reader.h"
#include "app/text/usage_error.h"
#include "haptics/spsc_ring.h"

namespace app {
namespace {

class CardMicrophone : public Microphone {
 public:
  explicit CardMicrophone(const std::function<void(const std::string&)>& report)
      : input_(
            kVoiceRate_Hz, [this](std::span<const float> samples, bool overrun) { take(samples, overrun); }, report) {}

  bool isThere() const { return input_.isAvailable(); }
  void takeInto(std::vector<HeardBlock>& heard, std::int64_t) override { ring_.drainInto(heard); }

 private:
  /// On PortAudio's thread.
  void take(std::span<const float> samples, bool overrun) noexcept {
    const std::int64_t now_ns = std::chrono::steady_clock::now().time_since_epoch().count();
    if (ring_.room() <= samples.size() / HeardBlock::kMost + 1) {
      lost_ += samples.size();
      lost_overrun_ = lost_overrun_ || overrun;
      return;
    }
    while (!samples.empty()) {
      block_.count = static_cast<std::uint32_t>(std::min(samples.size(), HeardBlock::kMost));
      std::copy_n(samples.begin(), block_.count, block_.samples.begin());
      samples = samples.subspan(block_.count);
      block_.overrun = overrun || lost_overrun_, block_.lost = lost_;
      block_.t_ns = samples.empty() ? now_ns : 0;
      ring_.push(block_);
      overrun = lost_overrun_ = false, lost_ = 0;
    }
  }

  static constexpr std::size_t kWaiting = 4096;  ///< 10 s where pieces are whole
  haptics::SpscRing<HeardBlock> ring_{kWaiting};
  HeardBlock block_;
  std::uint64_t lost_ = 0;
  bool lost_overrun_ = false;
  SoundInput input_;  ///< last: its thread uses the others
};

class FileMicrophone : public Microphone {
 public:
  explicit FileMicrophone(const std::string& file) : reader_(file, kVoiceRate_Hz) {}

  void takeInto(std::vector<HeardBlock>& heard, std::int64_t now_ns) override {
    if (!begun_ns_) begun_ns_ = now_ns;
    constexpr std::uint32_t kPiece = 120;  ///< a fourth of 10 ms
    for (;;) {
      constexpr std::int64_t kSecond_ns = 1'000'000'000;
      const auto frames = static_cast<std::int64_t>(frames_ + kPiece);
      const std::int64_t arrives_ns =
          *begun_ns_ + frames / kVoiceRate_Hz * kSecond_ns + frames % kVoiceRate_Hz * kSecond_ns / kVoiceRate_Hz;
      if (arrives_ns > now_ns) return;
      HeardBlock& block = heard.emplace_back();
      block.count = kPiece, block.t_ns = arrives_ns;
      reader_.read(std::span(block.samples).first(kPiece));
      frames_ += kPiece;
    }
  }

 private:
  SoundReader reader_;
  std::optional<std::int64_t> begun_ns_;
  std::uint64_t frames_ = 0;
};

}  // namespace

MicrophoneChoice microphoneFrom(const std::string& text) {
  constexpr std::string_view kFile = "file:", kRealtime = ",realtime";
  MicrophoneChoice choice;
  choice.is_none = text == "none";
  if (text == "default" || choice.is_none) return choice;
  if (!text.starts_with(kFile))
    throw UsageError("--microphone " + text + ": give default, none, file:F.wav or file:F.wav,realtime");
  choice.file = text.substr(kFile.size());
  choice.is_realtime = choice.file.ends_with(kRealtime);
  if (choice.is_realtime) choice.file.resize(choice.file.size() - kRealtime.size());
  SoundReader(choice.file, kVoiceRate_Hz);
  return choice;
}

std::unique_ptr<Microphone> openMicrophone(const std::function<void(const std::string&)>& report) {
  auto found = std::make_unique<CardMicrophone>(report);
  return found->isThere() ? std::move(found) : nullptr;
}

std::unique_ptr<Microphone> fileMicrophone(const std::string& file) { return std::make_unique<FileMicrophone>(file); }

}  // namespace app
