#include "app/calibrate/practice_input.h"

#include <cmath>

#include "calibration/geometry/units.h"
#include "calibration/random.h"

namespace app {
namespace {

constexpr double kNotch_mm = 1.0, kTilt_rad = calibration::radFromDegrees(3.0),
                 kTiltPerPixel_rad = calibration::radFromDegrees(0.3);
/// A target within this distance attracts the tip.
constexpr double kAttraction_mm = 3.5;
/// Frames in which a press is shown at least.
constexpr int kSeenPoses = 3;

glm::dvec3 errorOf(calibration::TouchPrecision precision, std::mt19937& rng) {
  return calibration::gaussianVector(rng, 1.0) *
         glm::dvec3(precision.in_plane_mm, precision.in_plane_mm, precision.along_sight_mm);
}

}  // namespace

void PracticeInput::take(const render::WindowEvent& event, const glm::dvec3& across_W, const glm::dvec3& up_W) {
  using render::Key;
  up_W_ = glm::normalize(up_W);
  towards_W_ = glm::normalize(glm::cross(across_W, up_W));
  // Through a mirror the edges are left-handed; the viewer is at +z of W.
  if (towards_W_.z < 0.0) towards_W_ = -towards_W_;
  if (const auto* moved = std::get_if<render::PointerMoved>(&event)) {
    if (moved->button == render::MouseButton::left) pose_.tip_W.mm += moved->by_px.x * across_W - moved->by_px.y * up_W;
    if (moved->button == render::MouseButton::middle) {
      middle_moved_ = true;
      tilt(up_W_, kTiltPerPixel_rad * moved->by_px.x);
      tilt(glm::cross(up_W_, towards_W_), kTiltPerPixel_rad * moved->by_px.y);
    }
  } else if (const auto* button = std::get_if<render::ButtonPressed>(&event)) {
    if (button->button == render::MouseButton::right) press(button->down);
    if (button->button == render::MouseButton::middle) {
      if (!button->down && !middle_moved_) pose_.in_inkwell = !pose_.in_inkwell;
      middle_moved_ = false;
    }
  } else if (const auto* wheel = std::get_if<render::WheelTurned>(&event)) {
    pose_.tip_W.mm -= kNotch_mm * wheel->notches * towards_W_;
  } else if (const auto* key = std::get_if<render::KeyPressed>(&event)) {
    if (key->key == Key::space && !key->repeated) press(key->down);
    if (!key->down) return;
    const glm::dvec3 right_W = glm::cross(up_W_, towards_W_);
    if (key->key == Key::left) tilt(up_W_, -kTilt_rad);
    if (key->key == Key::right) tilt(up_W_, kTilt_rad);
    if (key->key == Key::up) tilt(right_W, -kTilt_rad);
    if (key->key == Key::down) tilt(right_W, kTilt_rad);
    if (key->key == render::keyOf('H') && !key->repeated) pose_.in_inkwell = !pose_.in_inkwell;
  }
}

void PracticeInput::tilt(const glm::dvec3& axis_W, double angle_rad) {
  pose_.along_W.xyz = glm::normalize(glm::angleAxis(angle_rad, axis_W) * pose_.along_W.xyz);
}

/// The tap of a touchpad goes down and up between two frames: it counts all the same.
void PracticeInput::press(bool down) {
  if (down) {
    pose_.button = true;
    poses_pressed_ = 0;
  }
  release_due_ = !down && poses_pressed_ < kSeenPoses;
  if (!down && !release_due_) pose_.button = false;
}

PracticePose PracticeInput::pose(const WizardView& view) {
  if (release_due_ && poses_pressed_ >= kSeenPoses) release_due_ = pose_.button = false;
  ++poses_pressed_;
  PracticePose held = pose_;
  const bool was_held = is_held_;
  is_held_ = false;
  for (const ShownTarget& target : view.targets) {
    if (glm::distance(target.position_W.mm, pose_.tip_W.mm) > kAttraction_mm) continue;
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
