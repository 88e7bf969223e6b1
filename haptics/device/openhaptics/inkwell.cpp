#include "haptics/device/openhaptics/inkwell.h"

namespace haptics {
namespace {

constexpr double kFreeTravel_mm = 40.0;
constexpr double kLongestStep_mm = 5.0;  ///< in a tick; a larger one is a jump of the calibration

}  // namespace

Inkwell::Inkwell(std::optional<bool> docked_value) {
  if (docked_value) sense_.store(*docked_value ? docked_when_true : docked_when_false);
}

bool Inkwell::isDocked(bool switch_value, const glm::dvec3& position_mm, bool is_valid) noexcept {
  const bool continues = has_box_ && switch_value == value_ && glm::length(position_mm - last_mm_) <= kLongestStep_mm;
  value_ = switch_value;
  has_box_ = is_valid;
  last_mm_ = position_mm;
  min_mm_ = continues ? glm::min(min_mm_, position_mm) : position_mm;
  max_mm_ = continues ? glm::max(max_mm_, position_mm) : position_mm;
  if (is_valid && glm::length(max_mm_ - min_mm_) > kFreeTravel_mm)
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
