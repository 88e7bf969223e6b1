// The bur at work tick by tick: the motor turns it, the bone loads it, and the erosion law removes bone. State: the
// spindle, the yield of the last cut, the bur's last position. Frame P. Servo thread: per tick one turn() before the
// contact and one cut() after it. Cost: bone/carve and contact/cut_conditions. No allocation, no throw.
#pragma once

#include "haptics/body/bodies.h"
#include "haptics/contact/cut_conditions.h"
#include "haptics/contact/law_settings.h"
#include "haptics/tool/spindle.h"

namespace haptics {

class Cutting {
 public:
  /// The head at the proxy this tick.
  struct Engagement {
    calibration::Pose<calibration::Patient, calibration::Tool> X_PT;
    BurShape head;
    Contact contact;
    calibration::Vector<calibration::Patient> force_P_N;  ///< of head, shaft and spring
  };

  /// Advances the spindle by a tick under the load of the last.
  void turn(const SpindleSettings& spindle, bool pedal, double dt_s) noexcept;

  /// Motion of hand and spindle for the force laws.
  ToolMotion motion(const calibration::Vector<calibration::Patient>& velocity_P_mm_per_s, double dt_s) const noexcept;

  /// Removes bone by the erosion law; nothing with `allowed` false. Changed blocks are saved to `strokes`.
  CarveResult cut(Bodies& bodies, StrokeHistory& strokes, const ErosionSettings& erosion,
                  const SpindleSettings& spindle, const LawSettings& law, const Engagement& engaged, bool allowed,
                  double dt_s, std::uint64_t tick) noexcept;

  const SpindleState& spindle() const { return spindle_; }
  double load_Nmm() const { return load_Nmm_; }

 private:
  SpindleState spindle_;
  ErosionState erosion_state_;
  calibration::Point<calibration::Patient> last_P_;
  bool was_in_bone_ = false;
  double load_Nmm_ = 0.0;
};

}  // namespace haptics
