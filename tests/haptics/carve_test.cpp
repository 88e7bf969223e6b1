#include "haptics/bone/carve.h"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>
#include <random>

#include "calibration/geometry/units.h"
#include "haptics/bone/voxel_sphere.h"
#include "haptics/contact/cap.h"
#include "haptics/contact/overlap.h"
#include "tests/haptics/phantom.h"
#include "tests/haptics/time_erosion.h"

namespace haptics {
namespace {

using namespace phantom;

constexpr double kRadius_mm = 2.0;
const double kBall_mm3 = capVolume_mm3(kRadius_mm, 2.0 * kRadius_mm);

ErosionSettings rate(double per_s) {
  ErosionSettings erosion;
  erosion.time.removal_rate_per_s = per_s;
  return erosion;
}

double left_mm3(const CarvedBone& bone) {
  std::uint64_t sum = 0;
  for (std::uint8_t solid : bone.solidInGridOrder()) sum += solid;
  return static_cast<double>(sum) / 255.0 * bone.grid().voxelVolume_mm3();
}

double sweep(CarvedBone& bone, const glm::dvec3& from, const glm::dvec3& to, const ErosionStep& step) {
  return carveSweep(bone, {ShapeKind::sphere, kRadius_mm, 0.0}, {glm::dquat(1, 0, 0, 0), from},
                    {glm::dquat(1, 0, 0, 0), to}, step, 0)
      .removed_mm3;
}

/// Dwells at `centre` for `seconds` at `rate_Hz`.
double dwell(CarvedBone& bone, const glm::dvec3& centre, const ErosionSettings& erosion, double seconds,
             double rate_Hz) {
  double removed = 0.0;
  const auto ticks = static_cast<std::uint64_t>(std::lround(seconds * rate_Hz));
  for (std::uint64_t tick = 0; tick < ticks; ++tick)
    removed += carveSphere(bone, {centre}, kRadius_mm, timeErosion(erosion, 1.0 / rate_Hz), tick).removed_mm3;
  return removed;
}

TEST(Carve, RemovesNothingOutsideTheBur) {
  const Phantom phantom = block(3.0, 0.1);
  CarvedBone bone = phantom.bone();
  dwell(bone, {0.03, -0.04, 0.01}, rate(100.0), 0.1, 1000.0);
  for (int k = 0; k < bone.grid().size.z; ++k)
    for (int j = 0; j < bone.grid().size.y; ++j)
      for (int i = 0; i < bone.grid().size.x; ++i) {
        const double away = glm::length(bone.grid().centre_P_mm({i, j, k}) - glm::dvec3(0.03, -0.04, 0.01));
        const std::uint8_t solid = bone.field().solidAt({i, j, k});
        if (away > kRadius_mm + 0.062036) {
          EXPECT_EQ(solid, 255);
        } else if (away < kRadius_mm - 0.062036) {
          EXPECT_EQ(solid, 0);
        }
      }
}

TEST(Carve, LosesTheOverlapTimesRateTimesTimeWhileItIsShort) {
  // Half-space dwell of the reference: R = 2, h = 0.8, k = 4/s, t = 0.05 s.
  for (double rate_Hz : {500.0, 1000.0, 2000.0}) {
    const Phantom phantom = halfSpace(3.0, 0.2, {0.0, 0.0, 1.0}, glm::dvec3(0.02, 0.05, 0.03));
    CarvedBone bone = phantom.bone();
    const double overlap = sphereOverlap(bone.field(), {{0.0, 0.0, 1.2}}, kRadius_mm).volume_mm3;
    const double removed = dwell(bone, {0.0, 0.0, 1.2}, rate(4.0), 0.05, rate_Hz);
    EXPECT_NEAR(removed, overlap * 4.0 * 0.05, 0.005 * removed);
    EXPECT_NEAR(removed, capVolume_mm3(kRadius_mm, 0.8) * 4.0 * 0.05, 0.02 * removed);
  }
}

TEST(Carve, TakesItsOwnVolumeAndNoMoreHoweverLongItStays) {
  for (double s : {0.1, 0.2}) {
    CarvedBone bone = block(3.0, s).bone();
    const double before = left_mm3(bone);
    double removed = dwell(bone, {0.013, 0.031, -0.047}, rate(4.0), 0.5, 1000.0);
    EXPECT_NEAR(removed, kBall_mm3, 0.005 * kBall_mm3) << s;
    removed += dwell(bone, {0.013, 0.031, -0.047}, rate(4.0), 2.0, 1000.0);
    EXPECT_NEAR(removed, kBall_mm3, 0.005 * kBall_mm3) << s;
    EXPECT_NEAR(before - left_mm3(bone), removed, 1e-9);
  }
}

TEST(Carve, TakesTheCapOfAFlatFace) {
  for (double s : {0.1, 0.2})
    for (double rate_Hz : {500.0, 1000.0, 2000.0}) {
      CarvedBone bone = halfSpace(3.0, s, glm::normalize(glm::dvec3(0.2, 0.3, 0.9))).bone();
      const glm::dvec3 centre = glm::normalize(glm::dvec3(0.2, 0.3, 0.9));
      const double removed = dwell(bone, centre, rate(10.0), 0.5, rate_Hz);
      EXPECT_NEAR(removed, capVolume_mm3(kRadius_mm, 1.0), 0.02 * removed) << s << " " << rate_Hz;
    }
}

/// Sweeps from -x to +x through solid bone and returns what it took.
double sweep(double s, double rate_Hz, double speed_mm_per_s, double per_s) {
  CarvedBone bone = block(5.0, s).bone();
  double removed = 0.0;
  const auto ticks = static_cast<std::uint64_t>(std::lround(4.0 / speed_mm_per_s * rate_Hz));
  for (std::uint64_t tick = 0; tick <= ticks; ++tick) {
    const glm::dvec3 centre(-2.0 + 4.0 * static_cast<double>(tick) / static_cast<double>(ticks), 0.033, 0.071);
    removed += carveSphere(bone, {centre}, kRadius_mm, timeErosion(rate(per_s), 1.0 / rate_Hz), tick).removed_mm3;
  }
  return removed;
}

TEST(Carve, SweepsOutACapsule) {
  const double capsule = kBall_mm3 + calibration::kPi * kRadius_mm * kRadius_mm * 4.0;
  for (double s : {0.1, 0.2}) EXPECT_NEAR(sweep(s, 1000.0, 10.0, 200.0), capsule, 0.02 * capsule) << s;
}

TEST(Carve, CutsAtOneRateWhateverTheVoxelAndTheTick) {
  // Fast enough that much bone is left behind: what goes is rate times time times volume of the bur.
  const double seconds = 4.0 / 40.0, analytic = kBall_mm3 * 4.0 * seconds;
  for (double s : {0.1, 0.2})
    for (double rate_Hz : {500.0, 1000.0, 2000.0})
      EXPECT_NEAR(sweep(s, rate_Hz, 40.0, 4.0), analytic * (1.0 + 1.0 / (seconds * rate_Hz)), 0.01 * analytic)
          << s << " " << rate_Hz;
}

TEST(Carve, TakesTheSameInTurnsAsAllAtOnce) {
  // A stroke of 8 mm at 40 mm/s, twice: every block each tick, or each block in one tick of eight.
  const auto stroke = [](int turns) {
    CarvedBone bone = halfSpace(6.0, 0.1).bone();
    double removed = 0.0;
    for (std::uint64_t tick = 0; tick < 400; ++tick) {
      const double along = static_cast<double>(tick < 200 ? tick : 400 - tick) * 0.04;
      removed += carveSphere(bone, {{along - 4.0, 0.0, 1.2}}, kRadius_mm, timeErosion(rate(4.0), 1e-3), tick, turns)
                     .removed_mm3;
    }
    return removed;
  };
  const double at_once = stroke(1);
  EXPECT_NEAR(stroke(2), at_once, 0.002 * at_once);
  EXPECT_NEAR(stroke(8), at_once, 0.005 * at_once);
}

TEST(Carve, TakesTurnsOnlyWhereItIsDearAndNoStepGrowsLarge) {
  const CarvedBone fine = block(1.0, 0.1).bone(), coarse = block(1.0, 0.25).bone();
  EXPECT_EQ(carveInterleave(coarse, {ShapeKind::sphere, 1.5, 0.0}, timeErosion(rate(4.0), 1e-3)), 1);
  EXPECT_EQ(carveInterleave(fine, {ShapeKind::sphere, 4.0, 0.0}, timeErosion(rate(4.0), 1e-3)), 8);
  EXPECT_EQ(carveInterleave(fine, {ShapeKind::sphere, 4.0, 0.0}, timeErosion(rate(4.0), 0.2)), 1);
}

TEST(Carve, CutsAlikeWhenAVoxelIsPartlyUsedUp) {
  // Half-way to saturation the cap must not depend on the voxel.
  const double fine = sweep(0.1, 1000.0, 6.0, 1.4), coarse = sweep(0.2, 1000.0, 6.0, 1.4);
  EXPECT_NEAR(coarse, fine, 0.02 * fine);
}

TEST(Carve, LosesNothingToRoundingWhenSlow) {
  // 0.1 ms ticks at 0.01 /s: a millionth of a voxel a step, a fifteenth of a dose unit.
  CarvedBone bone = halfSpace(2.6, 0.2, {0.0, 0.0, 1.0}, glm::dvec3(0.02, 0.05, 0.03)).bone();
  const double overlap = sphereOverlap(bone.field(), {{0.0, 0.0, 0.6}}, kRadius_mm).volume_mm3;
  const double removed = dwell(bone, {0.0, 0.0, 0.6}, rate(0.01), 2.0, 10'000.0);
  EXPECT_NEAR(removed, overlap * 0.02, 0.005 * removed);
}

TEST(Carve, FollowsTheTissue) {
  ErosionSettings erosion = rate(4.0);
  const auto removedOf = [&](std::uint8_t label) {
    CarvedBone bone = block(2.5, 0.2).bone(label);
    const CarveResult result = carveSphere(bone, {{0.0, 0.0, 0.0}}, kRadius_mm, timeErosion(erosion, 0.01), 0);
    EXPECT_EQ(result.removed_mm3, result.removed_mm3_by_label[label]);
    return result.removed_mm3;
  };
  const double cortical = removedOf(1);
  EXPECT_NEAR(removedOf(2), cortical * 10.0 / 3.0, 0.03 * cortical);
  EXPECT_NEAR(removedOf(4), cortical / 3.0, 0.03 * cortical);
}

TEST(Carve, RemovesTheSameInAnySetting) {
  // Bit for bit, whatever has happened elsewhere in the bone.
  CarvedBone one = block(3.0, 0.2).bone(), other = block(3.0, 0.2).bone();
  for (std::uint64_t tick = 0; tick < 50; ++tick) {
    carveSphere(one, {{0.01 * static_cast<double>(tick), 0.0, 0.0}}, 1.0, timeErosion(rate(8.0), 1e-3), tick);
    carveSphere(other, {{0.01 * static_cast<double>(tick), 0.0, 0.0}}, 1.0, timeErosion(rate(8.0), 1e-3), tick);
  }
  EXPECT_EQ(one.digest(), other.digest());
  EXPECT_EQ(one.solidInGridOrder(), other.solidInGridOrder());
}

TEST(Carve, IgnoresWhatIsNoCut) {
  CarvedBone bone = block(2.5, 0.2).bone();
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (double bad : {nan, -1.0, -inf}) {
    EXPECT_EQ(carveSphere(bone, {{0.0, 0.0, 0.0}}, bad, timeErosion(rate(4.0), 1e-3), 0).removed_mm3, 0.0);
    EXPECT_EQ(carveSphere(bone, {{0.0, 0.0, 0.0}}, 1.0, timeErosion(rate(bad), 1e-3), 0).removed_mm3, 0.0);
    EXPECT_EQ(carveSphere(bone, {{0.0, 0.0, 0.0}}, 1.0, timeErosion(rate(4.0), bad), 0).removed_mm3, 0.0);
  }
  EXPECT_EQ(carveSphere(bone, {{nan, 0.0, 0.0}}, 1.0, timeErosion(rate(4.0), 1e-3), 0).removed_mm3, 0.0);
  EXPECT_EQ(carveSphere(bone, {{0.0, 0.0, 90.0}}, 1.0, timeErosion(rate(4.0), 1e-3), 0).removed_mm3, 0.0);
  EXPECT_EQ(sweep(bone, {0.0, nan, 0.0}, {0.0, 0.0, 0.0}, timeErosion(rate(4.0), 1e-3)), 0.0);
  for (std::uint8_t solid : bone.solidInGridOrder()) ASSERT_EQ(solid, 255);
}

TEST(CarveSweep, BridgesPosesThatAreFarApart) {
  const double capsule = kBall_mm3 + calibration::kPi * kRadius_mm * kRadius_mm * 4.0;
  CarvedBone bone = block(5.0, 0.2).bone();
  const double removed = sweep(bone, {-2.0, 0.03, 0.07}, {2.0, 0.03, 0.07}, timeErosion(rate(200.0), 1.0));
  EXPECT_NEAR(removed, capsule, 0.02 * capsule);
}

}  // namespace
}  // namespace haptics
