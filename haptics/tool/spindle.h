// The motor that turns the bur: commanded speed, torque-speed line, governor, inertia, load. mm, N, s; rpm in settings.
// A step of a piecewise linear equation, solved exactly piece by piece, so every tick rate gives the same curve:
//   J dw/dt = drive(w) - T_bearing - T_load,
//   drive = min( T_stall (1 - w / w_free),  T_stall (w_commanded - w) / (droop w_commanded) ), >= 0; 0 when off.
// Loads oppose the rotation and never start it: a load beyond T_stall stalls the bur, which recovers when it is
// removed. Servo thread, one step a tick, well under a microsecond. Effect of the speed on bone: bone/erosion_step.
#pragma once

#include <span>

#include "haptics/tool/parameter_table.h"

namespace haptics {

/// Defaults: a brushless surgical motor with a straight 1:1 handpiece, 40,000 rpm and 3 N cm (data sheets, unverified);
/// rotor and bur of 1.5 g cm2 reach speed in 30 ms.
struct SpindleSettings {
  double commanded_rpm = 40000.0;  ///< about +z of T; negative: reverse
  double stall_torque_Nmm = 30.0;
  double free_rpm = 50000.0;  ///< end of the torque-speed line
  double droop = 0.05;        ///< relative speed drop at which the governor gives full torque
  double inertia_g_cm2 = 1.5;
  double bearing_torque_Nmm = 0.5;
};

struct SpindleState {
  double rad_per_s = 0.0;            ///< about +z of T
  double angle_rad = 0.0;            ///< angle of the shaft, 0..2 pi
  double vibration_phase_rad = 0.0;  ///< of the felt vibration, 0..2 pi; continuous when its frequency changes
};

/// The state `dt_s` later with the pedal down (`on`) or up, under a load torque >= 0.
SpindleState advanced(const SpindleSettings& settings, const SpindleState& state, bool on, double load_Nmm,
                      double dt_s) noexcept;

/// The steady speed under a load, signed; 0: stalled.
double steadySpeed_rad_per_s(const SpindleSettings& settings, double load_Nmm) noexcept;

/// The motor's maximum power at this speed, N mm/s = mW: its torque-speed line times the speed.
double availablePower_Nmm_per_s(const SpindleSettings& settings, double rad_per_s) noexcept;

/// Frequency of the felt vibration, Hz: the spindle's up to 100 Hz; above, where hand and servo cannot follow, 120 to
/// 250 Hz rising with the speed (reference/devices 6).
double vibrationFrequency_Hz(double rad_per_s) noexcept;

double radPerSecond(double rpm) noexcept;
double rpmOf(double rad_per_s) noexcept;

using SpindleParameter = Parameter<SpindleSettings>;
std::span<const SpindleParameter> spindleParameters();

/// Every setting clamped to its range, defaults for NaN and infinity.
SpindleSettings sanitised(const SpindleSettings& settings);

}  // namespace haptics
