#include "haptics/servo/servo_statistics.h"

#include <algorithm>

namespace haptics {
namespace {

constexpr auto kRelaxed = std::memory_order_relaxed;

}  // namespace

void ServoStatistics::add(double work_us, double late_us) {
  const auto bin = static_cast<std::size_t>(std::clamp(work_us, 0.0, static_cast<double>(kBins - 1)));
  work_[bin].store(work_[bin].load(kRelaxed) + 1, kRelaxed);
  work_max_us_.store(std::max(work_max_us_.load(kRelaxed), work_us), kRelaxed);
  latest_us_.store(std::max(latest_us_.load(kRelaxed), late_us), kRelaxed);
  ticks_.store(ticks_.load(kRelaxed) + 1, kRelaxed);
}

void ServoStatistics::addMissed(std::uint64_t deadlines) {
  missed_.store(missed_.load(kRelaxed) + deadlines, kRelaxed);
}

void ServoStatistics::setGrants(bool realtime, bool memory_locked) {
  realtime_.store(realtime, kRelaxed);
  memory_locked_.store(memory_locked, kRelaxed);
}

ServoFigures ServoStatistics::figures() const {
  ServoFigures figures;
  figures.ticks = ticks_.load(kRelaxed);
  figures.missed = missed_.load(kRelaxed);
  figures.work_max_us = work_max_us_.load(kRelaxed);
  figures.latest_us = latest_us_.load(kRelaxed);
  figures.realtime = realtime_.load(kRelaxed);
  figures.memory_locked = memory_locked_.load(kRelaxed);

  std::uint64_t counted = 0;
  for (const auto& bin : work_) counted += bin.load(kRelaxed);
  const auto percentile = [&](double share) {
    std::uint64_t below = 0;
    for (std::size_t bin = 0; bin < kBins; ++bin) {
      below += work_[bin].load(kRelaxed);
      if (static_cast<double>(below) >= share * static_cast<double>(counted)) return static_cast<double>(bin) + 0.5;
    }
    return figures.work_max_us;
  };
  if (counted != 0) {
    figures.work_p50_us = percentile(0.50);
    figures.work_p99_us = percentile(0.99);
  }
  return figures;
}

}  // namespace haptics
