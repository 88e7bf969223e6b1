#include "calibration/fit/arm_numbers.h"

#include <gtest/gtest.h>

#include <random>

#include "calibration/arm/phantom_models.h"

namespace calibration {
namespace {

struct AnyArm {
  std::mt19937 chance{4};
  std::normal_distribution<double> normal;

  ArmStart start(const PhantomModel& model) {
    return {model.geometry,
            {glm::normalize(glm::dquat(normal(chance), normal(chance), normal(chance), normal(chance))),
             {30.0 * normal(chance), 30.0 * normal(chance), 30.0 * normal(chance)}},
            {{5.0, -7.0, 11.0}}};
  }
  ArmNumbers numbers() {
    ArmNumbers numbers{};
    for (std::size_t k = 0; k < numbers.size(); ++k)
      numbers[k] = normal(chance) * (kArmParameters[k].prior_sigma > 0.0 ? kArmParameters[k].prior_sigma : 0.1);
    return numbers;
  }
  RawJoints raw() {
    RawJoints raw;
    for (double& angle_rad : raw) angle_rad = 0.5 * normal(chance);
    return raw;
  }
};

TEST(ArmNumbers, AreTheModelWhereItStandsWhenAllAreZero) {
  AnyArm any;
  const ArmStart start = any.start(kPhantomModels[3]);
  const MeasuredArm arm = armOf(start, {});
  const RawJoints raw = any.raw();
  const MeasuredArm model{start.geometry, {}, start.X_WD};
  EXPECT_LT(glm::distance(arm.tip_W(raw).mm, model.tip_W(raw).mm), 1e-12);
}

TEST(ArmNumbers, KnowTheirSlopes) {
  AnyArm any;
  for (int round = 0; round < 40; ++round) {
    const ArmStart start = any.start(kPhantomModels[static_cast<std::size_t>(round % 4)]);
    const ArmNumbers numbers = any.numbers();
    const RawJoints raw = any.raw();
    const TipSlopes slopes = tipSlopes(start, numbers, raw);
    EXPECT_LT(glm::distance(slopes.tip_W_mm, armOf(start, numbers).tip_W(raw).mm), 1e-10);
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      ArmNumbers more = numbers, less = numbers;
      const double step = 1e-5;
      more[k] += step, less[k] -= step;
      const glm::dvec3 by_difference =
          (armOf(start, more).tip_W(raw).mm - armOf(start, less).tip_W(raw).mm) / (2.0 * step);
      EXPECT_LT(glm::distance(slopes.by_number[k], by_difference), 1e-5) << kArmParameters[k].name;
    }
  }
}

TEST(ArmNumbers, AreSixFifteenAndTwentyEight) {
  EXPECT_EQ(numbersOf(ArmModel::rigid).size(), 6u);
  EXPECT_EQ(numbersOf(ArmModel::joint_gains).size(), 15u);
  EXPECT_EQ(numbersOf(ArmModel::full).size(), 28u);
}

}  // namespace
}  // namespace calibration
