#include "app/hand_input.h"

#include <utility>

#include "calibration/geometry/units.h"

namespace app {
namespace {

constexpr double kWheelNotch_mm = 0.5;
constexpr double kTurn_rad = calibration::radFromDegrees(3.0);

constexpr std::array<std::pair<char, Wish>, 8> kWishes = {{{'D', Wish::drill_switch},
                                                           {'T', Wish::tool_change},
                                                           {'I', Wish::irrigation_switch},
                                                           {'U', Wish::undo},
                                                           {'P', Wish::snapshot},
                                                           {'X', Wish::emergency_stop},
                                                           {'R', Wish::arm_again},
                                                           {'H', Wish::set_home}}};

}  // namespace

void HandInput::take(const render::WindowEvent& event, double mm_per_px) {
  if (const auto* moved = std::get_if<render::PointerMoved>(&event)) {
    // Pixels run downwards, W upwards.
    if (moved->button == render::MouseButton::left)
      X_WT_.translation_mm += mm_per_px * glm::dvec3(moved->by_px.x, -moved->by_px.y, 0.0);
  } else if (const auto* wheel = std::get_if<render::WheelTurned>(&event)) {
    X_WT_.translation_mm.z -= kWheelNotch_mm * wheel->notches;
  } else if (const auto* key = std::get_if<render::KeyPressed>(&event)) {
    press(*key);
  } else if (std::holds_alternative<render::CloseAsked>(event)) {
    wishes_.push_back(Wish::end);
  }
}

void HandInput::press(const render::KeyPressed& key) {
  using render::Key;
  // The pedal is held, everything else is a press.
  if (key.key == Key::space) pedal_ = key.down;
  if (!key.down) return;
  if (key.key == Key::left) turn({0, 1, 0}, -kTurn_rad);
  if (key.key == Key::right) turn({0, 1, 0}, kTurn_rad);
  if (key.key == Key::up) turn({1, 0, 0}, -kTurn_rad);
  if (key.key == Key::down) turn({1, 0, 0}, kTurn_rad);
  if (key.key == render::keyOf('Q')) turn({0, 0, 1}, kTurn_rad);
  if (key.key == render::keyOf('E')) turn({0, 0, 1}, -kTurn_rad);
  if (key.repeated) return;
  if (key.key == Key::escape) wishes_.push_back(Wish::end);
  for (const auto& [letter, wish] : kWishes)
    if (key.key == render::keyOf(letter)) wishes_.push_back(wish);
  for (int n = 0; n < 9; ++n)
    if (key.key == render::keyOf(static_cast<char>('1' + n))) wishes_.push_back(LawWish{n});
}

void HandInput::turn(const glm::dvec3& axis_W, double angle_rad) {
  X_WT_.rotation = glm::normalize(glm::angleAxis(angle_rad, axis_W) * X_WT_.rotation);
}

std::vector<KeyWish> HandInput::takeWishes() { return std::exchange(wishes_, {}); }

}  // namespace app
