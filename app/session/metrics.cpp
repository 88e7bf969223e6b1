#include "app/session/metrics.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "app/session/assessment_event.h"
#include "app/session/coach_event.h"
#include "app/session/eyes_event.h"
#include "app/session/field_clarity.h"
#include "app/session/measures/clearance_measures.h"
#include "app/session/measures/hand_work.h"
#include "app/session/measures/near_work.h"
#include "app/session/measures/onlooker.h"
#include "app/session/measures/original_surface.h"
#include "app/session/measures/outcome.h"
#include "app/session/measures/practice_measures.h"
#include "app/session/measures/rests_on.h"
#include "app/session/measures/tissue_work.h"
#include "app/session/session_error.h"
#include "app/text/parse_number.h"

namespace app {
namespace {

using haptics::Fault;

/// The value below which `fraction` of all lie; reorders them.
double quantile(std::vector<float>& values, double fraction) {
  if (values.empty()) return 0.0;
  const auto nth = static_cast<std::ptrdiff_t>(fraction * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + nth, values.end());
  return static_cast<double>(values[static_cast<std::size_t>(nth)]);
}

constexpr double kObscured = 0.5;  ///< share of the cut in view

/// Adds one tick; `before` is the previous one, `clarity` that of the field.
void addTick(SessionMetrics& sum, const haptics::Tick& tick, const std::optional<haptics::Tick>& before,
             bool irrigating, double clarity) {
  const double force_N = glm::length(tick.commanded_force_P_N.xyz);
  const bool touches = tick.overlap_mm3 > 0.0;
  ++sum.ticks;
  sum.duration_s = tick.t_s + tick.dt_s;
  if (touches) sum.contact_s += tick.dt_s, sum.mean_contact_force_N += force_N * tick.dt_s;
  if (tick.drilling) sum.drill_on_s += tick.dt_s;
  if (tick.drilling && touches) sum.drill_in_contact_s += tick.dt_s;
  if (tick.drilling && touches && !irrigating) sum.dry_drilling_s += tick.dt_s;
  if (tick.drilling && touches && clarity < kObscured) sum.obscured_s += tick.dt_s;
  sum.max_force_N = std::max(sum.max_force_N, force_N);
  if (tick.gripped != 0) sum.grip_s += tick.dt_s;
  sum.max_grip_N = std::max(sum.max_grip_N, glm::length(tick.grip_force_P_N.xyz));
  if (tick.lever.piece != 0) sum.lever_s += tick.dt_s;
  sum.max_lever_Nmm = std::max(sum.max_lever_Nmm, std::abs(tick.lever.twist_Nmm));
  sum.max_fulcrum_N = std::max(sum.max_fulcrum_N, tick.lever.on_teeth_N);
  sum.ligament_torn_Nmm = tick.torn_total_Nmm;
  if (const haptics::BrokenBridge& broke = tick.broken; broke.piece != 0) {
    sum.bridges_broken += 1.0;
    sum.bridge_breaks.push_back({tick.t_s, broke.force_N, broke.bending_Nmm, broke.area_mm2, broke.is_complete});
  }
  sum.pieces_out = 0.0;
  for (std::size_t n = 0; n < tick.pieces; ++n)
    if (haptics::Bodies::isAside(tick.X_PQ[n])) sum.pieces_out += 1.0;
  sum.max_depth_mm = std::max(sum.max_depth_mm, tick.depth_mm);
  sum.removed_mm3 += tick.removed_mm3;  // without lost ticks
  if (tick.removed_mm3 < 0.0) sum.returned_mm3 -= tick.removed_mm3;
  if (has(tick.faults, Fault::clamped | Fault::slewed)) sum.limited_s += tick.dt_s;
  if (has(tick.faults, Fault::bad_pose | Fault::bad_force | Fault::device)) sum.faulty_s += tick.dt_s;
  if (before && !has(tick.faults, Fault::bad_pose) && !has(before->faults, Fault::bad_pose)) {
    const double step_mm = glm::distance(tick.hand.X_PT.translation_mm, before->hand.X_PT.translation_mm);
    sum.path_mm += step_mm;
    if (tick.drilling) sum.drilling_path_mm += step_mm;
  }
}

/// "7.30 mm from (…) to (…) mm"; none of other words.
std::optional<double> measuredMm(const std::string& text) {
  const std::size_t end = text.find(" mm from ");
  return end == std::string::npos ? std::nullopt : parseNumber<double>(std::string_view(text).substr(0, end));
}

/// None where a replay ends with another bone than the recording.
std::optional<std::vector<std::uint8_t>> knownBone(BoneLeft left, SessionMetrics& metrics) {
  if (left.divergence) return {};
  if (left.removed_mm3) metrics.removed_mm3_by_label = std::move(left.removed_mm3);
  return std::move(left.solid);
}

/// What is told by events.
void addEvents(SessionMetrics& metrics, const std::vector<SessionEvent>& events) {
  for (const SessionEvent& event : events) {
    if (event.kind == kTouchEvent) {
      if (!metrics.touched) metrics.touched.emplace();
      if (const auto touch = touchFrom(event.text)) countInto(*metrics.touched, *touch);
    }
    if (event.kind == kDrawnPlanEvent) metrics.drawn_plan = drawnPlanFrom(event.text);
    if (event.kind == kDrawnCutEvent) metrics.drawn_cut = drawnCutFrom(event.text);
    if (event.kind == kFlapEvent) metrics.flap = flapFrom(event.text);
    if (event.kind == kSocketEvent) metrics.socket = socketFrom(event.text);
    if (event.kind == kWayEvent) metrics.way = wayFrom(event.text), ++metrics.ways_looked_at;
    if (event.kind == kStepEvent) addStepEvent(metrics.procedure, event.text);
    if (event.kind == kPredictionEvent) metrics.prediction = predictionFrom(event.text);
    // Eyes and assessments are recorded since the same version.
    if (event.kind == kEyesEvent && !metrics.assessed) metrics.assessed = false;
    if (event.kind == kAssessmentEvent) {
      metrics.assessed = true;
      if (event.text.starts_with(kHelpRefused)) ++metrics.help_refused;
    }
    if (event.kind == kCoachEvent) ++metrics.coach_said;
    if (event.kind == kServoEvent) metrics.conditions.missed_ticks = missedTicksFrom(event.text);
    if (event.kind == kEyesEvent)
      if (const auto eyes = eyesFrom(event.text)) metrics.conditions.stereo = eyes->in_stereo;
  }
}

}  // namespace

SessionMetrics metricsOf(const std::string& path, const CaseOf& case_of, const BoneLeft* left) {
  SessionReader session(path);
  refuseDamaged(session, path);
  SessionMetrics metrics;
  const StoredStart start = session.start();
  metrics.patient_title = start.patient_title;
  metrics.program_version = start.program_version;
  metrics.calibration = start.calibration;
  metrics.former = start.setup.former;
  metrics.proposed = start.setup.proposed;
  metrics.closed = session.closed();
  metrics.missing_log = session.missingLog();
  const std::vector<SessionCommand> commands = session.commands();
  metrics.commands = commands.size();
  const std::vector<SessionEvent> events = session.events();
  metrics.events = events.size();
  addEvents(metrics, events);

  const SessionCase about = case_of ? case_of(start) : SessionCase();
  // A replay, of a recording that was not closed, is for who looks at the case.
  std::optional<std::vector<std::uint8_t>> after;
  const auto bone_left = [&] { return knownBone(left != nullptr ? *left : boneLeft(session, start), metrics); };
  if (case_of) after = bone_left();
  std::optional<RemovalClock> clock;
  if (after) clock.emplace(start.grid, start.solid, *after);
  std::vector<float> work_us;
  auto event = events.begin();
  SoftTouchCounter soft_touches;
  haptics::Command in_force;
  auto next = commands.begin();
  std::optional<haptics::Tick> before;
  FieldClarity field;
  HandWork work;
  const OriginalSurface surface(start.grid, start.solid);
  ClearanceMeasures clearance(about.risks);
  NearWork near(about.risks);
  TissueWork tissues;
  Onlooker onlooker;
  std::optional<double> parted_s;
  std::optional<double> out_s;  // of all pieces of the tooth
  bool is_removal_stored = false;
  for (TickBlock block = session.nextBlock(); !block.ticks.empty(); block = session.nextBlock()) {
    for (const haptics::Tick& tick : block.ticks) {
      for (; next != commands.end() && next->first_tick <= tick.index; ++next) {
        in_force = next->command;
        metrics.conditions.follow(in_force);
        onlooker.add(in_force, tick.t_s);
      }
      field.step(tick, in_force.irrigating);
      addTick(metrics, tick, before, in_force.irrigating, field.cover().clarity());
      work.add(workSample(tick, in_force, &surface));
      clearance.add(tick, in_force.tool);
      near.add(tick, in_force.tool);
      tissues.add(tick, in_force);
      if (clock) clock->add(tick, in_force.tool);
      if (!parted_s && (tick.broken.piece != 0 || (tick.pieces > 1 && before && before->pieces < 2)))
        parted_s = tick.t_s;
      const bool is_out = tick.pieces > 0 && metrics.pieces_out == static_cast<double>(tick.pieces);
      if (!is_out) out_s.reset();
      if (is_out && !out_s) out_s = tick.t_s;
      for (; event != events.end() && event->tick <= tick.index; ++event) {
        onlooker.add(*event, tick.t_s);
        if (event->kind != kRulerEvent) continue;
        if (const auto mm = measuredMm(event->text)) metrics.measured.push_back({tick.t_s, *mm, event->text});
      }
      onlooker.add(tick);
      soft_touches.add(tick);
      work_us.push_back(tick.work_us);
      before = tick;
    }
    if (!block.removed_mm3) continue;
    metrics.removed_mm3_by_label = std::move(block.removed_mm3);
    is_removal_stored = true;
  }
  if (metrics.missing_log && metrics.ticks == 0) throw missingLogError(path, *metrics.missing_log);
  metrics.lost = session.lost();
  if (!is_removal_stored && !case_of) bone_left();
  if (is_removal_stored) {
    metrics.removed_mm3 = 0.0;
    for (const auto& [tissue, removed_mm3] : *metrics.removed_mm3_by_label) metrics.removed_mm3 += removed_mm3;
  }
  if (metrics.contact_s > 0.0) metrics.mean_contact_force_N /= metrics.contact_s;
  work.finish();
  const auto add = [&metrics](std::vector<MeasureValue> values) {
    metrics.measures.insert(metrics.measures.end(), std::make_move_iterator(values.begin()),
                            std::make_move_iterator(values.end()));
  };
  constexpr std::string_view kNotLookedAt = "the case was not looked at";
  add(work.values());
  add(tissues.values(about.plan ? std::optional(about.plan->bur_radius_mm) : std::nullopt));
  add(case_of ? clearance.values() : noClearances(kNotLookedAt));
  add(case_of ? near.values() : noNearWork(kNotLookedAt));
  add(noEnvelope());
  add(!case_of ? noSight(kNotLookedAt)
               : onlooker.values(
                     {clock ? &*clock : nullptr, start, after.value_or(std::vector<std::uint8_t>()), about, out_s}));
  add(!case_of ? noOutcome(kNotLookedAt)
      : !clock ? noOutcome("the bone at the end is not known")
               : outcomeMeasures(
                     {start, *after, *clock, &surface, about, metrics.socket, parted_s, metrics.removed_mm3_by_label}));
  if (const auto task = assets::practiceTaskOf(start.setup.practice); task && clock)
    add(practiceMeasures(*task, start.grid, start.label, start.solid, *after));
  for (MeasureValue& measure : metrics.measures) measure.is_confirmed = isConfirmed(measure.id, metrics.proposed);
  metrics.envelope = near.envelope();
  metrics.soft_touches = soft_touches.counts();
  metrics.work_p50_us = quantile(work_us, 0.50);
  metrics.work_p99_us = quantile(work_us, 0.99);
  metrics.work_max_us = quantile(work_us, 1.00);
  return metrics;
}

}  // namespace app
