// Incision and flap by a scripted hand, where the rehearsal begins with the gum closed: the blade along the planned
// incision, down to the bone; the periosteal elevator under the gum from the incision to the base, strip by strip; then
// the planned cut, once the assistant holds the flap aside. By hand and change of tool alone. Frame P is
// the device's frame D; mm, s. Main thread, once a frame; microseconds.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "app/controls/control.h"
#include "app/procedure/flap/flap_plan.h"
#include "app/procedure/third_molar/delivery_path.h"
#include "haptics/servo/tick.h"
#include "haptics/tool/tool.h"

namespace app {

class FlapDemonstration {
 public:
  /// Borrows chart, plan and hand, before the first tick. `tray`: the first tool is the bur; throws UsageError without
  /// blade or elevator. `cutting`: the bur's way.
  FlapDemonstration(const GumChart& chart, const FlapPlan& plan, const assets::PlannedCut& cut,
                    const std::vector<haptics::Tool>& tray, haptics::LedHand& hand, const haptics::LedPath& cutting);

  struct Frame {
    haptics::Tick newest;
    haptics::Tool in_hand;    ///< of the newest command
    bool is_applied = false;  ///< that is in force in `newest`
    bool is_aside = false;    ///< the flap is raised and held
  };
  std::optional<ControlRequest> follow(const Frame& frame);
  /// A line for each step as it begins; once each.
  std::optional<std::string> news();
  bool isOver() const { return phase_ == Phase::over; }
  /// Why the flap was not raised; empty: it was, or not yet.
  const std::string& failure() const { return failure_; }

 private:
  enum class Phase {
    beginning,
    taking_blade,
    cutting,
    taking_elevator,
    raising,
    waiting,
    taking_bur,
    nearing,
    drilling,
    over
  };
  void lead(haptics::LedPath path) { hand_.lead(&paths_.emplace_back(std::move(path))); }
  std::optional<ControlRequest> take(std::size_t tool, Phase next, const Frame& frame);
  haptics::LedPath incisionPath(const HandPose& from) const;
  haptics::LedPath raisingPath(const HandPose& from) const;
  glm::dquat heldAt(const ChartPlace& place) const;
  HandPose at(const ChartPlace& place, double over_bone_mm) const;
  HandPose atGum(const ChartPlace& place) const;  ///< a little over it
  HandPose above(const ChartPlace& place) const;  ///< along the shaft, on the way in

  const GumChart& chart_;
  const FlapPlan& plan_;
  std::vector<haptics::Tool> tools_;
  std::size_t blade_ = 0, elevator_ = 0;
  haptics::LedHand& hand_;
  haptics::LedPath cutting_;
  glm::dvec3 outside_P_mm_, shaft_P_;
  glm::dquat R_PT_;
  Phase phase_ = Phase::beginning;
  double since_s_ = 0.0;
  std::deque<haptics::LedPath> paths_;  ///< the device reads them
  std::deque<std::string> news_;
  std::string failure_;
};

}  // namespace app
