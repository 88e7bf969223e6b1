#include "app/law_text.h"

#include "app/usage_error.h"

namespace app {

std::vector<std::string> lawNames() { return {"agus"}; }

std::string lawName(haptics::LawKind) { return "agus"; }

haptics::LawKind lawNamed(const std::string& name, const std::string& where) {
  std::string known;
  for (const std::string& one : lawNames()) {
    if (one == name) return haptics::LawKind::agus;
    known += (known.empty() ? "" : ", ") + one;
  }
  throw UsageError(where + " " + name + ": no such law, give one of " + known);
}

std::map<std::string, Setting> parametersOf(haptics::LawSettings& law) {
  return {{"stiffness_N_per_mm", {&law.agus.stiffness_N_per_mm, 0.0, 5.0, "N/mm"}},
          {"damping_Ns_per_mm", {&law.agus.damping_Ns_per_mm, 0.0, 0.1, "Ns/mm"}}};
}

}  // namespace app
