#include "app/device/check/check_steps.h"

#include <chrono>
#include <utility>

#include <fmt/core.h>

namespace app {
namespace {

constexpr auto kPollInterval = std::chrono::milliseconds(10);
constexpr int kMaxPolls = 1000, kMaxPollsAtRest = 300, kQuietPolls = 30;
constexpr double kAtRest_mm_per_s = 20.0;
constexpr double kSteady = 0.01;

}  // namespace

bool pushUntilSteady(CheckBench& bench, const glm::dvec3& force_D_N) {
  bench.hand.rearm();
  bench.hand.push(force_D_N);
  const double asked_N = glm::length(force_D_N);
  for (int i = 0; i < kMaxPolls; ++i) {
    if (glm::length(bench.hand.newest().lately_D_N - force_D_N) <= kSteady * asked_N) return true;
    bench.hand.wait(kPollInterval);
  }
  return false;
}

void letGo(CheckBench& bench) {
  bench.hand.push(glm::dvec3(0.0));
  for (int i = 0; i < kMaxPolls && glm::length(bench.hand.newest().pushed_D_N) > 0.0; ++i)
    bench.hand.wait(kPollInterval);
}

ConstantForceLoop::Seen stateAtRest(CheckBench& bench) {
  int quiet = 0;
  std::uint64_t ticks = bench.hand.newest().ticks;
  for (int i = 0; i < kMaxPollsAtRest && quiet < kQuietPolls; ++i) {
    bench.hand.wait(kPollInterval);
    const ConstantForceLoop::Seen& seen = bench.hand.newest();
    // A device that has not ticked since has not come to rest.
    if (std::exchange(ticks, seen.ticks) == seen.ticks) continue;
    quiet = glm::length(seen.state.velocity_D_mm_per_s.xyz) < kAtRest_mm_per_s ? quiet + 1 : 0;
  }
  return bench.hand.newest();
}

std::string newtons(const glm::dvec3& force_N) {
  return fmt::format("{:+.2f}, {:+.2f}, {:+.2f} N", force_N.x, force_N.y, force_N.z);
}

}  // namespace app
