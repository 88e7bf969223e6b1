#include "app/options/settings_text.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <vector>

#include <fmt/core.h>

#include "app/text/list.h"
#include "app/text/parse_number.h"
#include "app/text/suggestion.h"
#include "app/text/usage_error.h"

namespace app {
namespace {

/// By key or by its former name.
SettingMap::const_iterator settingOf(const std::string& key, const SettingMap& settings) {
  const auto found = settings.find(key);
  if (found != settings.end() || key.empty()) return found;
  return std::find_if(settings.begin(), settings.end(), [&](const auto& one) { return formerKey(one.first) == key; });
}

/// The closest key, or the places that list them: there are some fifty.
std::string unknownSetting(const std::string& text, const SettingMap& settings) {
  std::vector<std::string> keys;
  for (const auto& [key, setting] : settings) keys.push_back(key);
  constexpr std::size_t kFew = 8;
  const std::string suggestion = didYouMean(text.substr(0, text.find('=')), keys);
  return "--set " + text + ": no such setting" + (suggestion.empty() ? "," : suggestion) + " use key=value" +
         (keys.size() <= kFew ? " with one of " + joined(keys)
                              : "; molar laws lists the keys of force laws, app/options/feel.toml all");
}

}  // namespace

std::string_view formerKey(std::string_view key) {
  if (key == "stiffness_mandibular_canal") return "stiffness_canal";
  if (key == "factor_mandibular_canal") return "factor_canal";
  return {};
}

void applySettings(const std::vector<std::string>& texts, const SettingMap& settings) {
  std::set<std::string> seen;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    const auto found = settingOf(text.substr(0, equals), settings);
    if (equals == std::string::npos || found == settings.end()) throw UsageError(unknownSetting(text, settings));
    const std::string& key = found->first;
    if (!seen.insert(key).second) throw UsageError("--set " + key + ": given twice, give it once");
    const auto value = parseNumber<double>(std::string_view(text).substr(equals + 1));
    const Setting& setting = found->second;
    if (!value) throw UsageError("--set " + text + ": the value is not a number");
    if (*value < setting.low || *value > setting.high)
      throw UsageError(fmt::format("--set {}: the value is out of range, give {:.9g} to {:.9g}{}{}", text, setting.low,
                                   setting.high, setting.unit.empty() ? "" : " ", setting.unit));
    *setting.value = *value;
  }
}

void refuseUnlessPng(const std::string& option, const std::string& path, MissingEnding missing_ending) {
  const std::filesystem::path ending = std::filesystem::path(path).extension();
  if (ending.empty() && missing_ending == MissingEnding::allowed) return;
  if (ending != ".png") throw UsageError(option + " " + path + ": images are PNG, end the name in .png");
}

void refuseSameFile(const std::string& output, std::initializer_list<std::string> inputs) {
  std::error_code ignored;
  for (const std::string& input : inputs)
    if (!input.empty() && std::filesystem::equivalent(output, input, ignored))
      throw UsageError("--out " + output + ": it is also an input, give another name");
}

}  // namespace app
