#include "haptics/tool/spindle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "calibration/geometry/units.h"

namespace haptics {
namespace {

constexpr double kNmms2PerGramCm2 = 1e-4;

SpindleState after(const SpindleSettings& settings, SpindleState state, bool on, double load_Nmm, double seconds,
                   double rate_Hz) {
  const auto ticks = static_cast<int>(std::lround(seconds * rate_Hz));
  for (int tick = 0; tick < ticks; ++tick) state = advanced(settings, state, on, load_Nmm, seconds / ticks);
  return state;
}

/// A motor with no bearing friction, for closed forms.
SpindleSettings smooth() {
  SpindleSettings settings;
  settings.bearing_torque_Nmm = 0.0;
  return settings;
}
double timeConstant_s(const SpindleSettings& settings) {
  return settings.inertia_g_cm2 * kNmms2PerGramCm2 * radPerSecond(settings.free_rpm) / settings.stall_torque_Nmm;
}

TEST(Spindle, RunsUpAlongItsTorqueSpeedLine) {
  const SpindleSettings settings = smooth();
  const double free = radPerSecond(settings.free_rpm), tau_s = timeConstant_s(settings);
  for (double t_s : {0.001, 0.01, 0.03}) {
    const SpindleState state = after(settings, {}, true, 0.0, t_s, 1000.0);
    ASSERT_LT(state.rad_per_s, 0.9 * radPerSecond(settings.commanded_rpm));
    EXPECT_NEAR(state.rad_per_s, free * -std::expm1(-t_s / tau_s), 1e-9 * free);
    const double angle_rad = free * (t_s + tau_s * std::expm1(-t_s / tau_s));
    EXPECT_NEAR(std::remainder(state.angle_rad - angle_rad, 2.0 * calibration::kPi), 0.0, 1e-9);
  }
}

TEST(Spindle, HoldsItsCommandedSpeed) {
  const SpindleState state = after(smooth(), {}, true, 0.0, 1.0, 1000.0);
  EXPECT_NEAR(rpmOf(state.rad_per_s), 40000.0, 1.0);
}

TEST(Spindle, GivesUpItsDroopUnderLoad) {
  // Half the torque under the governor: half of the 5 %.
  const SpindleState state = after(smooth(), {}, true, 3.0, 1.0, 1000.0);
  EXPECT_NEAR(rpmOf(state.rad_per_s), 40000.0 * (1.0 - 0.05 * 3.0 / 30.0), 1.0);
}

TEST(Spindle, FallsAlongTheLineUnderMoreThanTheGovernorHas) {
  const SpindleState state = after(smooth(), {}, true, 15.0, 1.0, 1000.0);
  EXPECT_NEAR(rpmOf(state.rad_per_s), 50000.0 * 0.5, 1.0);
}

TEST(Spindle, StallsAtItsTorqueAndRecoversAsFromRest) {
  const SpindleSettings settings = smooth();
  SpindleState state = after(settings, {}, true, 0.0, 1.0, 1000.0);
  state = after(settings, state, true, 31.0, 2.0, 1000.0);
  EXPECT_EQ(state.rad_per_s, 0.0);
  EXPECT_EQ(after(settings, state, true, 30.0, 1.0, 1000.0).rad_per_s, 0.0);
  const double free = radPerSecond(settings.free_rpm);
  EXPECT_NEAR(after(settings, state, true, 0.0, 0.01, 1000.0).rad_per_s,
              free * -std::expm1(-0.01 / timeConstant_s(settings)), 1e-9 * free);
}

TEST(Spindle, StallsInTheTimeOfTheClosedForm) {
  // Free running at w0, then load L > T: w = w_free (1 - L/T) + (w0 - ..) exp(-t/tau) on the line, 0 thereafter.
  SpindleSettings settings = smooth();
  settings.commanded_rpm = settings.free_rpm;  // no governor in the way
  settings.droop = 0.9;
  const double free = radPerSecond(settings.free_rpm), tau_s = timeConstant_s(settings), load = 60.0;
  SpindleState state;
  state.rad_per_s = 0.99 * free * 0.1;  // on the line: below where the slack governor has taken over
  const double start = state.rad_per_s, last = free * (1.0 - load / 30.0);
  const double stall_s = tau_s * std::log((start - last) / -last);
  EXPECT_GT(after(settings, state, true, load, 0.98 * stall_s, 1e5).rad_per_s, 0.0);
  EXPECT_EQ(after(settings, state, true, load, 1.02 * stall_s, 1e5).rad_per_s, 0.0);
}

TEST(Spindle, RunsDownOnItsBearingsWithThePedalUp) {
  const SpindleSettings settings;
  SpindleState state;
  state.rad_per_s = 4000.0;
  const double inertia = settings.inertia_g_cm2 * kNmms2PerGramCm2;
  const SpindleState later = after(settings, state, false, 0.0, 0.5, 1000.0);
  EXPECT_NEAR(later.rad_per_s, 4000.0 - 0.5 * settings.bearing_torque_Nmm / inertia, 1e-8);
  EXPECT_EQ(after(settings, state, false, 0.0, 2.0, 1000.0).rad_per_s, 0.0);
}

TEST(Spindle, IsOneCurveAtAnyTickRate) {
  const SpindleSettings settings;
  const auto end = [&](double rate_Hz) {
    SpindleState state = after(settings, {}, true, 0.0, 0.05, rate_Hz);
    state = after(settings, state, true, 12.0, 0.05, rate_Hz);
    state = after(settings, state, true, 45.0, 0.01, rate_Hz);
    state = after(settings, state, true, 0.0, 0.02, rate_Hz);
    return after(settings, state, false, 0.2, 0.03, rate_Hz);
  };
  const SpindleState at_1kHz = end(1000.0);
  EXPECT_GT(at_1kHz.rad_per_s, 100.0);
  for (double rate_Hz : {500.0, 4000.0, 10000.0}) {
    const SpindleState state = end(rate_Hz);
    EXPECT_NEAR(state.rad_per_s, at_1kHz.rad_per_s, 1e-8 * at_1kHz.rad_per_s) << rate_Hz;
    EXPECT_NEAR(std::remainder(state.angle_rad - at_1kHz.angle_rad, 2.0 * calibration::kPi), 0.0, 1e-7) << rate_Hz;
  }
}

TEST(Spindle, AgreesWithSmallStepsWhateverTheMotor) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int trial = 0; trial < 40; ++trial) {
    SpindleSettings settings;
    settings.commanded_rpm = 1000.0 + 60000.0 * unit(random);
    settings.free_rpm = 5000.0 + 60000.0 * unit(random);
    settings.droop = 0.02 + 0.8 * unit(random);
    settings.bearing_torque_Nmm = 2.0 * unit(random);
    SpindleState state;
    state.rad_per_s = 5000.0 * unit(random);
    const double load = 40.0 * unit(random), t_s = 0.04, wanted = radPerSecond(settings.commanded_rpm);
    double w = state.rad_per_s;
    constexpr int kSteps = 40000;
    for (int i = 0; i < kSteps; ++i) {
      const double line = 30.0 * (1.0 - w / radPerSecond(settings.free_rpm));
      const double governor = 30.0 * (wanted - w) / (settings.droop * wanted);
      const double drive = std::max(0.0, std::min(line, governor));
      w += (drive - load - settings.bearing_torque_Nmm) / (settings.inertia_g_cm2 * kNmms2PerGramCm2) * t_s / kSteps;
      w = std::max(0.0, w);
    }
    EXPECT_NEAR(advanced(settings, state, true, load, t_s).rad_per_s, w, 0.2) << trial;
  }
}

TEST(Spindle, SettlesWhereItSaysItWill) {
  SpindleSettings settings;
  for (double rpm : {40000.0, -40000.0, 5000.0, 60000.0})
    for (double load : {0.0, 1.0, 6.0, 20.0, 29.0, 40.0}) {
      settings.commanded_rpm = rpm;
      EXPECT_NEAR(after(settings, {}, true, load, 3.0, 1000.0).rad_per_s, steadySpeed_rad_per_s(settings, load), 0.01)
          << rpm << " " << load;
    }
}

TEST(Spindle, StopsBeforeItTurnsTheOtherWay) {
  SpindleSettings settings = smooth();
  settings.bearing_torque_Nmm = 5.0;
  SpindleState state;
  state.rad_per_s = -200.0;
  const double stop_s = 200.0 * settings.inertia_g_cm2 * kNmms2PerGramCm2 / 5.0;
  EXPECT_LT(advanced(settings, state, true, 0.0, 0.99 * stop_s).rad_per_s, 0.0);
  EXPECT_GT(advanced(settings, state, true, 0.0, 1.01 * stop_s).rad_per_s, 0.0);
}

TEST(Spindle, GivesThePowerOfItsLine) {
  const SpindleSettings settings;
  const double half = 0.5 * radPerSecond(settings.free_rpm);
  EXPECT_NEAR(availablePower_Nmm_per_s(settings, half), 0.5 * 30.0 * half, 1e-6);
  EXPECT_EQ(availablePower_Nmm_per_s(settings, 0.0), 0.0);
  EXPECT_EQ(availablePower_Nmm_per_s(settings, 4.0 * half), 0.0);
}

TEST(Spindle, IsFeltAsItTurnsUpToAHundredHertzAndBelowTwoHundredAndFiftyBeyond) {
  const double turn = 2.0 * calibration::kPi;
  EXPECT_NEAR(vibrationFrequency_Hz(20.0 * turn), 20.0, 1e-9);
  EXPECT_NEAR(vibrationFrequency_Hz(-99.0 * turn), 99.0, 1e-9);
  double last = 0.0;
  for (double turns_Hz = 101.0; turns_Hz < 7000.0; turns_Hz *= 1.1) {
    const double buzz_Hz = vibrationFrequency_Hz(turns_Hz * turn);
    EXPECT_GT(buzz_Hz, std::max(last, 120.0));
    EXPECT_LT(buzz_Hz, 250.0);
    last = buzz_Hz;
  }
}

TEST(Spindle, KeepsThePhaseOfTheBuzzWhileItsPitchMoves) {
  const SpindleSettings settings;
  SpindleState state;
  for (int tick = 0; tick < 200; ++tick) {
    const SpindleState next = advanced(settings, state, true, tick > 100 ? 20.0 : 0.0, 1e-3);
    const double step = std::remainder(next.vibration_phase_rad - state.vibration_phase_rad, 2.0 * calibration::kPi);
    EXPECT_LE(std::abs(step), 2.0 * calibration::kPi * 0.25 + 1e-9) << tick;
    state = next;
  }
}

TEST(Spindle, StaysFiniteWhateverItIsGiven) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  SpindleSettings bad;
  bad.commanded_rpm = nan;
  bad.inertia_g_cm2 = 0.0;
  bad.free_rpm = -3.0;
  const SpindleSettings safe = sanitised(bad);
  EXPECT_EQ(safe.commanded_rpm, 40000.0);
  for (double dt_s : {0.0, -1.0, 1e-6, 10.0, nan})
    for (double load : {0.0, -5.0, 1e9, nan}) {
      SpindleState state;
      state.rad_per_s = 300.0;
      EXPECT_TRUE(std::isfinite(advanced(safe, state, true, load, dt_s).rad_per_s));
      EXPECT_TRUE(std::isfinite(advanced(safe, state, true, load, dt_s).vibration_phase_rad));
    }
}

}  // namespace
}  // namespace haptics
