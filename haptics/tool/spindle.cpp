#include "haptics/tool/spindle.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "calibration/geometry/units.h"

namespace haptics {
namespace {

using calibration::kPi;

/// 1 g cm2 = 1e-7 kg m2, and 1 kg m2 = 1000 N mm s2.
constexpr double kNmms2PerGramCm2 = 1e-4;

/// The motor in one direction of rotation, speeds from 0.
struct Motor {
  double commanded, free_speed, stall_torque, governor, inertia;
  double crossing;   ///< speed below which the line is the lesser of the two
  double idle_from;  ///< speed from which nothing drives

  Motor(const SpindleSettings& settings, bool on)
      : commanded(on ? radPerSecond(std::abs(settings.commanded_rpm)) : 0.0),
        free_speed(radPerSecond(settings.free_rpm)),
        stall_torque(settings.stall_torque_Nmm),
        governor(commanded > 0.0 ? stall_torque / (settings.droop * commanded) : 0.0),
        inertia(settings.inertia_g_cm2 * kNmms2PerGramCm2),
        idle_from(std::min(commanded, free_speed)) {
    // Where T (1 - w / free) = T (commanded - w) / (droop commanded); a weaker governor than the line is never active.
    const double steeper = commanded > 0.0 ? 1.0 / (settings.droop * commanded) - 1.0 / free_speed : 0.0;
    crossing = steeper > 0.0 ? std::clamp((1.0 / settings.droop - 1.0) / steeper, 0.0, idle_from) : idle_from;
  }

  /// drive = strength - slope w between `from` and `to`.
  struct Piece {
    double strength, slope, from, to;
  };
  /// The piece with w; at a boundary the one it moves into.
  Piece pieceAt(double w, bool rising) const {
    const auto below = [&](double bound) { return rising ? w < bound : w <= bound; };
    if (below(crossing) && crossing > 0.0) return {stall_torque, stall_torque / free_speed, 0.0, crossing};
    if (below(idle_from) && idle_from > 0.0) return {governor * commanded, governor, crossing, idle_from};
    return {0.0, 0.0, idle_from, HUGE_VAL};
  }
  double drive(double w) const {
    const Piece piece = pieceAt(w, true);
    return std::max(0.0, piece.strength - piece.slope * w);
  }
};

/// Speed and angle after a time within one piece.
struct Turning {
  double speed, angle;
};
Turning after(double w, double acceleration, double slope, double inertia, double t) {
  if (slope <= 0.0) return {w + acceleration * t, w * t + 0.5 * acceleration * t * t};
  const double rate = slope / inertia, change = acceleration / rate, done = -std::expm1(-rate * t);
  return {w + change * done, (w + change) * t - change * done / rate};
}

/// Time to reach a speed ahead within this piece; infinity if never.
double timeTo(double bound, double w, double acceleration, double slope, double inertia) {
  const double way = bound - w;
  if (slope <= 0.0) return acceleration == 0.0 ? HUGE_VAL : way / acceleration;
  const double rate = slope / inertia, part = way * rate / acceleration;
  return part < 1.0 ? -std::log1p(-part) / rate : HUGE_VAL;
}

/// Advances by `t` or until standstill; subtracts the time used from `t`.
Turning advancedFor(const Motor& motor, double w, double against, double& t) {
  double angle = 0.0;
  // The drive falls with the speed, so the speed is monotonic within a step: each piece at most once.
  for (int piece_count = 0; piece_count < 4 && t > 0.0; ++piece_count) {
    const double net = motor.drive(w) - against;
    if (net == 0.0 || (w <= 0.0 && net <= 0.0)) {
      angle += w * t;
      t = 0.0;
      break;
    }
    const bool rising = net > 0.0;
    const Motor::Piece piece = motor.pieceAt(w, rising);
    const double acceleration = net / motor.inertia, bound = rising ? piece.to : piece.from;
    const double until = std::isfinite(bound) ? timeTo(bound, w, acceleration, piece.slope, motor.inertia) : HUGE_VAL;
    const double step = std::min(t, until);
    const Turning next = after(w, acceleration, piece.slope, motor.inertia, step);
    angle += next.angle;
    w = until <= t ? bound : std::max(0.0, next.speed);
    t -= step;
    if (w <= 0.0 && !rising) break;
  }
  return {w, angle};
}

double wrapped(double angle_rad) {
  const double turns = angle_rad / (2.0 * kPi);
  return (turns - std::floor(turns)) * 2.0 * kPi;
}

using Row = SpindleParameter;
constexpr std::array kParameters = {
    Row{{},
        "spindle_rpm",
        "rpm",
        -400000.0,
        400000.0,
        "commanded speed; below 0 the other way round",
        valueIn<&SpindleSettings::commanded_rpm>},
    Row{{},
        "stall_torque_Nmm",
        "N mm",
        0.01,
        1000.0,
        "torque that stops the motor",
        valueIn<&SpindleSettings::stall_torque_Nmm>},
    Row{{},
        "free_rpm",
        "rpm",
        100.0,
        500000.0,
        "speed at which the motor has no torque left",
        valueIn<&SpindleSettings::free_rpm>},
    Row{{},
        "droop",
        "",
        0.001,
        0.9,
        "part of the commanded speed the governor gives up for its full torque",
        valueIn<&SpindleSettings::droop>},
    Row{{},
        "inertia_g_cm2",
        "g cm2",
        0.001,
        1000.0,
        "rotor, handpiece and bur",
        valueIn<&SpindleSettings::inertia_g_cm2>},
    Row{{},
        "bearing_torque_Nmm",
        "N mm",
        0.0,
        100.0,
        "friction that stops an idle bur",
        valueIn<&SpindleSettings::bearing_torque_Nmm>},
};

}  // namespace

double radPerSecond(double rpm) noexcept { return rpm * (2.0 * kPi / 60.0); }
double rpmOf(double rad_per_s) noexcept { return rad_per_s * (60.0 / (2.0 * kPi)); }

SpindleState advanced(const SpindleSettings& settings, const SpindleState& state, bool on, double load_Nmm,
                      double dt_s) noexcept {
  const double against = settings.bearing_torque_Nmm + (load_Nmm > 0.0 ? load_Nmm : 0.0);
  const double commanded_sense = settings.commanded_rpm < 0.0 ? -1.0 : 1.0;
  double sense = state.rad_per_s == 0.0 ? commanded_sense : std::copysign(1.0, state.rad_per_s);
  double left_s = std::isfinite(dt_s) ? std::max(0.0, dt_s) : 0.0, angle = 0.0, speed = std::abs(state.rad_per_s);
  if (!std::isfinite(speed) || !std::isfinite(against)) return {};

  // A reversed motor first runs down.
  if (sense != commanded_sense) {
    const Turning down = advancedFor(Motor(settings, false), speed, against, left_s);
    speed = down.speed;
    angle = sense * down.angle;
    if (speed <= 0.0) sense = commanded_sense;
  }
  if (sense == commanded_sense && left_s > 0.0) {
    const Turning driven = advancedFor(Motor(settings, on), speed, against, left_s);
    speed = driven.speed;
    angle += sense * driven.angle;
  }

  SpindleState next;
  next.rad_per_s = sense * speed;
  next.angle_rad = wrapped(state.angle_rad + angle);
  const double buzz_Hz = 0.5 * (vibrationFrequency_Hz(state.rad_per_s) + vibrationFrequency_Hz(next.rad_per_s));
  next.vibration_phase_rad = wrapped(state.vibration_phase_rad + 2.0 * kPi * buzz_Hz * std::max(0.0, dt_s));
  return next;
}

double steadySpeed_rad_per_s(const SpindleSettings& settings, double load_Nmm) noexcept {
  const Motor motor(settings, true);
  const double against = settings.bearing_torque_Nmm + std::max(0.0, load_Nmm);
  if (motor.commanded <= 0.0 || against >= motor.drive(0.0)) return 0.0;
  // The lower of the steady speeds of line and governor.
  const double by_line = motor.free_speed * (1.0 - against / motor.stall_torque);
  const double by_governor = motor.commanded - against / motor.governor;
  return std::copysign(std::max(0.0, std::min(by_line, by_governor)), settings.commanded_rpm);
}

double availablePower_Nmm_per_s(const SpindleSettings& settings, double rad_per_s) noexcept {
  const double speed = std::abs(rad_per_s), left = 1.0 - speed / radPerSecond(settings.free_rpm);
  return settings.stall_torque_Nmm * std::max(0.0, left) * speed;
}

double vibrationFrequency_Hz(double rad_per_s) noexcept {
  constexpr double kLiteral_Hz = 100.0, kLowest_Hz = 120.0, kHighest_Hz = 250.0;
  const double turns_Hz = std::abs(rad_per_s) / (2.0 * kPi);
  if (!(turns_Hz > kLiteral_Hz)) return turns_Hz;
  return kHighest_Hz - (kHighest_Hz - kLowest_Hz) * kLiteral_Hz / turns_Hz;
}

std::span<const SpindleParameter> spindleParameters() { return kParameters; }

SpindleSettings sanitised(const SpindleSettings& settings) {
  SpindleSettings safe = settings;
  clampToTable<kParameters>(safe);
  return safe;
}

}  // namespace haptics
