#include "app/calibrate/webcam_technician.h"

#include <algorithm>
#include <cmath>

#include "calibration/random.h"

namespace app {
namespace {

using namespace calibration;

constexpr double kAimed_mm = 3.0;  ///< a tip is held this near to the ring, one sigma an axis
constexpr double kGhost = 0.05;

/// An ordinary webcam, 1920 x 1080 or smaller with the same field of view.
Webcam webcamOf(glm::ivec2 size_px) {
  const double scale = size_px.x / 1920.0;
  Webcam webcam;
  webcam.model = {size_px, glm::dvec2(1400.0 * scale), 0.5 * glm::dvec2(size_px) - 0.5, 0.05, -0.1, 0.0005, -0.0004};
  return webcam;
}

}  // namespace

WebcamTechnician::WebcamTechnician(const SyntheticRig& rig, glm::ivec2 camera_px, std::uint32_t seed, double plate_mm)
    : rig_(rig), rng_(seed), webcam_(webcamOf(camera_px)), plate_mm_(plate_mm) {
  rig_.technician.precision = {0.0, 0.0};
  rig_.technician.outlier_share = 0.0;
  placeWebcam(0.0);
}

GreyImage WebcamTechnician::taken(const GreyImage* shown, const std::optional<LitTip>& tip) {
  return view_->image(shown, tip, ++pictures_);
}

GreyImage WebcamTechnician::image(const WebcamProcedure& procedure, const std::optional<Point<World>>& tip_W) {
  // Two shades of the ball, as a lamp from above makes them.
  const auto tip = tip_W ? std::optional(LitTip{.middle_W = *tip_W, .lamp_share = 0.2}) : std::nullopt;
  const GreyImage& shown = procedure.shown();
  const bool dark = std::ranges::all_of(shown.grey, [](std::uint8_t grey) { return grey == 0; });
  return taken(dark ? nullptr : &shown, tip);
}

void WebcamTechnician::act(WebcamProcedure& procedure) {
  if (procedure.expects() == WebcamInput::press) {
    getReady(procedure);
    return procedure.press();
  }
  const bool lit = procedure.step() == WebcamStep::tips && touch_;
  const auto tip_W = lit ? std::optional(rig_.tip_W(touch_->joints_rad)) : std::nullopt;
  procedure.see(image(procedure, tip_W), touch_ ? touch_->joints_rad : RawJoints{});
}

void WebcamTechnician::placeWebcamFor(const WebcamProcedure& procedure) {
  if (procedure.step() == WebcamStep::lens) return holdForLens();
  if (procedure.step() != WebcamStep::pattern) return;
  const auto position = static_cast<std::size_t>(procedure.position());
  placeWebcam(kCameraAside_deg[(position - 1) % kCameraAside_deg.size()]);
  webcam_poses_.resize(position);
  webcam_poses_.back() = webcam_.X_WC;
}

void WebcamTechnician::getReady(const WebcamProcedure& procedure) {
  touch_.reset();
  if (procedure.step() != WebcamStep::tips) return placeWebcamFor(procedure);
  Target about = *procedure.target();
  while (!touch_) {
    about.position_W.mm = procedure.target()->position_W.mm + gaussianVector(rng_, kAimed_mm);
    touch_ = simulatedTouch(rig_, about, rng_);
  }
}

void WebcamTechnician::holdForLens() {
  // From all sides, at all distances, turned about itself.
  const double way = 2.4 * ++views_, roll = 0.4 * std::sin(5.0 * views_);
  const glm::dvec3 from(280.0 * std::cos(way), 220.0 * std::sin(way), 480.0 + 60.0 * std::sin(3.0 * way));
  const glm::dvec3 at(40.0 * std::cos(2.0 * way), 30.0 * std::sin(3.0 * way), 0.0);
  webcam_.X_WC = lookingAt({from}, {at}, {std::sin(roll), std::cos(roll), 0.0});
  updateView();
}

void WebcamTechnician::placeWebcam(double aside_deg) {
  webcam_.X_WC = roughlyPlacedCamera(rig_.nominal, aside_deg, rng_);
  updateView();
}

void WebcamTechnician::updateView() {
  const Rig& rig = rig_.nominal;
  const double ghost = plate_mm_ > 0.0 ? kGhost : 0.0;
  view_.emplace(WebcamScene{.panel = rig.screen, .mirror = rig.mirror, .plate_mm = plate_mm_, .ghost = ghost}, webcam_);
}

}  // namespace app
