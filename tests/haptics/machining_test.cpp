#include "haptics/contact/machining.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#define GLM_ENABLE_EXPERIMENTAL
#include <glm/gtx/quaternion.hpp>

#include "calibration/geometry/units.h"
#include "haptics/contact/sliding.h"
#include "haptics/tool/spindle.h"
#include "tests/haptics/phantom.h"

namespace haptics {
namespace {

using namespace phantom;
using calibration::kPi;
using calibration::Tool;

const double k40krpm = radPerSecond(40000.0);

/// Spindle along `axis_P`, some way round it.
glm::dquat spindleAlong(const glm::dvec3& axis_P) { return glm::rotation(glm::dvec3(0, 0, 1), glm::normalize(axis_P)); }

/// A bur in flat bone; `at()` borrows from it.
struct Case {
  explicit Case(const Phantom& bone, double radius = 1.0, double depth = 0.5, glm::dvec3 axis = {1.0, 0.0, 0.0},
                glm::dvec3 velocity = glm::dvec3(0.0), double spindle = k40krpm)
      : field(bone.field()),
        radius_mm(radius),
        depth_mm(depth),
        axis_P(axis),
        velocity_P(velocity),
        spindle_rad_per_s(spindle) {}

  SolidField field;
  double radius_mm, depth_mm;
  glm::dvec3 axis_P, velocity_P;
  double spindle_rad_per_s;
  TissueStiffness tissue{};

  ToolInBone at() const {
    const calibration::Pose<Patient, Tool> X_PT{spindleAlong(axis_P), {0.013, -0.021, radius_mm - depth_mm}};
    ToolMotion motion;
    motion.velocity_P_mm_per_s = {velocity_P};
    motion.spindle_rad_per_s = spindle_rad_per_s;
    return {field, {ShapeKind::sphere, radius_mm, 0.0}, X_PT, tissue, motion};
  }
};

double plunge_mm3(double R, double h) { return kPi * h * (2.0 * R - h); }
double lateral_mm3(double R, double h) {
  return R * R * std::acos(1.0 - h / R) - (R - h) * std::sqrt(2.0 * R * h - h * h);
}
MachiningParameters chipsOnly() {
  MachiningParameters parameters;
  parameters.edge_tangential_N_per_mm = parameters.edge_radial_N_per_mm = 0.0;
  return parameters;
}

TEST(Machining, SweepsWhatTheFeedSweeps) {
  const Phantom bone = halfSpace(2.6, 0.1);
  for (double h : {0.2, 0.5, 1.0}) {
    const double R = 2.0;
    EXPECT_NEAR(sweptRate_mm3_per_s(Case(bone, R, h, {1, 0, 0}, {0, 0, -3.0}).at()) / (3.0 * plunge_mm3(R, h)), 1.0,
                0.01)
        << h;
    EXPECT_NEAR(sweptRate_mm3_per_s(Case(bone, R, h, {1, 0, 0}, {3.0, 0, 0}).at()) / (3.0 * lateral_mm3(R, h)), 1.0,
                0.01)
        << h;
  }
  EXPECT_EQ(sweptRate_mm3_per_s(Case(bone, 2.0, 0.5, {1, 0, 0}, {0, 0, 3.0}).at()), 0.0);
}

TEST(Machining, SpendsTheCuttingEnergyOnEveryCubicMillimetre) {
  const Phantom bone = halfSpace(1.8, 0.05);
  const MachiningParameters parameters = chipsOnly();
  for (double h : {0.1, 0.3, 0.5})
    for (const glm::dvec3 axis : {glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1), glm::dvec3(0.5, 0.3, 0.8)})
      for (const glm::dvec3 feed : {glm::dvec3(0, 0, -1), glm::dvec3(1, 0, 0)}) {
        const Case test(bone, 1.0, h, axis, feed);
        const ToolInBone at = test.at();
        const double power_Nmm_per_s = spindleTorque_Nmm(machiningContact(parameters, at), at) * k40krpm;
        const double swept = feed.z < 0.0 ? plunge_mm3(1.0, h) : lateral_mm3(1.0, h);
        EXPECT_NEAR(power_Nmm_per_s / (parameters.chip_tangential_N_per_mm2 * swept), 1.0, 0.02)
            << h << " axis " << axis.x << axis.y << axis.z << " feed " << feed.x << feed.z;
      }
}

TEST(Machining, PressesWithTwoNewtonsWhereItIsCalibrated) {
  const Phantom bone = halfSpace(1.8, 0.05);
  const Contact contact = machiningContact({}, Case(bone, 1.0, 0.5, {1, 0, 0}, {0, 0, -1.0}).at());
  EXPECT_NEAR(glm::length(contact.force_P_N.xyz), 2.0, 0.1);
}

TEST(Machining, TurnsTheTangentialPartAloneWhenTheSpindleTurnsTheOtherWay) {
  const Phantom bone = halfSpace(1.8, 0.1);
  const Case forwards(bone, 1.0, 0.4, {1, 0, 0}, {0.3, 0.2, -1.0});
  Case backwards = forwards;
  backwards.spindle_rad_per_s = -forwards.spindle_rad_per_s;
  MachiningParameters radial;
  radial.chip_tangential_N_per_mm2 = radial.edge_tangential_N_per_mm = 0.0;
  const auto force = [](const MachiningParameters& parameters, const Case& test) {
    return machiningContact(parameters, test.at()).force_P_N.xyz;
  };
  const glm::dvec3 without = force(radial, forwards);
  EXPECT_LT(glm::length(force(radial, backwards) - without), 1e-12);
  const glm::dvec3 one = force({}, forwards) - without, other = force({}, backwards) - without;
  EXPECT_LT(glm::length(one + other), 1e-12);
  EXPECT_GT(glm::length(one), 0.1);
}

TEST(Machining, PullsAgainstTheFlutesMotion) {
  // Spindle along +x over bone below: the lowest point moves along +y (w x r = x cross -z), so the bur is pushed to -y.
  const Phantom bone = halfSpace(1.8, 0.1);
  const Contact contact = machiningContact({}, Case(bone, 1.0, 0.4, {1, 0, 0}, {0, 0, 0}).at());
  EXPECT_LT(contact.force_P_N.xyz.y, -0.1);
  EXPECT_GT(contact.force_P_N.xyz.z, 0.5);
}

TEST(Machining, IsAWallWhereItDoesNotTurn) {
  const Phantom bone = halfSpace(1.8, 0.05);
  const MachiningParameters parameters;
  for (double h : {0.1, 0.25, 0.5}) {
    const Contact contact = machiningContact(parameters, Case(bone, 1.0, h, {1, 0, 0}, {0, 0, -5.0}, 0.0).at());
    // -k_s grad V of a cap, k_s = N K_re / (2 pi R).
    const double wall_N = parameters.flutes * parameters.edge_radial_N_per_mm * h * (2.0 - h) / 2.0;
    EXPECT_NEAR(contact.force_P_N.xyz.z / wall_N, 1.0, 0.01) << h;
    EXPECT_LT(std::hypot(contact.force_P_N.xyz.x, contact.force_P_N.xyz.y), 0.005 * wall_N);
    EXPECT_NEAR(contact.stiffness_N_per_mm, parameters.flutes * parameters.edge_radial_N_per_mm * (1.0 - h), 0.05);
    EXPECT_EQ(contact.vibration_P_N.xyz, glm::dvec3(0.0));
  }
}

/// Hand work round a closed square path over an edge of the block, and the work's absolute sum.
std::pair<double, double> loopWork(const Phantom& bone, const MachiningParameters& parameters, double spindle) {
  constexpr int kSteps = 100;
  const glm::dvec3 corners[] = {{0.0, 0.0, 0.55}, {1.2, 0.0, 0.55}, {1.2, 0.0, 0.85}, {0.0, 0.0, 0.85}};
  const SolidField field = bone.field();
  double work = 0.0, effort = 0.0;
  for (int side = 0; side < 4; ++side)
    for (int i = 0; i < kSteps; ++i) {
      const glm::dvec3 step = (corners[(side + 1) % 4] - corners[side]) / static_cast<double>(kSteps);
      const TissueStiffness tissue;
      ToolMotion motion;
      motion.spindle_rad_per_s = spindle;
      const calibration::Pose<Patient, Tool> X_PT{spindleAlong({0, 1, 0}), corners[side] + (i + 0.5) * step};
      const Contact contact =
          machiningContact(parameters, {field, {ShapeKind::sphere, 1.0, 0.0}, X_PT, tissue, motion});
      work += glm::dot(contact.force_P_N.xyz, step);
      effort += std::abs(glm::dot(contact.force_P_N.xyz, step));
    }
  return {work, effort};
}

TEST(Machining, GivesNoWorkRoundAnEdgeWhereItDoesNotTurn) {
  // Bone below z = 0 up to x = 0.6: a right-angled edge.
  const Phantom bone = filled(2.6, 0.1, [](const glm::dvec3& p) { return std::max(p.z, p.x - 0.6); });
  const auto [work, effort] = loopWork(bone, {}, 0.0);
  EXPECT_LT(std::abs(work), 0.005 * effort);
}

TEST(Machining, TakesOverFromTheWallWithoutAStep) {
  const Phantom bone = halfSpace(1.8, 0.1);
  double last = -1.0;
  for (double rpm = 0.0; rpm <= 1500.0; rpm += 10.0) {
    const double force =
        machiningContact({}, Case(bone, 1.0, 0.4, {1, 0, 0}, {0, 0, -1.0}, radPerSecond(rpm)).at()).force_P_N.xyz.z;
    if (last >= 0.0) {
      EXPECT_NEAR(force, last, 0.05) << rpm;
    }
    last = force;
  }
}

TEST(Machining, TellsItsSlopeToTheProxy) {
  const Phantom bone = halfSpace(2.6, 0.1);
  for (double h : {0.3, 0.6}) {
    const auto at = [&](double depth) { return machiningContact({}, Case(bone, 1.5, depth).at()); };
    const double slope = (at(h + 0.05).force_P_N.xyz.z - at(h - 0.05).force_P_N.xyz.z) / 0.1;
    EXPECT_NEAR(at(h).stiffness_N_per_mm / slope, 1.0, 0.05) << h;
  }
}

TEST(Machining, PressesHarderWhenWornAndSofterInSofterTissue) {
  const Phantom bone = halfSpace(1.8, 0.1);
  const Case test(bone, 1.0, 0.4);
  const double fresh = glm::length(machiningContact({}, test.at()).force_P_N.xyz);
  MachiningParameters worn;
  worn.worn = 1.0;
  EXPECT_NEAR(glm::length(machiningContact(worn, test.at()).force_P_N.xyz) / fresh, 3.0, 1e-9);
  Case soft = test;
  soft.tissue.factor[0] = 0.4;
  EXPECT_NEAR(glm::length(machiningContact({}, soft.at()).force_P_N.xyz) / fresh, 0.4, 1e-9);
}

TEST(Machining, VibratesNoHarderThanTheHandAndTheDeviceCanTake) {
  const Phantom bone = halfSpace(1.8, 0.1);
  MachiningParameters parameters;
  for (double share : {0.02, 0.1, 5.0}) {
    parameters.vibration_share = share;
    parameters.edge_radial_N_per_mm = share * 3.0;
    glm::dvec3 mean(0.0);
    for (int n = 0; n < 8; ++n) {
      const Case test(bone, 1.0, 0.4);
      ToolInBone at = test.at();
      at.motion.vibration_phase_rad = n * kPi / 4.0;
      const Contact contact = machiningContact(parameters, at);
      const double amplitude = glm::length(contact.vibration_P_N.xyz), force = glm::length(contact.force_P_N.xyz);
      EXPECT_NEAR(amplitude, std::min(0.3, std::min(share, 0.1) * force), 1e-12);
      EXPECT_NEAR(glm::dot(contact.vibration_P_N.xyz, glm::dvec3(1, 0, 0)), 0.0, 1e-12);
      mean += contact.vibration_P_N.xyz / 8.0;
    }
    EXPECT_LT(glm::length(mean), 1e-12);
  }
}

TEST(Machining, KnowsOtherHeads) {
  // Lying on flat bone, 0.4 mm deep: the side's strip, of half angle acos(1 - h/R), swept down and along.
  const double R = 1.0, h = 0.4, L = 3.0, half_width = std::sqrt(h * (2.0 * R - h));
  const Phantom bone = halfSpace(3.2, 0.1);
  const SolidField field = bone.field();
  const TissueStiffness tissue;
  for (ShapeKind kind : {ShapeKind::cylinder, ShapeKind::capsule}) {
    ToolMotion motion;
    motion.velocity_P_mm_per_s = {{0.0, 0.0, -2.0}};
    motion.spindle_rad_per_s = k40krpm;
    const calibration::Pose<Patient, Tool> X_PT{spindleAlong({1, 0, 0}), {0.013, -0.021, R - h}};
    const ToolInBone at{field, {kind, R, L}, X_PT, tissue, motion};
    const double ends = kind == ShapeKind::capsule ? plunge_mm3(R, h) : 0.0;
    const double swept = 2.0 * (2.0 * half_width * L + ends);
    EXPECT_NEAR(sweptRate_mm3_per_s(at) / swept, 1.0, 0.03);
    const MachiningParameters parameters = chipsOnly();
    const double power_Nmm_per_s = spindleTorque_Nmm(machiningContact(parameters, at), at) * k40krpm;
    EXPECT_NEAR(power_Nmm_per_s / (parameters.chip_tangential_N_per_mm2 * swept), 1.0, 0.03);
  }
}

/// A stationary bur is pressed in and drawn out again while it turns; what it overlaps goes at the swept rate.
TEST(Machining, ClosesItsEnergy) {
  // Spindle and hand together put in what chips and edges take: T w + F.v = K_tc MRR + edge drag, at every moment of a
  // press and its release; the hand's share is small beside the spindle's and never negative on the way in.
  const Phantom bone = halfSpace(2.2, 0.1);
  MachiningParameters edges;
  edges.chip_tangential_N_per_mm2 = edges.chip_radial_N_per_mm2 = 0.0;
  const MachiningParameters all;
  double spindle_mJ = 0.0, hand_mJ = 0.0, chips_mJ = 0.0, edge_mJ = 0.0;
  constexpr double kStep_s = 0.01;
  for (int tick = 0; tick < 100; ++tick) {
    const double way = tick < 50 ? -1.0 : 1.0, depth = 0.5 * (tick < 50 ? tick + 0.5 : 99.5 - tick) / 50.0;
    const Case test(bone, 1.0, depth, {1, 0, 0}, {0, 0, way});
    const ToolInBone at = test.at();
    const Contact contact = machiningContact(all, at);
    spindle_mJ += spindleTorque_Nmm(contact, at) * k40krpm * kStep_s;
    hand_mJ -= glm::dot(contact.force_P_N.xyz, test.velocity_P) * kStep_s;
    chips_mJ += all.chip_tangential_N_per_mm2 * sweptRate_mm3_per_s(at) * kStep_s;
    edge_mJ += spindleTorque_Nmm(machiningContact(edges, at), at) * k40krpm * kStep_s;
  }
  EXPECT_NEAR(spindle_mJ / (chips_mJ + edge_mJ), 1.0, 0.02);
  EXPECT_GT(hand_mJ, 0.0);
  EXPECT_LT(hand_mJ, 1e-3 * spindle_mJ);
}

TEST(Machining, KnowsNothingOfThinAir) {
  const Phantom bone = halfSpace(1.8, 0.1);
  const Contact contact = machiningContact({}, Case(bone, 1.0, -0.3).at());
  EXPECT_EQ(contact.force_P_N.xyz, glm::dvec3(0.0));
  const Case test(bone, 1.0, 0.4);
  ToolInBone lost = test.at();
  lost.X_PT.translation_mm.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(machiningContact({}, lost).force_P_N.xyz, glm::dvec3(0.0));
  EXPECT_EQ(sweptRate_mm3_per_s(lost), 0.0);
}

TEST(Sliding, IsTheRimOfASidewaysBurAtFirstTouch) {
  const BurShape ball{ShapeKind::sphere, 2.0, 0.0};
  for (double sine : {0.2, 0.7, 1.0}) EXPECT_NEAR(slidingArm_mm(ball, 1e-6, sine), 2.0 * sine, 1e-5);
}

TEST(Sliding, IsHertzsMeanRadiusUnderTheTip) {
  // int x^2 sqrt(1 - x^2) / int x sqrt(1 - x^2) = 3 pi / 16 of the contact's radius.
  const double h = 0.3, rim = std::sqrt(h * (4.0 - h));
  EXPECT_NEAR(slidingArm_mm({ShapeKind::sphere, 2.0, 0.0}, h, 0.0), 3.0 * kPi / 16.0 * rim, 0.002 * rim);
}

TEST(Sliding, AgreesWithAFineSumOfTheIntegral) {
  for (double h : {0.2, 1.0})
    for (double sine : {0.0, 0.5, 1.0}) {
      const double R = 2.0, rim = std::sqrt(h * (2.0 * R - h)), cosine = std::sqrt(1.0 - sine * sine);
      double sum = 0.0, weights = 0.0;
      for (int i = 0; i < 400; ++i)
        for (int n = 0; n < 400; ++n) {
          const double x = (i + 0.5) / 400.0, angle = n * kPi / 200.0, weight = x * std::sqrt(1.0 - x * x);
          const glm::dvec3 r(rim * x * std::cos(angle), rim * x * std::sin(angle),
                             std::sqrt(R * R - rim * rim * x * x));
          sum += weight * glm::length(glm::cross(r, glm::dvec3(sine, 0.0, cosine)));
          weights += weight;
        }
      EXPECT_NEAR(slidingArm_mm({ShapeKind::sphere, R, 0.0}, h, sine), sum / weights, 0.004 * R) << h << " " << sine;
    }
}

}  // namespace
}  // namespace haptics
