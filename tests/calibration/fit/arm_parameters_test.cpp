#include "calibration/fit/arm_parameters.h"

#include <gtest/gtest.h>

#include <random>

#include "calibration/arm/phantom_models.h"

namespace calibration {
namespace {

struct AnyArm {
  std::mt19937 rng{4};
  std::normal_distribution<double> normal;

  ArmStart start(const PhantomModel& model) {
    return {model.geometry,
            {glm::normalize(glm::dquat(normal(rng), normal(rng), normal(rng), normal(rng))),
             {30.0 * normal(rng), 30.0 * normal(rng), 30.0 * normal(rng)}},
            {{5.0, -7.0, 11.0}}};
  }
  ArmParameters parameters() {
    ArmParameters parameters{};
    for (std::size_t k = 0; k < parameters.size(); ++k)
      parameters[k] = normal(rng) * (kArmPriorSigma[k] > 0.0 ? kArmPriorSigma[k] : 0.1);
    return parameters;
  }
  RawJoints raw() {
    RawJoints raw;
    for (double& angle_rad : raw) angle_rad = 0.5 * normal(rng);
    return raw;
  }
};

TEST(ArmParameters, GiveTheStartArmAtZero) {
  AnyArm any;
  const ArmStart start = any.start(kPhantomModels[3]);
  const MeasuredArm arm = armOf(start, {});
  const RawJoints raw = any.raw();
  const MeasuredArm model{start.geometry, {}, start.X_WD};
  EXPECT_LT(glm::distance(arm.tip_W(raw).mm, model.tip_W(raw).mm), 1e-12);
}

TEST(ArmParameters, HaveTheJacobianOfDifferences) {
  AnyArm any;
  for (int round = 0; round < 40; ++round) {
    const ArmStart start = any.start(kPhantomModels[static_cast<std::size_t>(round % 4)]);
    const ArmParameters parameters = any.parameters();
    const RawJoints raw = any.raw();
    const TipJacobian slopes = tipJacobian(start, parameters, raw);
    EXPECT_LT(glm::distance(slopes.tip_W_mm, armOf(start, parameters).tip_W(raw).mm), 1e-10);
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      ArmParameters more = parameters, less = parameters;
      const double step = 1e-5;
      more[k] += step, less[k] -= step;
      const glm::dvec3 by_difference =
          (armOf(start, more).tip_W(raw).mm - armOf(start, less).tip_W(raw).mm) / (2.0 * step);
      EXPECT_LT(glm::distance(slopes.by_parameter[k], by_difference), 1e-5) << "parameter " << k;
    }
  }
}

TEST(ArmParameters, AreSixFifteenAndTwentyEight) {
  EXPECT_EQ(parametersOf(ArmModel::rigid).size(), 6u);
  EXPECT_EQ(parametersOf(ArmModel::joint_gains).size(), 15u);
  EXPECT_EQ(parametersOf(ArmModel::full).size(), 28u);
}

}  // namespace
}  // namespace calibration
