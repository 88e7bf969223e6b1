#include <gtest/gtest.h>

#include <random>

#include "haptics/ligament/piece_hold.h"
#include "tests/haptics/ligament_scene.h"
#include "tests/haptics/ligament_twin.h"

namespace haptics {
namespace {

constexpr double kTick_s = 1e-3;

/// A field whose surface lies where signed distance is 0.
DistanceField fieldOf(glm::ivec3 size, double spacing_mm, const phantom::SignedDistance& inside) {
  const phantom::ToothPhantom bone = phantom::solidOf(size, spacing_mm, inside);
  return {bone.grid, bone.solid, 1.6};
}

/// The faces of a box, without ligament.
std::vector<SamplePoint> boxFaces(const glm::dvec3& half_mm, double spacing_mm) {
  std::vector<SamplePoint> points;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const int a = (axis + 1) % 3, b = (axis + 2) % 3;
      const glm::ivec2 count(glm::round(2.0 * glm::dvec2(half_mm[a], half_mm[b]) / spacing_mm));
      for (int i = 0; i < count.x; ++i)
        for (int j = 0; j < count.y; ++j) {
          SamplePoint point{.area_mm2 = 4.0 * half_mm[a] * half_mm[b] / (count.x * count.y)};
          point.outward = glm::dvec3(0.0);
          point.outward[axis] = side;
          point.p_Q_mm[axis] = side * half_mm[axis];
          point.p_Q_mm[a] = half_mm[a] * (2.0 * (i + 0.5) / count.x - 1.0);
          point.p_Q_mm[b] = half_mm[b] * (2.0 * (j + 0.5) / count.y - 1.0);
          points.push_back(point);
        }
    }
  return points;
}

TEST(LigamentContact, BoxOnAPlaneSinksByForceOverStiffness) {
  const DistanceField plane = fieldOf({60, 60, 60}, 0.2, [](const glm::dvec3& p) { return p.z + 3.0; });
  PieceHold hold(arranged(boxFaces({2.0, 2.0, 3.0}, 0.5)), LigamentLaw{});
  PieceDrive drive;
  drive.force_N.xyz.z = -10.0;
  HoldTick tick;
  for (int n = 0; n < 300; ++n) tick = hold.step(drive, &plane, kTick_s);
  const double rest_z_mm = plane.at_mm({0.1, 0.1, -3.0});
  EXPECT_NEAR(rest_z_mm, 0.0, 1e-3) << "the plane lies where it was said to";
  const double depth_mm = 10.0 / (LigamentLaw{}.contact_N_per_mm3 * 16.0);
  EXPECT_NEAR(-tick.X_PQ.translation_mm.z / depth_mm, 1.0, 0.01);
  EXPECT_NEAR(tick.stored_Nmm, 0.5 * 10.0 * depth_mm, 0.01 * depth_mm * 10.0);
}

TEST(LigamentContact, SlotCentresAPieceThatIsTooWide) {
  constexpr double kOver_mm = 0.1;
  const DistanceField slot = fieldOf({60, 60, 60}, 0.2, [](const glm::dvec3& p) { return 2.0 - std::abs(p.x); });
  PieceHold hold(arranged(boxFaces({2.0 + kOver_mm / 2.0, 2.0, 2.0}, 0.5)), LigamentLaw{});
  PieceDrive drive;
  drive.spring.stiffness_N_per_mm = 20.0;
  drive.spring.target_X_PQ.translation_mm.x = 0.08;
  HoldTick tick = hold.step(drive, &slot, kTick_s);
  EXPECT_GT(tick.X_PQ.translation_mm.x, 0.0);
  drive.spring.stiffness_N_per_mm = 0.0;
  for (int n = 0; n < 300; ++n) tick = hold.step(drive, &slot, kTick_s);
  EXPECT_NEAR(tick.X_PQ.translation_mm.x, 0.0, 0.02 * kOver_mm);
  // Both walls press alike: energy of two springs.
  const double depth_mm = kOver_mm / 2.0, stiffness = 50.0 * 16.0;
  EXPECT_NEAR(tick.stored_Nmm / (stiffness * depth_mm * depth_mm), 1.0, 0.05);
}

TEST(LigamentContact, RestIsFreeOfForceWithBoneAllAround) {
  const phantom::SocketScene scene = phantom::rootInSocket();
  const DistanceField bone(scene.bone.grid, scene.bone.solid, 1.6);
  PieceHold hold = scene.hold(bone);
  for (int n = 0; n < 10; ++n) {
    const HoldTick tick = hold.step({}, &bone, kTick_s);
    EXPECT_LT(tick.residual_N, 1e-3);
    EXPECT_LT(glm::length(tick.X_PQ.translation_mm), 1e-6);
  }
}

TEST(LigamentContact, LigamentIsOnTheRootAlone) {
  const phantom::SocketScene scene = phantom::rootInSocket();
  const DistanceField bone(scene.bone.grid, scene.bone.solid, 1.6);
  double root_mm2 = 0.0, all_mm2 = 0.0, narrowest = 1.0, widest = 0.0;
  for (const SamplePoint& point : scene.points(bone)) {
    all_mm2 += point.area_mm2;
    if (!point.has_ligament) continue;
    root_mm2 += point.area_mm2;
    EXPECT_LT(point.p_Q_mm.z, 0.0);
    EXPECT_NEAR(point.rest_gap_mm, 0.25, point.p_Q_mm.z < -0.7 ? 0.12 : 0.3) << point.p_Q_mm.z;
    narrowest = std::min(narrowest, point.width_mm);
    widest = std::max(widest, point.width_mm);
  }
  EXPECT_GT(all_mm2, root_mm2 + 100.0) << "crown";
  // A cone of 3.14 to 1.75 mm radius over 9.6 mm, 147 mm2, and its rounded tip, less the rim.
  EXPECT_NEAR(root_mm2, 160.0, 12.0);
  EXPECT_NEAR(narrowest, 0.14, 0.005);
  EXPECT_NEAR(widest, 0.26, 0.005);
}

TEST(LigamentContact, KernelIsItsSlowTwinInBone) {
  const phantom::SocketScene scene = phantom::rootInSocket();
  const DistanceField bone(scene.bone.grid, scene.bone.solid, 1.6);
  const PieceHold hold = scene.hold(bone);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> way(-0.3, 0.3), turn(-0.02, 0.02);
  for (int n = 0; n < 20; ++n) {
    const PiecePose at{glm::normalize(glm::dquat(1.0, turn(random), turn(random), turn(random))),
                       {way(random), way(random), way(random)}};
    const HoldSums fast = phantom::sumsAt(hold, at, &bone);
    const phantom::TwinSums slow = phantom::twinSums(hold, at, &bone, kTick_s);
    EXPECT_NEAR(fast.energy / slow.energy, 1.0, 1e-4);
    double force = 0.0, stiffness = 0.0;
    for (std::size_t axis = 0; axis < 6; ++axis) {
      force = std::max(force, std::abs(slow.gradient[axis]));
      stiffness = std::max(stiffness, slow.hessian[axis][axis]);
    }
    for (std::size_t row = 0; row < 6; ++row) {
      EXPECT_NEAR(fast.gradient[row], slow.gradient[row], 2e-4 * force);
      for (std::size_t column = row; column < 6; ++column)
        EXPECT_NEAR(fast.hessian[SymmetricSix::at(row, column)], slow.hessian[row][column], 1e-3 * stiffness);
    }
  }
}

TEST(LigamentContact, FibresGoWithTheBoneTheyEndIn) {
  const phantom::SocketScene scene = phantom::rootInSocket();
  const DistanceField bone(scene.bone.grid, scene.bone.solid, 1.6);
  PieceHold hold = scene.hold(bone);
  phantom::ToothPhantom drilled = scene.bone;
  assets::forVoxels(drilled.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p = drilled.grid.centre_P_mm(ijk);
    if (p.x > 1.0 && p.z > -5.0) drilled.solid[v] = 0;
  });
  const DistanceField after(drilled.grid, drilled.solid, 1.6);
  const SocketChange change = socketAfter(after, hold.samples());
  hold.meet(change);
  const PieceSamples& samples = hold.samples();
  int torn = 0, held = 0;
  for (std::size_t n = 0; n < samples.ligament; ++n) {
    if (samples.area_mm2[n] == 0.0F) continue;
    const double x = samples.centre_Q_mm.x + samples.place_mm[0][n], z = samples.centre_Q_mm.z + samples.place_mm[2][n];
    const bool is_torn = hold.state().ligament.torn[n] == 1.0F;
    const bool in_cut = x > 1.6 && z > -4.4, is_away = x < 0.6 || z < -5.6;
    EXPECT_TRUE(is_torn || !in_cut) << x << ' ' << z;
    EXPECT_FALSE(is_torn && is_away) << x << ' ' << z;
    (is_torn ? torn : held) += 1;
  }
  EXPECT_GT(torn, 30);
  EXPECT_GT(held, 200);
  EXPECT_LT(hold.step({}, &after, kTick_s).residual_N, 1e-2) << "rest stays free of force";

  // Bone that comes back holds no fibres again.
  hold.meet(socketAfter(bone, hold.samples()));
  EXPECT_GT(std::count(hold.state().ligament.torn.begin(), hold.state().ligament.torn.end(), 1.0F), 30);
}

TEST(LigamentContact, PieceIsPulledOutOfItsSocketPastNothing) {
  const phantom::SocketScene scene = phantom::rootInSocket();
  const DistanceField bone(scene.bone.grid, scene.bone.solid, 1.6);
  PieceHold hold = scene.hold(bone);
  PieceDrive drive = phantom::pulledUp(0.0, 2e3, 1e6);
  double most_N = 0.0;
  HoldTick tick;
  int unsettled = 0;
  for (int n = 0; n < 3000; ++n) {
    drive.spring.target_X_PQ.translation_mm.z = 2e-3 * n;
    tick = hold.step(drive, &bone, kTick_s);
    most_N = std::max(most_N, -tick.on_hand.force_N.xyz.z);
    unsettled += tick.unsettled ? 1 : 0;
  }
  EXPECT_GT(most_N, 200.0);
  EXPECT_EQ(tick.torn_share, 1.0);
  EXPECT_NEAR(tick.X_PQ.translation_mm.z, 6.0, 0.1);
  EXPECT_LT(std::abs(tick.on_hand.force_N.xyz.z), 1.0) << "free";
  EXPECT_EQ(unsettled, 0);
}

TEST(LigamentContact, RandomHandsNearlyAlwaysSettleWhenALoosePieceJams) {
  const phantom::SocketScene scene = phantom::rootInSocket();
  const DistanceField bone(scene.bone.grid, scene.bone.solid, 1.6);
  int unsettled = 0, ticks = 0;
  for (unsigned seed = 0; seed < 4; ++seed) {
    PieceHold hold = scene.hold(bone);
    phantom::RandomHand hand(seed, 0.4 + 0.3 * seed, 0.05 + 0.05 * seed);
    for (int n = 0; n < 2000; ++n, ++ticks) {
      const HoldTick tick = hold.step(hand.next(), &bone, kTick_s);
      EXPECT_LE(tick.evaluations, kMostEvaluations);
      EXPECT_TRUE(calibration::isFinite(tick.X_PQ.translation_mm));
    }
    unsettled += hold.unsettled();
  }
  EXPECT_LT(unsettled, ticks * 15 / 1000) << "of " << ticks << ": forced by 200 N where it cannot go";
}

}  // namespace
}  // namespace haptics
