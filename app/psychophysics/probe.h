// A simulated hand that probes the bone as people do to compare hardness: it taps, presses, strokes or explores on
// minimum-jerk paths (Flash & Hogan, J Neurosci 5:1688, 1985) that pull a compliant hand
// (haptics/device/simulated/virtual_hand), which the bone pushes back. Every interval runs the whole servo; the drill
// is off. Reach and position vary between probings (`spread`, `wander_mm`), seeded. Frame P, mm, s. One thread; 5 to 50
// us a tick, 1000 ticks per second of probing.
#pragma once

#include <cstdint>
#include <vector>

#include "app/psychophysics/probe_measures.h"
#include "calibration/random.h"
#include "haptics/body/bodies.h"
#include "haptics/servo/command.h"

namespace app {

enum class Motion : std::uint8_t { tap, press, stroke, free };

struct ProbePlan {
  Motion motion = Motion::press;
  double reach_mm = 1.5;       ///< intended depth of the hand below the surface
  double duration_s = 0.8;     ///< of one interval
  double stroke_mm = 4.0;      ///< path along the surface: `stroke`
  double grip_N_per_mm = 0.5;  ///< stiffness of the hand along its path
  double spread = 0.1;         ///< standard deviation of the reach between probings, relative
  double wander_mm = 0.2;      ///< standard deviation of the position along the surface
  double rate_Hz = 1000.0;
};

/// Where bone is probed: the surface point and the direction the bur comes from.
struct ProbeSite {
  calibration::Point<calibration::Patient> surface_P;
  calibration::Vector<calibration::Patient> outward_P{{0.0, 0.0, 1.0}};  ///< unit
};

/// One interval. `bone` is borrowed and not changed.
std::vector<ProbeSample> probe(haptics::Bodies& bodies, const ProbeSite& site, const haptics::Command& command,
                               const ProbePlan& plan, calibration::RandomGenerator& hand);

}  // namespace app
