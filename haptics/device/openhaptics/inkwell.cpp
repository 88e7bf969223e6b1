#include "haptics/device/openhaptics/inkwell.h"

namespace haptics {
namespace {

constexpr double kFreeTravel_mm = 40.0;
constexpr double kLongestStep_mm = 5.0;  ///< in a tick; more is a jump of the calibration, no travel

}  // namespace

Inkwell::Inkwell(std::optional<bool> docked_value) {
  if (docked_value) sense_.store(*docked_value ? docked_when_true : docked_when_false);
}

bool Inkwell::isDocked(bool switch_value, const glm::dvec3& position_mm, bool place_is_sure) noexcept {
  const bool goes_on = has_box_ && switch_value == value_ && glm::length(position_mm - last_mm_) <= kLongestStep_mm;
  value_ = switch_value;
  has_box_ = place_is_sure;
  last_mm_ = position_mm;
  least_mm_ = goes_on ? glm::min(least_mm_, position_mm) : position_mm;
  most_mm_ = goes_on ? glm::max(most_mm_, position_mm) : position_mm;
  if (place_is_sure && glm::length(most_mm_ - least_mm_) > kFreeTravel_mm)
    sense_.store(switch_value ? docked_when_false : docked_when_true, std::memory_order_relaxed);

  const int sense = sense_.load(std::memory_order_relaxed);
  return sense == unknown || switch_value == (sense == docked_when_true);
}

std::optional<bool> Inkwell::dockedValue() const {
  const int sense = sense_.load(std::memory_order_relaxed);
  if (sense == unknown) return std::nullopt;
  return sense == docked_when_true;
}

}  // namespace haptics
