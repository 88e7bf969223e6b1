// Teeth with balls as cusps in closed form, and a plane that opposes them.
#pragma once

#include <vector>

#include "app/procedure/preparation/antagonist.h"
#include "tests/app/procedure/preparation/round_tooth.h"

namespace app::round_tooth {

inline constexpr double kCusp_mm = 2.0, kPlane_mm = 7.0;

struct Cusp {
  glm::dvec2 place_mm;
  double top_mm, radius_mm = kCusp_mm;
};

/// Balls on a tooth that ends at 3.5 mm.
inline shapes::Depth cusps(std::vector<Cusp> all) {
  return [all = std::move(all)](const glm::dvec3& p) {
    double depth_mm = std::min(kRadius_mm - std::hypot(p.x, p.y), 3.5 - p.z);
    for (const Cusp& one : all)
      depth_mm = std::max(depth_mm, one.radius_mm - glm::distance(p, {one.place_mm, one.top_mm - one.radius_mm}));
    return depth_mm;
  };
}

inline Antagonist plane(double height_mm) {
  Antagonist flat;
  for (int y = 0; y < OcclusalRaster::kSide; ++y)
    for (int x = 0; x < OcclusalRaster::kSide; ++x) flat.height_mm.at(x, y) = static_cast<float>(height_mm);
  return flat;
}

/// Of a ball of kCusp_mm as seen along the axis, up to a depth.
inline double cap_mm2(double paper_mm) { return std::numbers::pi * (2.0 * kCusp_mm * paper_mm - paper_mm * paper_mm); }

inline const Scene& bittenScene() {
  static const Scene kScene(0.05, true);
  return kScene;
}
inline OcclusalRaster heightsOf(const shapes::Depth& depth) {
  return occlusalHeights(bittenScene().crown, bittenScene().made(depth));
}

}  // namespace app::round_tooth
