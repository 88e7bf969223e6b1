#include "haptics/servo/cutting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#define GLM_ENABLE_EXPERIMENTAL
#include <glm/gtx/quaternion.hpp>

#include "calibration/geometry/units.h"
#include "haptics/bone/stroke_history.h"
#include "haptics/contact/law.h"
#include "tests/haptics/granted_rate.h"
#include "tests/haptics/phantom.h"

namespace haptics {
namespace {

using namespace phantom;
using calibration::kPi;
using calibration::Tool;

constexpr double kRadius_mm = 2.0;
constexpr std::uint8_t kCortical = 1, kTrabecular = 2, kEnamel = 4;

/// A hand that holds a bur somewhere and presses with a force of its choosing.
struct Bench {
  Bodies bone;
  StrokeHistory strokes;
  ErosionSettings erosion;
  SpindleSettings spindle;
  LawSettings law;
  Cutting cutting;
  glm::dvec3 axis_P{1.0, 0.0, 0.0};
  double pressing_N = 1.5, removed_mm3 = 0.0, granted_mm3 = 0.0;
  std::uint64_t tick = 0;

  Bench(const Phantom& phantom, std::uint8_t label, ErosionKind kind)
      : bone(phantom.bodies(label)), strokes(bone.bones()) {
    erosion.kind = kind;
    spindle.bearing_torque_Nmm = 0.0;
    for (int n = 0; n < 1000; ++n) cutting.turn(spindle, true, 1e-3);
  }

  void step(const glm::dvec3& place, double dt_s, bool pedal = true) {
    cutting.turn(spindle, pedal, dt_s);
    const calibration::Pose<Patient, Tool> X_PT{glm::rotation(glm::dvec3(0, 0, 1), axis_P), place};
    const SolidBodies field = bone.view();
    const BurShape head{ShapeKind::sphere, kRadius_mm, 0.0};
    const ToolInBone at{field, head, X_PT, law.tissue, cutting.motion({}, dt_s)};
    const Contact contact = contactOf(law, at);
    const double length = glm::length(contact.normal_P.xyz);
    const Vector<Patient> force = length > 0.0 ? (pressing_N / length) * contact.normal_P : Vector<Patient>{};
    if (pedal)
      granted_mm3 += dt_s * grantedRate_mm3_per_s(erosion, cutConditions(erosion, spindle, at, contact, pressing_N),
                                                  assets::Tissue::cortical);
    removed_mm3 += cutting.cut(bone, strokes, erosion, spindle, law, {X_PT, head, contact, force}, pedal, dt_s, tick++)
                       .removed_mm3;
  }

  void dwell(double seconds, double rate_Hz, const glm::dvec3& place = {0.03, 0.02, 1.0}) {
    for (int n = 0; n < static_cast<int>(std::lround(seconds * rate_Hz)); ++n) step(place, 1.0 / rate_Hz);
  }
};

TEST(Cutting, TakesByDoseWhatItsFrictionPaysForWhateverVoxelsAndTicks) {
  double first = 0.0;
  for (double spacing_mm : {0.1, 0.2, 0.4})
    for (double rate_Hz : {500.0, 1000.0, 4000.0, 10000.0}) {
      if (spacing_mm < 0.2 && rate_Hz > 4000.0) continue;
      Bench bench(halfSpace(3.0, spacing_mm, {0, 0, 1}, {0.02, 0.05, 0.03}), kCortical, ErosionKind::dose);
      bench.dwell(0.4, rate_Hz);
      EXPECT_NEAR(bench.removed_mm3 / bench.granted_mm3, 1.0, 0.02) << spacing_mm << " mm, " << rate_Hz << " Hz";
      // alpha mu F w R at first touch; a little less as the arm shortens with the depth.
      EXPECT_NEAR(bench.removed_mm3 / (0.4 * 0.5e-3 * 0.3 * 1.5 * radPerSecond(40000.0) * kRadius_mm), 0.93, 0.07);
      if (first == 0.0) first = bench.removed_mm3;
      EXPECT_NEAR(bench.removed_mm3 / first, 1.0, 0.02) << spacing_mm << " mm, " << rate_Hz << " Hz";
    }
}

TEST(Cutting, TakesByTheClockAsTheContinuumHasIt) {
  // R = 2, h = 0.8, k = 4/s, 0.05 s of the reference: within 8 % at 0.2 mm, and closer by squares.
  const double exact = kPi * 0.8 * 0.8 * (2.0 - 0.8 / 3.0) * 4.0 * 0.05;
  for (double spacing_mm : {0.1, 0.2, 0.4}) {
    Bench bench(halfSpace(3.0, spacing_mm, {0, 0, 1}, {0.02, 0.05, 0.03}), kCortical, ErosionKind::time);
    bench.dwell(0.05, 1000.0, {0.03, 0.02, 1.2});
    EXPECT_NEAR(bench.removed_mm3 / exact, 1.0, 0.08 * spacing_mm * spacing_mm / 0.04) << spacing_mm;
  }
}

/// A trough `length` long and h deep at `speed`; what was taken.
double trough(double spacing_mm, double rate_Hz, double speed_mm_per_s, double h, ErosionSettings erosion) {
  Bench bench(halfSpace(4.2, spacing_mm, {0, 0, 1}, {0.02, 0.05, 0.03}), kCortical, erosion.kind);
  bench.erosion = erosion;
  constexpr double kWay_mm = 3.0;
  const auto ticks = static_cast<int>(std::lround(kWay_mm / speed_mm_per_s * rate_Hz));
  for (int n = 0; n <= ticks; ++n)
    bench.step({-0.5 * kWay_mm + kWay_mm * n / ticks, 0.02, kRadius_mm - h}, 1.0 / rate_Hz);
  return bench.removed_mm3;
}

TEST(Cutting, TakesByMachiningWhatTheFeedSweeps) {
  const double R = kRadius_mm, h = 0.6;
  const double section = R * R * std::acos(1.0 - h / R) - (R - h) * std::sqrt(2.0 * R * h - h * h);
  ErosionSettings erosion;
  erosion.kind = ErosionKind::machining;
  for (double spacing_mm : {0.1, 0.2})
    for (double rate_Hz : {500.0, 2000.0})
      EXPECT_NEAR(trough(spacing_mm, rate_Hz, 6.0, h, erosion) / (3.0 * section), 1.0, 0.05) << spacing_mm << rate_Hz;
}

TEST(Cutting, TakesByMachiningNoMoreThanTheMotorCan) {
  // 0.1 J/mm3 and 30 N mm (1 - 0.8) 4189/s = 25 W: 250 mm3/s. A motor of 0.03 N mm has a thousandth of it.
  Bench bench(halfSpace(3.0, 0.2), kCortical, ErosionKind::machining);
  bench.spindle.stall_torque_Nmm = 0.03;
  bench.pressing_N = 0.0;
  const double most = 0.03 * 0.2 * radPerSecond(40000.0) / 100.0;
  for (int n = 0; n < 100; ++n) bench.step({0.03, 0.02, 1.2 - 0.01 * n}, 1e-3);  // 10 mm/s: 60 mm3/s
  EXPECT_NEAR(bench.removed_mm3 / (most * 0.1), 1.0, 0.05);
}

TEST(Cutting, IsSlowestInEnamelAndFastestInCancellousBone) {
  for (ErosionKind kind : {ErosionKind::time, ErosionKind::dose}) {
    const auto taken = [&](std::uint8_t label) {
      Bench bench(halfSpace(3.0, 0.2), label, kind);
      bench.dwell(0.05, 1000.0);
      return bench.removed_mm3;
    };
    const double cortical = taken(kCortical);
    EXPECT_NEAR(taken(kEnamel) / cortical, 1.0 / 3.0, 0.02);
    EXPECT_NEAR(taken(kTrabecular) / cortical, 10.0 / 3.0, 0.1);
  }
}

TEST(Cutting, LosesWithTheBoneWhatItSaysItTook) {
  for (const ErosionName& law : kErosions) {
    Bench bench(halfSpace(3.0, 0.2), kCortical, law.kind);
    for (int n = 0; n < 200; ++n) bench.step({0.002 * n, 0.02, 1.4 - 0.002 * n}, 1e-3);
    EXPECT_GT(bench.removed_mm3, 0.05) << law.key;
    double lost = 0.0;
    for (double part : bench.bone.removedByTissue_mm3()) lost += part;
    EXPECT_NEAR(lost, bench.removed_mm3, 1e-9) << law.key;
  }
}

TEST(Cutting, TakesNothingWithThePedalUpOrTheSpindleStalled) {
  for (const ErosionName& law : kErosions) {
    Bench up(halfSpace(3.0, 0.2), kCortical, law.kind);
    for (int n = 0; n < 20; ++n) up.step({0.0, 0.0, 1.2 - 0.01 * n}, 1e-3, false);
    EXPECT_EQ(up.removed_mm3, 0.0) << law.key;

    // mu F R = 0.3 * 3 * 2 = 1.8 N mm is more than this motor has.
    Bench stalled(halfSpace(3.0, 0.2), kCortical, law.kind);
    stalled.spindle.stall_torque_Nmm = 1.0;
    stalled.pressing_N = 3.0;
    stalled.dwell(1.0, 1000.0);
    EXPECT_EQ(stalled.cutting.spindle().rad_per_s, 0.0) << law.key;
    const double before = stalled.removed_mm3;
    stalled.dwell(0.1, 1000.0);
    EXPECT_EQ(stalled.removed_mm3, before) << law.key;
    // Let go it recovers and cuts on.
    stalled.pressing_N = 0.5;
    stalled.dwell(2.0, 1000.0, {0.6, 0.0, 1.0});
    EXPECT_GT(stalled.cutting.spindle().rad_per_s, 1000.0) << law.key;
  }
}

TEST(Cutting, SlowsTheSpindleWhileItPresses) {
  Bench bench(halfSpace(3.0, 0.2), kCortical, ErosionKind::dose);
  bench.pressing_N = 3.0;
  bench.erosion.dose.removal_mm3_per_J = 0.0;
  bench.dwell(1.0, 1000.0);
  const double load = bench.cutting.load_Nmm();
  EXPECT_NEAR(load, 0.3 * 3.0 * 1.8, 0.15);
  EXPECT_NEAR(bench.cutting.spindle().rad_per_s, steadySpeed_rad_per_s(bench.spindle, load), 1.0);
  EXPECT_LT(rpmOf(bench.cutting.spindle().rad_per_s), 39950.0);
}

TEST(Cutting, TakesLittleUnderTheTipOfATurningBur) {
  // Straight down: the sliding speed, and with it the loss, grows from the axis outwards.
  const Phantom phantom = halfSpace(3.0, 0.1, {0, 0, 1}, {0.05, 0.05, 0.03});
  Bench bench(phantom, kCortical, ErosionKind::dose);
  bench.axis_P = {0.0, 0.0, 1.0};
  bench.dwell(0.3, 1000.0, {0.0, 0.0, 1.2});
  const std::vector<std::uint8_t> left = bench.bone.solidInGridOrder();
  const auto lostAt = [&](const glm::dvec3& place) {
    const glm::ivec3 ijk(glm::round(phantom.grid.indexFromPoint(place)));
    return static_cast<double>(255 - left[phantom.grid.index(ijk)]);
  };
  EXPECT_GT(lostAt({1.0, 0.0, -0.2}), 20.0);
  EXPECT_NEAR(lostAt({0.5, 0.0, -0.2}) / lostAt({1.0, 0.0, -0.2}), 0.5, 0.05);
  EXPECT_LT(lostAt({0.0, 0.0, -0.2}), 0.12 * lostAt({1.0, 0.0, -0.2}));
}

TEST(Cutting, TakesEvenlyOnAllSides) {
  // No voxel comes first: the middle of what is gone lies under the middle of the bur.
  const Phantom phantom = halfSpace(3.0, 0.2);
  for (const ErosionName& law : kErosions) {
    Bench bench(phantom, kCortical, law.kind);
    for (int n = 0; n < 100; ++n) bench.step({0.0, 0.0, 1.4 - 0.002 * n}, 1e-3);
    const std::vector<std::uint8_t> left = bench.bone.solidInGridOrder();
    glm::dvec3 sum(0.0);
    double lost = 0.0;
    for (int k = 0; k < phantom.grid.size.z; ++k)
      for (int j = 0; j < phantom.grid.size.y; ++j)
        for (int i = 0; i < phantom.grid.size.x; ++i) {
          const std::size_t voxel = phantom.grid.index({i, j, k});
          const double part = phantom.solid[voxel] - left[voxel];
          sum += part * phantom.grid.centre_P_mm({i, j, k});
          lost += part;
        }
    ASSERT_GT(lost, 100.0) << law.key;
    EXPECT_LT(std::hypot(sum.x, sum.y) / lost, 0.02) << law.key;
  }
}

TEST(Cutting, TakesNothingByWhatIsNoNumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const ErosionName& law : kErosions) {
    Bench bench(halfSpace(3.0, 0.4), kCortical, law.kind);
    bench.pressing_N = nan;
    bench.step({nan, 0.0, 1.0}, 1e-3);
    bench.step({0.0, 0.0, 1.0}, 1e-3);
    bench.pressing_N = 1.0;
    bench.step({0.0, 0.0, 1.0}, 1e-3);
    EXPECT_TRUE(std::isfinite(bench.removed_mm3));
    EXPECT_TRUE(std::isfinite(bench.cutting.spindle().rad_per_s));
  }
}

}  // namespace
}  // namespace haptics
