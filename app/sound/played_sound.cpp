#include "app/sound/played_sound.h"

#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>

#include "app/text/usage_error.h"

namespace app {
namespace {

constexpr std::uint64_t kKeptSamples = 1U << 17U;
constexpr double kSecond_ns = 1e9;

}  // namespace

struct PlayedSound::Shared {
  std::atomic<std::uint64_t> turn;  ///< odd while the three below change
  std::atomic<std::uint64_t> written;
  std::atomic<std::int64_t> at_ns;  ///< when the sample with the number `first` was handed over
  std::atomic<std::uint64_t> first;
  std::atomic<double> rate_Hz;
  std::atomic<float> samples[kKeptSamples];
};

PlayedSound::PlayedSound() : memory_(::memfd_create("molar sound", MFD_CLOEXEC)), shared_(nullptr) {
  void* there = MAP_FAILED;
  if (memory_ >= 0 && ::ftruncate(memory_, sizeof(Shared)) == 0)
    there = ::mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED, memory_, 0);
  if (there == MAP_FAILED) {
    if (memory_ >= 0) ::close(memory_);
    throw UsageError("shared memory: there is none for the sound, close other programs");
  }
  shared_ = static_cast<Shared*>(there);
}

PlayedSound::~PlayedSound() {
  ::munmap(shared_, sizeof(Shared));
  ::close(memory_);
}

void PlayedSound::add(std::span<const float> samples, double rate_Hz, std::int64_t now_ns) noexcept {
  Shared& shared = *shared_;
  const std::uint64_t first = shared.written.load(std::memory_order_relaxed);
  for (std::size_t n = 0; n < samples.size(); ++n)
    shared.samples[(first + n) % kKeptSamples].store(samples[n], std::memory_order_relaxed);
  const std::uint64_t turn = shared.turn.load(std::memory_order_relaxed);
  shared.turn.store(turn + 1);
  shared.written.store(first + samples.size());
  shared.first.store(first);
  shared.at_ns.store(now_ns);
  shared.rate_Hz.store(rate_Hz);
  shared.turn.store(turn + 2);
}

PlayedSoundReader::PlayedSoundReader(int descriptor, double rate_Hz) : rate_Hz_(rate_Hz) {
  struct stat about {};
  if (descriptor < 0 || ::fstat(descriptor, &about) != 0 ||
      about.st_size < static_cast<off_t>(sizeof(PlayedSound::Shared)))
    return;
  void* const there = ::mmap(nullptr, sizeof(PlayedSound::Shared), PROT_READ, MAP_SHARED, descriptor, 0);
  if (there != MAP_FAILED) shared_ = static_cast<const PlayedSound::Shared*>(there);
}

PlayedSoundReader::~PlayedSoundReader() {
  if (shared_ != nullptr) ::munmap(const_cast<PlayedSound::Shared*>(shared_), sizeof(PlayedSound::Shared));
}

void PlayedSoundReader::read(std::int64_t from_ns, std::span<float> out) {
  std::ranges::fill(out, 0.0F);
  if (shared_ == nullptr) return;
  constexpr int kTries = 100;
  for (int n = 0; n < kTries; ++n) {
    const std::uint64_t turn = shared_->turn.load();
    const auto written = static_cast<double>(shared_->written.load());
    const auto first = static_cast<double>(shared_->first.load());
    const std::int64_t at_ns = shared_->at_ns.load();
    const double rate_Hz = shared_->rate_Hz.load();
    if (turn % 2 != 0 || turn != shared_->turn.load()) continue;
    if (!(rate_Hz >= 8e3 && rate_Hz <= 400e3) || written > 1e15) return;
    // The card asks for pieces, so its times scatter: the place is drawn towards them, and jumps only where far off.
    constexpr double kFar_s = 0.03, kPull = 0.02, kMost = 0.25;
    const double there = first + static_cast<double>(from_ns - at_ns) / kSecond_ns * rate_Hz;
    if (!(std::abs(there - position_) <= kFar_s * rate_Hz)) position_ = there;
    position_ += std::clamp(kPull * (there - position_), -kMost, kMost);
    const double step = rate_Hz / rate_Hz_;
    const double oldest = written - static_cast<double>(kKeptSamples) / 2.0;
    for (float& sample : out) {
      const double whole = std::floor(position_), part = position_ - whole;
      if (whole >= 0.0 && whole >= oldest && whole + 1.0 < written) {
        const auto index = static_cast<std::uint64_t>(whole);
        const double one = shared_->samples[index % kKeptSamples].load(std::memory_order_relaxed);
        const double next = shared_->samples[(index + 1) % kKeptSamples].load(std::memory_order_relaxed);
        const double value = one + part * (next - one);
        sample = value >= -1.0 && value <= 1.0 ? static_cast<float>(value) : 0.0F;
      }
      position_ += step;
    }
    return;
  }
}

}  // namespace app
