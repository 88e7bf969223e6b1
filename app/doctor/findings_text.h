// The result of one check of the doctor, and findings as aligned text and as JSON. Plain data.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/text/terminal_format.h"

namespace app {

enum class Health { ok, warn, missing, not_needed };

/// As programs read it.
constexpr std::string_view nameOf(Health health) {
  constexpr std::string_view kNames[] = {"ok", "warn", "missing", "not-needed"};
  return kNames[static_cast<int>(health)];
}

struct Finding {
  std::string id;  ///< the same in every version
  Health health = Health::ok;
  std::string sentence;
  std::string next_step = {};  ///< empty: nothing to do
};

/// How many report something missing.
int missingCount(const std::vector<Finding>& findings);

std::string asText(const std::vector<Finding>& findings, const TerminalFormat& look);
/// {"checks": [{"id", "state", "sentence", "next_step"}], "missing": n}
std::string asJson(const std::vector<Finding>& findings);

}  // namespace app
