#include "app/session/metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "app/session/field_clarity.h"
#include "app/session/measures/hand_work.h"
#include "app/session/measures/original_surface.h"
#include "app/session/replay.h"
#include "app/session/session_error.h"
#include "app/text/clock_text.h"
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

SessionMetrics metricsOf(const std::string& path) {
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
    if (event.kind == kSocketEvent) metrics.socket = socketFrom(event.text);
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
  for (TickBlock block = session.nextBlock(); !block.ticks.empty(); block = session.nextBlock()) {
    for (const haptics::Tick& tick : block.ticks) {
      for (; next != commands.end() && next->first_tick <= tick.index; ++next) in_force = next->command;
      field.step(tick, in_force.irrigating);
      addTick(metrics, tick, before, in_force.irrigating, field.cover().clarity());
      work.add(workSample(tick, in_force, &surface));
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
  metrics.soft_touches = soft_touches.counts();
  metrics.work_p50_us = quantile(work_us, 0.50);
  metrics.work_p99_us = quantile(work_us, 0.99);
  metrics.work_max_us = quantile(work_us, 1.00);
  return metrics;
}

namespace {

/// The end of the procedure's last step, or of the recording.
double endOfWork_s(const SessionMetrics& metrics) {
  return (metrics.procedure ? metrics.procedure->end_s() : std::nullopt).value_or(metrics.duration_s);
}

/// Units as people write them.
std::string unitText(std::string_view unit) {
  std::string text(unit);
  if (const std::size_t at = text.find("mm3"); at != std::string::npos) text.replace(at, 3, "mm³");
  return text == "deg" ? "°" : text;
}

/// A line for people: what, value and unit, or why there is none.
std::string measureLine(const MeasureValue& measure) {
  if (!measure.value) return fmt::format("  {:<75} not told: {}\n", measure.name, measure.why);
  return fmt::format("  {:<75} {:>9.2f} {}\n", measure.name, *measure.value + 0.0, unitText(measure.unit));
}

}  // namespace

std::string measuresHelp() {
  std::string text = "Measures (keys of --json):\n";
  for (const Measure& measure : kMeasures)
    text += fmt::format("  {:<22} {}, {}\n", measure.key, measure.meaning, unitText(measure.unit));
  return text;
}

std::string metricsText(const SessionMetrics& metrics) {
  std::string words =
      fmt::format("{:.1f} s, of which {:.1f} s in contact and {:.1f} s drilling in bone; {:.1f} mm³ removed",
                  metrics.duration_s, metrics.contact_s, metrics.drill_in_contact_s, metrics.removed_mm3);
  if (metrics.returned_mm3 > 0.0) words += fmt::format(", another {:.1f} mm³ undone", metrics.returned_mm3);
  words += metrics.drill_in_contact_s == 0.0 ? "\n"
           : metrics.dry_drilling_s > 0.0
               ? fmt::format("\ndry: {:.1f} s of drilling in bone without irrigation\n", metrics.dry_drilling_s)
               : std::string("\nalways irrigated while drilling in bone\n");
  if (metrics.former)
    words += fmt::format("this part only: it continues {}, {:.1f} s before it\n", metrics.former->file,
                         metrics.former->duration_s);
  if (const std::string touched = softTouchesText(metrics.soft_touches.touched); !touched.empty())
    words += "soft tissue touched: " + touched + "\n";
  if (const std::string cut = softTouchesText(metrics.soft_touches.cut); !cut.empty())
    words += "bur turned on: " + cut + "\n";
  if (metrics.missing_log)
    words += "its log " + *metrics.missing_log + " is not next to it: its part is missing, copy both files\n";
  if (metrics.calibration) words += "calibration: " + calibrationText(*metrics.calibration) + "\n";
  if (metrics.touched)
    words += "touched: " + (metrics.touched->empty() ? "no tooth, no canal" : touchesText(*metrics.touched)) + "\n";
  for (const BridgeBreak& broke : metrics.bridge_breaks)
    words +=
        fmt::format("bridge broken at {}: {:.1f} mm², {:.0f} N, {:.2f} N m{}\n", clockText(broke.t_s), broke.area_mm2,
                    broke.force_N, 1e-3 * broke.bending_Nmm, broke.is_complete ? "" : ", a spur stayed on the root");
  if (metrics.prediction) words += "predicted: " + predictionInWords(*metrics.prediction, endOfWork_s(metrics)) + "\n";
  if (metrics.socket && !socketInWords(*metrics.socket).empty())
    words += "socket: " + socketInWords(*metrics.socket) + "\n";
  if (metrics.procedure) {
    words += "procedure: " + procedureInWords(*metrics.procedure) + "\n";
    for (const std::string& step : stepsInWords(*metrics.procedure)) words += "  " + step + "\n";
  }
  for (const MeasuredWay& way : metrics.measured)
    words += "measured at " + clockText(way.t_s) + ": " + way.words + "\n";
  words += "\n";
  for (const Measure& measure : kMeasures)
    words +=
        fmt::format("  {:<55} {:>9.2f} {}\n", measure.meaning, metrics.*measure.value + 0.0, unitText(measure.unit));
  words += "\nThe hand's work:\n";
  for (const MeasureValue& measure : metrics.measures) words += measureLine(measure);
  if (metrics.removed_mm3_by_label)
    for (const auto& [tissue, removed_mm3] : *metrics.removed_mm3_by_label)
      words += fmt::format("  {:<55} {:>9.2f} mm³\n", "removed " + tissue, removed_mm3);
  return words;
}

std::string metricsInShort(const SessionMetrics& metrics) {
  std::string words = fmt::format("{} min, {:.1f} mm³ removed", clockText(metrics.duration_s), metrics.removed_mm3);
  if (metrics.dry_drilling_s > 0.0) words += fmt::format("; {:.1f} s without water", metrics.dry_drilling_s);
  if (metrics.touched && !metrics.touched->empty()) words += "; touched: " + touchesText(*metrics.touched);
  const std::string cut = softTouchesText(metrics.soft_touches.cut);
  const std::string pressed = softTouchesText(metrics.soft_touches.touched);
  if (!cut.empty()) words += "; bur turned on: " + cut;
  if (cut.empty() && !pressed.empty()) words += "; soft tissue touched: " + pressed;
  return words + ".";
}

namespace {

nlohmann::ordered_json calibrationMetrics(const SessionCalibration& c) {
  nlohmann::ordered_json json = {{"rig", c.rig},        {"rig_id", c.rig_id},   {"device_serial", c.device_serial},
                                 {"verdict", nullptr},  {"touches", c.touches}, {"checked_utc", nullptr},
                                 {"age_days", nullptr}, {"despite", nullptr}};
  if (!c.verdict.empty()) {
    json["verdict"] = c.verdict;
    json["rms_mm"] = c.rms_mm;
    json["p95_mm"] = c.p95_mm;
    json["max_mm"] = c.max_mm;
    json["checked_utc"] = c.checked_utc;
  }
  if (c.age_days) json["age_days"] = *c.age_days;
  if (!c.despite.empty()) json["despite"] = c.despite;
  return json;
}

}  // namespace

namespace {

/// As touches are recorded, to 1 ms.
double inMilliseconds(double time_s) { return std::round(1e3 * time_s) / 1e3; }

/// By the key of the tissue; all of them, so that a table has the same columns for every session.
nlohmann::ordered_json softTouchesJson(const SoftTouches& touches) {
  nlohmann::ordered_json json;
  for (std::size_t n = 1; n < assets::kSoftTissueCount; ++n)
    json[assets::kSoftTissues[n].key] = {{"touches", touches.touched[n].times},
                                         {"touched_s", touches.touched[n].seconds},
                                         {"bur_on", touches.cut[n].times},
                                         {"bur_on_s", touches.cut[n].seconds}};
  return json;
}

nlohmann::ordered_json placesJson(const std::vector<Place>& places, const char* unit) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Place& place : places) {
    const glm::dvec3& p = place.centre_P_mm;
    list.push_back({{unit, place.amount}, {"centre_P_mm", {p.x, p.y, p.z}}});
  }
  return list;
}

/// Where something is, and how much in all.
nlohmann::ordered_json socketJson(const SocketRecord& socket) {
  const std::vector<Place> canal = socket.canal.amount > 0.0 ? std::vector{socket.canal} : std::vector<Place>();
  nlohmann::ordered_json json = {{"clean", nullptr},
                                 {"chips", socket.chips.count},
                                 {"chips_mm3", socket.chips.mm3},
                                 {"chip_places", placesJson(socket.chip_places, "volume_mm3")},
                                 {"chips_taken", socket.chips_taken.count},
                                 {"chips_taken_mm3", socket.chips_taken.mm3},
                                 {"follicle_left", nullptr}};
  if (socket.follicle_left) json["follicle_left"] = *socket.follicle_left;
  if (!socket.is_out) return json;
  json["clean"] = socket.isClean();
  json["stitches"] = socket.stitches;
  json["stitch_places"] = socket.stitch_places;
  json.update(nlohmann::ordered_json{{"retained_mm3", sumOf(socket.retained)},
                                     {"retained", placesJson(socket.retained, "volume_mm3")},
                                     {"canal_open_mm2", socket.canal.amount},
                                     {"canal", placesJson(canal, "area_mm2")},
                                     {"lingual_open_mm2", sumOf(socket.lingual)},
                                     {"lingual", placesJson(socket.lingual, "area_mm2")},
                                     {"sharp_edges_mm", sumOf(socket.edges)},
                                     {"sharp_edges", placesJson(socket.edges, "length_mm")}});
  return json;
}

/// A step by its key; times of one that was not reached are null.
nlohmann::ordered_json procedureJson(const ProcedureRun& run) {
  nlohmann::ordered_json json = {{"name", run.name},
                                 {"guidance", run.guidance},
                                 {"complete", run.isComplete()},
                                 {"steps", nlohmann::ordered_json::array()}};
  for (const StepRecord& step : run.steps) {
    nlohmann::ordered_json entry = {
        {"key", step.key},    {"title", step.title},   {"state", nameOf(step.state)},
        {"begin_s", nullptr}, {"duration_s", nullptr}, {"errors", nlohmann::ordered_json::object()}};
    if (step.begin_s) entry["begin_s"] = *step.begin_s, entry["duration_s"] = step.duration_s;
    for (const auto& [error, times] : step.errors) entry["errors"][error] = times;
    json["steps"].push_back(std::move(entry));
  }
  return json;
}

/// With "why" where there is no value.
nlohmann::ordered_json measuresJson(const std::vector<MeasureValue>& measures) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const MeasureValue& measure : measures) {
    nlohmann::ordered_json entry = {
        {"id", measure.id}, {"name", measure.name}, {"value", nullptr}, {"unit", measure.unit}};
    if (measure.value)
      entry["value"] = *measure.value;
    else
      entry["why"] = measure.why;
    if (measure.t_s) entry["t_s"] = *measure.t_s;
    list.push_back(std::move(entry));
  }
  return list;
}

nlohmann::ordered_json predictionJson(const Prediction& p, double end_s) {
  nlohmann::ordered_json json = {{"difficulty", nullptr}, {"minutes", nullptr},
                                 {"computed", nullptr},   {"index", nullptr},
                                 {"at_s", p.at_s},        {"used_minutes", (end_s - p.at_s) / 60.0}};
  if (!p.difficulty.empty()) json["difficulty"] = p.difficulty;
  if (p.minutes) json["minutes"] = *p.minutes;
  if (!p.computed.empty()) json["computed"] = p.computed;
  if (p.index) json["index"] = *p.index;
  return json;
}

}  // namespace

std::string metricsJson(const SessionMetrics& metrics) {
  nlohmann::ordered_json by_label;
  if (metrics.removed_mm3_by_label) {
    by_label = nlohmann::ordered_json::object();
    for (const auto& [tissue, removed_mm3] : *metrics.removed_mm3_by_label) by_label[tissue] = removed_mm3;
  }
  nlohmann::ordered_json json = {
      {"patient", metrics.patient_title},
      {"program_version", metrics.program_version},
      {"calibration", metrics.calibration ? calibrationMetrics(*metrics.calibration) : nlohmann::ordered_json()},
      {"continues", nullptr},
      {"closed", metrics.closed},
      {"log_missing", metrics.missing_log.has_value()},
      {"ticks", metrics.ticks},
      {"lost", metrics.lost},
      {"commands", metrics.commands},
      {"events", metrics.events},
  };
  if (metrics.former)
    json["continues"] = {{"session", metrics.former->file}, {"duration_s", metrics.former->duration_s}};
  for (const Measure& measure : kMeasures) json[measure.key] = metrics.*measure.value;
  json["removed_mm3_by_label"] = by_label;
  json["measures"] = measuresJson(metrics.measures);
  json["touched"] = nullptr;
  if (metrics.touched) {
    json["touched"] = nlohmann::ordered_json::array();
    for (const TouchCount& count : *metrics.touched)
      json["touched"].push_back(
          {{"what", count.what}, {"times", count.times}, {"contact_s", inMilliseconds(count.contact_s)}});
  }
  json["measured"] = nlohmann::ordered_json::array();
  for (const MeasuredWay& way : metrics.measured)
    json["measured"].push_back({{"t_s", way.t_s}, {"mm", way.mm}, {"words", way.words}});
  json["bridge_breaks"] = nlohmann::ordered_json::array();
  for (const BridgeBreak& broke : metrics.bridge_breaks)
    json["bridge_breaks"].push_back({{"t_s", broke.t_s},
                                     {"force_N", broke.force_N},
                                     {"bending_Nmm", broke.bending_Nmm},
                                     {"area_mm2", broke.area_mm2},
                                     {"complete", broke.is_complete}});
  json["socket"] = metrics.socket ? socketJson(*metrics.socket) : nlohmann::ordered_json();
  json["procedure"] = metrics.procedure ? procedureJson(*metrics.procedure) : nlohmann::ordered_json();
  json["prediction"] = nullptr;
  if (metrics.prediction) json["prediction"] = predictionJson(*metrics.prediction, endOfWork_s(metrics));
  json["soft_tissue"] = softTouchesJson(metrics.soft_touches);
  json["work_us"] = {{"p50", metrics.work_p50_us}, {"p99", metrics.work_p99_us}, {"max", metrics.work_max_us}};
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace app
