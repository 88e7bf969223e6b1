#include "calibration/fit/rest_registration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace {

using calibration::CalibrationError;
using calibration::MarkTouch;
using calibration::registerRest;

const std::vector<glm::dvec3> kMarks = {{0, 0, 0}, {80, 0, 0}, {20, 60, 10}, {10, 50, 0}, {70, 40, 5}, {40, 10, 15}};

std::vector<MarkTouch> touches(std::size_t first, const glm::dquat& rotation, const glm::dvec3& translation_mm,
                               double noise_mm = 0.0, std::uint32_t seed = 1) {
  std::mt19937 rng(seed);
  std::normal_distribution<double> noise(0.0, 1.0);
  std::vector<MarkTouch> made;
  for (std::size_t i = first; i < first + 3; ++i) {
    const glm::dvec3 off(noise(rng), noise(rng), noise(rng));
    made.push_back({kMarks[i], {rotation * kMarks[i] + translation_mm + noise_mm * off}});
  }
  return made;
}

TEST(RestRegistration, FindsThePoseOfTheRest) {
  std::mt19937 rng(7);
  std::normal_distribution<double> any(0.0, 1.0);
  for (int n = 0; n < 200; ++n) {
    const glm::dquat rotation = glm::normalize(glm::dquat(any(rng), any(rng), any(rng), any(rng)));
    const glm::dvec3 translation_mm = 100.0 * glm::dvec3(any(rng), any(rng), any(rng));
    const auto rest = registerRest(touches(0, rotation, translation_mm), touches(3, rotation, translation_mm));
    EXPECT_LT(glm::length(rest.translation_mm - translation_mm), 1e-9);
    EXPECT_NEAR(std::abs(glm::dot(rest.rotation, rotation)), 1.0, 1e-12);
    EXPECT_LT(rest.fre_rms_mm, 1e-9);
    EXPECT_LT(rest.worst_mm, 1e-9);
  }
}

TEST(RestRegistration, StaysWithinTwoMillimetresForAnOrdinaryArm) {
  const glm::dquat rotation = glm::angleAxis(0.4, glm::normalize(glm::dvec3(1, 2, 3)));
  for (std::uint32_t seed = 1; seed <= 200; ++seed) {
    const auto rest = registerRest(touches(0, rotation, {5, -60, 20}, 0.2, seed),
                                   touches(3, rotation, {5, -60, 20}, 0.2, seed + 500));
    EXPECT_LT(rest.worst_mm, calibration::kMaxRestError_mm);
  }
}

TEST(RestRegistration, ShowsByVerificationThatTheRestHasMoved) {
  const glm::dquat rotation(1, 0, 0, 0);
  const auto rest = registerRest(touches(0, rotation, {0, 0, 0}), touches(3, rotation, {3, 0, 0}));
  EXPECT_NEAR(rest.worst_mm, 3.0, 1e-9);
}

TEST(RestRegistration, RefusesMarksInAnotherOrder) {
  auto fitted_to = touches(0, glm::dquat(1, 0, 0, 0), {0, 0, 0});
  std::swap(fitted_to[0].touched_W, fitted_to[2].touched_W);
  EXPECT_THROW(registerRest(fitted_to, {}), CalibrationError);
}

TEST(RestRegistration, RefusesTooFewOnALineOrNotFinite) {
  auto fitted_to = touches(0, glm::dquat(1, 0, 0, 0), {0, 0, 0});
  EXPECT_THROW(registerRest({fitted_to[0], fitted_to[1]}, {}), CalibrationError);
  auto line = fitted_to;
  line[2].mark_mm = {40, 0, 0};
  line[2].touched_W.mm = {40, 0, 0};
  EXPECT_THROW(registerRest(line, {}), CalibrationError);
  auto wild = fitted_to;
  wild[1].touched_W.mm.y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(registerRest(wild, {}), CalibrationError);
  EXPECT_THROW(registerRest(fitted_to, wild), CalibrationError);
}

}  // namespace
