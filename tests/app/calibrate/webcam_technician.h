// A technician with a webcam at a workstation whose truth is known: does what the webcam procedure asks, and takes the
// pictures that its camera would take.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "app/calibrate/webcam_procedure.h"
#include "calibration/geometry/units.h"
#include "calibration/synthetic/chance.h"
#include "calibration/synthetic/synthetic_rig.h"
#include "tests/calibration/synthetic/mirrored_workstation.h"

namespace app {

using namespace calibration;

class WebcamTechnician {
 public:
  WebcamTechnician(const SyntheticRig& rig, glm::ivec2 camera_px, std::uint32_t seed, double plate_mm = 0.0)
      : rig_(rig), chance_(seed), webcam_(webcamAtEye(camera_px)), plate_mm_(plate_mm) {
    rig_.habits.precision = {0.0, 0.0};
    rig_.habits.outlier_share = 0.0;
    putUp(0.0);
  }

  const CameraModel& lens() const { return webcam_.model; }
  /// Where the webcam was put at a position, from 0.
  const Pose<World, Camera>& stood(std::size_t position) const { return stood_[position]; }

  /// From where the webcam stands now; no framebuffer: the screen is dark.
  GreyPicture taken(const GreyPicture* shown, const std::optional<LitTip>& tip) {
    const GreyPicture seen = view_->picture(shown, tip, ++pictures_);
    keepPicture("taken_" + std::to_string(pictures_), seen);
    return seen;
  }

  void act(WebcamProcedure& procedure) {
    if (procedure.wants() == WebcamWants::press) {
      getReady(procedure);
      return procedure.press();
    }
    const bool lit = procedure.step() == WebcamStep::tips && touch_;
    // Two shades of the ball, as a lamp from above makes them.
    const std::optional<LitTip> tip =
        lit ? std::optional(LitTip{.middle_W = rig_.tip_W(touch_->joints_rad), .lamp_share = 0.2}) : std::nullopt;
    const GreyPicture& shown = procedure.shown();
    const bool dark = std::ranges::all_of(shown.grey, [](std::uint8_t grey) { return grey == 0; });
    procedure.see(taken(dark ? nullptr : &shown, tip), touch_ ? touch_->joints_rad : RawJoints{});
  }

 private:
  void getReady(const WebcamProcedure& procedure) {
    constexpr std::array<double, 3> kAside_deg = {0.0, 25.0, -25.0};
    touch_.reset();
    switch (procedure.step()) {
      case WebcamStep::lens: {
        // From all sides, at all distances, turned about itself.
        const double way = 2.4 * ++views_, roll = 0.4 * std::sin(5.0 * views_);
        const glm::dvec3 from(280.0 * std::cos(way), 220.0 * std::sin(way), 480.0 + 60.0 * std::sin(3.0 * way));
        const glm::dvec3 at(40.0 * std::cos(2.0 * way), 30.0 * std::sin(3.0 * way), 0.0);
        webcam_.X_WC = lookingAt({from}, {at}, {std::sin(roll), std::cos(roll), 0.0});
        return look();
      }
      case WebcamStep::pattern:
        putUp(kAside_deg[static_cast<std::size_t>(procedure.position() - 1)]);
        stood_.resize(static_cast<std::size_t>(procedure.position()));
        stood_.back() = webcam_.X_WC;
        return;
      case WebcamStep::tips: {
        Target about = *procedure.target();
        while (!touch_) {
          about.place_W.mm = procedure.target()->place_W.mm + gaussianVector(chance_, 3.0);
          touch_ = touched(rig_, about, chance_);
        }
        return;
      }
      default:
        return;
    }
  }

  void putUp(double aside_deg) {
    const glm::dquat aside = glm::angleAxis(radFromDegrees(aside_deg), glm::dvec3(0.0, 1.0, 0.0));
    const Point<World> from_W{aside * rig_.nominal.cyclopeanEye().mm + gaussianVector(chance_, 10.0)};
    webcam_.X_WC = lookingAt(from_W, {gaussianVector(chance_, 10.0)}, {0.0, 1.0, 0.0});
    look();
  }
  void look() {
    const Rig& rig = rig_.nominal;
    const double ghost = plate_mm_ > 0.0 ? 0.05 : 0.0;
    view_.emplace(WebcamScene{.panel = rig.screen, .mirror = rig.mirror, .plate_mm = plate_mm_, .ghost = ghost},
                  webcam_);
  }

  SyntheticRig rig_;
  std::mt19937 chance_;
  Webcam webcam_;
  double plate_mm_;
  std::optional<WebcamView> view_;
  std::optional<Touch> touch_;
  std::vector<Pose<World, Camera>> stood_;
  int views_ = 0;
  std::uint64_t pictures_ = 0;
};

}  // namespace app
