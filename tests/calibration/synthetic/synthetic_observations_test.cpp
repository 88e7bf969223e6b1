#include "tests/calibration/synthetic/synthetic_observations.h"

#include <gtest/gtest.h>

#include "calibration/geometry/units.h"

namespace calibration {
namespace {

TargetPlan positions() { return targetPlan("webcam27").value(); }

TEST(WebcamObservations, SeesScreenAndTipsFromThreePositions) {
  for (const WebcamCare& care : {fineWebcam(), coarseWebcam()})
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
      std::mt19937 rng(seed);
      const WebcamObservations observations =
          syntheticObservations(syntheticRig(Scenario::d, seed), positions(), care, rng);
      ASSERT_EQ(observations.positions.size(), 3u);
      for (const CameraPosition& position : observations.positions) {
        EXPECT_EQ(position.tips.size(), 27u);
        EXPECT_GE(position.screen.size(), 50u);
        const auto within = [&](const glm::dvec2& px) {
          return px.x > 0.0 && px.y > 0.0 && px.x < care.camera.size_px.x && px.y < care.camera.size_px.y;
        };
        for (const ScreenObservation& observation : position.screen) EXPECT_TRUE(within(observation.camera_px));
        for (const TipObservation& observation : position.tips)
          EXPECT_TRUE(within(observation.camera_px)) << observation.id;
      }
    }
}

TEST(WebcamObservations, DependOnRigAndSeed) {
  const SyntheticRig rig = syntheticRig(Scenario::d, 4);
  std::mt19937 a(1), b(1), c(2);
  const WebcamObservations one = syntheticObservations(rig, positions(), fineWebcam(), a);
  const WebcamObservations same = syntheticObservations(rig, positions(), fineWebcam(), b);
  const WebcamObservations other = syntheticObservations(rig, positions(), fineWebcam(), c);
  EXPECT_EQ(one.positions[1].tips[5].camera_px, same.positions[1].tips[5].camera_px);
  EXPECT_NE(one.positions[1].tips[5].camera_px, other.positions[1].tips[5].camera_px);
  EXPECT_EQ(one.device_model, "omni");
}

TEST(WebcamObservations, AreUprightInTheImage) {
  // Without noise the corner at the screen's lower left is at the image's lower left, for all positions.
  WebcamCare exact = fineWebcam();
  exact.screen_noise_px = exact.tip_noise_px = exact.focal_error = exact.centre_error_px = exact.outlier_share = 0.0;
  std::mt19937 rng(3);
  const WebcamObservations observations = syntheticObservations(syntheticRig(Scenario::d, 3), positions(), exact, rng);
  EXPECT_EQ(observations.camera.focal_px, exact.camera.focal_px);
  for (const CameraPosition& position : observations.positions) {
    const ScreenObservation &first = position.screen.front(), &last = position.screen.back();
    EXPECT_LT(first.position_W.mm.x, last.position_W.mm.x);
    EXPECT_LT(first.camera_px.x, last.camera_px.x);
    EXPECT_LT(first.position_W.mm.y, last.position_W.mm.y);
    EXPECT_GT(first.camera_px.y, last.camera_px.y);
  }
}

}  // namespace
}  // namespace calibration
