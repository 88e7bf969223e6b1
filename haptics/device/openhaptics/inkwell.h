// Whether the stylus stands in its inkwell. The vendor's switch is a boolean whose sense is not the same for every
// device and not documented, so it is learned: a docked stylus stands still, hence the value under which the handle has
// travelled over 40 mm, more than a stylus can swing in its well, is that of a free one. Until then the stylus counts
// as docked, which asks for no force. What somebody has set before is believed until the hand shows otherwise.
// mm; isDocked(): the servo's thread, a few flops; dockedValue(): any thread.
#pragma once

#include <atomic>
#include <optional>

#include "calibration/geometry/pose.h"

namespace haptics {

class Inkwell {
 public:
  /// `docked_value`: what the switch shows of a docked stylus, when it is known.
  explicit Inkwell(std::optional<bool> docked_value = {});

  /// Once a tick. `position_mm`: of the handle in any frame that stands still; not sure: it proves nothing.
  bool isDocked(bool switch_value, const glm::dvec3& position_mm, bool place_is_sure) noexcept;

  /// What the switch shows of a docked stylus, as set or learned.
  std::optional<bool> dockedValue() const;

 private:
  enum Sense : int { unknown, docked_when_false, docked_when_true };

  std::atomic<int> sense_{unknown};
  bool value_ = false, has_box_ = false;
  glm::dvec3 last_mm_{0.0}, least_mm_{0.0}, most_mm_{0.0};  ///< how far it went since the switch changed
};

}  // namespace haptics
