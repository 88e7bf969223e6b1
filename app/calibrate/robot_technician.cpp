#include "app/calibrate/robot_technician.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "app/calibrate/button_press.h"
#include "calibration/arm/phantom_models.h"

namespace app {
namespace {

constexpr double kReads_s = 0.15;   // before an answer
constexpr double kSettles_s = 0.5;  // at a target before a press
constexpr double kShort_s = 0.15, kLong_s = ButtonPress::kLong_s + 0.1;
constexpr double kAgain_s = 1.2;  // before a press is repeated
constexpr double kTremor_Hz = 9.0;
constexpr double kDockedTurn_deg = -20.0;
constexpr int kHolds = 40;

/// 0 to 1, at rest at both ends.
double eased(double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  return s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
}

}  // namespace

RobotTechnician::RobotTechnician(const calibration::SyntheticRig& rig, const TechnicianSettings& habits,
                                 std::uint32_t seed)
    : rig_(rig), settings_(habits), rng_(seed) {
  rng_.discard(1000);
}

StylusSample RobotTechnician::next(const WizardView& view, double t_s) {
  decide(view, t_s);
  StylusSample sample;
  sample.t_s = t_s;
  sample.valid = true;
  sample.docked = docked_ && t_s - start_s_ >= settings_.move_s;
  const double gone = eased((t_s - start_s_) / settings_.move_s);
  for (std::size_t i = 0; i < 6; ++i) sample.raw_rad[i] = from_rad_[i] + gone * (to_rad_[i] - from_rad_[i]);
  // Tremor, except in the inkwell.
  const double reach_mm = rig_.arm.geometry.thigh_mm;
  if (!sample.docked && gone >= 1.0 && reach_mm > 0.0)
    sample.raw_rad[0] += settings_.tremor_mm / reach_mm * std::sin(2.0 * calibration::kPi * kTremor_Hz * t_s);
  sample.X_DH = calibration::handlePose(rig_.arm.geometry, {}, sample.raw_rad);
  sample.button = press_from_s_ && t_s >= *press_from_s_ && t_s < *press_to_s_;
  return sample;
}

void RobotTechnician::decide(const WizardView& view, double t_s) {
  std::size_t target = view.targets.size();
  for (std::size_t i = 0; i < view.targets.size(); ++i)
    if (view.targets[i].state == TargetState::next) target = i;
  if (target < view.targets.size() && settings_.reversed) target = view.targets.size() - 1 - target;
  std::string seen = view.title + "|" + view.count + "|" + view.value + "|" + std::to_string(target) + "|" +
                     (view.marked ? view.choices[*view.marked] : "") + "|" + (view.inkwell ? "home" : "");
  const bool is_new = seen != seen_;
  if (is_new) {
    seen_ = std::move(seen);
    read_s_ = t_s;
    presses_here_ = 0;
    if (view.inkwell && !docked_) {
      goTo({0.0, 0.55, 0.45, 0.0, calibration::radFromDegrees(kDockedTurn_deg), 0.0}, t_s);
      docked_ = true;
    } else if (!view.inkwell && docked_) {
      docked_ = false;
      goTo({0.1, 0.6, 0.3, 0.0, 0.0, 0.0}, t_s);
    }
    if (view.choices.empty() && target < view.targets.size()) goToTarget(view, target, t_s);
  }
  if (press_to_s_ && t_s < *press_to_s_ + kReads_s) return;
  if (t_s - read_s_ < kReads_s) return;

  // Choices: step to the wanted one, then choose.
  if (view.marked) {
    const auto want = wanted(view);
    if (press_to_s_ && presses_here_ > 0 && t_s - *press_to_s_ < kAgain_s) return;
    press(t_s, want && *want == *view.marked ? kLong_s : kShort_s);
    return;
  }
  // A target: settle, then press or wait.
  if (target >= view.targets.size() || !view.choices.empty()) return;
  const bool arrived = t_s - start_s_ > settings_.move_s + kSettles_s;
  if (!arrived || (!settings_.presses && presses_here_ == 0 && t_s - start_s_ < settings_.move_s + 2.0)) return;
  if (press_to_s_ && presses_here_ > 0 && t_s - *press_to_s_ < kAgain_s) return;
  // A rejected touch is repeated.
  if (presses_here_ > 0) {
    presses_here_ = 0;
    goToTarget(view, target, t_s);
    return;
  }
  press(t_s, kShort_s);
}

std::optional<std::size_t> RobotTechnician::wanted(const WizardView& view) const {
  const auto choice = [&](const std::string& words) -> std::optional<std::size_t> {
    for (std::size_t i = 0; i < view.choices.size(); ++i)
      if (!words.empty() && view.choices[i].starts_with(words)) return i;
    return std::nullopt;
  };
  if (!view.value.empty()) {
    const double shown = std::strtod(view.value.c_str(), nullptr);
    double want = settings_.bar_mm;
    if (view.title.find("pupils") != std::string::npos) want = settings_.ipd_mm;
    if (view.title.find("eye") != std::string::npos) want = settings_.distance_mm;
    return shown < want ? 0 : shown > want ? 1 : 2;
  }
  if (view.figure == WizardFigure::letter_f)
    if (const auto i = choice(settings_.flip)) return i;
  if (view.figure == WizardFigure::letter_f && settings_.flip != "yes")
    if (const auto i = choice("no")) return i;
  if (view.verdict) {
    if (const auto i = choice(settings_.final_choice)) return i;
    if (const auto i = choice("done")) return i;
    return choice("leave");
  }
  if (const auto i = choice("go on"))
    return settings_.repeats_doubtful && view.marked == 1 && choice("touch the worst") ? 1 : *i;
  return view.marked ? std::optional<std::size_t>(0) : std::nullopt;
}

void RobotTechnician::press(double t_s, double seconds) {
  ++presses_here_;
  press_from_s_ = t_s;
  press_to_s_ = t_s + seconds;
}

void RobotTechnician::goTo(const calibration::RawJoints& raw_rad, double t_s) {
  const double gone = has_moved_ ? eased((t_s - start_s_) / settings_.move_s) : 1.0;
  for (std::size_t i = 0; i < 6; ++i) from_rad_[i] += gone * (to_rad_[i] - from_rad_[i]);
  if (!has_moved_) from_rad_ = raw_rad;
  has_moved_ = true;
  to_rad_ = raw_rad;
  start_s_ = t_s;
}

void RobotTechnician::goToTarget(const WizardView& view, std::size_t target, double t_s) {
  calibration::Target target_W{static_cast<int>(target) + 1, view.targets[target].position_W,
                               view.targets[target].stylus_W};
  // If the tilt is out of reach, approach the resting tilt until it is.
  for (int n = 0; n < kHolds; ++n) {
    if (const auto touch = calibration::simulatedTouch(rig_, target_W, rng_)) return goTo(touch->joints_rad, t_s);
    target_W.stylus_W.xyz = glm::normalize(0.9 * target_W.stylus_W.xyz + 0.1 * calibration::kRestingStylus_W.xyz);
  }
}

}  // namespace app
