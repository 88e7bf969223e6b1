// A human hand that follows a script: its target over time, tremor included, and its grip, a spring and a damper with
// the mass of the fingers behind the handle. Frame D; mm, N, s, kg. Pure; the device's thread.
#pragma once

#include <utility>

#include "haptics/device/simulated/hand_script.h"
#include "haptics/device/simulated/tremor.h"

namespace haptics {

/// A light grip on a stylus (starting values; with an Omni's 45 g about the 0.1 kg of reference/physics 2.5).
struct Grip {
  double mass_kg = 0.055;
  double stiffness_N_per_mm = 0.3;
  double damping_Ns_per_mm = 0.003;
  double tremor_rms_mm = 0.05;
};

class SimulatedHand {
 public:
  SimulatedHand(HandScript script, const Grip& grip, std::uint32_t seed)
      : script_(std::move(script)), grip_(grip), tremor_(grip.tremor_rms_mm, seed) {}

  const Grip& grip() const { return grip_; }
  HandTarget at(double t_s) const {
    HandTarget target = script_(t_s);
    if (target.grips) target.position_mm += tremor_.at(t_s);
    return target;
  }

 private:
  HandScript script_;
  Grip grip_;
  Tremor tremor_;
};

}  // namespace haptics
