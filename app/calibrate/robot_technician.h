// A simulated technician who follows the wizard's pages at a workstation with known errors: reads the view, goes to the
// glowing target, holds still, presses, answers. Runs the whole calibration without hardware, for tests and
// demonstrations. Its only input is the view; its reach is that of the synthetic rig. Frame W, mm, s. Deterministic for
// a seed. One thread; about a microsecond a tick, 50 for a new target.
#pragma once

#include <optional>
#include <random>
#include <string>

#include "app/calibrate/stylus_sample.h"
#include "app/calibrate/wizard_view.h"
#include "calibration/synthetic/synthetic_rig.h"

namespace app {

struct TechnicianSettings {
  bool presses = true;                                        ///< false: takes touches by holding still
  double tremor_mm = 0.03;                                    ///< at the wrist, one axis, 9 Hz
  double move_s = 0.6;                                        ///< from one target to the next
  std::string flip = "yes";                                   ///< how the F reads: the beginning of a choice
  double bar_mm = 100.0, ipd_mm = 63.0, distance_mm = 450.0;  ///< by ruler and tape
  bool reversed = false;                                      ///< touches the targets in reverse order
  bool repeats_doubtful = true;                               ///< repeats a doubtful touch when offered
  std::string final_choice = "take it";                       ///< the beginning of the choice at the end
};

class RobotTechnician {
 public:
  RobotTechnician(const calibration::SyntheticRig& rig, const TechnicianSettings& habits, std::uint32_t seed);

  /// The stylus at this time, after seeing this view.
  StylusSample next(const WizardView& view, double t_s);
  /// Changes the workstation: another homing, a moved base.
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
  double start_s_ = 0.0;  ///< start of the current movement
  bool docked_ = false, has_moved_ = false;
  std::string seen_;  ///< read last: title, count, message, marked choice
  double read_s_ = 0.0;
  std::optional<double> press_from_s_, press_to_s_;
  int presses_here_ = 0;
};

}  // namespace app
