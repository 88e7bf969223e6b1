#include "app/options/command_settings.h"

#include <cmath>

#include <fmt/core.h>

#include "app/options/bur_name.h"
#include "app/options/law_text.h"
#include "app/options/tool_text.h"
#include "app/text/list.h"
#include "app/text/usage_error.h"
#include "assets/toml_reader.h"
#include "haptics/contact/law_limits.h"
#include "haptics/servo/servo.h"

namespace app {
namespace {

SettingMap limitsOf(haptics::SafetyLimits& safety) {
  return {{"peak_force_N", {&safety.peak_force_N, 0.1, 40.0, "N"}},
          {"slew_N_per_s", {&safety.slew_N_per_s, 1.0, 1e5, "N/s"}},
          {"peak_torque_Nmm", {&safety.peak_torque_Nmm, 0.0, 2000.0, "Nmm"}},
          {"slew_Nmm_per_s", {&safety.slew_Nmm_per_s, 1.0, 1e6, "Nmm/s"}}};
}

void readNumbers(assets::TomlReader& keys, const std::string& table, const SettingMap& settings) {
  for (const auto& [name, setting] : settings) {
    const std::string former(formerKey(name));
    const std::string& key = !former.empty() && keys.has(table, former) ? former : name;
    *setting.value = keys.number(table, key, {setting.low, setting.high, setting.unit}, *setting.value);
  }
}

/// Without `worn`, which is the erosion's.
SettingMap lawParametersOf(haptics::LawSettings& law) {
  auto settings = parametersOf(law);
  settings.erase("worn");
  return settings;
}

/// `make(text)`; a UsageError becomes an error of the file at this key.
template <class Make>
auto madeOf(assets::TomlReader& keys, const std::string& table, const std::string& key, const std::string& text,
            const std::string& otherwise, Make make) {
  try {
    return make(text);
  } catch (const UsageError&) {
    keys.refuse(table, key, otherwise);
  }
}

/// A line per difference.
void compare(const std::string& table, const SettingMap& before, const SettingMap& after,
             std::vector<std::string>& lines) {
  for (const auto& [key, setting] : after) {
    const auto was = before.find(key);
    if (was == before.end() || *was->second.value == *setting.value) continue;
    lines.push_back("[" + table + "] " + key + " " + assets::numberText(*was->second.value) + " -> " +
                    assets::numberText(*setting.value) + (setting.unit.empty() ? "" : " ") + std::string(setting.unit));
  }
}

std::string shaftText(const haptics::Shaft& shaft) {
  return shaft.length_mm > 0.0 ? assets::numberText(shaft.radius_mm) + "," + assets::numberText(shaft.length_mm)
                               : "none";
}

}  // namespace

SettingMap settingsOf(haptics::Command& command) {
  SettingMap settings = lawParametersOf(command.law);
  settings.merge(parametersOf(command.erosion));
  settings.merge(parametersOf(command.spindle));
  settings.merge(limitsOf(command.safety));
  return settings;
}

void applyTo(haptics::Command& command, const std::vector<std::string>& texts) {
  applySettings(texts, settingsOf(command));
  command.law.machining.worn = command.erosion.worn;
}

haptics::Command commandFromToml(assets::TomlReader& keys, const haptics::Command& base) {
  haptics::Command command = base;
  command.law.kind = madeOf(keys, "law", "name", keys.text("law", "name", lawName(base.law.kind)),
                            "no such law, give one of " + lawNames(), [](const auto& text) { return lawNamed(text); });
  readNumbers(keys, "law", lawParametersOf(command.law));
  const auto erosion = haptics::erosionOfKey(keys.text("erosion", "name", erosionName(base.erosion.kind)));
  if (!erosion) keys.refuse("erosion", "name", "no such erosion, give one of " + joined(erosionNames()));
  command.erosion.kind = *erosion;
  readNumbers(keys, "erosion", parametersOf(command.erosion));
  command.law.machining.worn = command.erosion.worn;
  readNumbers(keys, "spindle", parametersOf(command.spindle));
  readNumbers(keys, "safety", limitsOf(command.safety));
  if (keys.has("tool", "head"))
    command.tool.head = madeOf(keys, "tool", "head", keys.text("tool", "head"),
                               "no such head, give " + headForms() + " in mm", headFrom);
  if (keys.has("tool", "shaft"))
    command.tool.shaft =
        madeOf(keys, "tool", "shaft", keys.text("tool", "shaft"), "no such shaft, give R,L in mm or none", shaftFrom);
  keys.refuseUnknownKeys();
  return command;
}

void refuseBeyondServoLimits(const haptics::Command& command) {
  const haptics::Command limited = haptics::sanitised(command);
  const auto check = [](const char* what, double requested, double accepted, const char* unit) {
    if (requested != accepted)
      throw UsageError(fmt::format("{} {:.9g} {}: beyond the limit of the servo, give {:.9g} {}", what, requested, unit,
                                   accepted, unit));
  };
  check("bur radius", command.tool.head.radius_mm, limited.tool.head.radius_mm, "mm");
  check("bur length", command.tool.head.length_mm, limited.tool.head.length_mm, "mm");
  check("stiffness", command.law.agus.stiffness_N_per_mm, limited.law.agus.stiffness_N_per_mm, "N/mm");
  check("damping", command.law.damping_Ns_per_mm, limited.law.damping_Ns_per_mm, "Ns/mm");
}

void refuseUnlessAdmitted(const haptics::Command& command) {
  if (!haptics::supports(command.law.kind, command.tool.head.kind))
    throw UsageError("law " + lawName(command.law.kind) + ": it does not admit " + textOf(command.tool.head) +
                     ", give a sphere or another law");
}

void refuseUnlessStable(const haptics::Command& command, double device_damping_Ns_per_mm, double rate_Hz) {
  refuseUnlessAdmitted(command);
  const double max_N_per_mm =
      haptics::passiveStiffness_N_per_mm(device_damping_Ns_per_mm, command.law.damping_Ns_per_mm, 1.0 / rate_Hz);
  const haptics::Admission admission = haptics::admissible(command.law, command.tool.head, max_N_per_mm);
  if (admission.answer != haptics::Admission::Answer::too_stiff) return;
  // Rounded down, so that the advised value is admissible.
  const double nearest = std::floor(1000.0 * admission.nearest) / 1000.0;
  throw UsageError(fmt::format(
      "law {}: with {} it is up to {:.3g} N/mm stiff, at {:g} Hz the device holds {:.3g} N/mm (2b/T): "
      "lower {} to {:g} {} or raise --rate",
      lawName(command.law.kind), textOf(command.tool.head), admission.slope_N_per_mm, rate_Hz, max_N_per_mm,
      admission.lower ? admission.lower->key : "its gain", nearest, admission.lower ? admission.lower->unit : ""));
}

haptics::Command loweredUntilStable(haptics::Command command, double device_damping_Ns_per_mm, double rate_Hz) {
  const double max_N_per_mm =
      haptics::passiveStiffness_N_per_mm(device_damping_Ns_per_mm, command.law.damping_Ns_per_mm, 1.0 / rate_Hz);
  // A law has only a few gains that make it stiff.
  for (int gain = 0; gain < 4; ++gain) {
    const haptics::Admission admission = haptics::admissible(command.law, command.tool.head, max_N_per_mm);
    if (admission.answer != haptics::Admission::Answer::too_stiff || !admission.lower) break;
    admission.lower->of(command.law) = std::floor(1000.0 * admission.nearest) / 1000.0;
  }
  refuseUnlessStable(command, device_damping_Ns_per_mm, rate_Hz);
  return command;
}

std::vector<std::string> changesBetween(const haptics::Command& before, const haptics::Command& after) {
  std::vector<std::string> lines;
  haptics::Command a = before, b = after;
  if (a.law.kind != b.law.kind) lines.push_back("[law] name " + lawName(a.law.kind) + " -> " + lawName(b.law.kind));
  // Both with the parameters of the new law.
  a.law.kind = b.law.kind;
  compare("law", lawParametersOf(a.law), lawParametersOf(b.law), lines);
  if (a.erosion.kind != b.erosion.kind)
    lines.push_back("[erosion] name " + erosionName(a.erosion.kind) + " -> " + erosionName(b.erosion.kind));
  a.erosion.kind = b.erosion.kind;
  compare("erosion", parametersOf(a.erosion), parametersOf(b.erosion), lines);
  compare("spindle", parametersOf(a.spindle), parametersOf(b.spindle), lines);
  compare("safety", limitsOf(a.safety), limitsOf(b.safety), lines);
  if (!(a.tool.head == b.tool.head))
    lines.push_back("[tool] head " + textOf(a.tool.head) + " -> " + textOf(b.tool.head) + " mm");
  if (shaftText(a.tool.shaft) != shaftText(b.tool.shaft))
    lines.push_back("[tool] shaft " + shaftText(a.tool.shaft) + " -> " + shaftText(b.tool.shaft) + " mm");
  // What only differs in kind.
  a.tool.head = b.tool.head, a.tool.shaft = b.tool.shaft;
  if (!(a.tool == b.tool)) lines.push_back("[tool] " + toolName(before.tool) + " -> " + toolName(after.tool));
  return lines;
}

}  // namespace app
