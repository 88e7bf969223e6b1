#include "app/evaluation/task_measures.h"

#include <algorithm>
#include <utility>

#include "app/session/measures/outcome.h"
#include "app/session/measures/work_sample.h"
#include "haptics/body/bodies.h"

namespace app {
namespace {

/// Those that a tick decides.
std::vector<RuleMeasure> ofTicks() {
  return {
      {"time", "s"},
      {"pieces", ""},
      {"pieces_out", ""},
      {"O1.removed", "mm3"},
      {"M1.on", "s"},
      {"M1.contact", "s"},
      {"M1.drilling", "s"},
      {"M1.idle", "s"},
      {"M2.path", "mm"},
      {"M2.contact", "mm"},
      {"S1.canal", "mm"},
      {"S1.lingual", "mm"},
      {"S1.second_molar", "mm"},
      {"S1.lingual_nerve", "mm"},
      {"S2.canal_1mm", "s"},
      {"S2.canal_2mm", "s"},
      {"S2.canal_4mm", "s"},
      {"S3.canal_max", "N"},
      {"S3.lingual_max", "N"},
      {"S3.second_molar_max", "N"},
      {"S5.canal", "mm/s"},
      {"S8.bone", "s"},
      {"S8.tooth", "s"},
      {"S9.time", "s"},
      {"S9.events", ""},
      {"S10.dry", "s"},
  };
}

}  // namespace

const std::vector<RuleMeasure>& ruleMeasures() {
  static const std::vector<RuleMeasure> kKnown = [] {
    std::vector<RuleMeasure> known = ofTicks();
    for (const MeasureName& one : outcomeNames()) known.push_back({one.id, one.unit});
    return known;
  }();
  return kKnown;
}

bool needsBone(std::string_view id) {
  return std::ranges::find(outcomeNames(), id, &MeasureName::id) != outcomeNames().end();
}

TaskMeasures::TaskMeasures(const assets::RiskStructures& structures, std::vector<std::string> ids)
    : ids_(std::move(ids)),
      values_(ids_.size()),
      asks_clearance_(asks("S1.") || asks("S2.")),
      asks_near_(asks("S3.") || asks("S4.") || asks("S5.")),
      asks_tissue_(asks("S8.") || asks("S9.")),
      asks_hand_(asks("M") || asks("S10.")),
      clearance_(structures),
      near_(structures) {
  for (const std::string& id : ids_) needs_bone_.push_back(needsBone(id));
}

bool TaskMeasures::asks(std::string_view beginning) const {
  return std::ranges::any_of(ids_, [&](const std::string& id) { return id.starts_with(beginning); });
}

void TaskMeasures::add(const haptics::Tick& tick, const haptics::Command& in_force, const BoneValue& bone) {
  time_s_ += tick.dt_s;
  removed_mm3_ += tick.removed_mm3;
  if (asks_clearance_) clearance_.add(tick, in_force.tool);
  if (asks_near_) near_.add(tick, in_force.tool);
  if (asks_tissue_) tissue_.add(tick, in_force);
  // Without the bone's surface: what is asked for needs no normal.
  if (asks_hand_) hand_.add(workSample(tick, in_force, nullptr));

  const auto aside = std::count_if(tick.X_PQ.begin(), tick.X_PQ.begin() + tick.pieces,
                                   [](const haptics::PiecePose& X_PQ) { return haptics::Bodies::isAside(X_PQ); });
  for (std::size_t n = 0; n < ids_.size(); ++n) {
    if (ids_[n] == "time") values_[n] = time_s_;
    if (ids_[n] == "pieces") values_[n] = tick.pieces;
    if (ids_[n] == "pieces_out") values_[n] = static_cast<double>(aside);
    if (ids_[n] == "O1.removed") values_[n] = removed_mm3_;
    if (needs_bone_[n]) values_[n] = bone ? bone(ids_[n]) : std::nullopt;
  }
  if (asks_clearance_) read(clearance_.values());
  if (asks_near_) read(near_.values());
  if (asks_tissue_) read(tissue_.values({}));
  if (asks_hand_) read(hand_.values());
}

void TaskMeasures::read(const std::vector<MeasureValue>& values) {
  for (std::size_t n = 0; n < ids_.size(); ++n)
    if (const auto found = std::ranges::find(values, ids_[n], &MeasureValue::id); found != values.end())
      values_[n] = found->value;
}

std::optional<double> TaskMeasures::value(std::string_view id) const {
  const auto found = std::ranges::find(ids_, id);
  return found == ids_.end() ? std::nullopt : values_[static_cast<std::size_t>(found - ids_.begin())];
}

}  // namespace app
