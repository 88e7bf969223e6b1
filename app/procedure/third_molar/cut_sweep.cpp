#include "app/procedure/third_molar/cut_sweep.h"

namespace app {
namespace {

constexpr double kHeldUp_mm = 0.08;

}  // namespace

std::vector<glm::dvec3> placesAlong_P_mm(const assets::PlannedCut& cut) {
  std::vector<glm::dvec3> places_P_mm;
  for (const auto& stroke : cut.strokes_P_mm)
    for (std::size_t n = 0; n < stroke.size(); ++n) {
      const glm::dvec3 to = n + 1 < stroke.size() ? stroke[n + 1] : stroke[n];
      const int steps = 1 + static_cast<int>(glm::distance(stroke[n], to) / kSweepStep_mm);
      for (int k = 0; k < steps; ++k) places_P_mm.push_back(glm::mix(stroke[n], to, static_cast<double>(k) / steps));
    }
  return places_P_mm;
}

void sweep(const assets::PlannedCut& cut, const assets::VolumeGrid& grid, std::span<std::uint8_t> solid) {
  const double radius_mm = cut.bur_radius_mm - kHeldUp_mm;
  for (const glm::dvec3& place : placesAlong_P_mm(cut))
    for (double up_mm = 0.0; up_mm < kCuttingHead_mm; up_mm += 2.0 * kSweepStep_mm) {
      const glm::dvec3 p = place + up_mm * cut.outward_P;
      const glm::ivec3 from(glm::floor(grid.indexFromPoint(p - radius_mm))),
          to(glm::ceil(grid.indexFromPoint(p + radius_mm)));
      assets::forVoxels(glm::max(from, glm::ivec3(0)), glm::min(to + 1, grid.size), [&](glm::ivec3 ijk) {
        if (glm::distance(grid.centre_P_mm(ijk), p) < radius_mm) solid[grid.index(ijk)] = 0;
      });
    }
}

}  // namespace app
