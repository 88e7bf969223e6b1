// Controls of a rehearsal, requested by keys, buttons of handle and pedal, the instructor's window and scripts. The
// table is the only source of their names, keys and help. Pure values; any thread.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "haptics/device/pedal/hand_action.h"

namespace app {

enum class Control : std::uint8_t {
  law,
  drill,
  tool,
  irrigation,
  undo,
  redo,
  snapshot,
  stop,
  arm,
  home,
  end,
  layer,
  face,
  line,
  keys,
  magnify,
  shrink,
  first_view,
  slice_up,
  slice_down,
  ruler,
  step,
  way,
  ring,
  sound,
  assistant,
  draw,
  draw_next,
  clear_tooth,
  deviation,
  insertion,
  bite
};

inline constexpr int kNoValue = -1;  ///< toggles a switch, selects the next tool

/// Value: index from 0 of a law, tool or layer; 1 on, 0 off; the face's opacity in percent.
struct ControlRequest {
  Control control = Control::end;
  int value = kNoValue;
  bool operator==(const ControlRequest&) const = default;
};

/// Kind of the value after a name. It is optional for a switch and a tool, required for law, layer and percent.
enum class ControlValue : std::uint8_t { none, on_or_off, tool, law, layer, percent };
constexpr bool isNeeded(ControlValue value) { return value >= ControlValue::law; }

struct ControlMeaning {
  Control control;
  std::string_view name;  ///< in scripts
  std::string_view key;   ///< with exactly its modifiers: "Shift+U"; empty: none
  std::string_view does;
  ControlValue value;
  bool is_felt;                ///< changes force, cutting or irrigation: a procedure may reserve it
  std::string_view also = "";  ///< a second key
};

inline constexpr std::array<ControlMeaning, 32> kControls = {{
    {Control::law, "law", "1 - 7", "force law: instructor or --verbose", ControlValue::law, true},
    {Control::drill, "drill", "D", "lock or unlock the drill", ControlValue::on_or_off, true},
    {Control::tool, "tool", "T", "change the tool", ControlValue::tool, true},
    {Control::irrigation, "irrigation", "I", "irrigation on or off", ControlValue::on_or_off, true},
    {Control::undo, "undo", "U", "undo the last stroke", ControlValue::none, true, "Ctrl+Z"},
    {Control::redo, "redo", "Shift+U", "redo the stroke undone last", ControlValue::none, true, "Ctrl+Shift+Z"},
    {Control::snapshot, "snapshot", "P", "save a picture at full quality", ControlValue::none, false},
    {Control::stop, "stop", "Shift+X", "emergency stop: motors off", ControlValue::none, false},
    {Control::arm, "arm", "R", "arm again after a fault", ControlValue::none, false},
    {Control::home, "home", "H", "the handle is at home", ControlValue::none, false},
    {Control::end, "end", "Esc", "end", ControlValue::none, false},
    {Control::layer, "layer", "", "show or hide a layer", ControlValue::layer, false},
    {Control::face, "face", "", "how much of the face is seen", ControlValue::percent, false},
    {Control::line, "line", "L", "line of text in the picture on or off", ControlValue::on_or_off, false},
    {Control::keys, "keys", "F1, ?", "show or close these keys", ControlValue::on_or_off, false},
    {Control::magnify, "magnify", "+", "stronger loupes", ControlValue::none, false},
    {Control::shrink, "shrink", "-", "weaker loupes", ControlValue::none, false},
    {Control::first_view, "first-view", "Home", "the first view again", ControlValue::none, false},
    {Control::slice_up, "slice-up", "PgUp", "axial CT slice half a millimetre up", ControlValue::none, false},
    {Control::slice_down, "slice-down", "PgDn", "the same down", ControlValue::none, false},
    {Control::ruler, "ruler", "M", "ruler: first point, second point, away", ControlValue::none, false},
    {Control::step, "step", "N", "go on to the procedure's next step", ControlValue::none, false},
    {Control::way, "way", "W", "what keeps the tooth or piece in", ControlValue::none, false},
    {Control::ring, "ring", "Shift+T", "ring of instruments; again takes", ControlValue::on_or_off, true},
    {Control::sound, "sound", "S", "sound on or off", ControlValue::on_or_off, false},
    {Control::assistant, "assistant", "A", "assistant holds cheek and flap aside", ControlValue::on_or_off, true},
    {Control::draw, "draw", "G", "own plan: a point of trough or section", ControlValue::none, false},
    {Control::draw_next, "draw-next", "Shift+G", "own plan: next line; then all anew", ControlValue::none, false},
    {Control::clear_tooth, "clear-tooth", "C", "tooth as clear as glass around a file", ControlValue::on_or_off, false},
    {Control::deviation, "deviation", "V", "colours: off the ideal", ControlValue::on_or_off, false},
    {Control::insertion, "insertion", "Shift+V", "way of insertion, undercut", ControlValue::on_or_off, false},
    {Control::bite, "bite", "B", "bite on articulating paper", ControlValue::none, false},
}};

constexpr const ControlMeaning& meaningOf(Control control) { return kControls[static_cast<std::size_t>(control)]; }

constexpr std::optional<Control> controlNamed(std::string_view name) {
  for (const ControlMeaning& one : kControls)
    if (one.name == name) return one.control;
  return {};
}

/// Of a pressed key; `key` is its upper-case letter.
std::optional<Control> controlOfKey(char key, bool shift, bool control);

/// From a script: `undo`, `irrigation`, `irrigation:off`, `tool:2`, `law:agus`, `layer:canal`, `face:30`. Throws
/// UsageError with the accepted values.
ControlRequest requestFrom(const std::string& text);

/// Of a button or pedal action, which has the control's name. None for drilling, which is held.
constexpr std::optional<ControlRequest> requestOf(haptics::HandAction action) {
  const std::optional<Control> control = controlNamed(haptics::nameOf(action));
  return control && action != haptics::HandAction::drill ? std::optional(ControlRequest{*control}) : std::nullopt;
}
static_assert(requestOf(haptics::HandAction::irrigation) && requestOf(haptics::HandAction::undo) &&
              requestOf(haptics::HandAction::tool_change));

/// Keys and mouse in a window, movements first.
struct KeyMeaning {
  std::string_view key, does;
};
/// Leaves out what a surgeon does not need (`with_laws`), and what concerns motors where there are none.
std::vector<KeyMeaning> keyMeanings(bool with_laws = true, bool with_motors = true);
/// The same as lines of text.
std::string keyHelp();

}  // namespace app
