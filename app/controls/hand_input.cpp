#include "app/controls/hand_input.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "calibration/geometry/units.h"
#include "haptics/contact/law_settings.h"

namespace app {
namespace {

// A notch of the wheel: a part of the gap, within limits; away from the bone it is at least an ordinary step.
constexpr double kNotchOfGap = 0.4, kFinestNotch_mm = 0.1, kLeavingNotch_mm = 0.3, kCoarsestNotch_mm = 2.0;
// Walls of a deep hole stay near: whoever turns out notch after notch wants out of it.
constexpr int kEvenNotches = 3;
constexpr double kLeavingGrowth = 1.3;
constexpr double kShiftFactor = 5.0;
constexpr double kRotation_rad = calibration::radFromDegrees(3.0);

/// By the table of controls; digits choose laws, also one that does not exist: whoever executes it says so.
std::optional<ControlRequest> requestOf(const render::KeyPressed& pressed) {
  if (pressed.key == render::Key::escape) return ControlRequest{Control::end};
  if (pressed.key == render::Key::f1 || pressed.key == render::keyOf('/')) return ControlRequest{Control::keys};
  for (int law = 0; law < 9; ++law)
    if (pressed.key == render::keyOf(static_cast<char>('1' + law))) return ControlRequest{Control::law, law};
  if (pressed.key == render::Key::home) return ControlRequest{Control::first_view};
  if (pressed.key == render::Key::page_up) return ControlRequest{Control::slice_up};
  if (pressed.key == render::Key::page_down) return ControlRequest{Control::slice_down};
  // + is on the key of =; both are on the keypad too.
  if (pressed.key == render::keyOf('=') || pressed.key == render::Key::keypad_add)
    return ControlRequest{Control::magnify};
  if (pressed.key == render::Key::keypad_subtract) return ControlRequest{Control::shrink};
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
      X_WT_.translation_mm += glm::conjugate(view_) * (mm_per_px * glm::dvec3(moved->by_px.x, -moved->by_px.y, 0.0));
  } else if (const auto* wheel = std::get_if<render::WheelTurned>(&event)) {
    roll(wheel->notches);
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
  if (key.key == Key::left_shift || key.key == Key::right_shift) shift_ = key.down;
  if (!key.down) return;
  if (key.key == Key::left) rotate({0, 1, 0}, -kRotation_rad);
  if (key.key == Key::right) rotate({0, 1, 0}, kRotation_rad);
  if (key.key == Key::up) rotate({1, 0, 0}, -kRotation_rad);
  if (key.key == Key::down) rotate({1, 0, 0}, kRotation_rad);
  if (key.key == render::keyOf('Q')) twist(kRotation_rad);
  if (key.key == render::keyOf('E')) twist(-kRotation_rad);
  if (key.repeated) return;
  if (const auto request = requestOf(key)) requests_.push_back(*request);
}

/// Notch by notch, as each changes the gap; away from the user is into the picture.
void HandInput::roll(double notches) {
  const double way = notches < 0.0 ? -1.0 : 1.0;
  for (double left = std::abs(notches); left > 0.0; left -= 1.0) {
    leaving_ = way > 0.0 ? 0 : leaving_ + 1;
    const double leaving_mm = kLeavingNotch_mm * std::pow(kLeavingGrowth, std::max(leaving_ - kEvenNotches, 0));
    const double finest_mm = std::min(way > 0.0 ? kFinestNotch_mm : leaving_mm, kCoarsestNotch_mm);
    double step_mm = gap_mm_ ? std::clamp(kNotchOfGap * *gap_mm_, finest_mm, kCoarsestNotch_mm) : kCoarsestNotch_mm;
    if (shift_) step_mm *= kShiftFactor;
    step_mm *= way * std::min(left, 1.0);
    X_WT_.translation_mm += (along_tool_ ? X_WT_.rotation : glm::conjugate(view_)) * glm::dvec3(0.0, 0.0, -step_mm);
    if (gap_mm_) gap_mm_ = std::max(*gap_mm_ - step_mm, 0.0);
  }
}

void HandInput::rotate(const glm::dvec3& screen_axis, double angle_rad) {
  X_WT_.rotation = glm::normalize(glm::angleAxis(angle_rad, glm::conjugate(view_) * screen_axis) * X_WT_.rotation);
}

/// Anticlockwise as seen from the handle.
void HandInput::twist(double angle_rad) {
  if (!twisting_) return rotate({0, 0, 1}, angle_rad);
  X_WT_.rotation = glm::normalize(X_WT_.rotation * glm::angleAxis(angle_rad, glm::dvec3(0.0, 0.0, 1.0)));
}

std::vector<ControlRequest> HandInput::takeRequests() { return std::exchange(requests_, {}); }

}  // namespace app
