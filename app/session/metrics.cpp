#include "app/session/metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "app/session/field_clarity.h"
#include "app/session/measures/clearance_measures.h"
#include "app/session/measures/hand_work.h"
#include "app/session/measures/original_surface.h"
#include "app/session/replay.h"
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

/// None where the replay ends with another bone.
std::optional<RemovedByTissue> removedByReplay(SessionReader& session) {
  const ReplayedState end = replayTo(session, std::numeric_limits<double>::infinity());
  if (end.divergence) return std::nullopt;
  return removedByKey(end.bodies.removedByTissue_mm3());
}

}  // namespace

SessionMetrics metricsOf(const std::string& path, const RisksOf& risks_of) {
  SessionReader session(path);
  refuseDamaged(session, path);
  SessionMetrics metrics;
  const StoredStart about = session.about();
  metrics.patient_title = about.patient_title;
  metrics.program_version = about.program_version;
  metrics.calibration = about.calibration;
  metrics.former = about.setup.former;
  metrics.closed = session.closed();
  metrics.missing_log = session.missingLog();
  const std::vector<SessionCommand> commands = session.commands();
  metrics.commands = commands.size();
  std::vector<SessionEvent> events = session.events();
  metrics.events = events.size();
  for (const SessionEvent& event : events) {
    if (event.kind == kTouchEvent) {
      if (!metrics.touched) metrics.touched.emplace();
      if (const auto touch = touchFrom(event.text)) countInto(*metrics.touched, *touch);
    }
    if (event.kind == kFlapEvent) metrics.flap = flapFrom(event.text);
    if (event.kind == kSocketEvent) metrics.socket = socketFrom(event.text);
    if (event.kind == kWayEvent) metrics.way = wayFrom(event.text), ++metrics.ways_looked_at;
    if (event.kind == kStepEvent) addStepEvent(metrics.procedure, event.text);
    if (event.kind == kPredictionEvent) metrics.prediction = predictionFrom(event.text);
  }
  std::erase_if(events, [](const SessionEvent& event) { return event.kind != kRulerEvent || !measuredMm(event.text); });

  std::vector<float> work_us;
  auto ruler = events.begin();
  SoftTouchCounter soft_touches;
  haptics::Command in_force;
  auto next = commands.begin();
  std::optional<haptics::Tick> before;
  FieldClarity field;
  HandWork work;
  const StoredStart start = session.start();
  const OriginalSurface surface(start.grid, start.solid);
  const assets::RiskStructures risks = risks_of ? risks_of(start) : assets::RiskStructures();
  ClearanceMeasures clearance(risks);
  for (TickBlock block = session.nextBlock(); !block.ticks.empty(); block = session.nextBlock()) {
    for (const haptics::Tick& tick : block.ticks) {
      for (; next != commands.end() && next->first_tick <= tick.index; ++next) in_force = next->command;
      field.step(tick, in_force.irrigating);
      addTick(metrics, tick, before, in_force.irrigating, field.cover().clarity());
      work.add(workSample(tick, in_force, &surface));
      clearance.add(tick, in_force.tool);
      for (; ruler != events.end() && ruler->tick <= tick.index; ++ruler)
        metrics.measured.push_back({tick.t_s, *measuredMm(ruler->text), ruler->text});
      soft_touches.add(tick);
      work_us.push_back(tick.work_us);
      before = tick;
    }
    metrics.removed_mm3_by_label = std::move(block.removed_mm3);
  }
  if (metrics.missing_log && metrics.ticks == 0) throw missingLogError(path, *metrics.missing_log);
  metrics.lost = session.lost();
  if (metrics.removed_mm3_by_label) {
    metrics.removed_mm3 = 0.0;
    for (const auto& [tissue, removed_mm3] : *metrics.removed_mm3_by_label) metrics.removed_mm3 += removed_mm3;
  } else {
    metrics.removed_mm3_by_label = removedByReplay(session);
  }
  if (metrics.contact_s > 0.0) metrics.mean_contact_force_N /= metrics.contact_s;
  work.finish();
  metrics.measures = work.values();
  const auto clearances = risks_of ? clearance.values() : noClearances("the case was not looked at");
  metrics.measures.insert(metrics.measures.end(), clearances.begin(), clearances.end());
  metrics.soft_touches = soft_touches.counts();
  metrics.work_p50_us = quantile(work_us, 0.50);
  metrics.work_p99_us = quantile(work_us, 0.99);
  metrics.work_max_us = quantile(work_us, 1.00);
  return metrics;
}

}  // namespace app
