// Pieces of a tooth of 16 x 16 x 24 mm with a slot: a changed brick, the join, the bridge; twins voxel by voxel.
#include <cmath>
#include <cstdio>

#include "assets/ct_volume.h"
#include "haptics/body/bridge_break.h"
#include "haptics/body/tooth_survey.h"
#include "tests/bench/extraction_parts.h"
#include "tests/haptics/tooth_phantom.h"

namespace bench {
namespace {

using haptics::phantom::ToothPhantom;

/// Crown, trunk and two roots; sectioned from the buccal side to `depth_mm` of 10.
ToothPhantom toothOf(double spacing_mm, double depth_mm) {
  const glm::ivec3 size(glm::ceil(glm::dvec3(16.0, 16.0, 24.0) / spacing_mm));
  ToothPhantom tooth(size, spacing_mm);
  assets::forVoxels(tooth.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p = tooth.grid.centre_P_mm(ijk) - glm::dvec3(0, 0, 2);
    const double crown = (glm::length((p - glm::dvec3(0, 0, 3.6)) / glm::dvec3(5.5, 5.0, 4.2)) - 1.0) * 4.2;
    const double trunk = std::max(std::hypot(p.x / 1.15, p.y) - 4.2, std::abs(p.z) - 2.5);
    const double down = std::clamp(-p.z / 11.0, 0.0, 1.0);
    const auto root = [&](double side) {
      return std::hypot(std::hypot(p.x - side * (2.6 + 1.2 * down), p.y), p.z + 11.0 * down) - (2.5 - 1.6 * down);
    };
    double d_mm = std::min({crown, trunk, root(1.0), root(-1.0)});
    const double slot = std::max(std::abs(p.z + 1.0) - 0.8, p.y + 5.0 - depth_mm);
    d_mm = std::max(d_mm, -slot);
    tooth.solid[v] = haptics::phantom::softEdge(d_mm, spacing_mm);
  });
  return tooth;
}

/// Labels of all voxels by a flood fill, the moments of each component summed.
std::size_t floodedVoxels(const ToothPhantom& tooth) {
  std::vector<std::uint8_t> seen(tooth.solid.size(), 0);
  std::vector<glm::ivec3> queue;
  std::size_t pieces = 0;
  glm::dmat3 second(0.0);
  assets::forVoxels(glm::ivec3(0), tooth.grid.size, [&](glm::ivec3 start) {
    const auto visit = [&](glm::ivec3 ijk) {
      if (!tooth.grid.contains(ijk)) return;
      const std::size_t v = tooth.grid.index(ijk);
      if (seen[v] != 0 || tooth.solid[v] < assets::kHalfSolid) return;
      seen[v] = 1;
      queue.push_back(ijk);
    };
    queue.clear();
    visit(start);
    for (std::size_t head = 0; head < queue.size(); ++head) {
      const glm::ivec3 at = queue[head];
      second += glm::outerProduct(glm::dvec3(at), glm::dvec3(at));
      for (int axis = 0; axis < 3; ++axis)
        for (const int step : {-1, 1}) {
          glm::ivec3 beside = at;
          beside[axis] += step;
          visit(beside);
        }
    }
    pieces += queue.empty() ? 0 : 1;
  });
  return second[0][0] > 0.0 ? pieces : 0;
}

}  // namespace

void benchPieces() {
  const double spacing_mm = 0.2;
  const ToothPhantom whole = toothOf(spacing_mm, 0.0), cut = toothOf(spacing_mm, 7.0);
  haptics::Components components(cut.grid, cut.solid);
  std::vector<std::pair<glm::ivec3, std::array<std::uint8_t, 512>>> changed;
  assets::forVoxels(glm::ivec3(0), cut.grid.bricks(), [&](glm::ivec3 brick) {
    const auto bytes = haptics::phantom::brickOf(cut, brick);
    if (bytes != haptics::phantom::brickOf(whole, brick)) changed.emplace_back(brick, bytes);
  });
  const double bricks_us = p10_us(200, [&] {
    for (const auto& [brick, bytes] : changed) components.update(brick, bytes);
  });
  const double brick_us = bricks_us / static_cast<double>(changed.size());
  const double join_us = p10_us(200, [&] { components.join(); });
  std::size_t pieces = 0;
  const double flood_us = p10_us(5, [&] { pieces = floodedVoxels(cut); });
  std::printf("pieces of a tooth at %.2f mm, %zu changed bricks, %zu piece(s)\n", spacing_mm, changed.size(), pieces);
  std::printf("  a changed brick %.2f us, join of all %.0f us; flood fill of the volume %.0f us\n", brick_us, join_us,
              flood_us);
  std::printf("  after 12 changed bricks: 1 / %.0f of the flood fill\n", flood_us / (12.0 * brick_us + join_us));

  std::printf("bridge of a slot          0.30 mm: mm2, ms     0.15 mm: mm2, ms    ratio, plan of its break, ms\n");
  const ToothPhantom uncut = toothOf(0.15, 0.0);
  for (const double depth_mm : {5.0, 6.0, 7.0, 8.0, 9.0}) {
    const ToothPhantom now = toothOf(0.15, depth_mm);
    haptics::ToothSurvey survey(uncut.grid, uncut.solid);
    assets::forVoxels(glm::ivec3(0), now.grid.bricks(),
                      [&](glm::ivec3 brick) { survey.update(brick, haptics::phantom::brickOf(now, brick)); });
    haptics::ToothFindings found = survey.pieces();
    std::array<double, 2> ms{}, mm2{};
    for (std::size_t n = 0; n < 2; ++n) {
      ms[n] = 1e-3 * p10_us(5, [&] { survey.findBridges(found, n == 0 ? 0.30 : 0.15); });
      mm2[n] = found.held[0].bridge[0].area_mm2;
    }
    const haptics::Components& cut_tooth = survey.components();
    const double break_ms = 1e-3 * p10_us(3, [&] { haptics::breakPlan(cut_tooth, {}, found.held[0].bridge[0]); });
    std::printf("  depth %.0f mm                    %6.2f %8.2f      %6.2f %8.2f   %6.1f %8.2f\n", depth_mm, mm2[0],
                ms[0], mm2[1], ms[1], ms[1] / ms[0], break_ms);
  }
}

}  // namespace bench
