#include "haptics/device/simulated/led_hand.h"

#include <algorithm>

namespace haptics {
namespace {

constexpr double kBraced_N_per_mm = 2.0;            // on a finger rest; our default
constexpr double kSlows_mm = 0.3, kStops_mm = 0.8;  // behind its path
constexpr double kSlowest = 0.05;                   // of the path's pace: what gives way in the end is not waited for

}  // namespace

LedHand::LedHand(const HandTarget& rest) : target_(rest) {
  target_.pedal = false;
  hand_.stiffness_N_per_mm = kBraced_N_per_mm;
  hand_.damping_Ns_per_mm = criticalDamping_Ns_per_mm(hand_.mass_kg, kBraced_N_per_mm);
  hand_.position_mm = rest.position_mm;
  capabilities_.model = "led hand";
  capabilities_.damping_Ns_per_mm = hand_.totalDamping_Ns_per_mm();
}

/// Held up, it goes on slowly.
double LedHand::pace() const noexcept {
  const double patient_mm = path_ != nullptr ? path_->patient_mm : 0.0;
  const double behind_mm = glm::distance(hand_.position_mm, target_.position_mm) - patient_mm;
  return std::clamp((kStops_mm - behind_mm) / (kStops_mm - kSlows_mm), kSlowest, 1.0);
}

HandleState LedHand::exchange(const Wrench<calibration::Device>& wrench_D, double dt_s) noexcept {
  if (const LedPath* const wanted = wanted_.load(std::memory_order_acquire); wanted != path_) {
    path_ = wanted;
    t_s_ = 0.0;
    // It begins where it says, not with a leap from the end of the former.
    target_ = path_->script(0.0);
  }
  const HandTarget from = target_;
  if (path_ != nullptr) {
    t_s_ += pace() * dt_s;
    target_ = path_->script(t_s_);
    if (t_s_ >= path_->duration_s) arrived_.store(path_, std::memory_order_release);
  }
  return hand_.follow(from, target_, wrench_D, dt_s);
}

}  // namespace haptics
