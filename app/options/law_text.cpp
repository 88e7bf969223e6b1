#include "app/options/law_text.h"

#include <algorithm>

#include <fmt/core.h>

#include "app/text/list.h"
#include "app/text/usage_error.h"
#include "haptics/contact/law_parameters.h"

namespace app {
namespace {

template <class Table, class Kind>
std::string nameIn(const Table& table, Kind kind) {
  const auto one = std::ranges::find_if(table, [&](const auto& law) { return law.kind == kind; });
  return one == table.end() ? "unknown" : std::string(one->key);
}

/// Rows of the current law and of every law.
template <class Settings, class Kind>
SettingMap settingsIn(std::span<const haptics::Parameter<Settings, Kind>> table, Settings& settings) {
  SettingMap found;
  for (const haptics::Parameter<Settings, Kind>& row : table) {
    if constexpr (requires { settings.kind; })
      if (row.law.value_or(settings.kind) != settings.kind) continue;
    found[std::string(row.key)] = {&row.of(settings), row.lowest, row.highest, row.unit};
  }
  return found;
}

std::string helpOn(const auto& parameter) {
  const std::string unit = parameter.unit.empty() ? "" : fmt::format(" ({})", parameter.unit);
  return fmt::format("    {}{}: {}\n", parameter.key, unit, parameter.meaning);
}

}  // namespace

std::string lawNames() { return joined(haptics::kLaws, &haptics::LawName::key); }
std::string lawName(haptics::LawKind law) { return nameIn(haptics::kLaws, law); }
std::string erosionName(haptics::ErosionKind law) { return nameIn(haptics::kErosions, law); }

haptics::LawKind lawNamed(const std::string& name, const std::string& where) {
  if (const auto law = haptics::lawOfKey(name)) return *law;
  throw UsageError(where + name + ": no such law, give one of " + lawNames());
}

std::vector<std::string> erosionNames() {
  std::vector<std::string> names;
  for (const haptics::ErosionName& law : haptics::kErosions) names.emplace_back(law.key);
  return names;
}

SettingMap parametersOf(haptics::LawSettings& law) { return settingsIn(haptics::lawParameters(), law); }
SettingMap parametersOf(haptics::ErosionSettings& law) { return settingsIn(haptics::erosionParameters(), law); }
SettingMap parametersOf(haptics::SpindleSettings& spindle) { return settingsIn(haptics::spindleParameters(), spindle); }

std::string erosionHelp() {
  std::string text = "Erosion laws and their --set keys:\n";
  for (const haptics::ErosionName& law : haptics::kErosions) {
    text += fmt::format("  {}: {}\n", law.key, law.formula);
    for (const haptics::ErosionParameter& one : haptics::erosionParameters())
      if (one.law == law.kind) text += helpOn(one);
  }
  text += "  every law, and the spindle:\n";
  for (const haptics::ErosionParameter& one : haptics::erosionParameters())
    if (!one.law) text += helpOn(one);
  for (const haptics::SpindleParameter& one : haptics::spindleParameters()) text += helpOn(one);
  return text;
}

}  // namespace app
