#include "app/calibrate/webcam_procedure.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "calibration/webcam/flip_check.h"
#include "calibration/webcam/ring_image.h"
#include "calibration/webcam/tip_spot.h"

namespace app {

namespace {

using calibration::BoardDetection;
using calibration::BoardView;
using calibration::CodeDetection;
using calibration::GreyImage;

/// Views of the lens must differ by this share of the image's width at some corner.
constexpr double kNewView = 0.06;
/// Noise of a detected tip, one sigma per axis: hand, exposure and shading of the ball.
constexpr double kTipNoise_px = 0.3, kBoardNoise_px = 0.25;
constexpr double kFlat_mm = 0.01;  ///< of the virtual screen: W lies in it

bool isNew(const BoardDetection& detection, const std::vector<BoardView>& views, double width_px) {
  return std::ranges::all_of(views, [&](const BoardView& view) {
    double farthest = 0.0;
    for (std::size_t i = 0; i < view.corners_px.size(); ++i)
      farthest = std::max(farthest, glm::distance(view.corners_px[i], detection.corners_px[i]));
    return farthest > kNewView * width_px;
  });
}

std::string cameraPosition(int position) {
  constexpr std::array<const char*, 3> kPlaces = {"at the surgeon's eyes", "25° further to the right",
                                                  "25° to the left of the eyes"};
  const auto which = static_cast<std::size_t>(std::clamp(position - 1, 0, 2));
  return kPlaces[which];
}

}  // namespace

WebcamProcedure::WebcamProcedure(const WebcamPlan& plan)
    : plan_(plan), screen_(calibration::seenScreen(plan.rig)), board_(calibration::boardFor(screen_.px)) {
  if (plan_.positions < 2)
    throw calibration::CalibrationError("webcam procedure: one position does not determine depth, take three");
  if (plan_.places.targets.empty())
    throw calibration::CalibrationError("webcam procedure: no places for the tip, take webcam27");
  for (const calibration::Point<calibration::World>& corner :
       {screen_.lower_left, screen_.lower_right, screen_.upper_left})
    if (std::abs(corner.mm.z) > kFlat_mm)
      throw calibration::CalibrationError(
          "webcam procedure: the virtual screen is not the plane z = 0 of W, correct screen and mirror in the rig "
          "file");
  code_.screen_px = screen_.px;
  if (plan_.gray_code) {
    patterns_ = calibration::patternImages(code_);
  } else {
    patterns_ = {calibration::boardImage(board_)};
  }
  dark_.size_px = screen_.px;
  dark_.grey.assign(static_cast<std::size_t>(screen_.px.x) * static_cast<std::size_t>(screen_.px.y), 0);
  observations_.device_model = plan_.device_model;
  observations_.screen_noise_px = kBoardNoise_px;
  observations_.tip_noise_px = kTipNoise_px;
  observations_.serial = plan_.serial;
  observations_.mount = plan_.mount;
  turnTo(WebcamStep::letter);
}

WebcamInput WebcamProcedure::expects() const {
  if (step_ == WebcamStep::done) return WebcamInput::nothing;
  return pressed_ ? WebcamInput::image : WebcamInput::press;
}

std::optional<calibration::Target> WebcamProcedure::target() const {
  if (step_ != WebcamStep::tips) return std::nullopt;
  return plan_.places.targets[observations_.positions.back().tips.size()];
}

double WebcamProcedure::progress() const {
  // Each view of the lens, pattern and tip counts as one image.
  const double a_position = 1.0 + static_cast<double>(plan_.places.targets.size());
  const double lens = plan_.lens ? 0.0 : plan_.lens_views;
  double done = lens_ ? lens : static_cast<double>(views_.size());
  for (const calibration::CameraPosition& position : observations_.positions)
    done += (position.screen.empty() ? 0.0 : 1.0) + static_cast<double>(position.tips.size());
  return std::min(1.0, done / (lens + plan_.positions * a_position));
}

void WebcamProcedure::show(const GreyImage& as_seen) { shown_ = calibration::framebufferFor(plan_.rig, as_seen); }

void WebcamProcedure::turnTo(WebcamStep step) {
  step_ = step;
  pressed_ = false;
  switch (step) {
    case WebcamStep::letter:
      show(calibration::letterF(screen_.px));
      sentence_ = "Clamp the webcam " + cameraPosition(1) + " so that it sees the whole screen" +
                  (plan_.rig.mirror ? " in the mirror" : "") + ", then press.";
      return;
    case WebcamStep::lens:
      show(calibration::boardImage(board_));
      sentence_ = "Hold the webcam still, another view each time, tilted 20 to 40°, then press: view " +
                  std::to_string(views_.size() + 1) + " of " + std::to_string(plan_.lens_views) + ".";
      return;
    case WebcamStep::pattern:
      seen_patterns_.clear();
      show(patterns_.front());
      sentence_ = "Clamp the webcam " + cameraPosition(position()) + ", take the stylus out of its sight, then press.";
      return;
    case WebcamStep::without_tip:
      show(dark_);
      sentence_ = "Keep the stylus out of sight.";
      pressed_ = true;
      return;
    case WebcamStep::tips:
      // The target as a flat ring, for displays without stereo.
      shown_ = calibration::ringImage(plan_.rig, plan_.rig.cyclopeanEye(), target()->position_W);
      sentence_ = "Light the tip, hold it at the ring, then press: " +
                  std::to_string(observations_.positions.back().tips.size() + 1) + " of " +
                  std::to_string(plan_.places.targets.size()) + ".";
      return;
    case WebcamStep::done:
      show(dark_);
      sentence_ = "All is gathered.";
      return;
  }
}

void WebcamProcedure::press() {
  if (step_ == WebcamStep::done) return;
  answer_.clear();
  pressed_ = true;
  if (step_ == WebcamStep::tips) show(dark_);
}

void WebcamProcedure::see(const GreyImage& image, const calibration::RawJoints& joints_rad) {
  if (expects() != WebcamInput::image) return;
  answer_.clear();
  if (!image_px_) image_px_ = plan_.lens ? plan_.lens->size_px : image.size_px;
  if (image.size_px != *image_px_) {
    answer_ = "The picture is " + std::to_string(image.size_px.x) + " x " + std::to_string(image.size_px.y) +
              ": set the webcam to " + std::to_string(image_px_->x) + " x " + std::to_string(image_px_->y) + ".";
    return turnTo(step_);
  }
  switch (step_) {
    case WebcamStep::letter:
      return checkLetter(image);
    case WebcamStep::lens:
      return checkLens(image);
    case WebcamStep::pattern:
      return checkPattern(image);
    case WebcamStep::without_tip:
      without_tip_ = image;
      return turnTo(WebcamStep::tips);
    case WebcamStep::tips:
      return checkTip(image, joints_rad);
    case WebcamStep::done:
      return;
  }
}

void WebcamProcedure::checkLetter(const GreyImage& image) {
  const auto reading = calibration::orientationOfF(image);
  if (!reading || !reading->isUpright()) {
    answer_ = reading ? calibration::remedyFor(*reading)
                      : "No F can be read: show all of the screen to the webcam, sharp, level within 40°.";
    return turnTo(WebcamStep::letter);
  }
  if (!plan_.lens) return turnTo(WebcamStep::lens);
  observations_.camera = *plan_.lens;
  observations_.positions.emplace_back();
  turnTo(WebcamStep::pattern);
}

void WebcamProcedure::checkLens(const GreyImage& image) {
  const BoardDetection detection = calibration::findBoard(image, board_);
  if (detection.trouble) {
    answer_ = detection.line;
  } else if (!isNew(detection, views_, image.size_px.x)) {
    answer_ = "This view is like one before: move or tilt the webcam.";
  } else {
    views_.push_back({"view " + std::to_string(views_.size() + 1), detection.corners_px});
  }
  if (views_.size() < static_cast<std::size_t>(plan_.lens_views)) return turnTo(WebcamStep::lens);

  std::vector<glm::dvec2> positions_mm;
  for (const glm::dvec2& px : board_.cornerPositions_px())
    positions_mm.emplace_back(calibration::positionOn(screen_, px).mm);
  try {
    lens_ = calibration::fitIntrinsics(image.size_px, positions_mm, views_);
  } catch (const calibration::CalibrationError& error) {
    answer_ = error.what();
    views_.clear();
    return turnTo(WebcamStep::lens);
  }
  plan_.lens = lens_->camera;
  observations_.camera = lens_->camera;
  observations_.positions.emplace_back();
  turnTo(WebcamStep::pattern);
}

void WebcamProcedure::checkPattern(const GreyImage& image) {
  seen_patterns_.push_back(image);
  // One press takes the whole code.
  if (seen_patterns_.size() < patterns_.size()) return show(patterns_[seen_patterns_.size()]);

  std::vector<glm::dvec2> screen_px, camera_px;
  if (plan_.gray_code) {
    const CodeDetection detection = calibration::decoded(code_, seen_patterns_);
    answer_ = detection.line;
    for (const calibration::ScreenCorrespondence& one : detection.correspondences) {
      screen_px.push_back(one.screen_px);
      camera_px.push_back(one.camera_px);
    }
  } else {
    const BoardDetection detection = calibration::findBoard(image, board_);
    answer_ = detection.line;
    camera_px = detection.corners_px;
    if (!camera_px.empty()) screen_px = board_.cornerPositions_px();
  }
  if (camera_px.empty()) return turnTo(WebcamStep::pattern);
  calibration::CameraPosition& position = observations_.positions.back();
  for (std::size_t i = 0; i < screen_px.size(); ++i)
    position.screen.push_back({{{glm::dvec2(calibration::positionOn(screen_, screen_px[i]).mm), 0.0}}, camera_px[i]});
  turnTo(WebcamStep::without_tip);
}

void WebcamProcedure::checkTip(const GreyImage& image, const calibration::RawJoints& joints_rad) {
  const calibration::TipSpot spot = calibration::findTipSpot(without_tip_, image);
  calibration::CameraPosition& position = observations_.positions.back();
  if (spot.trouble) {
    answer_ = spot.line;
    return turnTo(WebcamStep::tips);
  }
  position.tips.push_back({target()->id, joints_rad, spot.centre_px});
  if (position.tips.size() < plan_.places.targets.size()) return turnTo(WebcamStep::tips);
  if (observations_.positions.size() == static_cast<std::size_t>(plan_.positions)) return turnTo(WebcamStep::done);
  observations_.positions.emplace_back();
  turnTo(WebcamStep::pattern);
}

void WebcamProcedure::undo() {
  if (step_ != WebcamStep::tips || observations_.positions.back().tips.empty()) return;
  observations_.positions.back().tips.pop_back();
  turnTo(WebcamStep::tips);
}

}  // namespace app
