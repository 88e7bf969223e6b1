// What the session tells the servo: tool, law, erosion and limits, as one value that flows through Latest<Command>.
// Trivially copyable. Recorded with each change, so a replay needs nothing else. Units in the names.
// Defaults: reference/physics §6 (k_h 0.8 N/mm at 1 kHz) and a Touch-class device (3.3 N peak).
#pragma once

#include <array>
#include <cstdint>

#include "assets/tissue.h"

namespace haptics {

struct AgusParameters {
  double stiffness_N_per_mm = 0.8;      ///< F = k h
  double damping_Ns_per_mm = 0.0;       ///< F -= b v while in contact; b >= 0
};

struct ErosionParameters {
  double removal_rate_per_s = 4.0;      ///< fraction of a fully covered voxel of reference tissue per second
  std::array<double, assets::kTissueCount> tissue_factor = [] {
    std::array<double, assets::kTissueCount> f{};
    for (std::size_t i = 0; i < f.size(); ++i) f[i] = assets::kTissues[i].removal_factor;
    return f;
  }();
};

struct SafetyLimits {
  double peak_force_N = 3.3;            ///< magnitude clamp
  double slew_N_per_s = 300.0;          ///< largest change of the served force
};

struct Command {
  std::uint64_t serial = 0;             ///< rises by one with every change
  double bur_radius_mm = 2.0;           ///< felt, cut and drawn
  bool drill_enabled = true;            ///< false: the pedal does nothing
  AgusParameters agus;
  ErosionParameters erosion;
  SafetyLimits safety;
};

}  // namespace haptics
