#include "app/controls/hand_input.h"

#include <utility>

#include "calibration/geometry/units.h"
#include "haptics/contact/law_settings.h"

namespace app {
namespace {

constexpr double kWheelNotch_mm = 0.5;
constexpr double kRotation_rad = calibration::radFromDegrees(3.0);

/// By the table of controls; digits choose laws, also one that does not exist: whoever executes it says so.
std::optional<ControlRequest> requestOf(const render::KeyPressed& pressed) {
  if (pressed.key == render::Key::escape) return ControlRequest{Control::end};
  if (pressed.key == render::Key::f1 || pressed.key == render::keyOf('/')) return ControlRequest{Control::keys};
  for (int law = 0; law < 9; ++law)
    if (pressed.key == render::keyOf(static_cast<char>('1' + law))) return ControlRequest{Control::law, law};
  const int code = static_cast<int>(pressed.key);
  if (code <= ' ' || code > 'Z') return {};
  const auto control = controlOfKey(static_cast<char>(code), pressed.shift, pressed.control);
  return control ? std::optional(ControlRequest{*control}) : std::nullopt;
}

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
  } else if (std::holds_alternative<render::CloseRequested>(event)) {
    requests_.push_back({Control::end});
  }
}

void HandInput::press(const render::KeyPressed& key) {
  using render::Key;
  // The pedal is held; other keys act when pressed.
  if (key.key == Key::space) pedal_ = key.down;
  if (!key.down) return;
  if (key.key == Key::left) rotate({0, 1, 0}, -kRotation_rad);
  if (key.key == Key::right) rotate({0, 1, 0}, kRotation_rad);
  if (key.key == Key::up) rotate({1, 0, 0}, -kRotation_rad);
  if (key.key == Key::down) rotate({1, 0, 0}, kRotation_rad);
  if (key.key == render::keyOf('Q')) rotate({0, 0, 1}, kRotation_rad);
  if (key.key == render::keyOf('E')) rotate({0, 0, 1}, -kRotation_rad);
  if (key.repeated) return;
  if (const auto request = requestOf(key)) requests_.push_back(*request);
}

void HandInput::rotate(const glm::dvec3& axis_W, double angle_rad) {
  X_WT_.rotation = glm::normalize(glm::angleAxis(angle_rad, axis_W) * X_WT_.rotation);
}

std::vector<ControlRequest> HandInput::takeRequests() { return std::exchange(requests_, {}); }

}  // namespace app
