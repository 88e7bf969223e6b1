// A simulated technician with a webcam at a workstation with known errors: follows the webcam procedure and renders its
// camera images through lens, mirror and glass. For practice, demonstration and tests. Frames W and C, mm, px, rad.
// Deterministic for a seed. One thread; an image of 1080p takes 20 to 300 ms.
#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "app/calibrate/webcam_procedure.h"
#include "calibration/synthetic/synthetic_rig.h"
#include "calibration/synthetic/webcam_image.h"

namespace app {

class WebcamTechnician {
 public:
  /// The workstation as the rig's nominal one; `plate_mm`: glass of its mirror that the stylus is seen through.
  WebcamTechnician(const calibration::SyntheticRig& rig, glm::ivec2 camera_px, std::uint32_t seed,
                   double plate_mm = 0.0);

  const calibration::CameraModel& lens() const { return webcam_.model; }
  /// Where the webcam was put at a position, from 0.
  const calibration::Pose<calibration::World, calibration::Camera>& webcamPose(std::size_t position) const {
    return webcam_poses_[position];
  }

  /// Follows the current request: gets ready and presses, or takes the image.
  void act(WebcamProcedure& procedure);

  /// Moves only the webcam as requested, for a person who holds the stylus.
  void placeWebcamFor(const WebcamProcedure& procedure);
  /// What the webcam sees of what the procedure shows, with the tip lit, if any.
  calibration::GreyImage image(const WebcamProcedure& procedure,
                               const std::optional<calibration::Point<calibration::World>>& tip_W);
  /// From where the webcam stands now; no framebuffer: the screen is dark.
  calibration::GreyImage taken(const calibration::GreyImage* shown, const std::optional<calibration::LitTip>& tip);

 private:
  void getReady(const WebcamProcedure& procedure);
  void holdForLens();
  void placeWebcam(double aside_deg);
  void updateView();

  calibration::SyntheticRig rig_;
  std::mt19937 rng_;
  calibration::Webcam webcam_;
  double plate_mm_;
  std::optional<calibration::WebcamRenderer> view_;
  std::optional<calibration::Touch> touch_;
  std::vector<calibration::Pose<calibration::World, calibration::Camera>> webcam_poses_;
  int views_ = 0;
  std::uint64_t pictures_ = 0;
};

}  // namespace app
