#include "app/debrief/session_story.h"

#include <algorithm>
#include <cmath>

#include "app/options/bur_name.h"
#include "app/session/coach_event.h"
#include "app/session/measures/clearance_measures.h"
#include "app/session/step_event.h"
#include "app/session/touch_event.h"
#include "haptics/tool/clearance.h"

namespace app {
namespace {

constexpr double kUndoPause_s = 1.0;
constexpr std::string_view kBegin = "begin ", kError = "error in ";

/// "begin gutter at 12.000 s: Cut the gutter": what stands after the time.
std::string afterTime(const std::string& text) {
  const std::size_t at = text.find(" s: ");
  return at == std::string::npos ? text : text.substr(at + 4);
}

/// What is worth a mark. Never a path or a calibration's name.
std::optional<SessionMark> markFrom(const SessionEvent& event) {
  if (event.kind == kStepEvent) {
    if (event.text.starts_with(kBegin)) return SessionMark{0.0, MarkKind::step, afterTime(event.text)};
    if (event.text.starts_with(kError)) return SessionMark{0.0, MarkKind::error, afterTime(event.text)};
    return {};
  }
  if (event.kind == kCoachEvent) return SessionMark{0.0, MarkKind::coach, event.text};
  if (event.kind == kTouchEvent) {
    // The tooth that is operated on is meant to be touched.
    const auto touch = touchFrom(event.text);
    if (!touch || touch->what.ends_with("third molar")) return {};
    return SessionMark{0.0, MarkKind::touch, touch->what + " touched"};
  }
  if (event.kind == "soft tissue" && event.text.starts_with("bur on"))
    return SessionMark{0.0, MarkKind::touch, event.text};
  for (const char* kind : {"tooth", "forceps", "elevator", "stitch", "procedure", "flap told", "emergency stop"})
    if (event.kind == kind) return SessionMark{0.0, MarkKind::event, event.text};
  return {};
}

}  // namespace

void SessionStory::note(const haptics::Tick& tick, const SessionEvent& event) {
  if (auto mark = markFrom(event)) {
    mark->t_s = tick.t_s;
    marks_.push_back(std::move(*mark));
  }
}

void SessionStory::follow(const haptics::Tick& tick, const haptics::Command& command) {
  for (; next_event_ < events_.size() && events_[next_event_].tick <= tick.index; ++next_event_)
    note(tick, events_[next_event_]);
  if (!tool_ || !(*tool_ == command.tool)) {
    if (tool_) marks_.push_back({tick.t_s, MarkKind::tool, toolName(command.tool)});
    tool_ = command.tool;
  }
  if (tick.broken.piece != 0) marks_.push_back({tick.t_s, MarkKind::event, "a bridge of the tooth broke"});
  if (tick.restored_total_mm3 > restored_mm3_ &&
      (marks_.empty() || marks_.back().kind != MarkKind::undo || tick.t_s - marks_.back().t_s > kUndoPause_s))
    marks_.push_back({tick.t_s, MarkKind::undo, "undone"});
  restored_mm3_ = tick.restored_total_mm3;

  if (tick.t_s < next_sample_s_) return;
  next_sample_s_ = tick.t_s + kBetweenSamples_s - 0.5 * tick.dt_s;
  StorySample sample;
  sample.t_s = static_cast<float>(tick.t_s);
  sample.at_P_mm = glm::vec3(tick.proxy_P.mm);
  sample.force_N = static_cast<float>(glm::length(tick.law_force_P_N.xyz));
  sample.drilling = tick.drilling;
  if (!command.tool.grips && !has(tick.faults, haptics::Fault::bad_pose)) {
    const haptics::Clearances near_mm = haptics::clearances_mm(risks_, command.tool, heldPose(tick));
    for (std::size_t n = 0; n < near_mm.size(); ++n) {
      if (!near_mm[n]) continue;
      sample.clearance_mm = std::min(sample.clearance_mm, static_cast<float>(*near_mm[n]));
      sample.level = std::max(sample.level, assets::riskLevel(n, *near_mm[n]));
    }
  }
  most_force_N_ = std::max(most_force_N_, static_cast<double>(sample.force_N));
  samples_.push_back(sample);
}

std::span<const StorySample> SessionStory::samplesBefore(double t_s, double length_s) const {
  const auto first = std::ranges::lower_bound(samples_, static_cast<float>(t_s - length_s), {}, &StorySample::t_s);
  const auto last = std::ranges::lower_bound(samples_, static_cast<float>(t_s), {}, &StorySample::t_s);
  return first < last ? std::span(first, last) : std::span<const StorySample>();
}

std::vector<render::Bead> trailOf(std::span<const StorySample> samples, TrailColour colour) {
  constexpr float kLeastApart_mm = 0.25F;
  constexpr double kRadius_mm = 0.18;
  std::vector<render::Bead> beads;
  if (colour == TrailColour::none) return beads;
  glm::vec3 last_P_mm(1e9F);
  for (const StorySample& sample : samples) {
    if (glm::distance(sample.at_P_mm, last_P_mm) < kLeastApart_mm) continue;
    last_P_mm = sample.at_P_mm;
    render::Bead bead;
    bead.at_P.mm = glm::dvec3(sample.at_P_mm);
    bead.radius_mm = kRadius_mm;
    bead.kind = render::BeadKind::trail;
    bead.number =
        colour == TrailColour::clearance
            ? static_cast<std::uint64_t>(sample.level)
            : static_cast<std::uint64_t>((sample.force_N > 1.0F) + (sample.force_N > 2.0F) + (sample.force_N > 4.0F));
    beads.push_back(bead);
  }
  return beads;
}

}  // namespace app
