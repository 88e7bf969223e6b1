#include "app/options/law_text.h"

#include "app/text/usage_error.h"
#include "haptics/contact/law_parameters.h"

namespace app {

std::string lawNames() {
  std::string names;
  for (const haptics::LawName& one : haptics::kLaws) names += (names.empty() ? "" : ", ") + std::string(one.key);
  return names;
}

std::string lawName(haptics::LawKind law) {
  for (const haptics::LawName& one : haptics::kLaws)
    if (one.kind == law) return std::string(one.key);
  return "unknown";
}

haptics::LawKind lawNamed(const std::string& name, const std::string& where) {
  if (const auto law = haptics::lawOfKey(name)) return *law;
  throw UsageError(where + name + ": no such law, give one of " + lawNames());
}

std::map<std::string, Setting> parametersOf(haptics::LawSettings& law) {
  std::map<std::string, Setting> settings;
  for (const haptics::LawParameter& one : haptics::lawParameters())
    if (!one.law || *one.law == law.kind)
      settings[std::string(one.key)] = {&one.of(law), one.lowest, one.highest, one.unit};
  return settings;
}

}  // namespace app
