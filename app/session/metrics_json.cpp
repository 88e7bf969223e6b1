#include "app/session/metrics.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "app/session/gates.h"
#include "app/session/measures/rests_on.h"

namespace app {
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

/// The answers as `molar pieces --json` names them.
nlohmann::ordered_json wayJson(const WayRecord& way, std::size_t looks) {
  constexpr std::array kAnswers = {"free", "grazes", "blocked", "not-found"};
  nlohmann::ordered_json pieces = nlohmann::ordered_json::array();
  for (const WayOfPiece& piece : way.pieces) {
    nlohmann::ordered_json kept_by = nlohmann::ordered_json::array();
    for (const Keeper& one : piece.kept_by)
      kept_by.push_back({{"what", one.what},
                         {"volume_mm3", one.volume_mm3},
                         {"centre_P_mm", {one.centre_P_mm.x, one.centre_P_mm.y, one.centre_P_mm.z}}});
    pieces.push_back({{"piece", piece.piece},
                      {"answer", kAnswers[static_cast<std::size_t>(piece.answer)]},
                      {"waits", piece.waits},
                      {"lift", piece.lift},
                      {"kept_by_mm3", piece.kept_by_mm3},
                      {"kept_by", kept_by},
                      {"poses", piece.poses}});
  }
  return {{"looks", looks}, {"asked", way.was_asked}, {"words", wayInWords(way)}, {"pieces", pieces}};
}

nlohmann::ordered_json flapJson(const FlapRecord& flap) {
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(flapText(flap));
  json["kind"] = flap.incision_mm == 0.0 ? "none" : flap.limb_mm >= kLeastLimb_mm ? "triangular" : "envelope";
  return json;
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
                                     {"canal_by_root_mm2", socket.canal_by_root_mm2},
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
    if (!measure.conditions.empty()) entry["conditions"] = measure.conditions;
    entry["confirmed"] = measure.is_confirmed;
    list.push_back(std::move(entry));
  }
  return list;
}

nlohmann::ordered_json conditionsJson(const SessionConditions& conditions) {
  nlohmann::ordered_json json = {{"law", conditions.law},
                                 {"law_parameters", conditions.law_parameters},
                                 {"stereo", nullptr},
                                 {"force_scale", conditions.force_scale},
                                 {"peak_force_N", conditions.peak_force_N},
                                 {"missed_ticks", nullptr}};
  if (conditions.stereo) json["stereo"] = *conditions.stereo;
  if (conditions.missed_ticks) json["missed_ticks"] = *conditions.missed_ticks;
  return json;
}

nlohmann::ordered_json gatesJson(const SessionMetrics& metrics) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Gate& gate : gatesOf(metrics)) {
    nlohmann::ordered_json one = {{"key", gate.key}, {"name", gate.name}, {"happened", nullptr}, {"words", gate.words}};
    if (gate.is_open) one["happened"] = *gate.is_open;
    one["confirmed"] = gate.is_confirmed;
    list.push_back(std::move(one));
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

/// What nobody had confirmed, and the keys here that rest on it.
nlohmann::ordered_json notConfirmedJson(const assets::Proposed& proposed) {
  if (!proposed.any()) return nullptr;
  nlohmann::ordered_json json = {{"what", nlohmann::ordered_json::array()}, {"keys", nlohmann::ordered_json::array()}};
  if (proposed.tooth) json["what"].push_back("tooth");
  if (proposed.canal) json["what"].push_back("canal");
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
      {"confirmed", !metrics.proposed.any()},
      {"not_confirmed", notConfirmedJson(metrics.proposed)},
      {"program_version", metrics.program_version},
      {"calibration", metrics.calibration ? calibrationMetrics(*metrics.calibration) : nlohmann::ordered_json()},
      {"conditions", conditionsJson(metrics.conditions)},
      {"gates", gatesJson(metrics)},
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
  json["drawn_plan"] = metrics.drawn_plan && !metrics.drawn_plan->isEmpty()
                           ? nlohmann::ordered_json::parse(drawnPlanText(*metrics.drawn_plan))
                           : nlohmann::ordered_json();
  json["drawn_cut"] =
      metrics.drawn_cut ? nlohmann::ordered_json::parse(drawnCutText(*metrics.drawn_cut)) : nlohmann::ordered_json();
  json["flap"] = metrics.flap ? flapJson(*metrics.flap) : nlohmann::ordered_json();
  json["socket"] = metrics.socket ? socketJson(*metrics.socket) : nlohmann::ordered_json();
  json["way_out"] = metrics.way ? wayJson(*metrics.way, metrics.ways_looked_at) : nlohmann::ordered_json();
  json["procedure"] = metrics.procedure ? procedureJson(*metrics.procedure) : nlohmann::ordered_json();
  json["prediction"] = nullptr;
  if (metrics.prediction) json["prediction"] = predictionJson(*metrics.prediction, metrics.endOfWork_s());
  json["assessed"] = metrics.assessed ? nlohmann::ordered_json(*metrics.assessed) : nlohmann::ordered_json();
  json["help_refused"] = metrics.help_refused;
  json["coach_said"] = metrics.coach_said;
  json["soft_tissue"] = softTouchesJson(metrics.soft_touches);
  // Objects say it of themselves; what is a number or a list is named.
  for (const auto& [key, value] : json.items()) {
    if (isConfirmed(key, metrics.proposed) || value.is_null()) continue;
    json["not_confirmed"]["keys"].push_back(key);
  }
  json["work_us"] = {{"p50", metrics.work_p50_us}, {"p99", metrics.work_p99_us}, {"max", metrics.work_max_us}};
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace app
