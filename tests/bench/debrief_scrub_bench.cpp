// How fast a debrief follows a hand that drags along the time line, without a window: `debrief_scrub_bench S.molar
// [S2.molar] [WxH]`. Prints, for jumps to random moments and for a drag through the session, what the way to the moment
// and its picture cost on the processor; the window adds copying the picture.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "app/debrief/debrief_scene.h"
#include "render/quality_ladder.h"

namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point begun) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begun).count();
}

struct Times {
  std::vector<double> move_ms, draw_ms, all_ms;

  void tell(const char* what) {
    for (auto* const times : {&move_ms, &draw_ms, &all_ms}) std::ranges::sort(*times);
    const std::size_t half = all_ms.size() / 2, most = all_ms.size() * 95 / 100;
    std::printf(
        "%-28s %4zu: to the moment %4.0f ms, picture %4.0f ms; together median %4.0f, 95 %% %4.0f, longest %4.0f ms\n",
        what, all_ms.size(), move_ms[half], draw_ms[half], all_ms[half], all_ms[most], all_ms.back());
  }
};

}  // namespace

int main(int argc, char** argv) {
  app::DebriefPlan plan;
  for (int n = 1; n < argc; ++n) {
    const std::string word = argv[n];
    if (word.ends_with(".molar"))
      plan.sessions.push_back(word);
    else if (std::sscanf(argv[n], "%dx%d", &plan.size_px.x, &plan.size_px.y) != 2)
      plan.sessions.clear();
  }
  if (plan.sessions.empty()) {
    std::fprintf(stderr, "debrief_scrub_bench S.molar [S2.molar] [WxH]\n");
    return 2;
  }
  app::DebriefScene scene(plan);
  render::RenderOptions options;
  options.backend = render::Backend::cpu;
  scene.open(options);
  const Clock::time_point begun = Clock::now();
  scene.prepareTo(1e9);
  std::printf("%.0f s run again in %.1f s\n", scene.length_s(), millisecondsSince(begun) / 1e3);

  const auto measure = [&](const char* what, const std::vector<double>& at_s, bool scrubs) {
    Times times;
    for (const double t_s : at_s) {
      const Clock::time_point from = Clock::now();
      scrubs ? scene.goNear(t_s) : scene.goTo(t_s);
      times.move_ms.push_back(millisecondsSince(from));
      const Clock::time_point moved = Clock::now();
      scene.draw(plan.size_px, app::kScrubQuality);
      times.draw_ms.push_back(millisecondsSince(moved));
      times.all_ms.push_back(millisecondsSince(from));
    }
    times.tell(what);
  };
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> anywhere(0.0, scene.length_s());
  std::vector<double> jumps_s, drag_s;
  for (int n = 0; n < 150; ++n) jumps_s.push_back(anywhere(random));
  // There and back in 300 pictures, as a hand drags.
  for (int n = 0; n < 300; ++n) drag_s.push_back(scene.length_s() * (n < 150 ? n : 300 - n) / 150.0);
  scene.draw(plan.size_px, render::kQualitySteps.back().quality);
  measure("exact, anywhere", jumps_s, false);
  measure("scrubbing, anywhere", jumps_s, true);
  measure("scrubbing, there and back", drag_s, true);
  return 0;
}
