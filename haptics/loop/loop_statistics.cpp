#include "haptics/loop/loop_statistics.h"

#include <algorithm>

namespace haptics {
namespace {

constexpr auto kRelaxed = std::memory_order_relaxed;

}  // namespace

void MicrosecondHistogram::add(double us) {
  const auto bin = static_cast<std::size_t>(std::clamp(us, 0.0, static_cast<double>(kBins - 1)));
  bins_[bin].store(bins_[bin].load(kRelaxed) + 1, kRelaxed);
  max_us_.store(std::max(max_us_.load(kRelaxed), us), kRelaxed);
}

double MicrosecondHistogram::percentile_us(double share) const {
  std::uint64_t counted = 0;
  for (const auto& bin : bins_) counted += bin.load(kRelaxed);
  if (counted == 0) return 0.0;
  std::uint64_t below = 0;
  for (std::size_t bin = 0; bin + 1 < kBins; ++bin) {
    below += bins_[bin].load(kRelaxed);
    if (static_cast<double>(below) >= share * static_cast<double>(counted)) return static_cast<double>(bin) + 0.5;
  }
  return max_us();
}

void LoopStatistics::add(double work_us, double period_us, double late_us) {
  if (work_us > period_us) overruns_.store(overruns_.load(kRelaxed) + 1, kRelaxed);
  work_.add(work_us);
  late_.add(late_us);
  ticks_.store(ticks_.load(kRelaxed) + 1, kRelaxed);
}

void LoopStatistics::addMissed(std::uint64_t deadlines) { missed_.store(missed_.load(kRelaxed) + deadlines, kRelaxed); }

void LoopStatistics::setGrants(const RealtimeGrants& grants) {
  realtime_.store(grants.priority, kRelaxed);
  memory_locked_.store(grants.memory_locked, kRelaxed);
  core_.store(grants.core.value_or(-1), kRelaxed);
}

LoopFigures LoopStatistics::figures() const {
  LoopFigures figures;
  figures.ticks = ticks_.load(kRelaxed);
  figures.missed = missed_.load(kRelaxed);
  figures.overruns = overruns_.load(kRelaxed);
  figures.work_p50_us = work_.percentile_us(0.50);
  figures.work_p99_us = work_.percentile_us(0.99);
  figures.work_p999_us = work_.percentile_us(0.999);
  figures.work_max_us = work_.max_us();
  figures.late_p50_us = late_.percentile_us(0.50);
  figures.late_p99_us = late_.percentile_us(0.99);
  figures.late_max_us = late_.max_us();
  figures.grants.priority = realtime_.load(kRelaxed);
  figures.grants.memory_locked = memory_locked_.load(kRelaxed);
  if (const int core = core_.load(kRelaxed); core >= 0) figures.grants.core = core;
  return figures;
}

}  // namespace haptics
