#include "app/psychophysics/probe.h"

#include <algorithm>
#include <cmath>

#include "haptics/device/simulated/virtual_hand.h"
#include "haptics/servo/servo.h"

namespace app {
namespace {

constexpr double kClearance_mm = 0.5;
constexpr int kTaps = 3, kFreePresses = 4;
constexpr double kFreeWander_mm = 1.0, kFreeSpread = 0.3;
constexpr double kHandMass_kg = 0.1;

/// Positions in the axes of the site: x, y along the surface, z outward; 0 where the bur first touches.
struct Leg {
  glm::dvec3 to_mm{0.0};
  double duration_s = 0.0;
};

void addPress(std::vector<Leg>& way, const glm::dvec2& position_mm, double reach_mm, double duration_s) {
  way.push_back({{position_mm, -reach_mm}, 0.4 * duration_s});
  way.push_back({{position_mm, -reach_mm}, 0.2 * duration_s});
  way.push_back({{position_mm, kClearance_mm}, 0.4 * duration_s});
}

std::vector<Leg> legsOf(const ProbePlan& plan, calibration::RandomGenerator& hand) {
  const glm::dvec2 place = plan.wander_mm * glm::dvec2(hand.normal(), hand.normal());
  const auto reach = [&](double spread) { return plan.reach_mm * std::max(0.2, 1.0 + spread * hand.normal()); };
  std::vector<Leg> way{{{place, kClearance_mm}, 0.0}};
  switch (plan.motion) {
    case Motion::press:
      addPress(way, place, reach(plan.spread), plan.duration_s);
      break;
    case Motion::tap:
      for (int i = 0; i < kTaps; ++i) addPress(way, place, reach(plan.spread), plan.duration_s / kTaps);
      break;
    case Motion::stroke: {
      const glm::dvec2 half{0.5 * plan.stroke_mm, 0.0};
      const double depth_mm = reach(plan.spread);
      way[0].to_mm = {place - half, kClearance_mm};
      way.push_back({{place - half, -depth_mm}, 0.25 * plan.duration_s});
      way.push_back({{place + half, -depth_mm}, 0.5 * plan.duration_s});
      way.push_back({{place + half, kClearance_mm}, 0.25 * plan.duration_s});
      break;
    }
    case Motion::free:
      for (int i = 0; i < kFreePresses; ++i) {
        const glm::dvec2 there = place + kFreeWander_mm * glm::dvec2(hand.normal(), hand.normal());
        addPress(way, there, reach(std::max(kFreeSpread, plan.spread)), plan.duration_s / kFreePresses);
      }
      break;
  }
  return way;
}

/// Minimum jerk: 10 s^3 - 15 s^4 + 6 s^5 of the path, and its rate.
double minimumJerk(double s) { return s * s * s * (10.0 + s * (-15.0 + 6.0 * s)); }
double minimumJerkRate(double s) { return 30.0 * s * s * (1.0 - s) * (1.0 - s); }

}  // namespace

std::vector<ProbeSample> probe(haptics::Bodies& bodies, const ProbeSite& site, const haptics::Command& command,
                               const ProbePlan& plan, calibration::RandomGenerator& hand) {
  const std::vector<Leg> way = legsOf(plan, hand);
  const glm::dvec3 z = site.outward_P.xyz;
  const glm::dvec3 x = glm::normalize(glm::cross(glm::abs(z.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0), z));
  const glm::dmat3 R{x, glm::cross(z, x), z};
  const glm::dvec3 touch_P = site.surface_P.mm + command.tool.head.radius_mm * z;
  haptics::Command still = command;
  still.drill_enabled = false;

  haptics::Servo servo(bodies);
  haptics::VirtualHand flesh;
  flesh.mass_kg = kHandMass_kg;
  flesh.stiffness_N_per_mm = plan.grip_N_per_mm;
  flesh.damping_Ns_per_mm = haptics::criticalDamping_Ns_per_mm(kHandMass_kg, plan.grip_N_per_mm);
  flesh.position_mm = way[0].to_mm;
  const double dt_s = 1.0 / plan.rate_Hz;
  glm::dvec3 force_N{0.0};
  std::vector<ProbeSample> samples;
  for (std::size_t leg = 1; leg < way.size(); ++leg) {
    const glm::dvec3 from = way[leg - 1].to_mm, by = way[leg].to_mm - from;
    const double duration_s = way[leg].duration_s;
    const int ticks = std::max(1, static_cast<int>(std::lround(duration_s / dt_s)));
    for (int n = 1; n <= ticks; ++n) {
      const double s = static_cast<double>(n) / ticks;
      flesh.advance(from + minimumJerk(s) * by, minimumJerkRate(s) / duration_s * by, force_N, dt_s);
      haptics::HandSample sample;
      sample.X_PT = {glm::quat_cast(R), touch_P + R * flesh.position_mm};
      sample.velocity_P_mm_per_s = {R * flesh.velocity_mm_per_s};
      const haptics::Tick tick = servo.step(sample, still, dt_s);
      force_N = glm::transpose(R) * tick.commanded_force_P_N.xyz;
      samples.push_back({-flesh.position_mm.z, force_N.z});
    }
  }
  return samples;
}

}  // namespace app
