#include "app/procedure/third_molar/demonstration.h"

#include <algorithm>
#include <chrono>
#include <cmath>
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
constexpr double kAssistantWait_s = 10.0;                        ///< for the flap to be held aside
constexpr double kGutter_mm_per_s = 28.0, kCut_mm_per_s = 25.0;  ///< where nothing holds the bur up
/// Means of ways that begin and end at rest: at most 94 mm/s, as hands go with a bur in them.
constexpr double kOver_mm_per_s = 60.0, kIn_mm_per_s = 40.0;
constexpr const char* kAllDone = "the operation is done";
constexpr double kOutside_mm = 45.0;    ///< from the site, along the line of sight: where tools are turned
constexpr double kLaidAside_mm = 40.0;  ///< from that place to where a piece is laid down

HandPose handOf(const haptics::Tick& tick) { return tick.hand.X_PT; }

/// A plan is of the ball at the bur's end; the hand leads the middle of its head.
haptics::LedPath cutPath(assets::PlannedCut cut, const haptics::Tool& bur, double speed_mm_per_s) {
  const glm::dvec3 to_middle_mm = (haptics::halfHeight_mm(bur.head) - bur.head.radius_mm) * cut.shaft_P;
  for (auto& stroke : cut.strokes_P_mm)
    for (glm::dvec3& p : stroke) p += to_middle_mm;
  const haptics::TroughPath path(cut, {.shaft_P = cut.shaft_P,
                                       .speed_mm_per_s = speed_mm_per_s,
                                       .travel_mm_per_s = kOver_mm_per_s,
                                       .approach_mm_per_s = kIn_mm_per_s});
  return {[path](double t_s) { return path.at(t_s); }, path.duration_s()};
}

/// In front of the site, along the line of sight where one is known.
glm::dvec3 outsideOf(const assets::PlannedCut& cut) {
  const glm::dvec3 way = glm::length(cut.sight_P) > 0.0 ? cut.sight_P : cut.outward_P;
  return cut.surface_P_mm + kOutside_mm * glm::normalize(way);
}

/// Where a piece is laid down: outside, away from where handles point, so that no instrument meets it.
glm::dvec3 laidAt(const glm::dvec3& outside_P_mm, const glm::dvec3& site_P_mm, const glm::dvec3& handle_P) {
  const glm::dvec3 sight = glm::normalize(outside_P_mm - site_P_mm);
  glm::dvec3 off = handle_P - glm::dot(handle_P, sight) * sight;
  if (glm::length(off) < 1e-3)
    off = glm::cross(sight, std::abs(sight.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0));
  return outside_P_mm - kLaidAside_mm * glm::normalize(off);
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

glm::dquat Demonstration::heldAtGutter(const assets::PlannedCut& gutter, const haptics::Tool& bur) {
  return startOf(cutPath(gutter, bur, kGutter_mm_per_s)).rotation;
}

Demonstration::Demonstration(const Site& site, std::optional<FlapWork> flap)
    : Demonstration(site, std::move(flap), true) {}

Demonstration::Demonstration(const Site& site, std::optional<FlapWork> flap, bool goes_on)
    : bodies_(site.bodies),
      hand_(site.hand),
      tools_(site.tray),
      gutter_(site.gutter),
      flap_(std::move(flap)),
      outside_P_mm_(outsideOf(gutter_)),
      forceps_R_PT_(heldAtGutter(gutter_, tools_[0])),
      step_(flap_ ? OperationStep{FlapStep{}, "incise to the bone"} : gutterStep()) {
  if (goes_on) {
    tray_ = operationTray(tools_);
    planner_.emplace(site.patient, tools_[tray_.bur].head.radius_mm, tray_.elevator.has_value());
    CleaningPlanner::Tips tips_mm{};
    for (std::size_t n = 0; n < kCleanings; ++n)
      if (tray_.cleaning[n]) tips_mm[n] = tools_[*tray_.cleaning[n]].head.radius_mm;
    cleaning_.emplace(planner_->out_P(), forceps_R_PT_ * glm::dvec3(0.0, 0.0, 1.0), tips_mm, planner_->tongue_P_mm());
  }
  if (flap_) return;
  // The hand rests where the gutter begins.
  news_.push_back(step_.words);
  lead(cutPath(gutter_, tools_[0], kGutter_mm_per_s));
  phase_ = Phase::working;
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
  const bool works = phase_ == Phase::working || phase_ == Phase::gripping;
  if (!works || !frame.is_applied || frame.newest.dt_s == 0.0) return {};
  if (!(frame.in_hand == tools_[wanted_])) return "another tool was taken";
  if (std::holds_alternative<CutStep>(step_.what) && !frame.drill_enabled) return "the drill was locked";
  if (!haptics::mayRunMotors(frame.newest.state)) return "the motors are off";
  return {};
}

std::size_t Demonstration::toolOf(const OperationStep& step) const {
  if (const FlapStep* const flap = std::get_if<FlapStep>(&step.what))
    return flap->raises ? flap_->elevator() : flap_->blade();
  if (const CutStep* const cut = std::get_if<CutStep>(&step.what)) return cut->bares_crown ? 0 : tray_.bur;
  if (std::holds_alternative<SplitStep>(step.what)) return *tray_.elevator;
  if (const CleaningStep* const cleaning = std::get_if<CleaningStep>(&step.what))
    return *tray_.cleaning[static_cast<std::size_t>(cleaning->what)];
  return tray_.forceps;
}

std::optional<ControlRequest> Demonstration::startStep(const Frame& frame) {
  news_.push_back(step_.words);
  if (const EndStep* const end = std::get_if<EndStep>(&step_.what)) {
    if (!end->why_not.empty()) fail(frame, end->why_not);
    enter(end->why_not.empty() && !std::exchange(is_out_, true) ? Phase::settling : Phase::over, frame);
    return {};
  }
  wanted_ = toolOf(step_);
  enter(Phase::changing_tool, frame);
  if (frame.in_hand == tools_[wanted_]) return {};
  return ControlRequest{Control::tool, static_cast<int>(wanted_)};
}

/// Once the tool is in the hand, and the pieces are ready for it.
void Demonstration::work(const Frame& frame) {
  if (!(frame.in_hand == tools_[wanted_])) return fail(frame, "its tool could not be taken");
  const HandPose hand = handOf(frame.newest);
  if (const FlapStep* const flap = std::get_if<FlapStep>(&step_.what)) {
    lead(flap->raises ? flap_->raisingPath(hand, outside_P_mm_) : flap_->incisionPath(hand, outside_P_mm_));
  } else if (const CutStep* const step = std::get_if<CutStep>(&step_.what)) {
    const double speed_mm_per_s = step->bares_crown ? kGutter_mm_per_s : kCut_mm_per_s;
    const haptics::LedPath path = cutPath(step->cut, tools_[wanted_], speed_mm_per_s);
    lead(joined(throughOutside(hand, startOf(path), outside_P_mm_), path));
  } else if (const CleaningStep* const cleaning = std::get_if<CleaningStep>(&step_.what)) {
    lead(cleaningPath(hand, outside_P_mm_, *cleaning, tools_[wanted_].head.radius_mm, forceps_R_PT_));
  } else {
    return workInSocket(frame, hand);
  }
  enter(Phase::working, frame);
}

/// With elevator or forceps, for which the pieces have to be ready.
void Demonstration::workInSocket(const Frame& frame, const HandPose& hand) {
  const double waited_s = frame.newest.t_s - since_s_;
  if (!frame.is_ready_to_grip) {
    if (waited_s >= kLongestWait_s) fail(frame, "the pieces were not made ready");
  } else if (const SplitStep* const split = std::get_if<SplitStep>(&step_.what)) {
    // Without a bridge that may break the bur goes on.
    if (frame.newest.bridge == haptics::BreakAnswer::armed) {
      lead(twistInSlot(hand, outside_P_mm_, *split));
      enter(Phase::working, frame);
    } else if (waited_s >= kBridgeWait_s) {
      enter(Phase::settling, frame);
    }
  } else {
    lead(gripAndRock(hand, outside_P_mm_, std::get<DeliveryStep>(step_.what), forceps_R_PT_));
    enter(Phase::gripping, frame);
  }
}

/// Nothing changes any more: no split, no undo, no command on its way.
bool Demonstration::isStill(const Frame& frame) const {
  const haptics::Tick& tick = frame.newest;
  return tick.split != haptics::SplitAnswer::waiting && tick.split != haptics::SplitAnswer::running &&
         tick.bridge != haptics::BreakAnswer::breaking && tick.drill_inhibit != haptics::DrillInhibit::undo_running &&
         frame.is_applied && tick.t_s - since_s_ >= kSettles_s;
}

/// The hand has gone to the end of its way.
std::optional<ControlRequest> Demonstration::afterStep(const Frame& frame) {
  if (FlapStep* const flap = std::get_if<FlapStep>(&step_.what)) {
    if (flap->raises) return enter(Phase::retracting, frame), std::nullopt;
    step_ = {FlapStep{true}, "raise the flap"};
    return startStep(frame);
  }
  enter(planner_ ? Phase::settling : Phase::over, frame);
  return {};
}

std::optional<ControlRequest> Demonstration::afterSettling(const Frame& frame) {
  planning_ = std::async(
      frame.waits ? std::launch::deferred : std::launch::async,
      [this, copy = copyOf(bodies_, frame.newest), left = frame.left, is_out = is_out_]() -> OperationStep {
        if (is_out) return cleaning_->next(left, bodies_.grid(), copy.jaw).value_or(OperationStep{EndStep{}, kAllDone});
        return planner_->next(copy, bodies_.bones()[1].grid(), bodies_.firstBrick() * assets::kBrickVoxels);
      });
  enter(Phase::planning, frame);
  return {};
}

std::optional<ControlRequest> Demonstration::follow(const Frame& frame) {
  const haptics::Tick& tick = frame.newest;
  if (const std::string why = interruption(frame); !why.empty()) fail(frame, why);
  switch (phase_) {
    case Phase::beginning:
      return tick.dt_s == 0.0 ? std::nullopt : startStep(frame);
    case Phase::changing_tool:
      if (frame.is_applied) work(frame);
      return {};
    case Phase::working:
      return hand_.hasArrived() ? afterStep(frame) : std::nullopt;
    case Phase::gripping: {
      const DeliveryStep& step = std::get<DeliveryStep>(step_.what);
      const bool is_loose = tick.gripped == step.piece + 1 && tick.torn_share >= haptics::kLooseShare;
      if (!is_loose && !hand_.hasArrived()) return {};
      lead(takeOut(handOf(tick), tick.X_PQ[step.piece], step, outside_P_mm_,
                   laidAt(outside_P_mm_, gutter_.surface_P_mm, forceps_R_PT_ * glm::dvec3(0.0, 0.0, 1.0))));
      enter(Phase::working, frame);
      return {};
    }
    case Phase::retracting:
      if (frame.is_flap_aside) {
        step_ = gutterStep();
        return startStep(frame);
      }
      if (tick.t_s - since_s_ >= kAssistantWait_s) fail(frame, "the flap could not be raised and held aside");
      return {};
    case Phase::settling:
      return isStill(frame) ? afterSettling(frame) : std::nullopt;
    case Phase::planning:
      if (!frame.waits && planning_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return {};
      step_ = planning_.get();
      return startStep(frame);
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
