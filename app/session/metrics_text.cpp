#include "app/session/metrics.h"

#include <algorithm>

#include <fmt/core.h>

#include "app/session/assessment_event.h"
#include "app/session/gates.h"
#include "app/session/measures/rests_on.h"
#include "app/text/clock_text.h"

namespace app {
namespace {

constexpr std::string_view kNotConfirmed = " (not confirmed)";

/// A line for people, the value first, so that names of any length stand below each other.
std::string valueLine(double value, std::string_view unit, std::string_view name, bool is_confirmed) {
  return fmt::format("{:>11.2f} {:<8} {}{}\n", value + 0.0, unitText(unit), name, is_confirmed ? "" : kNotConfirmed);
}

/// What has no value stands below, a line for each reason.
std::string measuresText(const std::vector<MeasureValue>& measures) {
  struct Untold {
    std::string_view why, first;
    std::size_t count = 0;
  };
  std::string words;
  std::vector<Untold> untold;
  for (const MeasureValue& measure : measures) {
    if (isAmongMeasures(measure.id)) continue;
    if (measure.value) {
      words += valueLine(*measure.value, measure.unit, measure.name, measure.is_confirmed);
      continue;
    }
    auto same = std::ranges::find(untold, measure.why, &Untold::why);
    if (same == untold.end()) same = untold.insert(untold.end(), {measure.why, measure.name});
    ++same->count;
  }
  for (const Untold& one : untold)
    words += fmt::format("{:>11} {:<8} {}{}: {}\n", "-", "", one.first,
                         one.count == 1 ? "" : fmt::format(" and {} more (--json)", one.count - 1), one.why);
  return words;
}

}  // namespace

std::string unitText(std::string_view unit) {
  std::string text(unit);
  if (const std::size_t at = text.find("mm3"); at != std::string::npos) text.replace(at, 3, "mm³");
  if (const std::size_t at = text.find("mm2"); at != std::string::npos) text.replace(at, 3, "mm²");
  return text == "deg" ? "°" : text;
}

const MeasureValue* measureOf(const SessionMetrics& metrics, std::string_view id) {
  const auto found = std::ranges::find(metrics.measures, id, &MeasureValue::id);
  return found == metrics.measures.end() ? nullptr : &*found;
}

std::optional<double> valueOf(const SessionMetrics& metrics, std::string_view id) {
  const MeasureValue* const measure = measureOf(metrics, id);
  return measure != nullptr ? measure->value : std::nullopt;
}

bool isAmongMeasures(std::string_view id) {
  constexpr auto kBoth =
      std::to_array<std::string_view>({"M1.total", "M1.on", "M1.contact", "M1.drilling", "M2.path", "S10.dry"});
  return std::ranges::find(kBoth, id) != kBoth.end();
}

std::string measuresHelp() {
  std::string text = "Measures (keys of --json):\n";
  for (const Measure& measure : kMeasures)
    text += fmt::format("  {:<22} {}, {}\n", measure.key, measure.meaning, unitText(measure.unit));
  return text;
}

std::string notConfirmedText(const assets::Proposed& proposed) {
  if (!proposed.any()) return {};
  return fmt::format(
      "not confirmed: {} {} found by the program in the scan and nobody had confirmed {}; numbers that rest on {} are "
      "marked",
      proposed.words(), proposed.tooth && proposed.canal ? "were" : "was",
      proposed.tooth && proposed.canal ? "them" : "it", proposed.tooth && proposed.canal ? "them" : "it");
}

std::string metricsText(const SessionMetrics& metrics) {
  std::string words = metrics.proposed.any() ? notConfirmedText(metrics.proposed) + "\n" : std::string();
  const auto mark = [&metrics](std::string_view key) {
    return isConfirmed(key, metrics.proposed) ? std::string() : std::string(kNotConfirmed);
  };
  words += fmt::format("{:.1f} s, of which {:.1f} s in contact and {:.1f} s drilling in bone; {:.1f} mm³ removed",
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
    words += "touched: " + (metrics.touched->empty() ? "no tooth, no canal" : touchesText(*metrics.touched)) +
             mark("touched") + "\n";
  for (const BridgeBreak& broke : metrics.bridge_breaks)
    words += fmt::format("bridge broken at {}: {:.1f} mm², {:.0f} N, {:.2f} N m{}{}\n", clockText(broke.t_s),
                         broke.area_mm2, broke.force_N, 1e-3 * broke.bending_Nmm,
                         broke.is_complete ? "" : ", a spur stayed on the root", mark("bridge_breaks"));
  words += "events: " + gatesInWords(metrics) + "\n";
  words += "conditions: " + conditionsInWords(metrics.conditions) + "\n";
  if (metrics.assessed.value_or(false)) {
    words += "assessed: " + std::string(kAssessmentRules);
    if (metrics.help_refused > 0)
      words +=
          fmt::format("; help was asked for {}",
                      metrics.help_refused == 1 ? std::string("once") : fmt::format("{} times", metrics.help_refused));
    words += "\n";
  }
  if (metrics.prediction) words += "predicted: " + predictionInWords(*metrics.prediction, metrics.endOfWork_s()) + "\n";
  if (metrics.flap) words += "flap: " + flapInWords(*metrics.flap) + mark("flap") + "\n";
  if (metrics.socket && !socketInWords(*metrics.socket).empty())
    words += "socket: " + socketInWords(*metrics.socket) + mark("socket") + "\n";
  if (metrics.way) words += "last looked what keeps the tooth in: " + wayInWords(*metrics.way) + mark("way_out") + "\n";
  if (metrics.procedure) {
    words += "procedure: " + procedureInWords(*metrics.procedure) + "\n";
    for (const std::string& step : stepsInWords(*metrics.procedure)) words += "  " + step + "\n";
  }
  for (const MeasuredWay& way : metrics.measured)
    words += "measured at " + clockText(way.t_s) + ": " + way.words + "\n";
  words += "\n";
  for (const Measure& measure : kMeasures)
    words +=
        valueLine(metrics.*measure.value, measure.unit, measure.meaning, isConfirmed(measure.key, metrics.proposed));
  words += measuresText(metrics.measures);
  if (metrics.removed_mm3_by_label)
    for (const auto& [tissue, removed_mm3] : *metrics.removed_mm3_by_label)
      words +=
          valueLine(removed_mm3, "mm3", "removed " + tissue, isConfirmed("removed_mm3_by_label", metrics.proposed));
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

}  // namespace app
