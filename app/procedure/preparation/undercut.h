// P5: what a crown could not be put over (reference/sisters 5.3). Column by column along the way of insertion, from the
// bite to the margin: the most that was met so far, less what is there. And the way of insertion within 5 degrees of
// the tooth's axis with the least of it. The crown is sampled once in the tooth's frame. mm, rad. Any thread; some
// 70 ms to sample, 4 ms a way.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "app/procedure/preparation/crown.h"
#include "app/procedure/preparation/deviation.h"

namespace app {

class CrownColumns {
 public:
  /// From the margin to the top; `solid`: the crown as it is.
  CrownColumns(const Crown& crown, const BoxBytes& solid, double margin_mm);

  /// Of a way whose slopes are `lean` a mm towards the bite, to mesial and to the cheek.
  double undercut_mm3(const glm::dvec2& lean) const;

 private:
  std::size_t index(int x, int y, int level) const {
    const auto side = static_cast<std::size_t>(side_);
    return (static_cast<std::size_t>(level) * side + static_cast<std::size_t>(y)) * side + static_cast<std::size_t>(x);
  }

  /// Columns from..end of a row that hold something.
  struct Stretch {
    int from = 1 << 20, end = 0;
    void take(const Stretch& other) { from = std::min(from, other.from), end = std::max(end, other.end); }
  };
  const Stretch& stretch(int y, int level) const {
    return stretches_[static_cast<std::size_t>(level) * static_cast<std::size_t>(side_) + static_cast<std::size_t>(y)];
  }

  double column_mm_, step_mm_, low_mm_;
  int side_ = 0, levels_ = 0;
  std::vector<std::uint8_t> bytes_;
  std::vector<Stretch> stretches_;  ///< of all rows
};

struct InsertionWay {
  glm::dvec2 lean{0.0};  ///< slopes to mesial and to the cheek
  double off_axis_rad = 0.0;
  double undercut_mm3 = 0.0;
};

/// Columns for the search, and what is found told by finer ones. The tooth's axis itself where nothing is better by
/// more than the last digit.
InsertionWay bestInsertion(const CrownColumns& columns);

/// Towards the bite, unit, P.
glm::dvec3 wayOf(const InsertionWay& insertion, const assets::ToothFrame& frame);

/// Of the prepared surface, what stands under something along the way; roughness of the voxels does not count. Some 60
/// ms.
std::vector<glm::dvec3> undercutPlaces_P_mm(const Crown& crown, const BoxBytes& made,
                                            std::span<const DeviationPlace> surface, const glm::dvec3& way_P);

}  // namespace app
