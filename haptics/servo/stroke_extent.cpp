#include "haptics/servo/stroke_extent.h"

#include <glm/glm.hpp>

namespace haptics {

void StrokeExtent::begin(const calibration::Point<calibration::Patient>& at_P) noexcept {
  open_ = true;
  start_P_ = turn_P_ = at_P;
  time_s_ = furthest_mm_ = 0.0;
}

bool StrokeExtent::ends() noexcept {
  if (volume_mm3_ < kSmallest_mm3) return false;
  volume_mm3_ = 0.0;
  return true;
}

bool StrokeExtent::endsAt(bool cutting, const calibration::Point<calibration::Patient>& bur_P, double removed_mm3,
                          double dt_s) noexcept {
  pause_s_ = cutting ? 0.0 : pause_s_ + dt_s;
  if (!open_ && !cutting) return false;
  if (!open_) begin(bur_P);
  time_s_ += dt_s;
  volume_mm3_ += removed_mm3;
  const double half_tick_s = 0.5 * dt_s;
  if (pause_s_ > kPause_s - half_tick_s) {
    open_ = false;
    return ends();
  }
  // The way through the air to the next place is no reversal.
  if (!cutting) return false;

  const double reach_mm = glm::distance(bur_P.mm, start_P_.mm);
  if (reach_mm > furthest_mm_) furthest_mm_ = reach_mm, turn_P_ = bur_P;
  if (furthest_mm_ - reach_mm >= kReversal_mm) {
    begin(turn_P_);
    return ends();
  }
  if (time_s_ <= kLongest_s - half_tick_s && volume_mm3_ < kLargest_mm3) return false;
  begin(bur_P);
  return ends();
}

}  // namespace haptics
