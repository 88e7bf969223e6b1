#include "app/procedure/third_molar/demonstration.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "app/procedure/third_molar/cleaning_path.h"
#include "app/text/usage_error.h"
#include "haptics/device/simulated/trough_path.h"
#include "haptics/servo/piece_sites.h"

namespace app {
namespace {

constexpr double kLeastBur_mm = 0.7, kMostBur_mm = 1.3;          ///< radius, of the one that parts the tooth
constexpr double kLeastHalf_mm = 3.0;                            ///< of its head's length
constexpr double kSettles_s = 0.6;                               ///< after a step, before it is looked at
constexpr double kBridgeWait_s = 1.5;                            ///< for one to be found that may break
constexpr double kLongestWait_s = 20.0;                          ///< for pieces to be ready
constexpr double kGutter_mm_per_s = 16.0, kCut_mm_per_s = 25.0;  ///< where nothing holds the bur up
constexpr double kOutside_mm = 45.0;  ///< from the site, along the line of sight: where tools are turned

HandPose handOf(const haptics::Tick& tick) { return tick.hand.X_PT; }

/// A plan is of the ball at the bur's end; the hand leads the middle of its head.
haptics::LedPath cutPath(assets::PlannedCut cut, const haptics::Tool& bur, double speed_mm_per_s) {
  const glm::dvec3 to_middle_mm = (haptics::halfHeight_mm(bur.head) - bur.head.radius_mm) * cut.shaft_P;
  for (auto& stroke : cut.strokes_P_mm)
    for (glm::dvec3& p : stroke) p += to_middle_mm;
  const haptics::TroughPath path(cut, {.shaft_P = cut.shaft_P, .speed_mm_per_s = speed_mm_per_s});
  return {[path](double t_s) { return path.at(t_s); }, path.duration_s()};
}

/// In front of the site, along the line of sight where one is known.
glm::dvec3 outsideOf(const assets::PlannedCut& cut) {
  const glm::dvec3 way = glm::length(cut.sight_P) > 0.0 ? cut.sight_P : cut.outward_P;
  return cut.surface_P_mm + kOutside_mm * glm::normalize(way);
}

HandPose startOf(const haptics::LedPath& path) {
  const haptics::HandTarget start = path.script(0.0);
  return {start.rotation, start.position_mm};
}

}  // namespace

OperationTray operationTray(const std::vector<haptics::Tool>& tray) {
  OperationTray found;
  const auto bur = std::ranges::find_if(tray, [](const haptics::Tool& tool) {
    return tool.turns() && tool.head.kind == haptics::ShapeKind::capsule && tool.head.radius_mm >= kLeastBur_mm &&
           tool.head.radius_mm <= kMostBur_mm && haptics::halfHeight_mm(tool.head) >= kLeastHalf_mm;
  });
  const auto forceps = std::ranges::find_if(tray, [](const haptics::Tool& tool) { return tool.grips; });
  if (bur == tray.end() || forceps == tray.end())
    throw UsageError(
        "--procedure third-molar: its tray needs a bur with a round end, 1.4 to 2.6 mm thick and at least 6 mm long, "
        "and "
        "forceps; add --tool capsule:1.05,8 --tool forceps");
  found.bur = static_cast<std::size_t>(bur - tray.begin());
  found.forceps = static_cast<std::size_t>(forceps - tray.begin());
  const auto elevator = std::ranges::find_if(tray, [](const haptics::Tool& tool) {
    return tool.elevator == haptics::ElevatorKind::straight_301 || tool.elevator == haptics::ElevatorKind::straight_34s;
  });
  const auto place_of = [&](haptics::HandInstrument kind) -> std::optional<std::size_t> {
    const auto at = std::ranges::find(tray, kind, &haptics::Tool::hand_instrument);
    return at == tray.end() ? std::nullopt : std::optional(static_cast<std::size_t>(at - tray.begin()));
  };
  found.cleaning = {place_of(haptics::HandInstrument::suction), place_of(haptics::HandInstrument::curette),
                    place_of(haptics::HandInstrument::bone_file), found.forceps};
  if (elevator != tray.end()) found.elevator = static_cast<std::size_t>(elevator - tray.begin());
  return found;
}

Demonstration::Demonstration(const assets::Patient& patient, const assets::PlannedCut& gutter,
                             const std::vector<haptics::Tool>& tray, const haptics::Bodies& bodies,
                             haptics::LedHand& hand)
    : bodies_(bodies),
      hand_(hand),
      tray_(operationTray(tray)),
      planner_(patient, tray[tray_.bur].head.radius_mm, tray_.elevator.has_value()),
      cleaning_(planner_.out_P(), {tray_.cleaning[0].has_value(), tray_.cleaning[1].has_value(),
                                   tray_.cleaning[2].has_value(), tray_.cleaning[3].has_value()}),
      tools_(tray),
      outside_P_mm_(outsideOf(gutter)),
      forceps_R_PT_(startOf(cutPath(gutter, tray[0], kGutter_mm_per_s)).rotation) {
  news_.push_back("bare the crown");
  lead(cutPath(gutter, tray[0], kGutter_mm_per_s));
}

void Demonstration::lead(haptics::LedPath path) { hand_.lead(&paths_.emplace_back(std::move(path))); }

void Demonstration::enter(Phase phase, const Frame& frame) {
  phase_ = phase;
  since_s_ = frame.newest.t_s;
}

void Demonstration::fail(const Frame& frame, const std::string& why) {
  failure_ = why;
  enter(Phase::over, frame);
}

/// What keeps the hand from its work; empty: nothing.
std::string Demonstration::interruption(const Frame& frame) const {
  const bool works = phase_ == Phase::cutting || phase_ == Phase::splitting || phase_ == Phase::gripping ||
                     phase_ == Phase::taking_out || phase_ == Phase::cleaning;
  if (!works || !frame.is_applied || frame.newest.dt_s == 0.0) return {};
  if (!(frame.in_hand == tools_[wanted_])) return "another tool was taken";
  if (phase_ == Phase::cutting && !frame.drill_enabled) return "the drill was locked";
  if (!haptics::mayRunMotors(frame.newest.state)) return "the motors are off";
  return {};
}

std::optional<ControlRequest> Demonstration::startStep(const Frame& frame) {
  news_.push_back(step_.words);
  if (const EndStep* const end = std::get_if<EndStep>(&step_.what)) {
    if (end->why_not.empty()) is_out_ = true;
    if (!is_out_) fail(frame, end->why_not);
    enter(is_out_ ? Phase::settling : Phase::over, frame);
    return {};
  }
  wanted_ = std::holds_alternative<CutStep>(step_.what)     ? tray_.bur
            : std::holds_alternative<SplitStep>(step_.what) ? *tray_.elevator
                                                            : tray_.forceps;
  if (const CleaningStep* const cleaning = std::get_if<CleaningStep>(&step_.what))
    wanted_ = *tray_.cleaning[static_cast<std::size_t>(cleaning->what)];
  enter(Phase::changing_tool, frame);
  if (frame.in_hand == tools_[wanted_]) return {};
  return ControlRequest{Control::tool, static_cast<int>(wanted_)};
}

/// Once the tool is in the hand, and the pieces are ready for it.
void Demonstration::work(const Frame& frame) {
  if (!(frame.in_hand == tools_[wanted_])) return fail(frame, "its tool could not be taken");
  const HandPose hand = handOf(frame.newest);
  if (const CutStep* const step = std::get_if<CutStep>(&step_.what)) {
    const haptics::LedPath path = cutPath(step->cut, tools_[tray_.bur], kCut_mm_per_s);
    lead(joined(throughOutside(hand, startOf(path), outside_P_mm_), path));
    enter(Phase::cutting, frame);
  } else if (const SplitStep* const split = std::get_if<SplitStep>(&step_.what); split && frame.is_ready_to_grip) {
    // Without a bridge that may break the bur goes on.
    if (frame.newest.bridge == haptics::BreakAnswer::armed) {
      lead(twistInSlot(hand, outside_P_mm_, *split));
      enter(Phase::splitting, frame);
    } else if (frame.newest.t_s - since_s_ >= kBridgeWait_s) {
      enter(Phase::settling, frame);
    }
  } else if (const CleaningStep* const cleaning = std::get_if<CleaningStep>(&step_.what)) {
    lead(cleaningPath(hand, outside_P_mm_, *cleaning, tools_[wanted_], forceps_R_PT_));
    enter(Phase::cleaning, frame);
  } else if (frame.is_ready_to_grip) {
    lead(gripAndRock(hand, outside_P_mm_, std::get<DeliveryStep>(step_.what), forceps_R_PT_));
    enter(Phase::gripping, frame);
  } else if (frame.newest.t_s - since_s_ >= kLongestWait_s) {
    fail(frame, "the pieces were not made ready");
  }
}

/// Nothing changes any more: no split, no undo, no command on its way.
bool Demonstration::isStill(const Frame& frame) const {
  const haptics::Tick& tick = frame.newest;
  return tick.split != haptics::SplitAnswer::waiting && tick.split != haptics::SplitAnswer::running &&
         tick.bridge != haptics::BreakAnswer::breaking && tick.drill_inhibit != haptics::DrillInhibit::undo_running &&
         frame.is_applied && tick.t_s - since_s_ >= kSettles_s;
}

std::optional<ControlRequest> Demonstration::follow(const Frame& frame) {
  const haptics::Tick& tick = frame.newest;
  if (const std::string why = interruption(frame); !why.empty()) fail(frame, why);
  switch (phase_) {
    case Phase::cutting:
    case Phase::splitting:
    case Phase::taking_out:
    case Phase::cleaning:
      if (hand_.hasArrived()) enter(Phase::settling, frame);
      return {};
    case Phase::settling:
      if (!isStill(frame)) return {};
      if (is_out_) {
        auto next = cleaning_.next(frame.left);
        if (!next) return enter(Phase::over, frame), std::nullopt;
        step_ = std::move(*next);
        return startStep(frame);
      }
      planning_ = std::async(
          frame.waits ? std::launch::deferred : std::launch::async,
          [this, copy = copyOf(bodies_, tick), grid = bodies_.bones()[1].grid(),
           first = bodies_.firstBrick() * assets::kBrickVoxels] { return planner_.next(copy, grid, first); });
      enter(Phase::planning, frame);
      return {};
    case Phase::planning:
      if (!frame.waits && planning_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return {};
      step_ = planning_.get();
      return startStep(frame);
    case Phase::changing_tool:
      if (frame.is_applied) work(frame);
      return {};
    case Phase::gripping: {
      const DeliveryStep& step = std::get<DeliveryStep>(step_.what);
      const bool is_loose = tick.gripped == step.piece + 1 && tick.torn_share >= haptics::kLooseShare;
      if (!is_loose && !hand_.hasArrived()) return {};
      lead(takeOut(handOf(tick), tick.X_PQ[step.piece], step));
      enter(Phase::taking_out, frame);
      return {};
    }
    case Phase::over:
      return {};
  }
  return {};
}

std::optional<std::string> Demonstration::news() {
  if (news_.empty()) return {};
  std::string line = std::move(news_.front());
  news_.pop_front();
  return line;
}

}  // namespace app
