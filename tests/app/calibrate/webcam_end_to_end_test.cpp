// From pixels to a measured arm: images of a workstation whose truth is known, through lens, mirror and glass, read
// as a camera's are, one adjustment over all, judged by touches that it has not seen. Some seconds each.
#include <cmath>
#include <iostream>
#include <random>

#include <gtest/gtest.h>

#include "app/calibrate/webcam_procedure.h"
#include "app/calibrate/webcam_technician.h"
#include "calibration/synthetic/synthetic_rig.h"
#include "calibration/webcam/ring_image.h"
#include "calibration/webcam/webcam_fit.h"
#include "tests/calibration/synthetic/glass_formulas.h"
#include "tests/calibration/webcam/ring_check.h"

namespace app {
namespace {

using namespace calibration;

struct Outcome {
  WebcamFit fit;
  WebcamObservations observations;
  double held_out_rms_mm = 0.0, worst_mm = 0.0;
  Vector<World> mean_mm;
  RingCheck ring;
};

/// Believed focal length and centre of a lens are never quite the true ones.
CameraModel nearly(CameraModel lens) {
  lens.focal_px *= 1.001;
  lens.centre_px += glm::dvec2(0.8, -0.6);
  return lens;
}

/// Rings at eight places that were not calibrated with, from where the webcam stands now.
RingCheck ringsSeen(const WebcamFit& fit, const SyntheticRig& rig, const std::vector<Touch>& touches,
                    WebcamTechnician& technician) {
  const Pose<World, Camera>& X_WC = fit.X_WC.back();
  const GreyImage dark = technician.taken(nullptr, {});
  std::vector<Vector<Camera>> offsets_mm;
  for (const Touch& touch : touches) {
    const Point<World> believed_W = fit.arm.tip_W(touch.joints_rad);
    const GreyImage ring = ringImage(rig.nominal, {X_WC.translation_mm}, believed_W);
    const RingDetection both = detectRing(dark, technician.taken(&ring, LitTip{.middle_W = touch.target_W}));
    EXPECT_EQ(both.line, "");
    offsets_mm.push_back(ringOffset_mm(fit.camera, both, (X_WC.inverse() * believed_W).mm.z));
  }
  return judgedRing(offsets_mm);
}

Outcome calibrated(glm::ivec2 camera_px, std::uint32_t seed, double plate_mm) {
  const SyntheticRig rig = syntheticRig(Scenario::d, seed);
  WebcamTechnician technician(rig, camera_px, seed + 100, plate_mm);
  WebcamProcedure procedure({.rig = rig.nominal,
                             .places = *targetPlan("webcam27"),
                             .positions = 3,
                             .lens_views = 12,
                             .lens = nearly(technician.lens()),
                             .gray_code = false,
                             .device_model = rig.nominal.device->model,
                             .serial = "",
                             .mount = ""});
  for (int i = 0; i < 1000 && procedure.expects() != WebcamInput::nothing; ++i) technician.act(procedure);
  EXPECT_EQ(procedure.expects(), WebcamInput::nothing) << procedure.sentence() << " " << procedure.answer();

  Outcome outcome{.fit = fitWebcam(procedure.observations()),
                  .observations = procedure.observations(),
                  .held_out_rms_mm = 0.0,
                  .worst_mm = 0.0,
                  .mean_mm = {},
                  .ring = {}};
  std::mt19937 rng(seed + 1000);
  const std::vector<Touch> held_out = heldOutTouches(rig, 400, {60.0, 40.0, 30.0}, rng);
  double square = 0.0;
  const double n = static_cast<double>(held_out.size());
  for (const Touch& touch : held_out) {
    const glm::dvec3 error = outcome.fit.arm.tip_W(touch.joints_rad).mm - touch.target_W.mm;
    outcome.mean_mm.xyz += error / n;
    square += glm::dot(error, error) / n;
    outcome.worst_mm = std::max(outcome.worst_mm, glm::length(error));
  }
  outcome.held_out_rms_mm = std::sqrt(square);
  outcome.ring = ringsSeen(outcome.fit, rig, {held_out.begin(), held_out.begin() + kRingPlaces}, technician);
  std::cout << camera_px.x << " x " << camera_px.y << ", plate " << plate_mm << " mm, rig " << seed << ": held out "
            << outcome.held_out_rms_mm << " mm RMS, worst " << outcome.worst_mm << ", mean (" << outcome.mean_mm.xyz.x
            << ", " << outcome.mean_mm.xyz.y << ", " << outcome.mean_mm.xyz.z << "), tips " << outcome.fit.tip_rms_px
            << " px, screen " << outcome.fit.screen_rms_px << " px, cross-validated " << outcome.fit.cv_rms_mm
            << " mm, outliers " << outcome.fit.outliers << "; " << outcome.ring.line << "\n";
  return outcome;
}

TEST(WebcamEndToEnd, PicturesOf1080LinesMeasureTheArm) {
  const Outcome outcome = calibrated({1920, 1080}, 1, 0.0);
  EXPECT_LT(outcome.held_out_rms_mm, 0.35);
  EXPECT_LT(outcome.ring.mean_mm, 0.5);
}

TEST(WebcamEndToEnd, PicturesOf720LinesMeasureTheArm) {
  const Outcome outcome = calibrated({1280, 720}, 2, 0.0);
  EXPECT_LT(outcome.held_out_rms_mm, 0.5);
}

TEST(WebcamEndToEnd, ThroughTheGlassItMeasuresWhereTheTipIsSeen) {
  // 3 mm of glass at 45 degrees lift what is behind it towards the eye: the arm is put where its tip is seen.
  const Outcome outcome = calibrated({1280, 720}, 3, 3.0);
  const Plane<World> face = *syntheticRig(Scenario::d, 3).nominal.mirror;
  const double angle = radFromDegrees(45.0);
  const glm::dvec3 lifted_mm = plateShift_mm({face, 3.0}, angle) / std::sin(angle) * face.normal;
  EXPECT_LT(glm::distance(outcome.mean_mm.xyz, lifted_mm), 0.3);
  const double about_mean_mm =
      std::sqrt(outcome.held_out_rms_mm * outcome.held_out_rms_mm - glm::dot(outcome.mean_mm.xyz, outcome.mean_mm.xyz));
  EXPECT_LT(about_mean_mm, 0.4);
  EXPECT_TRUE(outcome.ring.passed) << outcome.ring.line;
  EXPECT_LT(outcome.ring.mean_mm, 0.5);
}

}  // namespace
}  // namespace app
