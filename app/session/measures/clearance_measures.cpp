#include "app/session/measures/clearance_measures.h"

#include <algorithm>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "app/session/measures/rests_on.h"
#include "app/text/clock_text.h"

namespace app {
namespace {

constexpr std::array<std::string_view, assets::kRiskStructures> kLeastIds{"S1.canal", "S1.lingual", "S1.second_molar",
                                                                          "S1.lingual_nerve"};
constexpr std::array<std::string_view, assets::kRiskStructures> kLeastNames{
    "least clearance to the mandibular canal", "least clearance to the outer lingual surface",
    "least clearance to the second molar", "least clearance to the lingual nerve's band (modelled)"};
constexpr std::array<std::string_view, assets::kRiskStructures> kForceIds{
    "S1.canal_force", "S1.lingual_force", "S1.second_molar_force", "S1.lingual_nerve_force"};
constexpr std::array<std::string_view, assets::kRiskStructures> kForceNames{
    "force at the least clearance to the mandibular canal", "force at the least clearance to the outer lingual surface",
    "force at the least clearance to the second molar", "force at the least clearance to the lingual nerve's band"};
constexpr std::array<std::string_view, assets::kRiskStructures> kSpeedIds{
    "S1.canal_speed", "S1.lingual_speed", "S1.second_molar_speed", "S1.lingual_nerve_speed"};
constexpr std::array<std::string_view, assets::kRiskStructures> kSpeedNames{
    "speed at the least clearance to the mandibular canal", "speed at the least clearance to the outer lingual surface",
    "speed at the least clearance to the second molar", "speed at the least clearance to the lingual nerve's band"};
constexpr std::array<std::string_view, 3> kBandIds{"S2.canal_1mm", "S2.canal_2mm", "S2.canal_4mm"};
constexpr std::array<std::string_view, 3> kBandNames{"time nearer than 1 mm to the mandibular canal",
                                                     "time nearer than 2 mm to the mandibular canal",
                                                     "time nearer than 4 mm to the mandibular canal"};
constexpr std::string_view kNotOn = "the drill was not on", kJustBegun = "the bur had just begun to turn";

/// Interpolation between voxels is not exactly a distance.
constexpr double kSlack_voxels = 0.5;

}  // namespace

calibration::Pose<calibration::Patient, calibration::Tool> heldPose(const haptics::Tick& tick) {
  return {tick.heldRotation(), tick.proxy_P.mm};
}

/// Whether neither the least nor a band can have changed.
bool ClearanceMeasures::isSettled(std::size_t structure, const Asked& asked) const {
  const double off_mm = asked.moved_mm + kSlack_voxels * structures_.distance[structure].grid.spacing_mm;
  if (!least_[structure] || asked.mm - off_mm < least_[structure]->mm) return false;
  return structure != static_cast<std::size_t>(assets::RiskStructure::canal) ||
         std::ranges::none_of(kBands_mm, [&](double band_mm) { return std::abs(asked.mm - band_mm) <= off_mm; });
}

void ClearanceMeasures::add(const haptics::Tick& tick, const haptics::Tool& tool) {
  if (!tick.drilling || !tool.turns() || has(tick.faults, haptics::Fault::bad_pose)) return;
  turned_ = true;
  const auto X_PT = heldPose(tick);
  // Of a bur that has just begun to turn it is not known.
  const bool goes_on = last_ && tick.t_s - last_s_ < 1.5 * tick.dt_s;
  std::optional<double> speed_mm_per_s;
  if (goes_on) speed_mm_per_s = glm::distance(X_PT.translation_mm, last_->translation_mm) / tick.dt_s;
  if (!(tool == tool_) || !last_) {
    tool_ = tool;
    asked_ = {};
  } else {
    const glm::dquat turn = X_PT.rotation * glm::conjugate(last_->rotation);
    const double reach_mm =
        std::max(haptics::halfHeight_mm(tool.head), tool.shaft.length_mm) + tool.head.radius_mm + tool.shaft.radius_mm;
    const double moved_mm = glm::distance(X_PT.translation_mm, last_->translation_mm) +
                            2.0 * glm::length(glm::dvec3(turn.x, turn.y, turn.z)) * reach_mm;
    for (auto& asked : asked_)
      if (asked) asked->moved_mm += moved_mm;
  }
  last_ = X_PT;
  last_s_ = tick.t_s;
  for (std::size_t n = 0; n < assets::kRiskStructures; ++n) {
    if (structures_.distance[n].isEmpty()) continue;
    if (!asked_[n] || !isSettled(n, *asked_[n])) {
      const double mm = haptics::clearance_mm(structures_.distance[n], tool, X_PT);
      asked_[n] = Asked{mm, 0.0};
      if (!least_[n] || mm < least_[n]->mm)
        least_[n] = Least{mm, tick.t_s, glm::length(tick.law_force_P_N.xyz), speed_mm_per_s};
    }
    if (n == static_cast<std::size_t>(assets::RiskStructure::canal))
      for (std::size_t band = 0; band < kBands_mm.size(); ++band)
        if (asked_[n]->mm < kBands_mm[band]) in_band_s_[band] += tick.dt_s;
  }
}

std::vector<MeasureValue> ClearanceMeasures::values() const {
  std::vector<MeasureValue> values;
  const auto add = [&](std::string_view id, std::string_view name, std::string_view unit, std::size_t structure) {
    const assets::StructureDistance& of = structures_.distance[structure];
    MeasureValue& value = values.emplace_back(MeasureValue{id, name, unit, {}, {}, {}});
    if (of.isEmpty())
      value.why = kNoStructure;
    else if (!turned_)
      value.why = kNotOn;
    else
      value.conditions = fmt::format("voxel {:g} mm, head and shaft, drill on", of.grid.spacing_mm);
    return value.why.empty();
  };
  for (std::size_t n = 0; n < assets::kRiskStructures; ++n)
    if (add(kLeastIds[n], kLeastNames[n], "mm", n) && least_[n])
      values.back().value = least_[n]->mm, values.back().t_s = least_[n]->t_s;
  for (std::size_t n = 0; n < assets::kRiskStructures; ++n) {
    if (add(kForceIds[n], kForceNames[n], "N", n) && least_[n]) values.back().value = least_[n]->force_N;
    if (!add(kSpeedIds[n], kSpeedNames[n], "mm/s", n) || !least_[n]) continue;
    values.back().value = least_[n]->speed_mm_per_s;
    if (!values.back().value) values.back().why = kJustBegun;
  }
  for (std::size_t band = 0; band < kBands_mm.size(); ++band)
    if (add(kBandIds[band], kBandNames[band], "s", 0)) values.back().value = in_band_s_[band];
  return values;
}

std::vector<MeasureValue> noClearances(std::string_view why) {
  static const assets::RiskStructures kNone;
  std::vector<MeasureValue> values = ClearanceMeasures(kNone).values();
  for (MeasureValue& value : values) value.why = why;
  return values;
}

std::string clearancesInWords(const ClearanceMeasures& measures, const assets::Proposed& proposed) {
  std::string words;
  for (std::size_t n = 0; n < assets::kRiskStructures; ++n)
    if (const auto& least = measures.least()[n])
      words += fmt::format("{}{} {:.1f} mm at {}{}", words.empty() ? "" : ", ", assets::kRiskTexts[n].name,
                           least->mm + 0.0, clockText(least->t_s),
                           isConfirmed(static_cast<assets::RiskStructure>(n), proposed) ? "" : " (not confirmed)");
  return words;
}

std::string clearanceText(const ClearanceMeasures& measures) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (std::size_t n = 0; n < assets::kRiskStructures; ++n)
    if (const auto& least = measures.least()[n])
      json[std::string(assets::kRiskTexts[n].key)] = {{"mm", least->mm}, {"t_s", least->t_s}};
  return json.dump();
}

}  // namespace app
