#include "tests/calibration/synthetic/synthetic_observations.h"

#include <cmath>

#include "calibration/random.h"
#include "calibration/synthetic/webcam_image.h"

namespace calibration {
namespace {

constexpr double kBesideTarget_mm = 3.0;  ///< no pit holds the tip, one sigma

/// Corners of a displayed board.
constexpr glm::ivec2 kCorners{13, 8};
constexpr double kSquare_mm = 30.0;

CameraModel believed(const WebcamCare& care, std::mt19937& rng) {
  CameraModel model = care.camera;
  model.focal_px *= 1.0 + gaussian(rng, care.focal_error);
  model.centre_px += glm::dvec2(gaussianVector(rng, care.centre_error_px));
  return model;
}

glm::dvec2 noise_px(double sigma_px, std::mt19937& rng) { return glm::dvec2(gaussianVector(rng, sigma_px)); }

}  // namespace

WebcamCare fineWebcam() {
  WebcamCare care;
  care.camera.k1 = -0.08;
  care.camera.k2 = 0.02;
  return care;
}

WebcamCare coarseWebcam() {
  WebcamCare care = fineWebcam();
  care.camera.size_px = {1280, 720};
  care.camera.focal_px *= 2.0 / 3.0;
  care.camera.centre_px = {639.5, 359.5};
  care.tip_noise_px = 1.0;
  return care;
}

WebcamObservations syntheticObservations(const SyntheticRig& rig, const TargetPlan& plan, const WebcamCare& care,
                                         std::mt19937& rng) {
  // The tip's position is measured by the camera: the touch precision does not matter.
  SyntheticRig held = rig;
  held.technician.precision = {0.0, 0.0};
  held.technician.outlier_share = 0.0;
  TargetPlan about = plan;

  WebcamObservations observations{.camera = believed(care, rng),
                                  .device_model = rig.nominal.device->model,
                                  .screen_noise_px = care.screen_noise_px,
                                  .tip_noise_px = care.tip_noise_px,
                                  .positions = {}};
  for (const double aside_deg : kCameraAside_deg) {
    const Pose<Camera, World> X_CW = roughlyPlacedCamera(rig.nominal, aside_deg, rng).inverse();
    CameraPosition& position = observations.positions.emplace_back();
    for (int row = 0; row < kCorners.y; ++row)
      for (int column = 0; column < kCorners.x; ++column) {
        const Point<World> corner_W{kSquare_mm *
                                    glm::dvec3(column - 0.5 * (kCorners.x - 1), row - 0.5 * (kCorners.y - 1), 0.0)};
        position.screen.push_back(
            {corner_W, care.camera.pixelOf(X_CW * corner_W) + noise_px(care.screen_noise_px, rng)});
      }
    for (std::size_t i = 0; i < plan.targets.size(); ++i)
      about.targets[i].position_W.mm = plan.targets[i].position_W.mm + gaussianVector(rng, kBesideTarget_mm);
    for (const Touch& touch : simulatedTouches(held, about, rng).touches) {
      glm::dvec2 tip_px = care.camera.pixelOf(X_CW * touch.target_W) + noise_px(care.tip_noise_px, rng);
      if (uniform(rng, 0.0, 1.0) < care.outlier_share) {
        const double way_rad = uniform(rng, 0.0, 2.0 * kPi);
        tip_px += uniform(rng, 10.0, 40.0) * glm::dvec2(std::cos(way_rad), std::sin(way_rad));
      }
      position.tips.push_back({touch.id, touch.joints_rad, tip_px});
    }
  }
  return observations;
}

}  // namespace calibration
