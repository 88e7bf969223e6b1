// `key=value` settings as people type them. Start-up only.
// Throws UsageError that lists the keys there are.
#pragma once

#include <initializer_list>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace haptics {
struct Command;
}

namespace app {

/// A number a person may set, with the range it must stay in.
struct Setting {
  double* value = nullptr;
  double low = 0.0, high = 0.0;
  std::string_view unit = "";
};

/// What a key was called before, as older files and scripts still write it; empty if it never changed.
std::string_view formerKey(std::string_view key);

/// Applies every `key=value` of `texts` to the settings; unknown keys, doubles and values out of range are refused.
void applySettings(const std::vector<std::string>& texts, const std::map<std::string, Setting>& settings);

/// Refuses a command of which the servo would obey only a part, so that what is asked is what is felt, cut and drawn.
void refuseBeyondServoLimits(const haptics::Command& command);

/// Refuses an output that is one of the inputs: --force must not eat what is being read.
void refuseSameFile(const std::string& output, std::initializer_list<std::string> inputs);

}  // namespace app
