// Somebody who does what the wizard's pages say, at a workstation whose truth is known: reads what is shown, goes to
// the glowing target, holds still, presses, answers. With it the whole calibration runs without hardware, in tests and
// as a demonstration. Sees nothing but the view; its hand ends where the synthetic rig's would. Frame W, mm, s.
// Deterministic for a seed. One thread; about a microsecond a tick, 50 where it turns to a new target.
#pragma once

#include <optional>
#include <random>
#include <string>

#include "app/calibrate/stylus_sample.h"
#include "app/calibrate/wizard_view.h"
#include "calibration/synthetic/synthetic_rig.h"

namespace app {

struct TechnicianSettings {
  bool presses = true;                                        ///< takes touches by the button; false: by holding still
  double tremor_mm = 0.03;                                    ///< at the wrist, one axis, 9 Hz
  double move_s = 0.6;                                        ///< from one target to the next
  std::string flip = "yes";                                   ///< how the F reads to them: the beginning of a choice
  double bar_mm = 100.0, ipd_mm = 63.0, distance_mm = 450.0;  ///< what ruler and tape say
  bool reversed = false;                                      ///< touches the targets in the opposite order
  bool repeats_doubtful = true;                               ///< touches a doubtful one again, as the page offers
  std::string final_choice = "take it";  ///< the beginning of what is chosen at the end; else what is marked
};

class RobotTechnician {
 public:
  RobotTechnician(const calibration::SyntheticRig& rig, const TechnicianSettings& habits, std::uint32_t seed);

  /// The stylus at this time, by somebody who saw this view last.
  StylusSample next(const WizardView& view, double t_s);
  /// Another morning: another homing, a base that was pushed.
  void moveTo(const calibration::SyntheticRig& rig) { rig_ = rig; }

 private:
  void decide(const WizardView& view, double t_s);
  void goTo(const calibration::RawJoints& raw_rad, double t_s);
  void goToTarget(const WizardView& view, std::size_t target, double t_s);
  std::optional<std::size_t> wanted(const WizardView& view) const;
  void press(double t_s, double seconds);

  calibration::SyntheticRig rig_;
  TechnicianSettings settings_;
  std::mt19937 rng_;

  calibration::RawJoints from_rad_{}, to_rad_{};
  double left_s_ = 0.0;  ///< when the hand set out
  bool docked_ = false, set_out_ = false;
  std::string seen_;  ///< what was read last: title, count, what was said, the marked choice
  double read_s_ = 0.0;
  std::optional<double> press_from_s_, press_to_s_;
  int presses_here_ = 0;
};

}  // namespace app
