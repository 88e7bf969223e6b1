#include "app/options/erosion_text.h"

namespace app {

std::vector<std::string> erosionNames() {
  std::vector<std::string> names;
  for (const haptics::ErosionName& law : haptics::kErosions) names.emplace_back(law.key);
  return names;
}

std::map<std::string, Setting> parametersOf(haptics::ErosionSettings& erosion) {
  std::map<std::string, Setting> settings;
  for (const haptics::ErosionParameter& parameter : haptics::erosionParameters())
    if (parameter.law.value_or(erosion.kind) == erosion.kind)
      settings[std::string(parameter.key)] = {&parameter.in(erosion), parameter.lowest, parameter.highest,
                                              parameter.unit.data()};
  return settings;
}

std::map<std::string, Setting> parametersOf(haptics::SpindleSettings& spindle) {
  std::map<std::string, Setting> settings;
  for (const haptics::SpindleParameter& parameter : haptics::spindleParameters())
    settings[std::string(parameter.key)] = {&(spindle.*parameter.value), parameter.lowest, parameter.highest,
                                            parameter.unit.data()};
  return settings;
}

std::string erosionHelp() {
  std::string text = "Erosion laws and their --set keys:\n";
  const auto add = [&](std::string_view key, std::string_view unit, std::string_view meaning) {
    text += "    " + std::string(key) + (unit.empty() ? "" : " (" + std::string(unit) + ")") + ": " +
            std::string(meaning) + "\n";
  };
  for (const haptics::ErosionName& law : haptics::kErosions) {
    text += "  " + std::string(law.key) + ": " + std::string(law.formula) + "\n";
    for (const haptics::ErosionParameter& parameter : haptics::erosionParameters())
      if (parameter.law == law.kind) add(parameter.key, parameter.unit, parameter.meaning);
  }
  text += "  every law, and the spindle:\n";
  for (const haptics::ErosionParameter& parameter : haptics::erosionParameters())
    if (!parameter.law) add(parameter.key, parameter.unit, parameter.meaning);
  for (const haptics::SpindleParameter& parameter : haptics::spindleParameters())
    add(parameter.key, parameter.unit, parameter.meaning);
  return text;
}

}  // namespace app
