// The result of one check of the doctor: an id that is stable across versions, its health, one plain sentence, and the
// next step if there is one. Plain data.
#pragma once

#include <string>
#include <string_view>

namespace app {

enum class Health { ok, warn, missing, not_needed };

/// As programs read it.
constexpr std::string_view nameOf(Health health) {
  constexpr std::string_view kNames[] = {"ok", "warn", "missing", "not-needed"};
  return kNames[static_cast<int>(health)];
}

struct Finding {
  std::string id;
  Health health = Health::ok;
  std::string sentence;
  std::string next_step = {};  ///< empty: nothing to do
};

}  // namespace app
