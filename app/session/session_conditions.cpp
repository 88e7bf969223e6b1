#include "app/session/session_conditions.h"

#include <fmt/core.h>

#include "app/text/parse_number.h"
#include "haptics/contact/law_parameters.h"

namespace app {

void SessionConditions::follow(const haptics::Command& command) {
  const std::string key(haptics::kLaws[static_cast<std::size_t>(command.law.kind) % haptics::kLaws.size()].key);
  if (law.empty())
    law = key;
  else if (law != key && !law.ends_with(", " + key))
    law += ", " + key;
  law_parameters.clear();
  for (const haptics::LawParameter& one : haptics::lawParameters())
    if (!one.law || *one.law == command.law.kind) law_parameters.emplace(one.key, one.of(command.law));
  peak_force_N = command.safety.peak_force_N;
}

std::optional<std::uint64_t> missedTicksFrom(const std::string& servo_text) {
  const std::size_t end = servo_text.find(" deadlines missed"), begin = servo_text.rfind(", ", end);
  if (end == std::string::npos || begin == std::string::npos) return {};
  return parseNumber<std::uint64_t>(std::string_view(servo_text).substr(begin + 2, end - begin - 2));
}

std::string conditionsInWords(const SessionConditions& conditions) {
  std::string parameters;
  for (const auto& [key, value] : conditions.law_parameters)
    // The many tissues follow from the program's version.
    if (!key.starts_with("stiffness_") || key.starts_with("stiffness_N"))
      parameters += fmt::format("{}{} {:g}", parameters.empty() ? "" : ", ", key, value);
  std::string words = "law " + (conditions.law.empty() ? "not recorded" : conditions.law);
  if (!parameters.empty()) words += " (" + parameters + ")";
  words += !conditions.stereo ? "; stereo not recorded" : *conditions.stereo ? "; stereo on" : "; stereo off";
  words += fmt::format("; force {:g}:1 up to {:g} N", conditions.force_scale, conditions.peak_force_N);
  words += conditions.missed_ticks ? fmt::format("; {} ticks missed", *conditions.missed_ticks)
                                   : std::string("; missed ticks not recorded");
  return words;
}

}  // namespace app
