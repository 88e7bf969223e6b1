#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "haptics/servo/servo.h"
#include "tests/haptics/phantom.h"

namespace haptics {
namespace {

using namespace phantom;

/// A hand that presses, slides, drills and lets go, while law, tool and stiffness are switched in its hand: the force
/// it gets, every millisecond.
std::vector<glm::dvec3> course(double rate_Hz, double& roughest_N) {
  Bodies bone = filled(6.0, 0.2, [](const glm::dvec3& p) { return p.z + 0.2 * std::sin(p.x); }).bodies(1);
  Servo servo(bone);
  Command command;
  const double dt_s = 1.0 / rate_Hz;
  const int ticks_per_ms = static_cast<int>(rate_Hz / 1000.0), ticks = 1200 * ticks_per_ms;
  std::vector<glm::dvec3> felt;
  glm::dvec3 last(0.0);
  for (int tick = 0; tick < ticks; ++tick) {
    const double t = (tick + 1) * dt_s;
    const int ms = tick / ticks_per_ms;
    if (tick % ticks_per_ms == 0) {
      if (ms == 300) ++command.serial, command.law.kind = LawKind::hertz;
      if (ms == 450) ++command.serial, command.tool.head.radius_mm = 1.4;
      if (ms == 600) ++command.serial, command.law = {}, command.law.agus.stiffness_N_per_mm = 1.6;
    }
    HandSample hand;
    const double depth = 1.4 * (0.5 - 0.5 * std::cos(std::min(t, 0.2) / 0.2 * 3.141592653589793));
    const double away = t > 1.0 ? 20.0 * (t - 1.0) : 0.0;
    hand.X_PT.translation_mm = {2.0 * std::sin(3.0 * t), 0.1, 2.2 - depth + away};
    hand.drill_pedal = t > 0.8 && t < 1.0;
    const Tick now = servo.step(hand, command, dt_s);
    roughest_N = std::max(roughest_N, glm::length(now.commanded_force_P_N.xyz - last));
    last = now.commanded_force_P_N.xyz;
    if (tick % ticks_per_ms == ticks_per_ms - 1) felt.push_back(last);
  }
  return felt;
}

TEST(ServoRate, FeelsTheSameAtOneFourAndTenKilohertz) {
  double roughest_N = 0.0, most_N = 0.0;
  const auto slow = course(1000.0, roughest_N);
  for (const glm::dvec3& force : slow) most_N = std::max(most_N, glm::length(force));
  EXPECT_GT(most_N, 1.0);
  for (double rate_Hz : {4000.0, 10'000.0}) {
    const auto fast = course(rate_Hz, roughest_N);
    ASSERT_EQ(fast.size(), slow.size());
    for (std::size_t ms = 0; ms < slow.size(); ++ms)
      ASSERT_LT(glm::length(fast[ms] - slow[ms]), 0.02 * most_N) << rate_Hz << " Hz, " << ms << " ms";
  }
}

TEST(ServoRate, SwitchesAndCutsWithoutAKnockAtAnyRate) {
  // The hand rests while law, tool, stiffness and limits change at random and the pedal goes down and up.
  std::mt19937 random(5);
  const auto any = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  for (double rate_Hz : {1000.0, 4000.0, 10'000.0}) {
    Bodies bone = filled(5.0, 0.25, [](const glm::dvec3& p) { return p.z + 0.4 * std::sin(2.0 * p.y); }).bodies(1);
    Servo servo(bone);
    Command command;
    glm::dvec3 last(0.0);
    double fastest_N_per_s = 0.0;
    const int ticks = static_cast<int>(0.6 * rate_Hz);
    for (int tick = 0; tick < ticks; ++tick) {
      if (tick % static_cast<int>(0.045 * rate_Hz) == 7) {
        ++command.serial;
        command.law.kind = kLaws[random() % 4].kind;
        command.law.agus.stiffness_N_per_mm = any(0.2, 2.0);
        command.tool.head.radius_mm = any(0.6, 2.0);
      }
      HandSample hand;
      hand.X_PT.translation_mm = {0.0, 0.1 * std::sin(20.0 * tick / rate_Hz), 0.9};
      hand.drill_pedal = tick % 1000 > 600;
      const glm::dvec3 felt = servo.step(hand, command, 1.0 / rate_Hz).commanded_force_P_N.xyz;
      fastest_N_per_s = std::max(fastest_N_per_s, glm::length(felt - last) * rate_Hz);
      last = felt;
    }
    EXPECT_LE(fastest_N_per_s, 300.0 * (1.0 + 1e-9)) << rate_Hz;
  }
}

}  // namespace
}  // namespace haptics
