// A lower third molar taken out from beginning to end by a scripted hand: where the gum is whole, incision and flap;
// then gutter, section, what blocks a piece, piece by piece out; then the socket cleaned and the places of stitches
// confirmed. Each step is planned from the bone and tooth as they are when the one before has ended
// (operation_planner), so it is carried out as a person would, by hand, pedal and change of tool alone. Main thread,
// once a frame, of which one a step takes 30 ms for a copy; steps are planned on a thread of their own, for which the
// destructor waits, or on this one where the servo is stepped.
#pragma once

#include <array>
#include <deque>
#include <future>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/controls/control.h"
#include "app/procedure/third_molar/cleaning_plan.h"
#include "app/procedure/third_molar/delivery_path.h"
#include "app/procedure/third_molar/flap_work.h"
#include "haptics/servo/tick.h"
#include "haptics/tool/tool.h"

namespace app {

/// Bur for section and clearing, elevator and forceps, by their place in the tray. Throws UsageError where bur or
/// forceps are missing.
struct OperationTray {
  std::size_t bur = 0, forceps = 0;
  std::optional<std::size_t> elevator;  ///< straight; none: the bur goes through
  /// By Cleaning; none: that is left out. Stitches are confirmed with the forceps.
  std::array<std::optional<std::size_t>, kCleanings> cleaning{};
};
OperationTray operationTray(const std::vector<haptics::Tool>& tray);

class Demonstration {
 public:
  /// Borrows all; before the first tick.
  struct Site {
    const assets::Patient& patient;
    const assets::PlannedCut& gutter;
    const std::vector<haptics::Tool>& tray;  ///< the first tool makes the gutter
    const haptics::Bodies& bodies;
    haptics::LedHand& hand;
  };
  /// `flap`: where the gum is whole.
  explicit Demonstration(const Site& site, std::optional<FlapWork> flap = {});
  /// That ends when the crown is bared: no more than blade, periosteal elevator and the first bur are needed.
  static Demonstration ofFlap(const Site& site, FlapWork flap) { return Demonstration(site, std::move(flap), false); }
  /// How instruments lie clear of what is around the site while the gutter is made.
  static glm::dquat heldAtGutter(const assets::PlannedCut& gutter, const haptics::Tool& bur);

  struct Frame {
    haptics::Tick newest;
    haptics::Tool in_hand;          ///< of the newest command
    bool drill_enabled = true;      ///< of the same
    bool is_applied = false;        ///< the newest command is in force in `newest`
    bool is_ready_to_grip = false;  ///< the pieces are ready for elevator and forceps
    bool waits = false;             ///< for a servo that is stepped
    bool is_flap_aside = false;     ///< raised and held
    SiteLeft left;                  ///< at the site
  };
  /// What the hand asks for with its other hand or foot: a tool.
  std::optional<ControlRequest> follow(const Frame& frame);
  /// A line for each step as it begins; once each.
  std::optional<std::string> news();

  bool isOver() const { return phase_ == Phase::over; }
  /// The last piece has been taken out: what is left is cleaning.
  bool isToothOut() const { return is_out_; }
  /// Why the tooth could not be taken out; empty while it is not over, and where it is out.
  const std::string& failure() const { return failure_; }

 private:
  enum class Phase { beginning, changing_tool, working, gripping, retracting, settling, planning, over };

  Demonstration(const Site& site, std::optional<FlapWork> flap, bool goes_on);
  void fail(const Frame& frame, const std::string& why);
  std::string interruption(const Frame& frame) const;
  void lead(haptics::LedPath path);
  void enter(Phase phase, const Frame& frame);
  std::size_t toolOf(const OperationStep& step) const;
  std::optional<ControlRequest> startStep(const Frame& frame);
  std::optional<ControlRequest> afterStep(const Frame& frame);
  std::optional<ControlRequest> afterSettling(const Frame& frame);
  void work(const Frame& frame);
  void workInSocket(const Frame& frame, const HandPose& hand);
  bool isStill(const Frame& frame) const;
  OperationStep gutterStep() const { return {CutStep{gutter_, true}, "bare the crown"}; }

  const haptics::Bodies& bodies_;
  haptics::LedHand& hand_;
  std::vector<haptics::Tool> tools_;
  assets::PlannedCut gutter_;
  std::optional<FlapWork> flap_;
  OperationTray tray_;
  std::optional<OperationPlanner> planner_;  ///< none: it ends with the gutter
  std::optional<CleaningPlanner> cleaning_;
  glm::dvec3 outside_P_mm_;  ///< of the mouth
  glm::dquat forceps_R_PT_;
  std::deque<haptics::LedPath> paths_;  ///< the device reads them
  Phase phase_ = Phase::beginning;
  double since_s_ = 0.0;  ///< of the phase
  std::future<OperationStep> planning_;
  OperationStep step_;
  std::size_t wanted_ = 0;  ///< tool of the tray
  std::deque<std::string> news_;
  std::string failure_;
  bool is_out_ = false;
};

}  // namespace app
