#include "calibration/webcam/webcam_fit.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibration/fit/target_plan.h"
#include "tests/calibration/synthetic/synthetic_observations.h"
#include "tests/refusal.h"

namespace calibration {
namespace {

using testing::HasSubstr;

struct Judged {
  SyntheticRig rig;
  WebcamObservations observations;
  std::vector<Touch> held_out;

  Judged(std::uint32_t seed, const WebcamCare& care, Scenario scenario = Scenario::d)
      : rig(syntheticRig(scenario, seed)) {
    std::mt19937 rng(seed);
    observations = syntheticObservations(rig, targetPlan("webcam27").value(), care, rng);
    held_out = heldOutTouches(rig, 200, {60, 40, 30}, rng);
  }
  double error_mm(const MeasuredArm& arm) const {
    double sum = 0.0;
    for (const Touch& touch : held_out) {
      const glm::dvec3 off = arm.tip_W(touch.joints_rad).mm - touch.target_W.mm;
      sum += glm::dot(off, off);
    }
    return std::sqrt(sum / double(held_out.size()));
  }
};

struct Figures {
  double median_mm, worst_mm;
};
Figures figures(std::vector<double> errors_mm) {
  std::ranges::sort(errors_mm);
  return {errors_mm[errors_mm.size() / 2], errors_mm.back()};
}

Figures heldOutOf(const WebcamCare& care, ArmModel model) {
  std::vector<double> errors_mm;
  for (std::uint32_t seed = 1; seed <= 12; ++seed) {
    const Judged charted(seed, care);
    errors_mm.push_back(charted.error_mm(fitWebcam(charted.observations, model).arm));
  }
  return figures(errors_mm);
}

TEST(WebcamFit, IsNearlyAsAccurateAsAJig) {
  const Figures fine = heldOutOf(fineWebcam(), ArmModel::full), coarse = heldOutOf(coarseWebcam(), ArmModel::full);
  std::cout << "held out, 12 rigs: 1080p " << fine.median_mm << " (worst " << fine.worst_mm << "), 720p "
            << coarse.median_mm << " (" << coarse.worst_mm << ") mm RMS\n";
  EXPECT_LE(fine.median_mm, 0.35);
  EXPECT_LE(coarse.median_mm, 0.5);
  EXPECT_LE(fine.worst_mm, 0.6);
}

TEST(WebcamFit, GainsFromTheArmsParameters) {
  EXPECT_GT(heldOutOf(fineWebcam(), ArmModel::rigid).median_mm,
            1.6 * heldOutOf(fineWebcam(), ArmModel::full).median_mm);
}

TEST(WebcamFit, FindsTheTruthWithoutNoise) {
  WebcamCare exact = fineWebcam();
  exact.screen_noise_px = exact.tip_noise_px = 1e-3;
  exact.focal_error = exact.centre_error_px = exact.outlier_share = 0.0;
  SyntheticRig rig = syntheticRig(Scenario::b, 5);
  rig.technician.arm_noise_rad = rig.technician.gimbal_noise_rad = 0.0;
  rig.arm.ripple = {};
  std::mt19937 rng(5);
  const WebcamFit fit = fitWebcam(syntheticObservations(rig, targetPlan("webcam27").value(), exact, rng));
  for (const Touch& touch : heldOutTouches(rig, 50, {60, 40, 30}, rng))
    EXPECT_LT(glm::distance(fit.arm.tip_W(touch.joints_rad).mm, touch.target_W.mm), 0.03);
  EXPECT_LT(fit.tip_rms_px, 0.1);
  EXPECT_LT(fit.fre_rms_mm, 0.03);
  EXPECT_EQ(fit.outliers, 0);
}

TEST(WebcamFit, IsRobustToWrongTips) {
  WebcamCare care = fineWebcam();
  care.outlier_share = 0.0;
  Judged charted(4, care);
  const WebcamFit clean = fitWebcam(charted.observations);
  charted.observations.positions[0].tips[3].camera_px += glm::dvec2(40, -25);
  charted.observations.positions[1].tips[20].camera_px += glm::dvec2(-300, 100);
  charted.observations.positions[2].tips[11].camera_px += glm::dvec2(9, 12);
  const WebcamFit wild = fitWebcam(charted.observations);
  EXPECT_EQ(wild.outliers, clean.outliers + 3);
  EXPECT_FALSE(wild.residuals[3].used);
  EXPECT_FALSE(wild.residuals[27 + 20].used);
  EXPECT_FALSE(wild.residuals[54 + 11].used);
  for (const Touch& touch : charted.held_out)
    EXPECT_LT(glm::distance(wild.arm.tip_W(touch.joints_rad).mm, clean.arm.tip_W(touch.joints_rad).mm), 0.3);
  EXPECT_LT(std::abs(charted.error_mm(wild.arm) - charted.error_mm(clean.arm)), 0.05);
}

TEST(WebcamFit, CrossValidatesItsError) {
  for (const WebcamCare& care : {fineWebcam(), coarseWebcam()}) {
    std::vector<double> ratios;
    for (std::uint32_t seed = 1; seed <= 9; ++seed) {
      const Judged charted(seed, care);
      const WebcamFit fit = fitWebcam(charted.observations);
      ratios.push_back(fit.cv_rms_mm / charted.error_mm(fit.arm));
    }
    EXPECT_GT(figures(ratios).median_mm, 0.9);
    EXPECT_LT(figures(ratios).median_mm, 1.4);
    EXPECT_LT(figures(ratios).worst_mm, 2.0);
  }
}

TEST(WebcamFit, FindsTheCameraPoses) {
  const Judged charted(2, fineWebcam());
  const WebcamFit fit = fitWebcam(charted.observations);
  ASSERT_EQ(fit.X_WC.size(), 3U);
  EXPECT_NEAR(fit.baseline_deg, 50.0, 8.0);
  EXPECT_LT(fit.screen_rms_px, 0.5);
  EXPECT_LT(fit.tip_rms_px, 2.0);
  EXPECT_EQ(fit.used + fit.outliers, 81);
  EXPECT_EQ(fit.residuals.size(), 81U);
  EXPECT_GT(fit.tilt_spread_deg, 25.0);
  EXPECT_TRUE(fit.warnings.empty()) << fit.warnings.front().line;
  for (std::size_t i = 0; i < 27; ++i)
    EXPECT_LT(std::abs(glm::dot(glm::normalize(fit.residuals[i].error_mm.xyz),
                                glm::normalize(fit.residuals[i].target_W.mm - fit.X_WC[0].translation_mm))),
              0.05)
        << "nothing is said along the line of sight";
}

TEST(WebcamFit, IsFarBetterThanOnePositionAlone) {
  std::vector<double> alone, together;
  for (std::uint32_t seed = 1; seed <= 9; ++seed) {
    const Judged charted(seed, fineWebcam());
    alone.push_back(charted.error_mm(armFromOnePosition(charted.observations, 0)));
    together.push_back(charted.error_mm(fitWebcam(charted.observations).arm));
  }
  std::cout << "one position alone, arm as its model: " << figures(alone).median_mm << " mm RMS\n";
  EXPECT_GT(figures(alone).median_mm, 1.0);
  EXPECT_LT(figures(together).median_mm, 0.25 * figures(alone).median_mm);
}

std::string refusal(const WebcamObservations& observations) {
  return tests::refusalOf<CalibrationError>([&] { fitWebcam(observations); });
}

TEST(WebcamFit, RefusesInsufficientObservations) {
  const WebcamObservations good = Judged(3, fineWebcam()).observations;
  EXPECT_EQ(refusal(good), "accepted");

  WebcamObservations observations = good;
  observations.positions.resize(1);
  EXPECT_THAT(refusal(observations), HasSubstr("one camera position"));

  observations = good;
  for (CameraPosition& position : observations.positions) position.tips.resize(5);
  EXPECT_THAT(refusal(observations), HasSubstr("15 tips are too few"));

  observations = good;
  observations.positions = {good.positions[0], good.positions[0]};
  EXPECT_THAT(refusal(observations), HasSubstr("positions are the same"));

  observations = good;
  observations.positions[1].tips[4].camera_px.x = std::nan("");
  EXPECT_THAT(refusal(observations), HasSubstr("not finite"));

  observations = good;
  observations.positions[0].screen.resize(3);
  EXPECT_THAT(refusal(observations), HasSubstr("screen"));

  observations = good;
  observations.device_model = "novint";
  EXPECT_THAT(refusal(observations), HasSubstr("novint"));
}

TEST(WebcamFit, RefusesAMirroredScreen) {
  for (std::uint32_t seed = 1; seed <= 6; ++seed) {
    WebcamObservations observations = Judged(seed, fineWebcam()).observations;
    for (CameraPosition& position : observations.positions)
      for (ScreenObservation& observation : position.screen) observation.position_W.mm.x = -observation.position_W.mm.x;
    EXPECT_THAT(refusal(observations), HasSubstr("mirrored"));
  }
}

TEST(WebcamFit, RefusesTouchesOfOtherImages) {
  WebcamObservations observations = Judged(6, fineWebcam()).observations;
  for (CameraPosition& position : observations.positions) {
    std::vector<TipObservation>& tips = position.tips;
    for (std::size_t i = 0; i + 1 < tips.size(); ++i)
      std::swap(tips[i].camera_px, tips[(i * 7 + 3) % tips.size()].camera_px);
  }
  EXPECT_THAT(refusal(observations), HasSubstr("belong together"));
}

TEST(WebcamFit, WarnsOfFewTipsOneTiltAndNarrowViews) {
  const auto kinds = [](const WebcamObservations& observations) {
    std::vector<FitWarning::Kind> found;
    for (const FitWarning& warning : fitWebcam(observations).warnings) found.push_back(warning.kind);
    return found;
  };
  WebcamObservations observations = Judged(3, fineWebcam()).observations;
  for (CameraPosition& position : observations.positions) {
    std::vector<TipObservation> some;
    for (std::size_t i = 0; i < position.tips.size(); i += 3) some.push_back(position.tips[i]);
    position.tips = some;
  }
  EXPECT_THAT(kinds(observations), testing::Contains(FitWarning::Kind::few_touches));
  EXPECT_THAT(kinds(Judged(3, fineWebcam(), Scenario::e).observations),
              testing::Contains(FitWarning::Kind::little_tilt));
}

}  // namespace
}  // namespace calibration
