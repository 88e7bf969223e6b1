#include "app/calibrate/practice_input.h"

#include <cmath>

#include "calibration/geometry/units.h"
#include "calibration/random.h"

namespace app {
namespace {

constexpr double kNotch_mm = 1.0, kTilt_rad = calibration::radFromDegrees(3.0);
/// Nearer than this a target draws the tip in.
constexpr double kDrawsIn_mm = 3.5;

glm::dvec3 errorOf(calibration::TouchPrecision precision, std::mt19937& rng) {
  return calibration::gaussianVector(rng, 1.0) *
         glm::dvec3(precision.in_plane_mm, precision.in_plane_mm, precision.along_sight_mm);
}

}  // namespace

void PracticeInput::take(const render::WindowEvent& event, const glm::dvec3& across_W, const glm::dvec3& up_W) {
  using render::Key;
  up_W_ = glm::normalize(up_W);
  towards_W_ = glm::normalize(glm::cross(across_W, up_W));
  // Seen through a mirror the picture's edges are a left-handed pair; towards the person is towards +z of W.
  if (towards_W_.z < 0.0) towards_W_ = -towards_W_;
  if (const auto* moved = std::get_if<render::PointerMoved>(&event)) {
    if (moved->button == render::MouseButton::left) hold_.tip_W.mm += moved->by_px.x * across_W - moved->by_px.y * up_W;
  } else if (const auto* wheel = std::get_if<render::WheelTurned>(&event)) {
    hold_.tip_W.mm -= kNotch_mm * wheel->notches * towards_W_;
  } else if (const auto* key = std::get_if<render::KeyPressed>(&event)) {
    if (key->key == Key::space) hold_.button = key->down;
    if (!key->down) return;
    const glm::dvec3 right_W = glm::cross(up_W_, towards_W_);
    if (key->key == Key::left) tilt(up_W_, -kTilt_rad);
    if (key->key == Key::right) tilt(up_W_, kTilt_rad);
    if (key->key == Key::up) tilt(right_W, -kTilt_rad);
    if (key->key == Key::down) tilt(right_W, kTilt_rad);
    if (key->key == render::keyOf('H') && !key->repeated) hold_.in_inkwell = !hold_.in_inkwell;
  }
}

void PracticeInput::tilt(const glm::dvec3& axis_W, double turn_rad) {
  hold_.along_W.xyz = glm::normalize(glm::angleAxis(turn_rad, axis_W) * hold_.along_W.xyz);
}

PracticePose PracticeInput::hold(const WizardView& view) {
  PracticePose held = hold_;
  const bool was_held = is_held_;
  is_held_ = false;
  for (const ShownTarget& target : view.targets) {
    if (glm::distance(target.position_W.mm, hold_.tip_W.mm) > kDrawsIn_mm) continue;
    if (!was_held || held_W_ != target.position_W.mm) {
      held_W_ = target.position_W.mm;
      off_mm_ = errorOf(view.target_kind == calibration::TargetKind::cross ? calibration::kCrossPrecision
                                                                           : calibration::kPitPrecision,
                        rng_);
    }
    is_held_ = true;
    held.tip_W.mm = held_W_ + off_mm_;
    held.steadied = view.target_kind == calibration::TargetKind::pit;
    break;
  }
  return held;
}

}  // namespace app
