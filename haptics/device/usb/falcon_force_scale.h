// The scale from torque to the Falcon's motor words: word = -words_per_Nmm * torque. It is not published: public code
// sends -10000 words per N m and calls its own limit arbitrary. Until a unit has been measured with a balance its force
// counts as uncalibrated and its motors get a tenth of their range at most, about 1 N whatever the true scale is. N,
// mm; plain values, any thread. Source: libnifalcon/libnifalcon, FalconKinematicStamper.cpp (facts;
// reference/devices 3.2); 8 N: reference/product.
#pragma once

#include <span>
#include <string>

#include "haptics/wrench.h"

namespace haptics {

struct FalconForceScale {
  double words_per_Nmm = 10.0;  ///< positive; public code's guess
  double max_weighed_N = 0.0;   ///< largest force measured; 0: never measured
  std::string serial;           ///< of the measured unit; empty: not known

  bool isWeighed() const { return max_weighed_N > 0.0; }
};

/// One reading: the requested force, and what the balance showed along it.
struct ForceReading {
  double asked_N = 0.0, shown_N = 0.0;
};

/// The scale with which the readings, taken with `used`, would have been right. Throws DeviceError for fewer than three
/// readings, a wrong sign, or readings more than 15 % of the largest off one line.
FalconForceScale weighed(const FalconForceScale& used, std::span<const ForceReading> readings);

/// Throws DeviceError unless it has 2 to 50 words per N mm and 0.2 to 10 N measured.
void check(const FalconForceScale& scale);

/// Before measuring 1 N, then three times the largest force measured, at most 8 N.
double falconPeakForce_N(const FalconForceScale& scale);
int falconMaxWord(const FalconForceScale& scale);
double falconPeakTorque_Nmm(const FalconForceScale& scale);

/// The next step for its owner, one sentence; empty once it is measured.
std::string falconForceAdvice(const FalconForceScale& scale);

}  // namespace haptics
