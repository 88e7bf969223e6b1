#include "app/rehearsal/operated_site.h"

#include <fmt/core.h>

#include "assets/scan/tooth_division.h"

namespace app {
namespace {

/// Before the first cut, where a rehearsal goes on; empty: it begins with it.
std::vector<std::uint8_t> wholeTooth(const RehearsalPlan& plan) {
  if (plan.scanned_solid.empty()) return {};
  const assets::CtVolume& ct = plan.patient.ct;
  const auto is_tooth = assets::voxelsOfTooth(ct, plan.patient.operatedTooth());
  return assets::divideByTooth(ct.grid, plan.scanned_solid, ct.label, is_tooth).tooth.solid;
}

}  // namespace

OperatedSite::OperatedSite(const Links& links)
    : links_(links),
      bodies_(links.station.bodies()),
      tooth_(bodies_, wholeTooth(links.plan)),
      sites_(bodies_),
      socket_(links.plan, bodies_, links.event_log),
      ways_(links.plan, bodies_, links.event_log),
      drawn_(links.plan, bodies_, links.event_log),
      jaw_stress_(links.plan.patient),
      root_stress_(links.plan.patient) {
  if (links.plan.flap_closed) flap_.emplace(links.plan, links.event_log);
}

void OperatedSite::follow(std::span<const haptics::Tick> ticks) {
  const haptics::Command& command = links_.command.inForce();
  followLuxation(ticks);
  socket_.follow(ticks, command);
  if (flap_) flap_->follow(ticks, command, links_.station.commandSerial());
}

void OperatedSite::followLuxation(std::span<const haptics::Tick> ticks) {
  const auto volume_mm3 = [this](std::size_t piece) { return sites_.volume_mm3(piece); };
  for (const LuxationLog::Told& told :
       luxation_.follow(ticks, links_.command.inForce().tool.grips, sites_.isReady(), volume_mm3)) {
    links_.head_up.say(told.line);
    if (told.is_event) links_.event_log.note(told.by_elevator ? "elevator" : "forceps", told.line);
  }
}

void OperatedSite::follow(const Frame& frame, render::Frame& picture) {
  tooth_.follow(frame.bricks, frame.newest, links_.waits);
  const bool may_loosen = frame.may_loosen && links_.station.isApplied(frame.newest);
  if (const auto order = socket_.follow({frame.bricks, frame.newest, may_loosen, links_.waits}))
    links_.command.loosen(*order);
  followDrawn(frame, picture);
  followFlap(picture);
  if (const auto line = socket_.news()) links_.head_up.say(*line);
  followWays(frame, picture);
  if (links_.station.isApplied(frame.newest)) makePiecesReady(frame.newest);
  followStress(frame.newest);
  if (const auto order = tooth_.order(frame.newest)) links_.command.split(*order);
  if (const auto line = tooth_.news()) {
    links_.head_up.say(*line);
    links_.event_log.note("tooth", *line);
  }
}

void OperatedSite::followDrawn(const Frame& frame, render::Frame& picture) {
  for (const auto& touched : frame.drawn) links_.head_up.say(touched ? drawn_.mark(*touched) : drawn_.nextLine());
  picture.beads = socket_.beads();
  const std::vector<render::Bead> drawn = drawn_.beads();
  picture.beads.insert(picture.beads.end(), drawn.begin(), drawn.end());
}

void OperatedSite::followFlap(render::Frame& picture) {
  if (!flap_) return;
  flap_->show(picture);
  links_.command.layFlapAside(flap_->flap().isAside());
  while (const auto line = flap_->news()) links_.head_up.say(*line);
}

void OperatedSite::followWays(const Frame& frame, render::Frame& picture) {
  if (frame.asks_way) ways_.ask();
  ways_.follow(frame.bricks, frame.newest, !frame.is_shown, links_.waits);
  picture.obstacles = ways_.obstacles();
  if (const auto line = ways_.news()) links_.head_up.say(*line);
}

void OperatedSite::followStress(const haptics::Tick& newest) {
  jaw_stress_.follow(newest, [this] { return bodies_.jaw().copyBox(glm::ivec3(0), bodies_.grid().size); });
  root_stress_.follow(newest, bodies_);
  if (const auto line = root_stress_.news()) links_.event_log.note("tooth", *line);
}

/// And the bridge to break, while forceps or an elevator are in the hand.
void OperatedSite::makePiecesReady(const haptics::Tick& newest) {
  const bool luxates = links_.command.inForce().tool.luxates();
  if (const auto order = sites_.follow(newest, luxates, links_.waits)) links_.command.makeReady(*order);
  if (const auto order = tooth_.bridgeOrder(newest, luxates, links_.waits)) links_.command.arm(*order);
}

std::optional<FlapFacts> OperatedSite::flapFacts() const {
  if (!flap_) return {};
  const FlapRecord& flap = flap_->newest();
  return FlapFacts{flap.incision_mm * flap.full_share, flap.raised_share, flap_->flap().isAside()};
}

void OperatedSite::finish(std::span<const glm::ivec3> bricks, const haptics::Tick& newest) {
  if (flap_) flap_->finish();
  socket_.finish(bricks, newest);
  compared_ = drawn_.finish();
}

void OperatedSite::describe(RehearsalFigures& figures) {
  figures.tooth = tooth_.ending();
  figures.luxation = luxation_.summary();
  if (flap_) figures.flap = flap_->newest();
  figures.socket = socket_.newest();
  figures.way = ways_.words();
  if (compared_) figures.drawn = drawnCutInWords(*compared_);
  const auto add_stress = [&](const char* what, double most_N_per_mm2) {
    if (most_N_per_mm2 <= 0.0) return;
    figures.luxation +=
        fmt::format("{}{} stressed to {:.0f} MPa (model)", figures.luxation.empty() ? "" : ", ", what, most_N_per_mm2);
  };
  add_stress("jaw", jaw_stress_.most_N_per_mm2());
  add_stress("root or crown", root_stress_.most_N_per_mm2());
}

}  // namespace app
