// The form of a cut (reference/product 4.2): O7, its profile in stations of 0.5 mm along a straight line: depth below
// the surface as it was, width, section; and O8, gouges: where the cut's floor lies more than 0.5 mm below its median
// within 2 mm. The floor is a map over the plane square to `outward`, of columns 1.5 voxels wide. Frame P, mm. Pure
// functions; any thread; some tens of ms.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "app/session/measures/removal_clock.h"

namespace app {

/// Unit, square to each other: along the cut, across it, out of the bone.
struct CutAxes {
  glm::dvec3 along_P{0.0}, across_P{0.0}, outward_P{0.0};
};

struct Evenness {
  double mean = 0.0, variation = 0.0;  ///< standard deviation over mean
};
struct TroughProfile {
  Evenness depth_mm, width_mm;
  double section_mm2 = 0.0;  ///< mean
  double length_mm = 0.0;    ///< of the stations that were cut
};
inline constexpr double kStation_mm = 0.5;

/// `counts`: of a voxel; `depth_mm`: of a place below the surface as it was. Stations with less than half of the median
/// section are the cut's ends and do not count. None: fewer than three stations.
std::optional<TroughProfile> troughProfile(const RemovalClock& clock, const CutAxes& axes,
                                           const std::function<bool(std::size_t)>& counts,
                                           const std::function<double(const glm::dvec3&)>& depth_mm);

struct Gouges {
  int count = 0;
  double deepest_mm = 0.0;  ///< below the median; 0: none
};
inline constexpr double kGouge_mm = 0.5, kAroundGouge_mm = 2.0;

/// None: fewer than ten columns were cut.
std::optional<Gouges> gougesIn(const RemovalClock& clock, const CutAxes& axes,
                               const std::function<bool(std::size_t)>& counts);

}  // namespace app
