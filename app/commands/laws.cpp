// `molar laws`: every force law with its parameters, units, ranges, defaults and sources, as text or JSON; and its
// curves F(h) and K(h) in flat bone, as a figure.

#include <algorithm>
#include <cstdio>
#include <memory>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "app/commands/command.h"
#include "app/options/command_settings.h"
#include "app/options/law_text.h"
#include "app/options/settings_text.h"
#include "app/options/tool_text.h"
#include "app/report/chart.h"
#include "app/report/law_curves.h"
#include "app/text/command_line.h"
#include "app/text/list.h"
#include "app/text/message.h"
#include "assets/toml_reader.h"
#include "calibration/output_file.h"
#include "haptics/contact/law_parameters.h"
#include "haptics/safety/safety_limits.h"

namespace app {
namespace {

using haptics::LawParameter;

struct LawsOptions {
  bool json = false, force = false;
  std::string plot, tool = "sphere:2";
  std::vector<std::string> laws{"all"}, settings;
  double rate_Hz = 1000.0, device_damping_Ns_per_mm = kUsualDeviceDamping_Ns_per_mm;
};

std::vector<const haptics::LawName*> chosenLaws(const LawsOptions& options) {
  const auto is_chosen = [&](std::string_view name) { return std::ranges::count(options.laws, name) > 0; };
  for (const std::string& name : options.laws)
    if (name != "all") lawNamed(name);
  std::vector<const haptics::LawName*> chosen;
  for (const haptics::LawName& law : haptics::kLaws)
    if (is_chosen("all") || is_chosen(law.key)) chosen.push_back(&law);
  return chosen;
}

nlohmann::json jsonOf(const LawParameter& one) {
  return {{"key", one.key},
          {"unit", one.unit},
          {"lowest", one.lowest},
          {"highest", one.highest},
          {"default", one.defaultValue()},
          {"meaning", one.meaning},
          {"source", one.source}};
}

void printJson(const std::vector<const haptics::LawName*>& laws) {
  using nlohmann::json;
  json list = json::array(), common = json::array();
  for (const haptics::LawName* law : laws) {
    json parameters = json::array();
    for (const LawParameter& one : haptics::lawParameters())
      if (one.law == law->kind) parameters.push_back(jsonOf(one));
    json shapes = json::array();
    for (const auto& [kind, name] : headKinds())
      if (haptics::supports(law->kind, kind)) shapes.push_back(name);
    list.push_back({{"law", law->key},
                    {"formula", law->formula},
                    {"good_for", law->good_for},
                    {"heads", shapes},
                    {"parameters", parameters}});
  }
  for (const LawParameter& one : haptics::lawParameters())
    if (!one.law) common.push_back(jsonOf(one));
  std::printf("%s\n", json{{"laws", list}, {"every_law", common}}.dump(2).c_str());
}

std::string rowsOf(const LawParameter& one) {
  return fmt::format("    {:26} {:>9.9g}  {:14} {:7} {}\n    {:26} {:9}  {:14} {:7}   {}\n", one.key,
                     one.defaultValue(), fmt::format("{:.9g} .. {:.9g}", one.lowest, one.highest), one.unit,
                     one.meaning, "", "", "", "", one.source);
}

void printTable(const std::vector<const haptics::LawName*>& laws) {
  std::string page;
  for (const haptics::LawName* law : laws) {
    page += fmt::format("{}   {}\n  {}{}\n", law->key, law->formula, law->good_for,
                        haptics::supports(law->kind, haptics::ShapeKind::cylinder) ? "" : "; round heads only");
    page += fmt::format("    {:26} {:>9}  {:14} {:7} {}\n", "parameter", "default", "range", "unit", "meaning, source");
    for (const LawParameter& one : haptics::lawParameters())
      if (one.law == law->kind) page += rowsOf(one);
    page += "\n";
  }
  page += "every law\n";
  for (const LawParameter& one : haptics::lawParameters())
    if (!one.law) page += rowsOf(one);
  std::fputs(page.c_str(), stdout);
}

std::string numberOf(double value) { return fmt::format("{:.9g}", std::round(1e4 * value) / 1e4); }

void plot(const LawsOptions& options, const std::vector<const haptics::LawName*>& laws) {
  BurIndentation press;
  press.head = headFrom(options.tool);
  press.deepest_mm = press.head.radius_mm;
  refuseUnlessPng("--plot", options.plot);
  calibration::OutputFile file(options.plot, options.force);

  Chart chart;
  chart.title = "Force laws on flat cortical bone";
  chart.caption = "Bur " + options.tool +
                  " (mm), pressed in along its shaft; machining: " + numberOf(press.spindle_rpm) + " rpm, " +
                  numberOf(press.feed_mm_per_s) + " mm/s. Limits of a device with " +
                  numberOf(1000.0 * options.device_damping_Ns_per_mm) + " Ns/m of its own damping at " +
                  numberOf(options.rate_Hz) + " Hz.";
  Panel force{"Force", "depth h / mm", "force F / N", {}, {}, {}, {}};
  Panel stiffness{"Stiffness", "depth h / mm", "stiffness K = dF/dh / (N/mm)", {}, {}, {}, {}};
  double strongest = 0.0, stiffest = 0.0, softest = 0.0;
  for (const haptics::LawName* law : laws) {
    if (!haptics::supports(law->kind, press.head.kind)) continue;
    haptics::LawSettings settings;
    settings.kind = law->kind;
    if (!options.settings.empty()) applySettings(options.settings, parametersOf(settings));
    const LawCurve found = lawCurve(settings, press);
    Curve curve;
    curve.label = std::string(law->key);
    curve.colour = static_cast<int>(law->kind);
    // Dashes show both curves where agus, points and harmonic coincide.
    curve.dashed = law->kind == haptics::LawKind::points || law->kind == haptics::LawKind::harmonic;
    curve.points = found.force_N;
    for (const glm::dvec2& p : found.force_N) strongest = std::max(strongest, p.y);
    force.curves.push_back(curve);
    curve.points = found.stiffness_N_per_mm;
    for (const glm::dvec2& p : found.stiffness_N_per_mm)
      stiffest = std::max(stiffest, p.y), softest = std::min(softest, p.y);
    stiffness.curves.push_back(curve);
  }
  // A limit far above all curves is not drawn.
  const double peak_N = haptics::SafetyLimits{}.peak_force_N;
  const double max_N_per_mm = 2.0 * options.device_damping_Ns_per_mm * options.rate_Hz;
  if (peak_N < 4.0 * strongest) force.lines.push_back({"device, " + numberOf(peak_N) + " N", peak_N, true});
  stiffness.lines.push_back({"Kmax = 2b/T = " + numberOf(max_N_per_mm) + " N/mm", max_N_per_mm, true});
  // Values far beyond every device are cut off at the top.
  force.x_range = stiffness.x_range = glm::dvec2(0.0, press.deepest_mm);
  if (strongest > 3.0 * peak_N) force.y_range = glm::dvec2(0.0, 3.0 * peak_N);
  const double top = std::min(1.05 * std::max(stiffest, 1.2 * max_N_per_mm), 2.5 * max_N_per_mm);
  stiffness.y_range = glm::dvec2(softest < -0.05 * top ? std::max(softest, -0.5 * top) : 0.0, top);
  chart.panels = {force, stiffness};
  drawChart(chart, file);
  printMessage("figure of " + joined(laws, [](const haptics::LawName* law) { return law->key; }) + ": " + options.plot);
}

int laws(const LawsOptions& options) {
  const auto chosen = chosenLaws(options);
  if (!options.plot.empty()) {
    plot(options, chosen);
    return 0;
  }
  if (options.json)
    printJson(chosen);
  else
    printTable(chosen);
  return 0;
}

}  // namespace

void addLaws(CommandLine& molar) {
  auto o = std::make_shared<LawsOptions>();
  CommandLine& command =
      molar.command("laws", "Force laws: parameters, units, ranges, sources; F(h) and K(h)").forEngineers();
  command.option("--law", o->laws, "Which, or all").separatedByCommas().showsDefault();
  Option plot = command.option("--plot", o->plot, "Draw force and stiffness over depth, .png").valueNamed("FILE");
  command.flag("--json", o->json, "For programs").excludes(plot);
  command.option("--tool", o->tool, "--plot: " + headHelp()).showsDefault();
  command.option("--set", o->settings, "--plot: key=value of the law chosen").needs(plot);
  command.option("--rate", o->rate_Hz, "--plot: servo rate, Hz").from(500.0, 10000.0).showsDefault();
  command.option("--device-damping", o->device_damping_Ns_per_mm, "--plot: damping of device and hand, Ns/mm")
      .from(0.0, 0.1)
      .showsDefault();
  command.flag("--force", o->force, "Replace the figure if it exists");
  command.does([o] { return laws(*o); });
}

}  // namespace app
