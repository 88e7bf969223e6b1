// Can a piece of tooth come out of what is around it, and what is in its way? A search over poses in which solid may be
// cut at a price: the answer is a way with little to cut, and the voxels that it cuts. An upper bound: "blocked" tells
// what is enough to take away, not the least. Straight out is always a way, so one is always found. Frame and mm of the
// obstacles' grid. Worker threads; 0.2 to 2 s, some 5 s for a whole tooth in its socket; allocates. A pure function:
// the same bytes give the same bits. Method and figures: reference/extraction 7 (A* over 12 moves; least constraint
// removal, Erickson and LaValle, AAAI 2013).
#pragma once

#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "assets/volume_grid.h"
#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"

namespace haptics {

enum class WayOutAnswer {
  free,       ///< less than kGrazes_mm3 to cut
  grazes,     ///< less than kBlocked_mm3: within what voxels can tell of a tight way
  blocked,    ///< a way, once that much is cut
  not_found,  ///< nothing solid to take out
};

inline constexpr double kGrazes_mm3 = 0.05, kBlocked_mm3 = 2.0;
/// Overlap up to here is no contact.
inline constexpr double kPlay_mm = 0.1;

struct WayOutGoal {
  glm::dvec3 direction{0.0, 0.0, 1.0};  ///< unit
  double distance_mm = 12.0;            ///< along it, of the middle of the piece's thickest part
  /// Not what has the least to cut: what is cut is weighed in every pose that is tried, which spreads the search and
  /// takes some times longer. For a hand that makes room for the pieces after this one, too.
  bool is_roomy = false;
};

struct WayOut {
  WayOutAnswer answer = WayOutAnswer::not_found;
  /// From where the piece lies to where it is out. Empty: not found.
  std::vector<calibration::Pose<calibration::Patient, calibration::Piece>> path_X_PQ;
  double length_mm = 0.0, turned_rad = 0.0;  ///< of the middle of the thickest part; largest turn from the start
  std::vector<std::size_t> in_the_way;       ///< voxels of the obstacles, ascending
  double in_the_way_mm3 = 0.0;
  std::size_t poses = 0;  ///< that were looked at
};

struct SolidVoxels {
  assets::VolumeGrid grid;
  std::span<const std::uint8_t> solid;  ///< in the order of the grid
};

/// Both where they are now. The obstacles' grid should reach goal.distance_mm beyond the piece; outside it the nearest
/// place of it counts. Without a solid voxel of the piece: not found; also when it was told to stop, which takes some
/// tenths of a second at most.
WayOut findWayOut(const SolidVoxels& obstacles, const SolidVoxels& piece, const WayOutGoal& goal,
                  const std::stop_token& stop = {});

}  // namespace haptics
