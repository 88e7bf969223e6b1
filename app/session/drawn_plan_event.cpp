#include "app/session/drawn_plan_event.h"

#include <cmath>
#include <utility>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "assets/json_depth.h"

namespace app {
namespace {

using DrawnJson = nlohmann::ordered_json;

constexpr double kFarthest_mm = 1e4, kMost_mm3 = 1e6;

double drawnHundredth(double value) { return std::round(100.0 * value) / 100.0; }

std::optional<double> drawnNumber(const DrawnJson& value, double low, double high) {
  if (!value.is_number()) return {};
  const double number = value.get<double>();
  return number >= low && number <= high ? std::optional(number) : std::nullopt;
}

std::optional<glm::dvec3> drawnPlace(const DrawnJson& value) {
  if (!value.is_array() || value.size() != 3) return {};
  glm::dvec3 p(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    const auto number = drawnNumber(value[static_cast<std::size_t>(axis)], -kFarthest_mm, kFarthest_mm);
    if (!number) return {};
    p[axis] = *number;
  }
  return p;
}

DrawnJson drawnJson(const std::string& text) {
  return assets::isNestedTooDeep(text) ? DrawnJson() : DrawnJson::parse(text, nullptr, false);
}

std::optional<DrawnCut> drawnCutIn(const DrawnJson& value) {
  DrawnCut cut;
  const std::pair<const char*, std::pair<double*, double>> fields[] = {{"length_mm", {&cut.length_mm, kFarthest_mm}},
                                                                       {"followed_share", {&cut.followed_share, 1.0}},
                                                                       {"removed_mm3", {&cut.removed_mm3, kMost_mm3}},
                                                                       {"beside_mm3", {&cut.beside_mm3, kMost_mm3}},
                                                                       {"off_mm", {&cut.off_mm, kFarthest_mm}}};
  for (const auto& [key, to] : fields) {
    if (!value.is_object() || !value.contains(key)) return {};
    const auto number = drawnNumber(value[key], 0.0, to.second);
    if (!number) return {};
    *to.first = *number;
  }
  return cut;
}

}  // namespace

double lengthOf_mm(const std::vector<glm::dvec3>& line_P_mm) {
  double sum_mm = 0.0;
  for (std::size_t n = 1; n < line_P_mm.size(); ++n) sum_mm += glm::distance(line_P_mm[n - 1], line_P_mm[n]);
  return sum_mm;
}

std::string drawnPlanText(const DrawnPlan& plan) {
  DrawnJson all = DrawnJson::object();
  for (std::size_t which = 0; which < kDrawnLines; ++which) {
    DrawnJson& line = all[std::string(kDrawnLineNames[which]) + "_P_mm"] = DrawnJson::array();
    for (const glm::dvec3& p : plan.line_P_mm[which])
      line.push_back({drawnHundredth(p.x), drawnHundredth(p.y), drawnHundredth(p.z)});
  }
  return all.dump();
}

std::optional<DrawnPlan> drawnPlanFrom(const std::string& text) {
  const DrawnJson all = drawnJson(text);
  if (!all.is_object()) return {};
  DrawnPlan plan;
  for (std::size_t which = 0; which < kDrawnLines; ++which) {
    const auto line = all.find(std::string(kDrawnLineNames[which]) + "_P_mm");
    if (line == all.end() || !line->is_array() || line->size() > kMostDrawnPoints) return {};
    for (const DrawnJson& value : *line) {
      const auto p = drawnPlace(value);
      if (!p) return {};
      plan.line_P_mm[which].push_back(*p);
    }
  }
  return plan;
}

std::string drawnCutText(const DrawnComparison& comparison) {
  DrawnJson all = DrawnJson::object();
  for (std::size_t which = 0; which < kDrawnLines; ++which) {
    DrawnJson& one = all[std::string(kDrawnLineNames[which])];
    if (const auto& cut = comparison[which])
      one = {{"length_mm", drawnHundredth(cut->length_mm)},
             {"followed_share", drawnHundredth(cut->followed_share)},
             {"removed_mm3", drawnHundredth(cut->removed_mm3)},
             {"beside_mm3", drawnHundredth(cut->beside_mm3)},
             {"off_mm", drawnHundredth(cut->off_mm)}};
  }
  return all.dump();
}

std::optional<DrawnComparison> drawnCutFrom(const std::string& text) {
  const DrawnJson all = drawnJson(text);
  if (!all.is_object()) return {};
  DrawnComparison comparison;
  for (std::size_t which = 0; which < kDrawnLines; ++which) {
    const auto one = all.find(kDrawnLineNames[which]);
    if (one == all.end()) return {};
    if (one->is_null()) continue;
    comparison[which] = drawnCutIn(*one);
    if (!comparison[which]) return {};
  }
  return comparison;
}

std::string drawnCutInWords(const DrawnComparison& comparison) {
  std::string words;
  for (std::size_t which = 0; which < kDrawnLines; ++which) {
    const auto& cut = comparison[which];
    if (!cut) continue;
    words += fmt::format("{}{}: {:.0f} % of {:.0f} mm followed", words.empty() ? "" : "; ", kDrawnLineNames[which],
                         100.0 * cut->followed_share, cut->length_mm);
    if (cut->removed_mm3 > 0.0)
      words += fmt::format(", {:.0f} of {:.0f} mm³ beside it", cut->beside_mm3, cut->removed_mm3);
  }
  return words;
}

}  // namespace app
