// The search of a way out in the scenes of reference/extraction 7; the answer without what was in the way beside it.
#include <cstdio>

#include "tests/bench/extraction_parts.h"
#include "tests/haptics/way_out_scene.h"

namespace bench {

void benchWayOut() {
  using haptics::phantom::WayOutScene;
  constexpr const char* kAnswers[] = {"free", "grazes", "blocked", "not found"};
  std::printf("way out: scene, answer, in the way mm3, once taken away mm3, way mm, turn rad, poses, CPU s\n");
  for (const WayOutScene& scene :
       {haptics::phantom::openSlot(), haptics::phantom::ledge(0.5), haptics::phantom::ledge(1.0),
        haptics::phantom::ledge(2.0), haptics::phantom::keyAndSlot(), haptics::phantom::curvedRoot(false),
        haptics::phantom::curvedRoot(true)}) {
    const double began_us = threadTime_us();
    const haptics::WayOut way = scene.answer();
    const double took_s = 1e-6 * (threadTime_us() - began_us);
    const double after_mm3 = way.in_the_way.empty() ? 0.0 : scene.without(way.in_the_way).answer().in_the_way_mm3;
    std::printf("  %-32s %-8s %6.2f %6.2f %6.1f %5.2f %6zu %6.2f\n", scene.name.c_str(),
                kAnswers[static_cast<int>(way.answer)], way.in_the_way_mm3, after_mm3, way.length_mm, way.turned_rad,
                way.poses, took_s);
  }
}

}  // namespace bench
