#include "app/controls/control.h"

#include <algorithm>
#include <functional>

#include <fmt/core.h>

#include "app/options/law_text.h"
#include "app/options/picture_option.h"
#include "app/text/list.h"
#include "app/text/parse_number.h"
#include "app/text/usage_error.h"

namespace app {
namespace {

constexpr std::array<KeyMeaning, 9> kMovements = {{
    {"Space", "pedal: drill while held"},
    {"Drag", "move in the screen's plane"},
    {"Wheel", "away from you: in"},
    {"Shift+Wheel", "the same, five times as far"},
    {"Wheel", "on a CT slice: through the slices"},
    {"Right drag", "turn the view (on a desk)"},
    {"Arrows", "tilt the handpiece"},
    {"Q, E", "rotate the handpiece, twist an elevator"},
    {"O held", "the mouse moves the mirror"},
}};

constexpr bool isInOrder() {
  for (std::size_t i = 0; i < kControls.size(); ++i)
    if (static_cast<std::size_t>(kControls[i].control) != i) return false;
  return true;
}
static_assert(isInOrder());

constexpr int kMaxTools = 64;

template <class Table, class Name = std::identity>
std::optional<int> indexOf(std::string_view text, const Table& table, Name name = {}) {
  const auto found = std::ranges::find(table, text, name);
  return found == table.end() ? std::nullopt : std::optional(static_cast<int>(found - table.begin()));
}

/// Of a whole number from `first` to `last`, counted from 0.
std::optional<int> indexBetween(std::string_view text, int first, int last) {
  const std::optional<int> number = parseNumber<int>(text);
  return number && *number >= first && *number <= last ? std::optional(*number - first) : std::nullopt;
}

std::optional<int> valueIn(ControlValue kind, std::string_view text) {
  switch (kind) {
    case ControlValue::on_or_off:
      return indexOf(text, std::array<std::string_view, 2>{"off", "on"});
    case ControlValue::tool:
      return indexBetween(text, 1, kMaxTools);
    case ControlValue::law:
      if (const auto named = indexOf(text, haptics::kLaws, &haptics::LawName::key)) return named;
      return indexBetween(text, 1, static_cast<int>(haptics::kLaws.size()));
    case ControlValue::layer:
      return indexOf(text, kPictureLayers, &PictureLayer::name);
    case ControlValue::percent:
      return indexBetween(text, 0, 100);
    case ControlValue::none:
      break;
  }
  return {};
}

std::string acceptedValues(ControlValue kind) {
  switch (kind) {
    case ControlValue::on_or_off:
      return ":on, :off or no value";
    case ControlValue::tool:
      return "the tool's number from 1, or no value for the next";
    case ControlValue::law:
      return "one of " + lawNames();
    case ControlValue::layer:
      return "one of " + joined(kPictureLayers, &PictureLayer::name);
    case ControlValue::percent:
      return "percent, 0 to 100";
    case ControlValue::none:
      break;
  }
  return "no value";
}

/// One of "U", "Shift+U", "Ctrl+Shift+Z".
bool isKey(std::string_view text, char key, bool shift, bool control) {
  const auto take_prefix = [&](std::string_view prefix) {
    const bool found = text.starts_with(prefix);
    if (found) text.remove_prefix(prefix.size());
    return found;
  };
  return take_prefix("Ctrl+") == control && take_prefix("Shift+") == shift && text.size() == 1 && text.front() == key;
}

}  // namespace

std::optional<Control> controlOfKey(char key, bool shift, bool control) {
  for (const ControlMeaning& one : kControls)
    if (isKey(one.key, key, shift, control) || isKey(one.also, key, shift, control)) return one.control;
  return {};
}

ControlRequest requestFrom(const std::string& text) {
  const std::size_t colon = text.find(':');
  const auto control = controlNamed(std::string_view(text).substr(0, colon));
  if (!control) throw UsageError("\"" + text + "\": no such control, give " + joined(kControls, &ControlMeaning::name));
  const ControlMeaning& meaning = meaningOf(*control);
  ControlRequest request{*control};
  if (colon != std::string::npos)
    request.value = valueIn(meaning.value, std::string_view(text).substr(colon + 1)).value_or(kNoValue);
  if ((colon != std::string::npos || isNeeded(meaning.value)) && request.value == kNoValue)
    throw UsageError("\"" + text + "\": " + std::string(meaning.name) + " takes " + acceptedValues(meaning.value));
  return request;
}

std::vector<KeyMeaning> keyMeanings(bool with_laws, bool with_motors) {
  std::vector<KeyMeaning> keys(kMovements.begin(), kMovements.end());
  for (const ControlMeaning& one : kControls) {
    const bool is_of_motors =
        one.control == Control::stop || one.control == Control::arm || one.control == Control::home;
    if (one.key.empty() || (one.control == Control::law && !with_laws) || (is_of_motors && !with_motors)) continue;
    keys.push_back({one.key, one.does});
  }
  return keys;
}

std::string keyHelp() {
  std::string text = "Keys:\n";
  for (const KeyMeaning& key : keyMeanings()) text += fmt::format("  {:13}{}\n", key.key, key.does);
  return text;
}

}  // namespace app
