#include "calibration/webcam/webcam_start.h"

#include <cmath>
#include <string>

#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

#include "calibration/arm/phantom_models.h"
#include "calibration/geometry/rotation.h"

namespace calibration {
namespace {

constexpr double kMaxScreenRms_px = 3.0;
/// Error of a nominal arm, three sigma; the search goes up to four times that.
constexpr double kNominalArm_mm = 2.5;
constexpr int kTries = 600;

struct Lens {
  cv::Matx33d K;
  cv::Vec4d bent;

  explicit Lens(const CameraModel& camera)
      : K(camera.focal_px.x, 0.0, camera.centre_px.x, 0.0, camera.focal_px.y, camera.centre_px.y, 0.0, 0.0, 1.0),
        bent(camera.k1, camera.k2, camera.p1, camera.p2) {}
};

[[noreturn]] void refusePosition(std::size_t position, const std::string& what, const std::string& mend) {
  throw CalibrationError("webcam, camera position " + std::to_string(position + 1) + ": " + what + ", " + mend);
}

cv::Point3d pointOf(const glm::dvec3& mm) { return {mm.x, mm.y, mm.z}; }
cv::Point2d pixelOf(const glm::dvec2& px) { return {px.x, px.y}; }

/// X_C?: OpenCV's rotation and translation.
template <class To>
Pose<Camera, To> poseOf(const cv::Vec3d& rotation, const cv::Vec3d& shift) {
  return {rotationFromVector({rotation[0], rotation[1], rotation[2]}), {shift[0], shift[1], shift[2]}};
}

}  // namespace

Pose<Camera, World> cameraSeeing(const WebcamObservations& observations, std::size_t position) {
  const Lens lens(observations.camera);
  std::vector<cv::Point3d> positions;
  std::vector<cv::Point2d> pixels;
  for (const ScreenObservation& observation : observations.positions[position].screen) {
    positions.push_back(pointOf(observation.position_W.mm));
    pixels.push_back(pixelOf(observation.camera_px));
  }
  cv::Vec3d rotation, shift;
  try {
    if (!cv::solvePnP(positions, pixels, lens.K, lens.bent, rotation, shift, false, cv::SOLVEPNP_IPPE))
      refusePosition(position, "no camera pose explains the screen", "take the images again");
    cv::solvePnPRefineLM(positions, pixels, lens.K, lens.bent, rotation, shift);
  } catch (const cv::Exception&) {
    refusePosition(position, "the screen points are not flat or lie on a line", "show the whole board");
  }
  const auto X_CW = poseOf<World>(rotation, shift);
  if (X_CW.inverse().translation_mm.z <= 0.0)
    refusePosition(position, "the screen is seen mirrored", "correct the screen's corners in the rig file");

  double sum = 0.0;
  for (const ScreenObservation& observation : observations.positions[position].screen) {
    const glm::dvec2 off = observations.camera.pixelOf(X_CW * observation.position_W) - observation.camera_px;
    sum += glm::dot(off, off);
  }
  if (!(std::sqrt(sum / double(positions.size())) < kMaxScreenRms_px))
    refusePosition(position, "no camera pose explains the screen", "measure the lens again, keep the zoom locked");
  return X_CW;
}

Pose<World, Device> deviceSeen(const WebcamObservations& observations, std::size_t position,
                               const Pose<Camera, World>& X_CW) {
  const Lens lens(observations.camera);
  MeasuredArm nominal;
  nominal.geometry = findPhantomModel(observations.device_model)->geometry;
  std::vector<cv::Point3d> tips;
  std::vector<cv::Point2d> pixels;
  for (const TipObservation& observation : observations.positions[position].tips) {
    tips.push_back(pointOf(nominal.tip_W(observation.joints_rad).mm));  // X_WD is identity: in D
    pixels.push_back(pixelOf(observation.camera_px));
  }

  // Widen the limit until enough tips agree.
  const double px_per_mm = observations.camera.focal_px.x / glm::length(X_CW.translation_mm);
  for (const double wider : {1.0, 2.0, 4.0}) {
    cv::Vec3d rotation, shift;
    std::vector<int> agreeing;
    try {
      const double limit_px = 3.0 * observations.tip_noise_px + wider * kNominalArm_mm * px_per_mm;
      if (!cv::solvePnPRansac(tips, pixels, lens.K, lens.bent, rotation, shift, false, kTries,
                              static_cast<float>(limit_px), 0.999, agreeing, cv::SOLVEPNP_SQPNP))
        continue;
      if (3 * agreeing.size() < 2 * tips.size()) continue;
      std::vector<cv::Point3d> their_tips;
      std::vector<cv::Point2d> their_pixels;
      for (const int i : agreeing) {
        their_tips.push_back(tips[static_cast<std::size_t>(i)]);
        their_pixels.push_back(pixels[static_cast<std::size_t>(i)]);
      }
      cv::solvePnPRefineLM(their_tips, their_pixels, lens.K, lens.bent, rotation, shift);
    } catch (const cv::Exception&) {
      continue;
    }
    return X_CW.inverse() * poseOf<Device>(rotation, shift);
  }
  refusePosition(position, "no device pose explains where the tip is seen",
                 "check that touches and images belong together and that the device is the right one");
}

}  // namespace calibration
