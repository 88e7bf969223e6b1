// What it costs to ask during a rehearsal whether the bur works out of sight: `sight_bench S.molar`. Asks once every
// 16 ms of the session, with the bone as it then was, eyes 400 mm above the site.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

#include "app/session/measures/sight_lines.h"
#include "app/session/session_moments.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "sight_bench S.molar\n");
    return 2;
  }
  app::SessionMoments moments(argv[1]);
  const app::StoredStart& start = moments.start();
  const glm::dvec3 site_P_mm =
      start.setup.site ? start.setup.site->centre_P_mm : start.grid.centre_P_mm(start.grid.size / 2);
  const app::EyesPlace eyes{site_P_mm + glm::dvec3(-31.0, -100.0, 390.0), site_P_mm + glm::dvec3(31.0, -100.0, 390.0),
                            true};
  std::vector<double> times_us;
  int hidden = 0;
  double next_s = 0.0;
  std::vector<std::uint8_t> solid = start.solid;
  double copied_s = -1.0;
  while (moments.index(1.0, [&](const haptics::Tick& tick, const haptics::Command& command) {
    if (tick.t_s < next_s || !tick.drilling || !(tick.removed_mm3 > 0.0)) return;
    next_s = tick.t_s + 0.016;
    if (tick.t_s - copied_s > 1.0) solid = moments.bodies().solidInMouth(), copied_s = tick.t_s;
    const app::SightLines lines{start.grid, solid, start.soft_tissue, {command.assistant_holds, command.flap_aside}};
    const auto begun = std::chrono::steady_clock::now();
    hidden += app::worksOutOfSight(lines, tick, command.tool.head, eyes) ? 1 : 0;
    times_us.push_back(std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begun).count());
  })) {
  }
  if (times_us.empty()) return 1;
  std::ranges::sort(times_us);
  std::printf("%zu frames with removal: median %.0f us, 99 %% below %.0f us, longest %.0f us; %d out of sight\n",
              times_us.size(), times_us[times_us.size() / 2], times_us[times_us.size() * 99 / 100], times_us.back(),
              hidden);
  return 0;
}
