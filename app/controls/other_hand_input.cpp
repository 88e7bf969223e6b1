#include "app/controls/other_hand_input.h"

#include <algorithm>
#include <array>

namespace app {
namespace {

constexpr render::Key kItsKey = render::keyOf('O');

constexpr bool isShift(render::Key key) { return key == render::Key::left_shift || key == render::Key::right_shift; }

}  // namespace

bool OtherHandInput::moves(const render::WindowEvent& event) const {
  if (!has_mouse_ && !held_) return false;
  if (const auto* const moved = std::get_if<render::PointerMoved>(&event))
    return moved->button == render::MouseButton::left;
  if (std::holds_alternative<render::WheelTurned>(event)) return true;
  constexpr std::array kTurning{render::Key::left, render::Key::right, render::Key::up,
                                render::Key::down, render::keyOf('Q'), render::keyOf('E')};
  const auto* const key = std::get_if<render::KeyPressed>(&event);
  return key != nullptr && std::ranges::find(kTurning, key->key) != kTurning.end();
}

bool OtherHandInput::take(const render::WindowEvent& event, double mm_per_px) {
  const auto* const key = std::get_if<render::KeyPressed>(&event);
  if (key != nullptr && key->key == kItsKey) {
    held_ = key->down;
    return true;
  }
  // Shift is both hands': a wheel turns five times as far.
  const bool is_its = moves(event);
  if (is_its || (key != nullptr && isShift(key->key))) hand_.take(event, mm_per_px);
  hand_.takeRequests();
  return is_its;
}

}  // namespace app
