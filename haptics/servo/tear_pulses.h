// What a hand without torque feels of tissue that gives way, as short pulses of force across the axis of the tool: one
// for each 2 mJ of ligament torn, to alternate sides, up to twice as strong when more tears at once; and a crack, once,
// when a bridge of tooth breaks. One pulse at a time: what tears meanwhile is in the next one. A pulse goes out and
// back, p(u) = u^3 (1-u)^3 differentiated, so that its mean is exactly zero whatever the ticks: it moves neither the
// hand's place nor the books of energy. Source: reference/extraction 5.4 (amplitudes are our default); as short as the
// slew limit of 300 N/s allows at any rate.
// N, mJ = N mm, s; frame P. Servo thread; a few flops, no allocation, no function of libm but a square root.
#pragma once

#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"

namespace haptics {

class TearPulses {
 public:
  static constexpr double kGrain_Nmm = 2.0;                      ///< torn, for one pulse
  static constexpr double kWeakest_N = 0.2, kStrongest_N = 0.4;  ///< peak
  static constexpr double kSteps = 5.0;                          ///< grains in one pulse that make it the strongest
  static constexpr double kPulse_s = 0.010, kCrack_s = 0.024;    ///< out and back
  static constexpr double kCrack_N = 1.0;

  /// The force of this tick. `torn_Nmm` by this tick (below 0 or no number: none); `cracks`: a bridge broke;
  /// `tool_axis_P`: unit length.
  calibration::Vector<calibration::Patient> update(double torn_Nmm, bool cracks, const glm::dvec3& tool_axis_P,
                                                   double dt_s) noexcept;

 private:
  void start(double peak_N, double duration_s, const glm::dvec3& tool_axis_P) noexcept;

  double waiting_Nmm_ = 0.0;                             ///< torn, not yet felt
  double peak_N_ = 0.0, duration_s_ = 1.0, at_s_ = 1.0;  ///< of the pulse; over at duration_s_
  bool cracks_ = false;                                  ///< the pulse that is due next
  double side_ = 1.0;
  glm::dvec3 across_P_{0.0};
};

}  // namespace haptics
