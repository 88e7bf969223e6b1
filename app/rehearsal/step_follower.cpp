#include "app/rehearsal/step_follower.h"

#include <utility>

#include <fmt/core.h>

#include "app/session/measures/clearance_measures.h"
#include "assets/tooth.h"

namespace app {
namespace {

StepInstrument instrumentOf(const haptics::Tool& tool) {
  switch (tool.hand_instrument) {
    case haptics::HandInstrument::none:
    default:
      break;
    case haptics::HandInstrument::scalpel_15:
      return StepInstrument::scalpel;
    case haptics::HandInstrument::periosteal:
      return StepInstrument::periosteal_elevator;
    case haptics::HandInstrument::curette:
      return StepInstrument::curette;
    case haptics::HandInstrument::bone_file:
      return StepInstrument::bone_file;
    case haptics::HandInstrument::suction:
      return StepInstrument::suction;
  }
  return tool.isElevator() ? StepInstrument::elevator : tool.grips ? StepInstrument::forceps : StepInstrument::bur;
}

std::optional<double> toCanal_mm(const assets::RiskStructures& risks, const haptics::Tick& tick,
                                 const haptics::Tool& tool) {
  const assets::StructureDistance& canal = risks.of(assets::RiskStructure::canal);
  return canal.isEmpty() ? std::nullopt : std::optional(haptics::clearance_mm(canal, tool, heldPose(tick)));
}

}  // namespace

StepFollower::StepFollower(const RehearsalPlan& plan, const haptics::Bodies& bodies, EventLog& event_log)
    : plan_(plan),
      event_log_(event_log),
      tracker_(plan.flap_closed ? plan.procedure_steps->plan : withFlapRaised(plan.procedure_steps->plan)),
      prediction_(plan.procedure_steps->prediction) {
  if (plan.patient.site) operated_ = assets::toothName(plan.patient.site->fdi);
  if (tracker_.asksForBone() && plan.cut && plan.patient.site)
    gutter_.emplace(plan.patient, plan.scanned_solid.empty() ? plan.patient.ct.solid : plan.scanned_solid, *plan.cut,
                    bodies);
}

void StepFollower::start() {
  event_log_.note(kStepEvent, procedureText(run()));
  if (prediction_.isGiven()) event_log_.note(kPredictionEvent, predictionText(prediction_));
}

void StepFollower::predict(const std::string& difficulty, std::optional<double> minutes, double t_s) {
  prediction_.difficulty = difficulty;
  prediction_.minutes = minutes;
  prediction_.at_s = t_s;
  if (prediction_.isGiven()) event_log_.note(kPredictionEvent, predictionText(prediction_));
}

void StepFollower::follow(std::span<const haptics::Tick> ticks, const haptics::Command& command,
                          std::optional<double> bridge_mm, const std::optional<SocketRecord>& socket,
                          const std::optional<FlapFacts>& flap) {
  StepFacts facts;
  facts.flap = flap;
  facts.in_hand = instrumentOf(command.tool);
  facts.irrigating = command.irrigating;
  facts.bridge_mm = bridge_mm;
  if (socket && socket->is_out)
    facts.socket = SocketFacts{socket->chips.mm3, socket->follicle_left.value_or(0.0), sumOf(socket->edges),
                               socket->isClean(), socket->stitches};
  if (gutter_ && gutter_->newest()) {
    facts.gutter_removed = gutter_->newest()->gutter_removed;
    facts.crown_bared = gutter_->newest()->crown_bared;
  }
  for (const haptics::Tick& tick : ticks) {
    const bool cuts = tick.drilling && tick.depth_mm > 0.0;
    facts.nerve_mm = cuts ? toCanal_mm(plan_.risks, tick, command.tool) : std::nullopt;
    tracker_.follow(tick, facts);
  }
  tell();
}

void StepFollower::follow(const Touch& touch) {
  if (touch.what == operated_) return;
  tracker_.blame(touch.what == kCanalTouch ? StepError::canal : StepError::neighbour);
  tell();
}

void StepFollower::followBone(std::span<const glm::ivec3> bricks, double t_s, bool waits) {
  if (gutter_ && tracker_.asksForBone()) gutter_->follow(bricks, t_s, waits);
}

std::string StepFollower::skip() {
  const auto step = tracker_.current();
  if (!tracker_.skip()) return "there is no step to skip";
  const std::string line = "skipped: " + tracker_.plan().steps[*step].title;
  tell();
  return line;
}

void StepFollower::finish() {
  tracker_.finish();
  tell();
}

void StepFollower::tell() {
  for (const std::string& event : tracker_.takeEvents()) event_log_.note(kStepEvent, event);
  std::string given, before;
  for (const std::string& one : tracker_.takeGiven())
    if (one != std::exchange(before, one)) given += (given.empty() ? "" : "; ") + one;
  if (tracker_.current() == told_) return;
  told_ = tracker_.current();
  if (plan_.procedure_steps->guidance != Guidance::guided) return;
  const std::string next = told_ ? tracker_.plan().steps[*told_].instruction : "all steps have ended";
  const std::string line = given.empty() || next.empty() ? given + next : given + ". " + next;
  if (!line.empty()) news_.push_back(line);
}

std::string StepFollower::task() const {
  if (plan_.procedure_steps->guidance != Guidance::guided) return "";
  const StepPlan& plan = tracker_.plan();
  const auto step = tracker_.current();
  if (!step) return fmt::format("{} steps done: end with Esc", plan.steps.size());
  const std::string missing = tracker_.missing();
  return fmt::format("{}/{} {}{}", *step + 1, plan.steps.size(), plan.steps[*step].title,
                     missing.empty() ? "" : ": " + missing);
}

std::optional<std::string> StepFollower::news() {
  if (news_.empty()) return {};
  std::string line = news_.front();
  news_.pop_front();
  return line;
}

bool StepFollower::showsGutter() const {
  const auto step = tracker_.current();
  return plan_.procedure_steps->guidance == Guidance::guided && step &&
         tracker_.plan().steps[*step].region == StepRegion::gutter;
}

ProcedureRun StepFollower::run() const {
  return {tracker_.plan().name, std::string(kGuidances[static_cast<std::size_t>(plan_.procedure_steps->guidance)]),
          tracker_.records()};
}

}  // namespace app
