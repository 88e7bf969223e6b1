#include "calibration/fit/rest_registration.h"

#include <algorithm>
#include <cmath>

#include "calibration/fit/rigid_fit.h"
#include "calibration/geometry/pose.h"

namespace calibration {
namespace {

constexpr double kOtherMarks_mm = 3.0;

}  // namespace

RestRegistration registerRest(const std::vector<MarkTouch>& fitted_to, const std::vector<MarkTouch>& verified_by) {
  for (const auto* touches : {&fitted_to, &verified_by})
    for (const MarkTouch& touch : *touches)
      if (!isFinite(touch.mark_mm) || !isFinite(touch.touched_W.mm))
        throw CalibrationError("hand rest: a touch is not a number: touch its marks again");
  if (fitted_to.size() < 3) throw CalibrationError("hand rest: fewer than three marks: touch three");

  std::vector<PointPair> pairs;
  for (const MarkTouch& touch : fitted_to) pairs.push_back({touch.touched_W.mm, touch.mark_mm});
  const auto laid = rigidFit(pairs);
  if (!laid) throw CalibrationError("hand rest: its marks lie on a line: choose three that make a triangle");

  RestRegistration found;
  found.rotation = glm::normalize(glm::quat_cast(laid->rotation));
  found.translation_mm = laid->translation_mm;
  const double n = static_cast<double>(fitted_to.size());
  double sum_mm2 = 0.0, largest_mm = 0.0;
  for (const MarkTouch& touch : fitted_to) {
    const double off_mm = glm::length(found.position_W(touch.mark_mm).mm - touch.touched_W.mm);
    sum_mm2 += off_mm * off_mm / n;
    largest_mm = std::max(largest_mm, off_mm);
  }
  found.fre_rms_mm = std::sqrt(sum_mm2);
  if (largest_mm > kOtherMarks_mm)
    throw CalibrationError("hand rest: the touches lie unlike its marks: touch the marks in their order");
  for (const MarkTouch& touch : verified_by)
    found.worst_mm = std::max(found.worst_mm, glm::length(found.position_W(touch.mark_mm).mm - touch.touched_W.mm));
  return found;
}

}  // namespace calibration
