// A block of bone from which balls are taken along a way, as a bur does it: ticks, and the bone that is left.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "app/session/measures/removal_clock.h"
#include "assets/tissue.h"

namespace app::test {

struct Removal {
  assets::VolumeGrid grid;
  std::vector<std::uint8_t> before, after, label;
  std::vector<haptics::Tick> ticks;
  haptics::Tool tool{{haptics::ShapeKind::sphere, 1.0, 0.0}, {}};

  explicit Removal(glm::ivec3 size, double spacing_mm = 0.25)
      : grid{size, spacing_mm, glm::dvec3(0.0)},
        before(grid.voxelCount(), 0),
        label(grid.voxelCount(), static_cast<std::uint8_t>(assets::Tissue::cortical)) {}

  /// Solid by the distance to a surface, negative inside.
  template <class Distance>
  void fill(const Distance& distance_mm) {
    assets::forVoxels(grid,
                      [&](glm::ivec3 ijk, std::size_t v) { before[v] = grey(-distance_mm(grid.centre_P_mm(ijk))); });
    after = before;
  }
  /// The ball stands here in the next tick.
  void ball(const glm::dvec3& centre_P_mm) {
    assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
      after[v] = std::min(after[v], grey(glm::distance(grid.centre_P_mm(ijk), centre_P_mm) - tool.head.radius_mm));
    });
    stand(centre_P_mm);
  }
  void stand(const glm::dvec3& centre_P_mm) {
    haptics::Tick tick;
    tick.dt_s = 0.001;
    tick.index = ticks.size();
    tick.t_s = 0.001 * static_cast<double>(ticks.size());
    tick.proxy_P.mm = centre_P_mm;
    tick.drilling = true;
    tick.removed_mm3 = 0.01;
    tick.overlap_mm3 = 0.1;
    ticks.push_back(tick);
  }
  RemovalClock clock() const {
    RemovalClock clock(grid, before, after);
    for (const haptics::Tick& tick : ticks) clock.add(tick, tool);
    return clock;
  }

 private:
  std::uint8_t grey(double inside_mm) const {
    return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(0.5 + inside_mm / grid.spacing_mm, 0.0, 1.0)));
  }
};

}  // namespace app::test
