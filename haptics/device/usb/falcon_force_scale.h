// How the Falcon's motor words are made of torques, and how far that may be trusted: word = -words_per_Nmm * torque.
// Nobody has published the scale: public code sends -10000 words per N m and calls its own limit arbitrary. Until a
// unit has been weighed on a spring scale its force is not calibrated and its motors get at most a tenth of their
// range: whatever the true scale is, a tenth of what the unit can do, around 1 N. N, mm; plain numbers, any thread. The
// file that keeps a weighing is read and written where files are known. Source: libnifalcon/libnifalcon,
// FalconKinematicStamper.cpp (facts; reference/devices 3.2); 8 N: reference/product.
#pragma once

#include <span>
#include <string>

#include "haptics/wrench.h"

namespace haptics {

struct FalconForceScale {
  double words_per_Nmm = 10.0;  ///< positive; public code's guess
  double max_weighed_N = 0.0;   ///< the largest force that a scale has confirmed; 0: never weighed
  std::string serial;           ///< of the unit that was weighed; empty: not known

  bool isWeighed() const { return max_weighed_N > 0.0; }
};

/// One reading: what the program asked for, and what the scale showed along it.
struct FalconWeighing {
  double asked_N = 0.0, shown_N = 0.0;
};

/// The scale with which the readings, taken with `used`, would have shown what was asked. Throws DeviceError with fewer
/// than three, with a sign that is wrong, or when they lie more than 15 % of the largest off one line.
FalconForceScale weighed(const FalconForceScale& used, std::span<const FalconWeighing> readings);

/// Throws DeviceError when a number of it is not believable: 2 to 50 words per N mm, 0.2 to 10 N weighed.
void check(const FalconForceScale& scale);

/// What it allows: a tenth of the motors' range before weighing, then three times what was weighed, never above 8 N.
double falconPeakForce_N(const FalconForceScale& scale);
int falconMaxWord(const FalconForceScale& scale);
double falconPeakTorque_Nmm(const FalconForceScale& scale);

/// The next step for its owner, one sentence; empty once it is weighed.
std::string falconForceAdvice(const FalconForceScale& scale);

}  // namespace haptics
