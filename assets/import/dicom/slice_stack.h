// Slices to a volume, by geometry alone: order along the normal of the planes, steps, gantry tilt, gaps, doubles. Never
// by instance number, slice location or thickness, which scanners fill as they like. Positions in P (LPS mm);
// tolerances of reference "DICOM": a step is regular within 0.01 mm or 1 %. Pure; any thread; n log n.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

namespace assets {

/// Of the rows and columns of all slices.
struct SliceAxes {
  glm::dvec3 row_P{1, 0, 0};     ///< along a row, unit
  glm::dvec3 column_P{0, 1, 0};  ///< along a column, unit, at right angles
  bool is_mended = false;        ///< as written they were off by up to 1 %

  glm::dvec3 normal_P() const { return glm::cross(row_P, column_P); }
};

/// None if the directions are off by more than 1 % of unit length or of a right angle.
std::optional<SliceAxes> sliceAxes(const glm::dmat2x3& row_column);

/// Slices between two neighbours that are not there.
struct SliceGap {
  std::size_t before = 0;               ///< place in SliceStack::order of the slice below the gap
  double missing_mm = 0.0;              ///< more than the usual step
  std::optional<int> missing_slices{};  ///< where the gap is a whole number of steps
};

struct SliceStack {
  std::vector<std::size_t> order;  ///< indices of the input, one for each place, lowest along the normal first
  std::vector<double> along_mm;    ///< their places along the normal
  std::vector<std::vector<std::size_t>> doubles;  ///< inputs that lie at one place, two or more of them
  double step_mm = 0.0;                           ///< the usual one; 0 for a single slice
  double smallest_step_mm = 0.0, largest_step_mm = 0.0;
  bool is_regular = true;
  std::vector<SliceGap> gaps;  ///< short holes in a regular row
  /// Slices from which on the step is another one: places in `order`. Empty for a regular stack and one with gaps
  /// alone.
  std::vector<std::size_t> changes;
  glm::dvec3 per_mm_P{0, 0, 1};  ///< displacement for a millimetre along the normal; longer than 1 under tilt
  double tilt_deg = 0.0;
  double sideways_mm = 0.0;  ///< the farthest that a slice lies off the straight line

  double extent_mm() const { return along_mm.empty() ? 0.0 : along_mm.back() - along_mm.front(); }
};

/// Positions of the first pixels of slices of the same axes; at least one.
SliceStack stackOf(const std::vector<glm::dvec3>& positions_P_mm, const SliceAxes& axes);

/// A slice of the volume: between two slices of the stack, `share` of the way from `below` to `above`.
struct MadeSlice {
  std::size_t below = 0, above = 0;  ///< places in `order`
  double share = 0.0;

  bool isInvented() const { return share > 0.0 && share < 1.0; }
};

/// Slices at equal steps that cover the stack: the slices themselves where it is regular, else some between them, at
/// the usual step (gaps) or the smallest one (a step that changes).
struct EvenSlices {
  double step_mm = 0.0;
  std::vector<MadeSlice> slices;
};
EvenSlices evenSlices(const SliceStack& stack);

}  // namespace assets
