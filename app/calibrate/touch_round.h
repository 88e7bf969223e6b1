// One round of touches: targets in order, taken by a press or by holding still, with the stylus tilted as shown. A
// doubtful touch is rejected with a reason; a second press takes it. Long press undoes the last; in the inkwell, or
// with nothing to undo, the round pauses. After a silence of the device one touch is repeated to check its zero; if
// that has changed, all start again. Frame W, mm, s. Plain logic; one thread; a few microseconds a tick, allocates when
// a touch is taken.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/calibrate/announcements.h"
#include "app/calibrate/button_press.h"
#include "app/calibrate/choice_menu.h"
#include "app/calibrate/still_capture.h"
#include "calibration/fit/target_plan.h"

namespace app {

/// Name of a target: "pit", "cross", "mark".
const char* nounOf(const calibration::TargetPlan& plan);

class TouchRound {
 public:
  enum class TouchEvent { nothing, taken, undone, started_again, left };

  /// `max_distance_mm`: a tip computed further from its target is doubtful; 0: the 60 mm limit of an unmeasured arm.
  TouchRound(calibration::TargetPlan plan, const calibration::MeasuredArm& assumed, double max_distance_mm,
             Announcements& announcements);

  /// `pressed_s`: when the button went down.
  TouchEvent update(const StylusSample& sample, Press press, double pressed_s);
  /// Accepts any tilt.
  void ignoreTilt() { any_tilt_ = true; }
  /// Called after the device was silent.
  void lost();
  void show(WizardView& view) const;

  bool isComplete() const;
  /// Those taken, in the plan's order, with the targets' ids; `joints_rad` as the sensors read.
  std::vector<calibration::Touch> touches() const;
  /// Of all taken ones.
  double tiltSpread_deg() const;
  /// Indices of touches taken with a wrong tilt.
  std::vector<std::size_t> wronglyTilted() const;
  double duration_s() const { return busy_s_; }

  /// Updates the estimate of the arm.
  void setArm(const calibration::MeasuredArm& arm, double max_distance_mm);
  /// In the order of touches().
  void setDoubtful(const std::vector<bool>& doubtful);
  /// Repeats a touch, by its index in touches().
  void again(std::size_t touch);
  void retakeAll();
  std::string nameOf(std::size_t touch) const;
  bool isDoubtful(std::size_t touch) const;

 private:
  struct Taken {
    calibration::RawJoints raw_rad{};
    bool wrongly_tilted = false, doubtful = false;
  };

  std::optional<std::size_t> next() const;
  std::size_t planIndex(std::size_t touch) const;
  calibration::Vector<calibration::World> heldAlong_W(const calibration::RawJoints& raw_rad) const;
  /// Why a touch is rejected; empty: accepted.
  std::string objection(std::size_t index, const calibration::RawJoints& raw_rad, bool& tilt_is_wrong) const;
  TouchEvent take(const StillReading& take, bool pressed);
  TouchEvent confirm(const StillReading& take);
  TouchEvent pause(Press press);
  TouchEvent undo();
  void keepTime(double t_s);

  calibration::TargetPlan plan_;
  calibration::MeasuredArm arm_;
  double max_distance_mm_;
  bool any_tilt_ = false;
  Announcements& announcements_;
  StillCapture still_;
  std::vector<std::optional<Taken>> taken_;  ///< one a target
  std::vector<std::size_t> order_;           ///< in which they were taken
  std::optional<std::size_t> confirming_;    ///< touched again after a silence
  std::optional<std::size_t> objected_;      ///< doubtful touch that a second press takes
  double objected_at_s_ = 0.0;
  std::optional<double> dwelt_at_s_;  ///< a press right after counts as the same touch
  std::optional<calibration::RawJoints> last_rad_;
  std::optional<StylusSample> now_;
  std::optional<ChoiceMenu> pause_;
  bool docked_ = false;

  double seen_s_ = 0.0, busy_s_ = 0.0, taken_at_s_ = 0.0;  ///< of the time it was not paused
  std::vector<double> intervals_s_;
};

}  // namespace app
