#include "calibration/fit/expected_error_map.h"

#include <algorithm>
#include <cmath>

#include "calibration/fit/touch_checks.h"

namespace calibration {
namespace {

/// Squared distances of a point from the three axes.
glm::dvec3 fromAxes_mm2(const glm::dvec3& along_mm) {
  const glm::dvec3 squared = along_mm * along_mm;
  return glm::dvec3(squared.x + squared.y + squared.z) - squared;
}

constexpr double kMinSpread_mm2 = 1e-6;  ///< avoids division by zero for targets on an axis

}  // namespace

ExpectedErrorMap::ExpectedErrorMap(const std::vector<Point<World>>& targets_W, double fle_mm) : fle_mm_(fle_mm) {
  std::vector<glm::dvec3> positions;
  for (const Point<World>& target : targets_W) positions.push_back(target.mm);
  const Extent extent = extentOf(positions);
  middle_mm_ = extent.middle_mm;
  axes_ = extent.axes;
  spread_mm2_ = glm::max(fromAxes_mm2(extent.spread_mm), glm::dvec3(kMinSpread_mm2));
  count_ = std::max<double>(1.0, static_cast<double>(positions.size()));
}

double ExpectedErrorMap::at_mm(const Point<World>& position_W) const {
  const glm::dvec3 shares = fromAxes_mm2(glm::transpose(axes_) * (position_W.mm - middle_mm_)) / spread_mm2_;
  return fle_mm_ * std::sqrt((1.0 + (shares.x + shares.y + shares.z) / 3.0) / count_);
}

}  // namespace calibration
