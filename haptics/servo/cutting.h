// The bur at work, tick by tick: the motor turns it, the bone holds it back, and the erosion law of the moment takes
// its share. State: the spindle, what the last cut yielded, where the bur was. Frame P. Servo thread, one turn() before
// the contact of a tick and one cut() after it. Cost: bone/carve and contact/cut_moment. No allocation, no throw.
#pragma once

#include "haptics/bone/carve.h"
#include "haptics/contact/cut_conditions.h"
#include "haptics/contact/law_settings.h"
#include "haptics/tool/spindle.h"

namespace haptics {

class Cutting {
 public:
  /// Where and how hard the head is held this tick.
  struct Engagement {
    calibration::Pose<calibration::Patient, calibration::Tool> X_PQ;  ///< the tool at the proxy
    BurShape head;
    Contact contact;
    calibration::Vector<calibration::Patient> force_P_N;  ///< all that holds the hand
  };

  /// Turns the spindle on by a tick, under what held it back in the last.
  void turn(const SpindleSettings& spindle, bool pedal, double dt_s) noexcept;

  /// The hand's motion with the spindle's, for the force laws.
  ToolMotion motion(const calibration::Vector<calibration::Patient>& velocity_P_mm_per_s, double dt_s) const noexcept;

  /// Takes from the bone what the law grants with the spindle as it turns; nothing with `allowed` false. What it
  /// changes is saved to `strokes`.
  CarveResult cut(CarvedBone& bone, StrokeHistory& strokes, const ErosionSettings& erosion,
                  const SpindleSettings& spindle, const LawSettings& law, const Engagement& held, bool allowed,
                  double dt_s, std::uint64_t tick) noexcept;

  const SpindleState& spindle() const { return spindle_; }
  double load_Nmm() const { return load_Nmm_; }

 private:
  SpindleState spindle_;
  ErosionState memory_;
  calibration::Point<calibration::Patient> last_P_;
  bool was_in_bone_ = false;
  double load_Nmm_ = 0.0;
};

}  // namespace haptics
