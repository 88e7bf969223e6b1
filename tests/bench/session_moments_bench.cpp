// Jumps in a recorded session: `session_moments_bench S.molar [JUMPS]`. Prints what running it once costs, what the
// keyframes hold, and the wall time of jumps to random moments; each must give the digest that was recorded.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <utility>
#include <vector>

#include "app/session/session_moments.h"

namespace {

double millisecondsSince(std::chrono::steady_clock::time_point begun) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begun).count();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "session_moments_bench S.molar [JUMPS]\n");
    return 2;
  }
  const auto begun = std::chrono::steady_clock::now();
  app::SessionMoments moments(argv[1]);
  std::vector<std::pair<double, std::uint64_t>> recorded;
  while (moments.index(10.0, [&](const haptics::Tick& tick, const haptics::Command&) {
    recorded.emplace_back(tick.t_s, tick.bone_digest);
  })) {
  }
  std::printf(
      "%.0f s of session run again in %.1f s%s\n%zu keyframes, every %.0f s: %.0f MB, with the bodies %.0f MB\n",
      moments.length_s(), millisecondsSince(begun) / 1e3, moments.difference() ? ", not as recorded" : "",
      moments.keyframes(), moments.betweenKeyframes_s(), static_cast<double>(moments.keyframeBytes()) / 1e6,
      static_cast<double>(moments.bytes()) / 1e6);
  std::mt19937_64 random(1);
  std::vector<double> jumps_ms;
  int wrong = 0;
  for (int n = argc > 2 ? std::atoi(argv[2]) : 200; n > 0; --n) {
    const std::size_t last = random() % recorded.size();
    const auto from = std::chrono::steady_clock::now();
    moments.goTo(recorded[last].first + 1e-6);
    jumps_ms.push_back(millisecondsSince(from));
    wrong += moments.bodies().digest() == recorded[last].second ? 0 : 1;
  }
  std::ranges::sort(jumps_ms);
  std::printf("%zu jumps: median %.0f ms, 99 %% below %.0f ms, longest %.0f ms; %d with another digest\n",
              jumps_ms.size(), jumps_ms[jumps_ms.size() / 2], jumps_ms[jumps_ms.size() * 99 / 100], jumps_ms.back(),
              wrong);
  return wrong == 0 ? 0 : 1;
}
