// Where the outer lingual surface of the jaw was cut through (reference/product 4.2: O5), and how much wall is left
// before it (O6). The surface is that of the bone as scanned where it faces the tongue, beside the operated tooth and
// along the crest (app/case/risk_structures): what was open there before does not count, and what was undone neither.
// Frame P, mm, s. Pure functions; any thread; some tens of ms.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "app/session/measures/removal_clock.h"
#include "assets/structure_distance.h"

namespace app {

struct Hole {
  double area_mm2 = 0.0;  ///< faces that look to the tongue
  std::optional<double> first_s;
  glm::dvec3 centre_P_mm{0.0};
};
inline constexpr double kLeastPerforation_mm2 = 0.5;  ///< smaller ones are voxels at the rim

/// The removal with the bone as it lay: labels and solid before and after, in the order of the clock's grid.
struct RemovedBone {
  const RemovalClock& clock;
  std::span<const std::uint8_t> label, before, after;

  /// Bone that was solid and is not any more.
  bool isGone(std::size_t v) const;
};

/// The largest first. `lingual`: what lies beyond the surface; `lingual_P`: unit, towards the tongue.
std::vector<Hole> perforations(const RemovedBone& bone, const assets::StructureDistance& lingual,
                               const glm::dvec3& lingual_P);

/// From the surface to the nearest bone that is gone, 0 where it is through; none: no bone is gone.
std::optional<double> wallLeft_mm(const RemovedBone& bone, const assets::StructureDistance& lingual);

}  // namespace app
