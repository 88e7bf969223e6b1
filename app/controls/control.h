// What may be asked for in a rehearsal besides moving the hand: one vocabulary for keys, the buttons of handle and
// pedal, the instructor's window and scripts. The table is the one source of names, keys and help. Pure values; any
// thread.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "haptics/device/pedal/hand_action.h"

namespace app {

enum class Control : std::uint8_t { law, drill, tool, irrigation, undo, snapshot, stop, arm, home, end, layer, face };

inline constexpr int kNoValue = -1;  ///< of a switch the other way, of the tools the next one

/// One thing asked for, once. Its value: of a law, tool or layer the index from 0; of a switch 1 on, 0 off; of the face
/// percent.
struct ControlRequest {
  Control control = Control::end;
  int value = kNoValue;
  bool operator==(const ControlRequest&) const = default;
};

/// What may follow a name: a switch's :on or :off and a tool's number may be left out, the others not.
enum class ControlValue : std::uint8_t { none, on_or_off, tool, law, layer, percent };
constexpr bool isNeeded(ControlValue value) { return value >= ControlValue::law; }

struct ControlMeaning {
  Control control;
  std::string_view name;  ///< as a script writes it
  std::string_view key;   ///< empty: none
  std::string_view does;
  ControlValue value;
  bool is_felt;  ///< changes what is felt, cut or watered: a procedure may keep it for itself
};

inline constexpr std::array<ControlMeaning, 12> kControls = {{
    {Control::law, "law", "1 - 7", "choose the force law", ControlValue::law, true},
    {Control::drill, "drill", "D", "lock or unlock the drill", ControlValue::on_or_off, true},
    {Control::tool, "tool", "T", "change the tool", ControlValue::tool, true},
    {Control::irrigation, "irrigation", "I", "irrigation on or off", ControlValue::on_or_off, true},
    {Control::undo, "undo", "U", "undo the last stroke", ControlValue::none, true},
    {Control::snapshot, "snapshot", "P", "snapshot", ControlValue::none, false},
    {Control::stop, "stop", "X", "emergency stop: motors off", ControlValue::none, false},
    {Control::arm, "arm", "R", "arm again after a fault", ControlValue::none, false},
    {Control::home, "home", "H", "the handle stands at home", ControlValue::none, false},
    {Control::end, "end", "Esc", "end", ControlValue::none, false},
    {Control::layer, "layer", "", "show or hide a layer", ControlValue::layer, false},
    {Control::face, "face", "", "how much of the face is seen", ControlValue::percent, false},
}};

constexpr const ControlMeaning& meaningOf(Control control) { return kControls[static_cast<std::size_t>(control)]; }

constexpr std::optional<Control> controlNamed(std::string_view name) {
  for (const ControlMeaning& one : kControls)
    if (one.name == name) return one.control;
  return {};
}

/// As a script writes it: `undo`, `irrigation`, `irrigation:off`, `tool:2`, `law:agus`, `layer:canal`, `face:30`.
/// Throws UsageError that says what may stand there.
ControlRequest requestFrom(const std::string& text);

/// By its name, for a pedal calls what it asks for as everybody else does. None for drilling, which is held and no
/// request.
constexpr std::optional<ControlRequest> requestOf(haptics::HandAction action) {
  const std::optional<Control> control = controlNamed(haptics::nameOf(action));
  return control && action != haptics::HandAction::drill ? std::optional(ControlRequest{*control}) : std::nullopt;
}
static_assert(requestOf(haptics::HandAction::irrigation) && requestOf(haptics::HandAction::undo) &&
              requestOf(haptics::HandAction::tool_change));

/// What keys and mouse do in a window, the hand's movements first.
struct KeyMeaning {
  std::string_view key, does;
};
std::vector<KeyMeaning> keyMeanings();
/// The same as lines for a terminal.
std::string keyHelp();

}  // namespace app
