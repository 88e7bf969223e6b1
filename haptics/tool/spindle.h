// The motor that turns the bur: commanded speed, torque-speed line, governor, inertia, load. mm, N, s; rpm where people
// set it. A pure step of a piecewise linear equation, solved exactly piece by piece, so any tick rate gives one curve:
//   J dw/dt = drive(w) - T_bearing - T_load,
//   drive = min( T_stall (1 - w / w_free),  T_stall (w_commanded - w) / (droop w_commanded) ), never below 0, 0 when
//   off.
// Loads oppose the turning and never start it: a load beyond T_stall stalls the bur, and it recovers when let go.
// Servo thread, one step a tick, well under a microsecond. Not what the speed does to bone (bone/erosion_step).
#pragma once

#include <span>

#include "haptics/tool/parameter_table.h"

namespace haptics {

/// Defaults: a brushless surgical motor with a straight 1:1 handpiece, 40,000 rpm and 3 N cm (as makers' data sheets
/// state, unverified); a rotor and bur of 1.5 g cm2 reach speed in 30 ms.
struct SpindleSettings {
  double commanded_rpm = 40000.0;  ///< about +z of T; below 0 it turns the other way
  double stall_torque_Nmm = 30.0;
  double free_rpm = 50000.0;  ///< where the torque-speed line ends
  double droop = 0.05;        ///< of the commanded speed, at which the governor gives all there is
  double inertia_g_cm2 = 1.5;
  double bearing_torque_Nmm = 0.5;
};

struct SpindleState {
  double rad_per_s = 0.0;            ///< about +z of T
  double angle_rad = 0.0;            ///< angle of the shaft, 0..2 pi
  double vibration_phase_rad = 0.0;  ///< phase of the tone the hand feels, 0..2 pi; runs on when its frequency changes
};

/// The state `dt_s` later with the pedal down (`on`) or up, under a load torque of at least 0.
SpindleState advanced(const SpindleSettings& settings, const SpindleState& state, bool on, double load_Nmm,
                      double dt_s) noexcept;

/// The speed that lasts under a load, signed; 0: stalled.
double steadySpeed_rad_per_s(const SpindleSettings& settings, double load_Nmm) noexcept;

/// The most the motor can give at this speed, N mm/s = mW: its torque-speed line times the speed.
double availablePower_Nmm_per_s(const SpindleSettings& settings, double rad_per_s) noexcept;

/// What a turning bur feels like in the hand, Hz: the spindle's own turns up to 100 Hz; above, where hand and servo can
/// not follow, 120 to 250 Hz rising with the speed (reference/devices 6).
double vibrationFrequency_Hz(double rad_per_s) noexcept;

double radPerSecond(double rpm) noexcept;
double rpmOf(double rad_per_s) noexcept;

using SpindleParameter = Parameter<SpindleSettings>;
std::span<const SpindleParameter> spindleParameters();

/// Every setting clamped to its range, defaults for NaN and infinity.
SpindleSettings sanitised(const SpindleSettings& settings);

}  // namespace haptics
