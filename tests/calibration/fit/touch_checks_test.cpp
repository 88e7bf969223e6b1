#include "calibration/fit/touch_checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "calibration/arm/phantom_models.h"
#include "calibration/geometry/units.h"
#include "tests/refusal.h"

namespace calibration {
namespace {

using testing::HasSubstr;

TouchSet fiveTouches() {
  TouchSet set;
  const std::vector<glm::dvec3> positions = {{0, 0, 0}, {50, 0, 0}, {0, 40, 0}, {0, 0, 30}, {50, 40, 30}};
  for (std::size_t i = 0; i < positions.size(); ++i)
    set.touches.push_back(
        {static_cast<int>(i) + 1, {0.1 * static_cast<double>(i), 0, 0, 0, 0, 0}, {positions[i]}, true});
  return set;
}

std::string refusalOfTouches(const TouchSet& set) {
  return tests::refusalOf<CalibrationError>([&] { checkTouches(set); });
}

TEST(TouchChecks, AcceptGoodTouches) { EXPECT_EQ(refusalOfTouches(fiveTouches()), "accepted"); }

TEST(TouchChecks, NameTheTouchThatIsNotFinite) {
  TouchSet set = fiveTouches();
  set.touches[2].joints_rad[4] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusalOfTouches(set), HasSubstr("touch 3 holds a value that is not finite"));
  set = fiveTouches();
  set.touches[1].target_W.mm.y = std::numeric_limits<double>::infinity();
  EXPECT_THAT(refusalOfTouches(set), HasSubstr("touch 2"));
}

TEST(TouchChecks, NameTheTouchThatWasTakenTwice) {
  TouchSet set = fiveTouches();
  set.touches.push_back(set.touches[1]);
  set.touches.back().id = 9;
  EXPECT_THAT(refusalOfTouches(set), testing::AllOf(HasSubstr("touch 9 is touch 2 again")));
  set.touches.back().used = false;
  EXPECT_EQ(refusalOfTouches(set), "accepted") << "what was set aside does not count";
}

TEST(TouchChecks, RefuseVerificationTouchesOfTheFitOrAnotherDevice) {
  const auto refusalOf = [](const TouchSet& verification) -> std::string {
    TouchSet fitted = fiveTouches();
    fitted.serial = "7";
    try {
      checkUnseen(fitted, verification);
    } catch (const CalibrationError& error) {
      return error.what();
    }
    return "accepted";
  };
  TouchSet verification = fiveTouches();
  for (Touch& touch : verification.touches) touch.joints_rad[3] += 0.2;
  EXPECT_EQ(refusalOf(verification), "accepted") << "the same places, touched anew";
  verification.touches[3].joints_rad = fiveTouches().touches[1].joints_rad;
  EXPECT_THAT(refusalOf(verification), HasSubstr("touch 4 of the verification is touch 2 of the fit"));
  verification.touches[3].used = false;
  EXPECT_EQ(refusalOf(verification), "accepted");
  verification.serial = "8";
  EXPECT_THAT(refusalOf(verification), HasSubstr("serial '7', the verification touches with '8'"));
}

TEST(TouchChecks, RefuseTooFewALineAndOnePosition) {
  TouchSet set = fiveTouches();
  set.touches.resize(3);
  EXPECT_THAT(refusalOfTouches(set), HasSubstr("at least 4 are needed"));
  set = fiveTouches();
  for (Touch& touch : set.touches) touch.target_W.mm = {10.0 * touch.id, 5.0 * touch.id, 0.3 * (touch.id % 2)};
  EXPECT_THAT(refusalOfTouches(set), HasSubstr("lie on a line"));
  for (Touch& touch : set.touches) touch.target_W.mm = {1.0, 0.1 * touch.id, 0.0};
  EXPECT_THAT(refusalOfTouches(set), HasSubstr("at one position"));
}

TEST(TouchChecks, RefuseAnInvalidModelOrPrecision) {
  TouchSet set = fiveTouches();
  set.device_model = "novint";
  EXPECT_THAT(refusalOfTouches(set), HasSubstr("novint"));
  set = fiveTouches();
  set.precision.in_plane_mm = -1.0;
  EXPECT_THAT(refusalOfTouches(set), HasSubstr("precision"));
}

TEST(TiltSpread, IsTheSmallerOfRoomAndGimbal) {
  std::mt19937 rng(2);
  std::uniform_real_distribution<double> wide(-0.5, 0.5), narrow(-0.02, 0.02);
  std::vector<Touch> varied, stiff_gimbal, one_direction;
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < 30; ++i) {
    const glm::dvec3 arm(wide(rng), 0.7 + wide(rng), wide(rng));
    varied.push_back({1, {arm.x, arm.y, arm.z, wide(rng), wide(rng), 0}, {}, true});
    stiff_gimbal.push_back({1, {arm.x, arm.y, arm.z, narrow(rng), narrow(rng), 0}, {}, true});
    const glm::dvec3 g = wristAnglesFor(arm, glm::dquat(1.0, 0.0, 0.0, 0.0));
    one_direction.push_back({1, {arm.x, arm.y, arm.z, g.x, g.y, g.z}, {}, true});
    all.push_back(i);
  }
  EXPECT_GT(tiltSpread_deg(kOmniGeometry, varied, all), 35.0);
  EXPECT_LT(tiltSpread_deg(kOmniGeometry, stiff_gimbal, all), 5.0);
  EXPECT_LT(tiltSpread_deg(kOmniGeometry, one_direction, all), 1.0);
}

TEST(HullVolume, IsThatOfABlockForAnyInteriorPoints) {
  std::vector<glm::dvec3> grid;
  for (const double x : {-65.0, 0.0, 65.0})
    for (const double y : {-45.0, 0.0, 45.0})
      for (const double z : {-32.5, 0.0, 32.5}) grid.push_back({x, y, z});
  EXPECT_NEAR(hullVolume_mm3(grid), 130.0 * 90.0 * 65.0, 1.0);
  EXPECT_NEAR(hullVolume_mm3({{0, 0, 0}, {6, 0, 0}, {0, 5, 0}, {0, 0, 4}}), 20.0, 1e-3);
  EXPECT_EQ(hullVolume_mm3({{0, 0, 0}, {6, 0, 0}, {0, 5, 0}, {6, 5, 0}, {3, 3, 0}}), 0.0);
  EXPECT_EQ(hullVolume_mm3({{0, 0, 0}, {6, 0, 0}, {0, 5, 0}}), 0.0);
}

TEST(HullVolume, IsThatOfABallNearly) {
  std::mt19937 rng(3);
  std::normal_distribution<double> normal;
  std::vector<glm::dvec3> positions;
  for (int i = 0; i < 2000; ++i)
    positions.push_back(10.0 * glm::normalize(glm::dvec3(normal(rng), normal(rng), normal(rng))));
  EXPECT_NEAR(hullVolume_mm3(positions) / (4.0 / 3.0 * kPi * 1000.0), 1.0, 0.01);
}

TEST(TouchChecks, MeasureTheSpreadOfDirections) {
  std::vector<glm::dvec3> all(10, {0.0, 0.0, 1.0});
  EXPECT_EQ(pairSpread_deg(all), 0.0);
  for (std::size_t i = 0; i < 5; ++i) all[i] = {1.0, 0.0, 0.0};
  EXPECT_NEAR(pairSpread_deg(all), 90.0, 1e-9);
  EXPECT_EQ(pairSpread_deg({}), 0.0);
}

}  // namespace
}  // namespace calibration
