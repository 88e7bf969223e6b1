#include "app/options/canal_text.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include <fmt/core.h>

#include "app/text/list.h"
#include "app/text/parse_number.h"
#include "app/text/usage_error.h"
#include "assets/synthetic/built_in_teeth.h"
#include "assets/tooth.h"

namespace app {
namespace {

struct CanalMeasure {
  const char* name;
  double low, high;
};
const CanalMeasure kBore{"diameter", 0.06, 3.0}, kTubeLength{"length", 2.0, 30.0}, kArcRadius{"radius", 2.0, 100.0},
    kArcAngle{"angle", 1.0, 90.0};

/// The first `needed` must be there.
std::vector<double> canalMeasures(const std::string& text, const std::string& list,
                                  const std::vector<CanalMeasure>& measures, std::size_t needed) {
  std::vector<double> values;
  for (const std::string_view part : split(list)) {
    if (values.size() == measures.size())
      throw UsageError("--canal " + text + ": there are too many numbers, give " + canalForms());
    const CanalMeasure& measure = measures[values.size()];
    const auto value = parseNumber<double>(part);
    if (!value || !std::isfinite(*value))
      throw UsageError(fmt::format("--canal {}: the {} is not a number, give {}", text, measure.name, canalForms()));
    if (*value < measure.low || *value > measure.high)
      throw UsageError(fmt::format("--canal {}: the {} is out of range, give {} to {}", text, measure.name, measure.low,
                                   measure.high));
    values.push_back(*value);
  }
  if (values.size() < needed)
    throw UsageError(
        fmt::format("--canal {}: the {} is missing, give {}", text, measures[values.size()].name, canalForms()));
  return values;
}

std::vector<int> builtInCanalTeeth() {
  std::vector<int> teeth;
  for (const bool right : {false, true}) {
    assets::JawParameters jaw;
    jaw.right_side = right;
    for (const int fdi : assets::builtInTeeth(jaw)) teeth.push_back(fdi);
  }
  return teeth;
}

}  // namespace

std::string canalForms() { return "straight:D[,L], arc:R,ANGLE[,D] or builtin:TOOTH:NAME"; }

assets::RootCanal canalFrom(const std::string& text) {
  const std::size_t colon = text.find(':');
  const std::string kind = text.substr(0, colon), rest = colon == std::string::npos ? "" : text.substr(colon + 1);
  assets::RootCanal canal;
  if (kind == "builtin") {
    const std::size_t name = rest.find(':');
    const auto fdi = parseNumber<int>(rest.substr(0, name));
    const std::vector<int> teeth = builtInCanalTeeth();
    if (name == std::string::npos || !fdi || !std::ranges::count(teeth, *fdi))
      throw UsageError(fmt::format("--canal {}: give builtin:TOOTH:NAME with tooth {}", text,
                                   joined(teeth, [](int tooth) { return std::to_string(tooth); })));
    assets::JawParameters jaw;
    jaw.right_side = assets::isRight(*fdi);
    const auto canals = assets::roundCanals(assets::builtInTooth(jaw, *fdi));
    for (const assets::RoundCanal& one : canals)
      if (rest.substr(name + 1) == one.name) return one.canal;
    throw UsageError(fmt::format("--canal {}: tooth {} has no such canal, choose {}", text, *fdi,
                                 joined(canals, [](const assets::RoundCanal& one) { return one.name; })));
  }
  if (kind == "straight") {
    const auto values = canalMeasures(text, rest, {kBore, kTubeLength}, 1);
    canal.straight_mm = values.size() > 1 ? values[1] : 16.0;
    canal.orifice_radius_mm = canal.apex_radius_mm = 0.5 * values[0];
    return canal;
  }
  if (kind == "arc") {
    const auto values = canalMeasures(text, rest, {kArcRadius, kArcAngle, kBore}, 2);
    canal = {8.0, values[0], values[1] * std::numbers::pi / 180.0, 2.0};
    if (values.size() > 2) canal.orifice_radius_mm = canal.apex_radius_mm = 0.5 * values[2];
    return canal;
  }
  throw UsageError("--canal " + text + ": it is no form of canal, give " + canalForms());
}

}  // namespace app
