// Whether the stylus is in its inkwell. The polarity of the vendor's switch differs between devices and is not
// documented, so it is learned: a docked stylus stands still, so the value under which the handle has travelled over 40
// mm, more than a stylus can swing in its inkwell, is that of a free one. Until then the stylus counts as docked, which
// allows no force. A configured value holds until movement contradicts it. mm; isDocked(): the servo's thread, a few
// flops; dockedValue(): any thread.
#pragma once

#include <atomic>
#include <optional>

#include "calibration/geometry/pose.h"

namespace haptics {

class Inkwell {
 public:
  /// `docked_value`: of the switch with a docked stylus, if known.
  explicit Inkwell(std::optional<bool> docked_value = {});

  /// Once a tick. `position_mm`: of the handle in any fixed frame; an invalid position is ignored.
  bool isDocked(bool switch_value, const glm::dvec3& position_mm, bool is_valid) noexcept;

  /// Of the switch with a docked stylus, as set or learned.
  std::optional<bool> dockedValue() const;

 private:
  enum Sense : int { unknown, docked_when_false, docked_when_true };

  std::atomic<int> sense_{unknown};
  bool value_ = false, has_box_ = false;
  glm::dvec3 last_mm_{0.0}, min_mm_{0.0}, max_mm_{0.0};  ///< extent of the movement since the switch changed
};

}  // namespace haptics
