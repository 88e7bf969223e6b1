#include "app/calibrate/stylus_source.h"

#include <cmath>

#include "app/text/usage_error.h"

namespace app {
namespace {

constexpr double kRate_Hz = 1000.0;
/// After this long without a tick, the wizard receives an invalid sample.
constexpr double kSilent_s = 0.15;
/// A robot's clock that fell behind does not hurry after it.
constexpr std::int64_t kMostTicks = 100, kHurriedTicks = 20;

double since_s(std::chrono::steady_clock::time_point began) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

}  // namespace

StylusSample sampleOf(const haptics::TimedHandle& handle) {
  const haptics::HandleState& state = handle.state;
  const double norm = glm::dot(state.X_DH.rotation, state.X_DH.rotation);
  StylusSample sample;
  sample.t_s = handle.t_s;
  sample.raw_rad = state.joints_rad;
  sample.X_DH = state.X_DH;
  sample.button = (state.buttons & 1U) != 0;
  sample.docked = state.docked;
  sample.valid = state.healthy && state.calibrated && std::isfinite(norm) && std::abs(norm - 1.0) < 1e-6 &&
                 std::isfinite(glm::length(state.X_DH.translation_mm));
  for (const double angle : state.joints_rad) sample.valid = sample.valid && std::isfinite(angle);
  return sample;
}

DeviceSource::DeviceSource(haptics::HapticDevice& device)
    : model_(device.capabilities().model), hand_(device, kRate_Hz) {
  hand_.start();
}

void DeviceSource::takeInto(std::vector<StylusSample>& out, const WizardView&) {
  taken_.clear();
  hand_.takeInto(taken_);
  for (const haptics::TimedHandle& handle : taken_) {
    StylusSample sample = sampleOf(handle);
    if (sample.valid && !handle.state.has_joints)
      throw UsageError(model_ + ": it does not report its joint angles, calibrate a Phantom or Touch");
    if (sample.t_s <= last_s_) continue;
    last_s_ = sample.t_s;
    out.push_back(sample);
  }
  const double now_s = since_s(began_);
  if (now_s - last_s_ < kSilent_s) return;
  StylusSample nothing;
  nothing.t_s = last_s_ = now_s;
  out.push_back(nothing);
}

PracticeSource::PracticeSource(const calibration::SyntheticRig& rig)
    : stylus_(rig, {.tip_W = {kPracticeStart_mm}}), hand_({.tip_W = {kPracticeStart_mm}}, rig.seed), device_(stylus_) {}

void PracticeSource::takeInto(std::vector<StylusSample>& out, const WizardView& view) {
  stylus_.setPose(hand_.pose(view));
  device_.takeInto(out, view);
}

void PracticeSource::take(const render::WindowEvent& event, const glm::dvec3& across_W, const glm::dvec3& up_W) {
  hand_.take(event, across_W, up_W);
}

RobotSource::RobotSource(const calibration::SyntheticRig& rig, const TechnicianSettings& habits, bool hurried)
    : rig_(rig), robot_(rig, habits, rig.seed), hurried_(hurried) {}

void RobotSource::takeInto(std::vector<StylusSample>& out, const WizardView& view) {
  const std::int64_t due = hurried_ ? ticks_ + kHurriedTicks : static_cast<std::int64_t>(since_s(began_) * kRate_Hz);
  for (std::int64_t n = 0; ticks_ < due && n < kMostTicks; ++n)
    out.push_back(robot_.next(view, static_cast<double>(++ticks_) / kRate_Hz));
  if (out.empty()) return;
  const calibration::Pose<calibration::World, calibration::Handle> X_WH = rig_.X_WD * rig_.arm.X_DH(out.back().raw_rad);
  seen_ = TrueStylus{X_WH * calibration::Point<calibration::Handle>{rig_.arm.truth.tip_H_mm},
                     {X_WH.rotation * glm::dvec3(0.0, 0.0, 1.0)}};
}

}  // namespace app
