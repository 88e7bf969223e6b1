#include "haptics/servo/proxy.h"

#include <gtest/gtest.h>

#include <random>

#include "calibration/geometry/units.h"
#include "tests/haptics/phantom.h"

namespace haptics {
namespace {

using namespace phantom;

constexpr double kRadius_mm = 2.0;
const LawSettings kLaw;

Proxy::State held(Proxy& proxy, const SolidField& field, const glm::dvec3& hand, double R = kRadius_mm) {
  Tool tool;
  tool.head.radius_mm = R;
  const Proxy::State now = proxy.update(field, kLaw, tool, {glm::dquat(1, 0, 0, 0), hand}, {}, 20.0);
  EXPECT_LE(now.evaluations, Proxy::kMaxEvaluations);
  return now;
}

glm::dvec3 forceAt(Proxy& proxy, const SolidField& field, const glm::dvec3& hand, double R = kRadius_mm) {
  return held(proxy, field, hand, R).force_P_N().xyz;
}

TEST(Proxy, IsTheLawAloneWhileShallow) {
  const Phantom phantom = halfSpace(4.0, 0.2);
  const SolidField field = phantom.field();
  Proxy proxy;
  for (double h : {-0.5, 0.1, 0.5, 0.9}) {
    const glm::dvec3 hand(0.3, -0.2, kRadius_mm - h);
    const Proxy::State now = held(proxy, field, hand);
    EXPECT_EQ(now.proxy_P.mm, hand);
    const Contact bare = contactOf(kLaw, {field, {}, {glm::dquat(1, 0, 0, 0), hand}, kLaw.tissue, {}});
    EXPECT_EQ(now.force_P_N().xyz, bare.force_P_N.xyz);
  }
}

TEST(Proxy, SpendsOneLookAtTheHandInSlowMotion) {
  const Phantom phantom = halfSpace(4.0, 0.2);
  Proxy proxy;
  int evaluations = 0;
  for (int tick = 0; tick < 100; ++tick)
    evaluations += held(proxy, phantom.field(), {0.01 * tick, 0.0, 1.6}).evaluations;
  EXPECT_EQ(evaluations, 100);
}

TEST(Proxy, IsStiffnessTimesDepthOverFlatBoneForAnyDepth) {
  const glm::dvec3 normal = glm::normalize(glm::dvec3(0.3, -0.4, 0.8));
  const Phantom phantom = halfSpace(7.0, 0.2, normal);
  Proxy proxy;
  for (int step = 0; step <= 700; ++step) {
    const double depth = 0.01 * step;
    const glm::dvec3 force = forceAt(proxy, phantom.field(), (kRadius_mm - depth) * normal);
    if (depth < 0.2) continue;
    EXPECT_NEAR(glm::length(force), 0.8 * depth, 0.8 * (0.005 + 0.003 * depth)) << depth;
    EXPECT_GT(glm::dot(glm::normalize(force), normal), 0.9998) << depth;
  }
}

TEST(Proxy, GoesOnWithTheSlopeOfEveryLaw) {
  const Phantom phantom = halfSpace(7.0, 0.2);
  for (const LawName& law : kLaws) {
    LawSettings settings;
    settings.kind = law.kind;
    Proxy proxy;
    double before_N = 0.0, at_N = 0.0, slope_N_per_mm = 0.0;
    for (int step = 0; step <= 400; ++step) {
      const double depth = 0.01 * step;
      const calibration::Pose<Patient, calibration::Tool> X_PT{glm::dquat(1, 0, 0, 0), {0.0, 0.0, kRadius_mm - depth}};
      const Proxy::State now = proxy.update(phantom.field(), settings, {}, X_PT, {}, 20.0);
      const double force_N = now.force_P_N().xyz.z;
      if (step == 90) before_N = force_N;
      if (step == 100) at_N = force_N, slope_N_per_mm = now.spring_N_per_mm;
      if (step > 105) {
        EXPECT_NEAR(force_N - at_N, slope_N_per_mm * (depth - 1.0), 0.02 + 0.02 * force_N) << law.key << " " << depth;
      }
    }
    EXPECT_GT(slope_N_per_mm, 0.0) << law.key;
    EXPECT_NEAR((at_N - before_N) / 0.1, slope_N_per_mm, 0.12 * slope_N_per_mm) << law.key;
  }
}

TEST(Proxy, MeetsTheLawWithoutAStep) {
  const Phantom phantom = halfSpace(7.0, 0.2, glm::normalize(glm::dvec3(0.1, 0.2, 0.9)));
  const glm::dvec3 normal = glm::normalize(glm::dvec3(0.1, 0.2, 0.9));
  Proxy proxy;
  glm::dvec3 last = forceAt(proxy, phantom.field(), (kRadius_mm - 0.8) * normal);
  for (int step = 1; step <= 800; ++step) {
    // In and out again through the depth where the proxy stops.
    const double depth = 0.8 + 0.4 * std::sin(step * 0.01);
    const glm::dvec3 force = forceAt(proxy, phantom.field(), (kRadius_mm - depth) * normal);
    EXPECT_LT(glm::length(force - last), 0.008) << depth;
    last = force;
  }
}

TEST(Proxy, SlidesAlongTheSurfaceAndNeverSticks) {
  const Phantom phantom = halfSpace(8.0, 0.2);
  Proxy proxy;
  forceAt(proxy, phantom.field(), {-4.0, 0.0, -1.0});
  for (int tick = 0; tick < 400; ++tick) {
    const glm::dvec3 hand(-4.0 + 0.02 * tick, 0.0, -1.0);
    const Proxy::State now = held(proxy, phantom.field(), hand, kRadius_mm);
    if (tick < 5) continue;
    // Straight above the hand, so the force has no drag to it.
    EXPECT_NEAR(now.proxy_P.mm.x, hand.x, 0.02);
    EXPECT_NEAR(now.proxy_P.mm.z, 1.0, 0.02);
    EXPECT_LT(std::abs(now.force_P_N().xyz.x), 0.02);
  }
}

TEST(Proxy, HoldsAtAThinPlate) {
  // 0.6 mm of bone, pushed through at 0.5 m/s and at a crawl.
  for (double R : {1.0, 2.0, 4.0})
    for (double speed_mm_per_s : {5.0, 500.0}) {
      const Phantom phantom = filled(
          R + 2.0, 0.2, [](const glm::dvec3& p) { return std::abs(p.z) - 0.3; }, glm::dvec3(0.03));
      Proxy proxy;
      const double start = R + 0.5;
      const int ticks = static_cast<int>((start + 1.0) / speed_mm_per_s * 1000.0);
      for (int tick = 0; tick <= ticks + 50; ++tick) {
        const double z = std::max(start - speed_mm_per_s * 1e-3 * tick, -1.0);
        const Proxy::State now = held(proxy, phantom.field(), {0.0, 0.0, z}, R);
        ASSERT_GT(now.proxy_P.mm.z, 0.2 * R) << "R " << R << " at " << speed_mm_per_s << " mm/s, hand at " << z;
      }
    }
}

TEST(Proxy, HoldsAFastHandBackAtTheSurface) {
  const Phantom phantom = halfSpace(6.0, 0.2);
  Proxy proxy;
  for (double z = 6.0; z > -3.0; z -= 0.5) {
    const Proxy::State now = held(proxy, phantom.field(), {0.0, 0.1 * z, z}, 1.0);
    EXPECT_GT(now.proxy_P.mm.z, 0.3);
  }
}

TEST(Proxy, GlidesToTheHandWhenTheBoneIsCutAway) {
  Phantom phantom = halfSpace(5.0, 0.2);
  Proxy proxy;
  glm::dvec3 last(0.0);
  for (int tick = 0; tick < 50; ++tick) last = forceAt(proxy, phantom.field(), {0.0, 0.0, 0.0});
  // The surface sinks by 2 micrometres a tick, as under a turning bur.
  for (int tick = 0; tick < 1200; ++tick) {
    const double level = -0.002 * tick;
    if (tick % 5 == 0) phantom = filled(5.0, 0.2, [=](const glm::dvec3& p) { return p.z - level; });
    const glm::dvec3 force = forceAt(proxy, phantom.field(), {0.0, 0.0, 0.0});
    EXPECT_LT(glm::length(force - last), 0.05);
    last = force;
  }
  EXPECT_LT(glm::length(last), 0.01);
}

TEST(Proxy, DoesNotBuzzInASlotNarrowerThanTheBur) {
  for (double tight : {0.02, 0.1, 0.3}) {
    const double half = kRadius_mm - tight;
    const Phantom phantom = filled(4.0, 0.2, [=](const glm::dvec3& p) { return half - std::abs(p.y); });
    Proxy proxy;
    glm::dvec3 last = forceAt(proxy, phantom.field(), {0.03, -0.2, 0.02});
    EXPECT_GT(last.y, 0.02);
    for (int step = 1; step <= 400; ++step) {
      const glm::dvec3 force = forceAt(proxy, phantom.field(), {0.03, -0.2 + 0.001 * step, 0.02});
      EXPECT_LT(glm::length(force - last), 0.008) << tight;
      last = force;
    }
    EXPECT_LT(last.y, -0.02);
  }
}

TEST(Proxy, StaysFiniteAndContinuousInARandomWalkThroughRandomBone) {
  std::mt19937 random(23);
  std::normal_distribution<double> step(0.0, 0.02);
  const Phantom phantom = filled(5.0, 0.25, [](const glm::dvec3& p) {
    return std::sin(1.3 * p.x) + std::sin(1.7 * p.y) + std::sin(1.1 * p.z) + 0.5;
  });
  Proxy proxy;
  glm::dvec3 hand(0.0, 0.0, 4.0);
  for (int tick = 0; tick < 5000; ++tick) {
    hand = glm::clamp(hand + glm::dvec3(step(random), step(random), step(random)), -5.0, 5.0);
    const Proxy::State now = held(proxy, phantom.field(), hand, 0.8);
    EXPECT_TRUE(std::isfinite(glm::length(now.force_P_N().xyz)));
    EXPECT_LE(glm::length(now.head.normal_P.xyz), 1.0 + 1e-12);
  }
}

/// A slender bur with its shaft along x, lying with it.
Proxy::State lying(Proxy& proxy, const SolidField& field, const glm::dvec3& hand, const Tool& tool) {
  const glm::dquat along_x = glm::angleAxis(0.5 * calibration::kPi, glm::dvec3(0, 1, 0));
  return proxy.update(field, kLaw, tool, {along_x, hand}, {}, 20.0);
}

TEST(Proxy, IsHeldByTheShaftWhereOnlyTheShaftTouches) {
  const Phantom phantom = halfSpace(11.0, 0.2);
  const Tool tool{{ShapeKind::sphere, 0.5, 0.0}, {1.2, 17.0}};
  Proxy proxy;
  for (int step = 0; step <= 300; ++step) {
    const double depth = 0.01 * step;
    const Proxy::State now = lying(proxy, phantom.field(), {-8.0, 0.0, 1.2 - depth}, tool);
    if (depth < 0.25) continue;
    // As stiff as Agus's wall at every depth; the head may begin to touch when the shaft gives way.
    EXPECT_NEAR(now.force_P_N().xyz.z, 0.8 * depth, 0.03 + 0.05 * depth) << depth;
    EXPECT_EQ(now.head.depth_mm, 0.0);
    // Pressed behind the head, the bone turns its tip down, about -y.
    EXPECT_LT(now.torque_P_Nmm().xyz.y, -2.0 * now.shaft.force_P_N.xyz.z);
  }
}

TEST(Proxy, GoesIntoTheCornerBetweenHeadAndShaftWithoutAStep) {
  // A floor at z = 0 under the head, and a step of bone beside the shaft that begins 2 mm behind the head.
  const Phantom phantom =
      filled(11.0, 0.25, [](const glm::dvec3& p) { return std::min(p.z, std::max(1.4 - p.y, -2.0 - p.x)); });
  const Tool tool{{ShapeKind::sphere, 1.0, 0.0}, {0.6, 9.0}};
  Proxy proxy;
  glm::dvec3 last = lying(proxy, phantom.field(), {-4.0, -0.6, 0.7}, tool).force_P_N().xyz;
  double sideways_N = 0.0;
  for (int tick = 1; tick <= 2000; ++tick) {
    // Down onto the floor, then sideways until the shaft is deep in the step, and back.
    const double s = 0.5 - 0.5 * std::cos(0.002 * calibration::kPi * tick);
    const glm::dvec3 hand(-4.0, -0.6 + 3.0 * s, 0.7 - 0.8 * s);
    const Proxy::State now = lying(proxy, phantom.field(), hand, tool);
    const glm::dvec3 force = now.force_P_N().xyz;
    EXPECT_LT(glm::length(force - last), 0.02) << tick;
    EXPECT_LE(now.shaft.depth_mm, 0.45) << tick;
    EXPECT_LE(now.head.depth_mm, 0.6) << tick;
    sideways_N = std::min(sideways_N, force.y);
    last = force;
  }
  EXPECT_LT(sideways_N, -0.5);
}

TEST(Proxy, ScalesALawDownToWhatTheDeviceHolds) {
  const Phantom phantom = halfSpace(4.0, 0.2);
  Proxy proxy;
  const Proxy::State now =
      proxy.update(phantom.field(), kLaw, {}, {glm::dquat(1, 0, 0, 0), {0.0, 0.0, kRadius_mm - 1.5}}, {}, 0.4);
  EXPECT_NEAR(now.force_P_N().xyz.z, 0.4 * 1.5, 0.01);
}

}  // namespace
}  // namespace haptics
