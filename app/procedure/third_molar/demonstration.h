// A lower third molar taken out from beginning to end by a scripted hand: gutter, section, what blocks a piece, piece
// by piece out. Each step is planned from the bone and tooth as they are when the one before has ended
// (operation_planner), so it is carried out as a person would, by hand, pedal and change of tool alone. Main thread,
// once a frame; steps are planned on a thread of their own, or waited for where the servo is stepped.
#pragma once

#include <deque>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include "app/controls/control.h"
#include "app/procedure/third_molar/delivery_path.h"
#include "haptics/servo/tick.h"
#include "haptics/tool/tool.h"

namespace app {

/// Bur for section and clearing, and forceps, by their place in the tray. Throws UsageError where one is missing.
struct OperationTray {
  std::size_t bur = 0, forceps = 0;
};
OperationTray operationTray(const std::vector<haptics::Tool>& tray);

class Demonstration {
 public:
  /// Borrows all; before the first tick. `tray`: the first tool makes the gutter.
  Demonstration(const assets::Patient& patient, const assets::PlannedCut& gutter,
                const std::vector<haptics::Tool>& tray, const haptics::Bodies& bodies, haptics::LedHand& hand);

  struct Frame {
    haptics::Tick newest;
    bool is_applied = false;        ///< the newest command is in force in `newest`
    bool is_ready_to_grip = false;  ///< the pieces are ready for forceps
    bool waits = false;             ///< for a servo that is stepped
  };
  /// What the hand asks for with its other hand or foot: a tool.
  std::optional<ControlRequest> follow(const Frame& frame);
  /// A line for each step as it begins; once each.
  std::optional<std::string> news();

  bool isOver() const { return phase_ == Phase::over; }
  /// Empty once the tooth is out.
  const std::string& failure() const { return failure_; }

 private:
  enum class Phase { cutting, settling, planning, changing_tool, gripping, taking_out, over };

  void lead(haptics::LedPath path);
  void enter(Phase phase, const Frame& frame);
  std::optional<ControlRequest> startStep(const Frame& frame);
  void work(const Frame& frame);

  const haptics::Bodies& bodies_;
  haptics::LedHand& hand_;
  OperationTray tray_;
  OperationPlanner planner_;
  haptics::Tool bur_;
  glm::dvec3 outside_P_mm_;
  glm::dquat forceps_held_P_;
  std::deque<haptics::LedPath> paths_;  ///< the device reads them
  Phase phase_ = Phase::cutting;
  double since_s_ = 0.0;  ///< of the phase
  std::future<OperationStep> planning_;
  OperationStep step_;
  std::size_t in_hand_ = 0;  ///< of the tray
  std::deque<std::string> news_;
  std::string failure_;
};

}  // namespace app
