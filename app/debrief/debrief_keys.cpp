#include "app/debrief/debrief_keys.h"

#include <fmt/core.h>

namespace app {

std::string debriefKeyHelp() {
  std::string help = "Keys:\n";
  for (const DebriefKey& one : kDebriefKeys)
    if (!one.name.empty()) help += fmt::format("  {:<20}{}\n", one.name, one.does);
  return help + "  Right button held   turn the patient; click or drag on the time line to go there\n";
}

}  // namespace app
