#include "haptics/device/openhaptics/hd_handle.h"

#include <algorithm>
#include <cmath>

#include "calibration/arm/phantom_models.h"

namespace haptics {
namespace {

constexpr double kHeatRate_Hz = 10.0;

/// Large enough for any property, zero if the library wrote nothing.
using Buffer = std::array<double, kHdBufferSize>;

glm::dvec3 three(const Buffer& values) { return {values[0], values[1], values[2]}; }

bool contains(std::string_view name, std::string_view word) { return name.find(word) != std::string_view::npos; }

}  // namespace

HdModel modelNamed(std::string_view name) {
  HdModel model;
  const bool is_touch_x = contains(name, "Touch X");
  model.is_omni = contains(name, "Omni") || (contains(name, "Touch") && !is_touch_x);
  model.has_inkwell = model.is_omni || is_touch_x;
  model.has_deadman = contains(name, "Desktop");
  if (model.is_omni) model.geometry = &calibration::kOmniGeometry;
  if (contains(name, "Premium 1.5")) model.geometry = &calibration::kPremium15Geometry;
  if (contains(name, "Omni")) model.arm_model = "omni";
  if (contains(name, "Touch")) model.arm_model = is_touch_x ? "desktop" : "touch";
  if (contains(name, "Desktop")) model.arm_model = "desktop";
  if (contains(name, "Premium 1.5")) model.arm_model = "premium";
  return model;
}

HdHandle::HdHandle(const HdFunctions& hd, HdErrors& errors, const HdModel& model, bool has_orientation,
                   std::optional<bool> docked_value, std::uint32_t pedal_buttons)
    : hd_(hd),
      errors_(errors),
      model_(model),
      has_orientation_(has_orientation),
      inkwell_(docked_value),
      pedal_buttons_(pedal_buttons) {
  has_.fill(true);
}

/// The first frame finds out whether the device has this part: if not, the library reports an error.
template <class Read>
bool HdHandle::readPart(Part part, Read&& read) noexcept {
  if (!has_[part]) return false;
  if (first_) errors_.drain(hd_);
  read();
  if (first_ && errors_.drain(hd_).count > 0) has_[part] = false;
  return has_[part];
}

void HdHandle::readPose(HandleState& state) noexcept {
  Buffer position{}, transform{};
  hd_.get_doublev(hd::kCurrentPosition, position.data());
  hd_.get_doublev(hd::kCurrentTransform, transform.data());
  const glm::dmat3 R(transform[0], transform[1], transform[2], transform[4], transform[5], transform[6], transform[8],
                     transform[9], transform[10]);
  const double volume = glm::determinant(R);
  const bool is_rotation = std::isfinite(volume) && std::abs(volume - 1.0) < 0.05;
  state.fresh = is_rotation && std::isfinite(glm::length(three(position)));
  if (state.fresh) {
    X_DH_.translation_mm = three(position);
    if (has_orientation_) X_DH_.rotation = glm::normalize(glm::quat_cast(R));
  }
  state.X_DH = X_DH_;

  Buffer speed{};
  const bool moves = readPart(velocity, [&] { hd_.get_doublev(hd::kCurrentVelocity, speed.data()); });
  if (moves && std::isfinite(glm::length(three(speed)))) state.velocity_D_mm_per_s.xyz = three(speed);
}

void HdHandle::readSwitches(HandleState& state, bool sure) noexcept {
  std::array<int, kHdBufferSize> pressed{};
  if (readPart(buttons, [&] { hd_.get_integerv(hd::kCurrentButtons, pressed.data()); }))
    state.buttons = static_cast<std::uint32_t>(pressed[0]) & 0xFu;
  state.pedal = (state.buttons & pedal_buttons_) != 0;

  std::array<hd::Boolean, kHdBufferSize> on{};
  if (model_.has_deadman && readPart(safety_switch, [&] { hd_.get_booleanv(hd::kCurrentSafetySwitch, on.data()); }))
    state.held = on[0] != 0;
  on = {};
  if (readPart(inkwell_switch, [&] { hd_.get_booleanv(hd::kCurrentInkwellSwitch, on.data()); }))
    state.docked = inkwell_.isDocked(on[0] != 0, state.X_DH.translation_mm, sure);
}

void HdHandle::readHeat(double rate_Hz) noexcept {
  if (--ticks_to_check_ > 0) return;
  ticks_to_check_ = static_cast<int>(rate_Hz / kHeatRate_Hz);
  Buffer motors{};
  if (!readPart(heat, [&] { hd_.get_doublev(hd::kMotorTemperature, motors.data()); })) return;
  heat_ = 0.0;
  for (std::size_t motor = 0; motor < 6; ++motor)
    if (std::isfinite(motors[motor])) heat_ = std::max(heat_, std::min(motors[motor], 1.0));
}

HandleState HdHandle::read(bool calibrated, double rate_Hz) noexcept {
  HandleState state;
  state.calibrated = calibrated;
  readPose(state);

  Buffer arm_rad{}, wrist_rad{};
  const bool has_arm = readPart(arm, [&] { hd_.get_doublev(hd::kCurrentJointAngles, arm_rad.data()); });
  const bool has_wrist = readPart(wrist, [&] { hd_.get_doublev(hd::kCurrentGimbalAngles, wrist_rad.data()); });
  const calibration::PhantomJoints joints{has_arm ? three(arm_rad) : glm::dvec3(0.0),
                                          has_wrist ? three(wrist_rad) : glm::dvec3(0.0)};
  if (has_arm && model_.geometry && std::isfinite(glm::length(joints.arm_rad)))
    state.jacobian_D_mm = calibration::armJacobian_mm(*model_.geometry, joints.arm_rad);
  for (int i = 0; i < 3; ++i) {
    state.joints_rad[static_cast<std::size_t>(i)] = joints.arm_rad[i];
    state.joints_rad[static_cast<std::size_t>(i + 3)] = joints.wrist_rad[i];
  }
  state.has_joints = has_arm && has_wrist && std::isfinite(glm::length(joints.arm_rad + joints.wrist_rad));

  readSwitches(state, calibrated && state.fresh);
  readHeat(rate_Hz);
  state.motor_heat = heat_;
  first_ = false;
  return state;
}

}  // namespace haptics
