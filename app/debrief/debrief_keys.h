// What the keys of a debrief do: the one table for window, panel and help. Pure values; any thread.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "render/display/window.h"

namespace app {

enum class DebriefAction : std::uint8_t {
  play,
  back_little,
  on_little,
  back_far,
  on_far,
  shuttle_back,
  shuttle_stop,
  shuttle_on,
  faster,
  slower,
  to_start,
  to_end,
  next_mark,
  former_mark,
  bookmark,
  remove_bookmark,
  clip_from,
  clip_to,
  save_clip,
  picture,
  trail,
  ghost,
  other_ghost,
  edges,
  line,
  first_view,
  magnify,
  shrink,
  keys,
  close
};

struct DebriefKey {
  DebriefAction action;
  render::Key key;
  bool shift;
  std::string_view name, does;  ///< empty name: told with the one before
};

inline constexpr std::array<DebriefKey, 33> kDebriefKeys = {{
    {DebriefAction::play, render::Key::space, false, "Space", "play or pause"},
    {DebriefAction::back_little, render::Key::left, false, "Left, Right", "one second"},
    {DebriefAction::on_little, render::Key::right, false, "", ""},
    {DebriefAction::back_far, render::Key::left, true, "Shift+Left, Right", "ten seconds"},
    {DebriefAction::on_far, render::Key::right, true, "", ""},
    {DebriefAction::shuttle_back, render::keyOf('J'), false, "J K L", "back, stop, on; again: faster"},
    {DebriefAction::shuttle_stop, render::keyOf('K'), false, "", ""},
    {DebriefAction::shuttle_on, render::keyOf('L'), false, "", ""},
    {DebriefAction::faster, render::Key::up, false, "Up, Down", "speed 1/8 to 8"},
    {DebriefAction::slower, render::Key::down, false, "", ""},
    {DebriefAction::to_start, render::Key::home, false, "Home, End", "start, end"},
    {DebriefAction::to_end, render::Key::end, false, "", ""},
    {DebriefAction::next_mark, render::keyOf('N'), false, "N, Shift+N", "next, former mark"},
    {DebriefAction::former_mark, render::keyOf('N'), true, "", ""},
    {DebriefAction::bookmark, render::keyOf('B'), false, "B, Shift+B", "set, remove a bookmark"},
    {DebriefAction::remove_bookmark, render::keyOf('B'), true, "", ""},
    {DebriefAction::clip_from, render::keyOf('I'), false, "I, O", "a clip's start, end"},
    {DebriefAction::clip_to, render::keyOf('O'), false, "", ""},
    {DebriefAction::save_clip, render::keyOf('C'), false, "C", "save the clip as pictures"},
    {DebriefAction::picture, render::keyOf('P'), false, "P", "save a picture"},
    {DebriefAction::trail, render::keyOf('T'), false, "T", "way of the tool: force, clearance, none"},
    {DebriefAction::ghost, render::keyOf('G'), false, "G, Shift+G",
     "ghost: the tool at the hand, the other session's tool"},
    {DebriefAction::other_ghost, render::keyOf('G'), true, "", ""},
    {DebriefAction::edges, render::keyOf('E'), false, "E", "sharp edges of bone, once a piece is out"},
    {DebriefAction::line, render::keyOf('H'), false, "H", "line of text in the picture"},
    {DebriefAction::first_view, render::keyOf('V'), false, "V", "the surgeon's view again"},
    {DebriefAction::magnify, render::keyOf('='), false, "+, -", "nearer, farther"},
    {DebriefAction::magnify, render::keyOf('='), true, "", ""},
    {DebriefAction::magnify, render::Key::keypad_add, false, "", ""},
    {DebriefAction::shrink, render::keyOf('-'), false, "", ""},
    {DebriefAction::shrink, render::Key::keypad_subtract, false, "", ""},
    {DebriefAction::keys, render::Key::f1, false, "F1", "these keys"},
    {DebriefAction::close, render::Key::escape, false, "Esc", "close"},
}};

/// While its key is held: moving about, not what writes or switches.
constexpr bool repeats(DebriefAction action) {
  switch (action) {
    case DebriefAction::back_little:
    case DebriefAction::on_little:
    case DebriefAction::back_far:
    case DebriefAction::on_far:
    case DebriefAction::next_mark:
    case DebriefAction::former_mark:
    case DebriefAction::magnify:
    case DebriefAction::shrink:
      return true;
    default:
      return false;
  }
}

/// None: it does nothing.
constexpr std::optional<DebriefAction> actionOf(const render::KeyPressed& pressed) {
  if (!pressed.down || pressed.control) return {};
  for (const DebriefKey& one : kDebriefKeys)
    if (one.key == pressed.key && one.shift == pressed.shift)
      return pressed.repeated && !repeats(one.action) ? std::nullopt : std::optional(one.action);
  return {};
}

/// For the help, one line each.
std::string debriefKeyHelp();

}  // namespace app
