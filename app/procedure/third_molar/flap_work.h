// How a scripted hand makes an incision and raises a flap: the blade along the planned incision, down to the bone; the
// periosteal elevator under the gum from the incision to the base, strip by strip. Frame P is the device's frame D;
// handle and tool coincide. mm, s. Pure; speeds and pressures are our defaults.
#pragma once

#include <vector>

#include "app/procedure/flap/flap_plan.h"
#include "app/procedure/third_molar/delivery_path.h"
#include "haptics/tool/tool.h"

namespace app {

class FlapWork {
 public:
  /// Borrows chart and plan. `tray`: throws UsageError without blade or periosteal elevator. `R_PT`: how an instrument
  /// lies clear of what is around the site.
  FlapWork(const GumChart& chart, const FlapPlan& plan, const std::vector<haptics::Tool>& tray, const glm::dquat& R_PT);

  /// Places in the tray.
  std::size_t blade() const { return blade_; }
  std::size_t elevator() const { return elevator_; }
  haptics::LedPath incisionPath(const HandPose& from, const glm::dvec3& outside_P_mm) const;
  haptics::LedPath raisingPath(const HandPose& from, const glm::dvec3& outside_P_mm) const;

 private:
  glm::dquat heldAt(const ChartPlace& place) const;
  HandPose at(const ChartPlace& place, double over_bone_mm) const;
  HandPose atGum(const ChartPlace& place) const;  ///< a little over it
  HandPose above(const ChartPlace& place) const;  ///< along the shaft, on the way in

  const GumChart& chart_;
  const FlapPlan& plan_;
  std::size_t blade_ = 0, elevator_ = 0;
  double blade_radius_mm_ = 0.0, elevator_radius_mm_ = 0.0;
  glm::dvec3 shaft_P_;
  glm::dquat R_PT_;
};

}  // namespace app
