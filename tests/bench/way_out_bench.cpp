// The search of a way out in the scenes of reference/extraction 7; the answer without what was in the way beside it.
#include <cstdio>

#include "haptics/body/surface_points.h"
#include "haptics/body/way_bound.h"
#include "tests/bench/extraction_parts.h"
#include "tests/haptics/way_out_scene.h"

namespace bench {

namespace {

void benchParts() {
  const haptics::phantom::WayOutScene scene = haptics::phantom::openSlot();
  const auto& [grid, solid] = scene.bone;
  constexpr double kBand_mm = 4.5;
  const double field_us = p10_us(5, [&] { haptics::DistanceField(grid, solid, kBand_mm); });
  const haptics::DistanceField field(grid, solid, kBand_mm);
  const haptics::DistanceField piece(scene.piece.grid, scene.piece.solid, 2.0);
  const haptics::SurfacePoints points = haptics::surfacePoints(piece, glm::dvec3(0.0), 0.5);
  double sum_mm3 = 0.0;
  const auto per_point_ns = [&](double height_mm) {
    const haptics::Placement there{{0.0, 0.0, height_mm}, {1.0, 0.0, 0.0, 0.0}};
    const double us = p10_us(50, [&] { sum_mm3 += haptics::overlap_mm3(points, there, field, haptics::kPlay_mm); });
    return 1e3 * us / static_cast<double>(points.at_mm.size());
  };
  std::printf("field: %.0f ns a voxel; a point: %.1f ns in the air, %.1f in the slot, %.1f in bone\n",
              1e3 * field_us / static_cast<double>(grid.voxelCount()), per_point_ns(40.0), per_point_ns(0.0),
              per_point_ns(-12.0));
  const double bound_us = p10_us(5, [&] {
    haptics::WayBound(field, {glm::dvec3(0.0), 4.0}, {0.0, 0.0, 1.0}, 12.0, 3.0, 18.0);
  });
  std::printf("bound: %.0f ms\n", 1e-3 * bound_us);
}

}  // namespace

void benchWayOut() {
  benchParts();
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
