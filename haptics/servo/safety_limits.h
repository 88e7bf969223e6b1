// How much force may reach the hand and how fast it may change. Trivially copyable, part of a Command.
// Defaults: a Touch-class device, 3.3 N peak (reference/physics 4).
#pragma once

namespace haptics {

struct SafetyLimits {
  double peak_force_N = 3.3;    ///< magnitude clamp
  double slew_N_per_s = 300.0;  ///< largest change of the served force
};

}  // namespace haptics
