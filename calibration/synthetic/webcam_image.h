// What a webcam at the surgeon's eye sees of the workstation, pixel by pixel: the panel in the mirror (or without one),
// its ghost from the far face of the glass, the lit ball at the stylus's tip through the glass, and a camera that is
// out of focus, dims to its corners and is noisy. All flips come from where the panel's corners are. Frames W and C,
// mm, px. A pure function of its arguments: the same seed, the same image on every machine. Any thread; 0.1 to 0.3 s
// a image of 1920 x 1080, 20 ms where the panel is dark. Each pixel is the mean light over its area, then encoded.
// Not modelled: rolling shutter, automatic exposure, a panel that is brighter from one side, a hand.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "calibration/rig.h"
#include "calibration/synthetic/glass_plate.h"
#include "calibration/webcam/camera.h"

namespace calibration {

/// What stands before the camera.
struct WebcamScene {
  ScreenCorners panel;  ///< where the corners of the framebuffer's image truly are
  std::optional<Plane<World>> mirror{};
  double plate_mm = 0.0;  ///< glass behind the mirroring face; 0: nothing is bent, no ghost
  double refractive_index = 1.52;
  double ghost = 0.0;         ///< light of the far face's image, a share of the front face's
  double panel_light = 0.8;   ///< of white, where 1 saturates the camera
  double room_light = 0.004;  ///< everywhere
};

/// Ball at the tip of the stylus: painted, or lit from inside.
struct LitTip {
  Point<World> middle_W;
  double radius_mm = 1.5;
  double light = 0.7;       ///< where it is brightest
  double lamp_share = 0.0;  ///< of its light that comes from a lamp and leaves its far side dark
  Vector<World> to_lamp_W{{0, 1, 0}};
  Vector<World> smear_mm{};  ///< how far it moves while the shutter is open, half of it before `middle_W`
};

/// The camera as it truly is.
struct Webcam {
  CameraModel model;
  Pose<World, Camera> X_WC;
  double defocus_px = 0.6;  ///< one sigma
  double noise_grey = 1.5;  ///< one sigma of an encoded value
  double vignetting = 0.2;  ///< light that a corner of the image lacks
  double gamma = 2.2;       ///< encoded value = light^(1/gamma); the panel shows value^2.2
};

/// One webcam that stands still: what is the same for all its images is worked out once.
class WebcamRenderer {
 public:
  WebcamRenderer(const WebcamScene& scene, const Webcam& webcam);

  /// `shown`: the framebuffer; none: the panel is dark. Its size may be a whole part of the panel's pixels.
  GreyImage image(const GreyImage* shown, const std::optional<LitTip>& tip, std::uint64_t seed) const;

 private:
  using PanelMap = std::vector<glm::vec2>;  ///< at each corner of a pixel: 0..1 across and down the panel; NaN beside
  template <class SightOf>
  PanelMap panelMap(const SightOf& sight_of) const;
  void addPanel(const PanelMap& map, const GreyImage& shown, double share, std::vector<float>& light) const;
  void addTip(const LitTip& tip, std::vector<float>& light) const;
  Ray rayOf(const glm::dvec2& pixel) const;

  WebcamScene scene_;
  Webcam webcam_;
  std::optional<GlassPlate> plate_;
  PanelMap seen_, ghost_;
};

/// A camera that looks at a place from another, the image's up towards `up_W`.
Pose<World, Camera> lookingAt(const Point<World>& from_W, const Point<World>& at_W, const glm::dvec3& up_W);

/// From the middle of the case: at the eyes, and to the right and left of them.
inline constexpr std::array<double, 3> kCameraAside_deg = {0.0, 25.0, -25.0};
/// Where a camera stands that somebody has put up there by eye, a centimetre off, one sigma an axis.
Pose<World, Camera> roughlyPlacedCamera(const Rig& rig, double aside_deg, std::mt19937& rng);

}  // namespace calibration
