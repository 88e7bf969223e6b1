// The calibration through a webcam, step by step, without window, camera or clock: the screen's F must read right, the
// lens is measured on the shown board, then from three positions the board or a Gray code and, on a dark screen, the
// lit tip at 27 places each. States what the screen must show, the instruction, and whether it expects a press or an
// image; the result is a set of observations. Frames W and C, mm, px, rad. One thread; an image takes 10 ms to 2 s.
// Source: reference/calibration 2.3.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibration/fit/target_plan.h"
#include "calibration/rig.h"
#include "calibration/webcam/board.h"
#include "calibration/webcam/gray_code.h"
#include "calibration/webcam/intrinsics.h"
#include "calibration/webcam/webcam_file.h"

namespace app {

struct WebcamPlan {
  calibration::Rig rig;            ///< nominal screen, mirror and eyes
  calibration::TargetPlan places;  ///< "webcam27"
  int positions = 3, lens_views = 12;
  std::optional<calibration::CameraModel> lens;  ///< known: it is not measured again
  bool gray_code = false;                        ///< false: the board
  std::string device_model = "omni", serial, mount;
};

enum class WebcamStep { letter, lens, pattern, without_tip, tips, done };
enum class WebcamInput { press, image, nothing };

class WebcamProcedure {
 public:
  /// Throws CalibrationError: a screen too small for the board, no places, fewer than two positions, a
  /// virtual screen that is not the plane z = 0 of W.
  explicit WebcamProcedure(const WebcamPlan& plan);

  WebcamStep step() const { return step_; }
  WebcamInput expects() const;
  const std::string& sentence() const { return sentence_; }  ///< the one thing to do
  const std::string& answer() const { return answer_; }      ///< to the last image: why it was not taken; or empty
  /// For the framebuffer as it is; right way round by the rig's corners.
  const calibration::GreyImage& shown() const { return shown_; }
  /// Current target of the tip.
  std::optional<calibration::Target> target() const;
  int position() const { return static_cast<int>(observations_.positions.size()); }  ///< from 1
  double progress() const;                                                           ///< 0 to 1

  /// The technician is ready: the camera stands, the tip is in its place.
  void press();
  /// Taken while shown() had been on the screen for two frames; `joints_rad` as the sensors read meanwhile.
  void see(const calibration::GreyImage& image, const calibration::RawJoints& joints_rad);
  /// The last tip is taken again; nothing where there is none at this position.
  void undo();

  /// Of the lens, once measured here.
  const std::optional<calibration::Intrinsics>& lens() const { return lens_; }
  /// All that was gathered; complete once expects() nothing.
  const calibration::WebcamObservations& observations() const { return observations_; }

 private:
  void turnTo(WebcamStep step);
  void show(const calibration::GreyImage& as_seen);
  void checkLetter(const calibration::GreyImage& image);
  void checkLens(const calibration::GreyImage& image);
  void checkPattern(const calibration::GreyImage& image);
  void checkTip(const calibration::GreyImage& image, const calibration::RawJoints& joints_rad);

  WebcamPlan plan_;
  calibration::ScreenCorners screen_;
  calibration::ShownBoard board_;
  calibration::GrayCode code_;
  std::vector<calibration::GreyImage> patterns_, seen_patterns_;
  calibration::GreyImage dark_, without_tip_;
  std::vector<calibration::BoardView> views_;
  std::optional<calibration::Intrinsics> lens_;
  calibration::WebcamObservations observations_;

  WebcamStep step_ = WebcamStep::letter;
  bool pressed_ = false;
  std::optional<glm::ivec2> image_px_;  ///< size of the first image, required of all
  std::string sentence_, answer_;
  calibration::GreyImage shown_;
};

}  // namespace app
