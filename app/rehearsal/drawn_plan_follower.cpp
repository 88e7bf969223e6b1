#include "app/rehearsal/drawn_plan_follower.h"

#include <algorithm>
#include <utility>

#include <fmt/core.h>

#include "app/procedure/drawn_plan/drawn_cut.h"
#include "assets/scan/tooth_division.h"

namespace app {
namespace {

constexpr double kDrawnBall_mm = 0.3, kDrawnStep_mm = 0.5;

/// Of all its pieces, each where it came from.
std::vector<std::uint8_t> toothOf(const haptics::Bodies& bodies) {
  const auto copy = [&](std::size_t n) {
    const haptics::CarvedBone& piece = bodies.bones()[n + 1];
    return piece.copyBox(glm::ivec3(0), piece.grid().size);
  };
  std::vector<std::uint8_t> tooth = copy(0);
  for (std::size_t n = 1; n < bodies.pieces(); ++n) {
    const std::vector<std::uint8_t> piece = copy(n);
    for (std::size_t v = 0; v < tooth.size(); ++v)
      tooth[v] = static_cast<std::uint8_t>(std::min(255, tooth[v] + piece[v]));
  }
  return tooth;
}

std::vector<std::uint8_t> jawOf(const haptics::Bodies& bodies) {
  return bodies.jaw().copyBox(glm::ivec3(0), bodies.grid().size);
}

}  // namespace

DrawnPlanFollower::DrawnPlanFollower(const RehearsalPlan& plan, const haptics::Bodies& bodies, EventLog& event_log)
    : plan_(plan), bodies_(bodies), event_log_(event_log) {
  if (plan.drawn.isEmpty()) return;
  begin();
  drawn_ = plan.drawn;
  drawing_ = drawn_[DrawnLine::section].empty() ? Drawing::section : Drawing::done;
  record();
}

/// Of a rehearsal that goes on, as scanned: what was cut before the pause counts.
void DrawnPlanFollower::begin() {
  if (!plan_.scanned_solid.empty()) {
    const assets::CtVolume& ct = plan_.patient.ct;
    const haptics::Bodies scanned(ct.grid, plan_.scanned_solid, ct.label,
                                  assets::voxelsOfTooth(ct, plan_.patient.operatedTooth()));
    jaw_before_ = jawOf(scanned);
    if (scanned.pieces() > 0) tooth_before_ = toothOf(scanned);
    return;
  }
  jaw_before_ = jawOf(bodies_);
  if (bodies_.pieces() > 0) tooth_before_ = toothOf(bodies_);
}

void DrawnPlanFollower::record() { event_log_.note(kDrawnPlanEvent, drawnPlanText(drawn_)); }

std::string DrawnPlanFollower::mark(const glm::dvec3& p_P_mm) {
  if (drawing_ == Drawing::done) return "the plan is drawn: Shift+G begins anew";
  const auto which = static_cast<DrawnLine>(drawing_);
  std::vector<glm::dvec3>& line = drawn_[which];
  if (line.size() >= kMostDrawnPoints) return "the line has enough points: Shift+G ends it";
  if (jaw_before_.empty()) begin();
  line.push_back(p_P_mm);
  record();
  const std::string name(kDrawnLineNames[static_cast<std::size_t>(which)]);
  if (line.size() == 1) return name + ": next point, G; Shift+G ends the line";
  return fmt::format("{} {:.1f} mm, {} points", name, lengthOf_mm(line), line.size());
}

std::string DrawnPlanFollower::nextLine() {
  switch (drawing_) {
    case Drawing::trough:
      // Whoever draws no trough goes on to the section.
      if (drawn_[DrawnLine::trough].size() == 1) drawn_[DrawnLine::trough].clear(), record();
      drawing_ = Drawing::section;
      return "the section's line now: touch the tooth, G";
    case Drawing::section:
      if (drawn_[DrawnLine::section].size() == 1) drawn_[DrawnLine::section].clear(), record();
      drawing_ = Drawing::done;
      return drawn_.isEmpty()
                 ? "nothing is drawn"
                 : fmt::format("drawn: trough {:.1f} mm, section {:.1f} mm; compared at the end",
                               lengthOf_mm(drawn_[DrawnLine::trough]), lengthOf_mm(drawn_[DrawnLine::section]));
    case Drawing::done:
      break;
  }
  drawn_ = {};
  jaw_before_.clear();
  drawing_ = Drawing::trough;
  record();
  return "the trough's line anew: touch the bone, G";
}

std::vector<render::Bead> DrawnPlanFollower::beads() const {
  std::vector<render::Bead> beads;
  const auto add = [&](const glm::dvec3& p, double radius_mm) {
    beads.push_back({{p}, radius_mm, render::BeadKind::drawn});
  };
  for (const std::vector<glm::dvec3>& line : drawn_.line_P_mm)
    for (std::size_t n = 0; n < line.size(); ++n) {
      add(line[n], kDrawnBall_mm);
      if (n == 0) continue;
      const int steps = static_cast<int>(glm::distance(line[n - 1], line[n]) / kDrawnStep_mm);
      for (int step = 1; step < steps; ++step)
        add(glm::mix(line[n - 1], line[n], static_cast<double>(step) / steps), 0.6 * kDrawnBall_mm);
    }
  return beads;
}

std::optional<DrawnComparison> DrawnPlanFollower::finish() {
  if (jaw_before_.empty()) return {};
  const glm::dvec3 outward_P = plan_.cut ? plan_.cut->outward_P : glm::dvec3(0.0, 0.0, 1.0);
  DrawnComparison comparison;
  if (const auto& trough = drawn_[DrawnLine::trough]; trough.size() > 1)
    comparison[0] = drawnCut(trough, outward_P, kBesideTrough_mm, bodies_.grid(), jaw_before_, jawOf(bodies_));
  if (const auto& section = drawn_[DrawnLine::section]; section.size() > 1 && !tooth_before_.empty())
    comparison[1] =
        drawnCut(section, outward_P, kBesideSection_mm, bodies_.bones()[1].grid(), tooth_before_, toothOf(bodies_));
  if (!comparison[0] && !comparison[1]) return {};
  event_log_.note(kDrawnCutEvent, drawnCutText(comparison));
  return comparison;
}

}  // namespace app
