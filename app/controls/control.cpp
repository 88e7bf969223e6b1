#include "app/controls/control.h"

#include <charconv>

#include "app/options/law_text.h"
#include "app/options/picture_layers.h"
#include "app/text/printed.h"
#include "app/text/usage_error.h"

namespace app {
namespace {

constexpr std::array<KeyMeaning, 5> kMovements = {{
    {"Space", "pedal: drill while held"},
    {"Drag", "move in the screen's plane"},
    {"Wheel", "move nearer or farther"},
    {"Arrows", "tilt the handpiece"},
    {"Q, E", "turn the handpiece"},
}};

constexpr bool isInOrder() {
  for (std::size_t i = 0; i < kControls.size(); ++i)
    if (static_cast<std::size_t>(kControls[i].control) != i) return false;
  return true;
}
static_assert(isInOrder());

constexpr int kMostTools = 64;

std::string layerNames() {
  std::string names;
  for (const PictureLayer& layer : kPictureLayers) names += (names.empty() ? "" : ", ") + std::string(layer.name);
  return names;
}

std::string controlNames() {
  std::string names;
  for (const ControlMeaning& one : kControls) names += (names.empty() ? "" : ", ") + std::string(one.name);
  return names;
}

std::optional<int> numberIn(std::string_view text, int least, int most) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || number < least || number > most) return {};
  return number;
}

template <class Table, class Name>
std::optional<int> indexIn(const Table& table, std::string_view text, Name name) {
  for (std::size_t i = 0; i < table.size(); ++i)
    if (table[i].*name == text) return static_cast<int>(i);
  return {};
}

std::optional<int> onOrOff(std::string_view text) {
  if (text == "on") return 1;
  return text == "off" ? std::optional(0) : std::nullopt;
}

/// Counted from 1 by people, from 0 inside.
std::optional<int> countedFromOne(std::string_view text, int most) {
  const auto number = numberIn(text, 1, most);
  return number ? std::optional(*number - 1) : std::nullopt;
}

std::optional<int> valueIn(ControlValue kind, std::string_view text) {
  switch (kind) {
    case ControlValue::on_or_off:
      return onOrOff(text);
    case ControlValue::tool:
      return countedFromOne(text, kMostTools);
    case ControlValue::law: {
      const auto named = indexIn(haptics::kLaws, text, &haptics::LawName::key);
      return named ? named : countedFromOne(text, static_cast<int>(haptics::kLaws.size()));
    }
    case ControlValue::layer:
      return indexIn(kPictureLayers, text, &PictureLayer::name);
    case ControlValue::percent:
      return numberIn(text, 0, 100);
    case ControlValue::none:
      break;
  }
  return {};
}

std::string whatMayFollow(ControlValue kind) {
  switch (kind) {
    case ControlValue::on_or_off:
      return ":on, :off or nothing";
    case ControlValue::tool:
      return "the tool's number from 1, or nothing for the next";
    case ControlValue::law:
      return "one of " + lawNames();
    case ControlValue::layer:
      return "one of " + layerNames();
    case ControlValue::percent:
      return "percent, 0 to 100";
    case ControlValue::none:
      break;
  }
  return "nothing";
}

}  // namespace

ControlWish wishFrom(const std::string& text) {
  const std::size_t colon = text.find(':');
  const auto control = controlNamed(std::string_view(text).substr(0, colon));
  if (!control) throw UsageError("\"" + text + "\": there is no such control, write " + controlNames());
  const ControlMeaning& meaning = meaningOf(*control);
  ControlWish wish{*control};
  if (colon != std::string::npos)
    wish.value = valueIn(meaning.value, std::string_view(text).substr(colon + 1)).value_or(kNoValue);
  if ((colon != std::string::npos || isNeeded(meaning.value)) && wish.value == kNoValue)
    throw UsageError("\"" + text + "\": after " + std::string(meaning.name) + " stands " +
                     whatMayFollow(meaning.value));
  return wish;
}

std::vector<KeyMeaning> keyMeanings() {
  std::vector<KeyMeaning> keys(kMovements.begin(), kMovements.end());
  for (const ControlMeaning& one : kControls)
    if (!one.key.empty()) keys.push_back({one.key, one.does});
  return keys;
}

std::string keyHelp() {
  std::string text = "Keys:\n";
  for (const KeyMeaning& key : keyMeanings())
    text += printed("  %-8s%s\n", std::string(key.key).c_str(), std::string(key.does).c_str());
  return text;
}

}  // namespace app
