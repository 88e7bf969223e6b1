#include "app/controls/control.h"

#include <algorithm>
#include <functional>

#include <fmt/core.h>

#include "app/options/law_text.h"
#include "app/options/picture_layers.h"
#include "app/text/list.h"
#include "app/text/parse_number.h"
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

template <class Table, class Name = std::identity>
std::optional<int> indexIn(const Table& table, std::string_view text, Name name = {}) {
  const auto found = std::ranges::find(table, text, name);
  return found == table.end() ? std::nullopt : std::optional(static_cast<int>(found - table.begin()));
}

std::optional<int> within(std::optional<int> number, int least, int most) {
  return number && *number >= least && *number <= most ? number : std::nullopt;
}

/// Tools and laws are counted from 1 by people, from 0 inside.
std::optional<int> valueIn(ControlValue kind, std::string_view text) {
  static constexpr std::array<std::string_view, 2> kSwitch = {"off", "on"};
  const std::optional<int> number = parseNumber<int>(text);
  const auto from_one = [&](int most) { return within(number, 1, most) ? std::optional(*number - 1) : std::nullopt; };
  switch (kind) {
    case ControlValue::on_or_off:
      return indexIn(kSwitch, text);
    case ControlValue::tool:
      return from_one(kMostTools);
    case ControlValue::law: {
      const auto named = indexIn(haptics::kLaws, text, &haptics::LawName::key);
      return named ? named : from_one(static_cast<int>(haptics::kLaws.size()));
    }
    case ControlValue::layer:
      return indexIn(kPictureLayers, text, &PictureLayer::name);
    case ControlValue::percent:
      return within(number, 0, 100);
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
      return "one of " + joined(kPictureLayers, &PictureLayer::name);
    case ControlValue::percent:
      return "percent, 0 to 100";
    case ControlValue::none:
      break;
  }
  return "nothing";
}

}  // namespace

ControlRequest requestFrom(const std::string& text) {
  const std::size_t colon = text.find(':');
  const auto control = controlNamed(std::string_view(text).substr(0, colon));
  if (!control)
    throw UsageError("\"" + text + "\": there is no such control, write " + joined(kControls, &ControlMeaning::name));
  const ControlMeaning& meaning = meaningOf(*control);
  ControlRequest request{*control};
  if (colon != std::string::npos)
    request.value = valueIn(meaning.value, std::string_view(text).substr(colon + 1)).value_or(kNoValue);
  if ((colon != std::string::npos || isNeeded(meaning.value)) && request.value == kNoValue)
    throw UsageError("\"" + text + "\": after " + std::string(meaning.name) + " stands " +
                     whatMayFollow(meaning.value));
  return request;
}

std::vector<KeyMeaning> keyMeanings() {
  std::vector<KeyMeaning> keys(kMovements.begin(), kMovements.end());
  for (const ControlMeaning& one : kControls)
    if (!one.key.empty()) keys.push_back({one.key, one.does});
  return keys;
}

std::string keyHelp() {
  std::string text = "Keys:\n";
  for (const KeyMeaning& key : keyMeanings()) text += fmt::format("  {:8}{}\n", key.key, key.does);
  return text;
}

}  // namespace app
