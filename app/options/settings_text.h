// Settings of the command line, `key=value`. Start-up only. Throws UsageError listing the known keys.
#pragma once

#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace app {

/// A number that can be set, and its range.
struct Setting {
  double* value = nullptr;
  double low = 0.0, high = 0.0;
  std::string_view unit = "";
};

using SettingMap = std::map<std::string, Setting>;

/// Former name of a key, still accepted from files and scripts; empty if it never changed.
std::string_view formerKey(std::string_view key);

/// Applies every `key=value`; unknown keys, duplicates and values out of range are refused.
void applySettings(const std::vector<std::string>& texts, const SettingMap& settings);

/// Refuses an image of another format. Allowed: a name without an ending, or none at all, where one is added.
enum class MissingEnding { refused, allowed };
void refuseUnlessPng(const std::string& option, const std::string& path,
                     MissingEnding missing_ending = MissingEnding::refused);

/// Refuses an output that is one of the inputs: --force must not overwrite what is being read.
void refuseSameFile(const std::string& output, std::initializer_list<std::string> inputs);

}  // namespace app
