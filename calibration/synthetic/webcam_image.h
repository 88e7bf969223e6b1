// Renders what a webcam at the surgeon's eye sees: the panel in the mirror (or directly), its ghost from the far face
// of the glass, the lit ball at the stylus tip through the glass; with defocus, vignetting and noise. All flips follow
// from the panel's corners. Frames W and C, mm, px. A pure function of its arguments, the same on every machine. Any
// thread; 0.1 to 0.3 s for an image of 1920 x 1080, 20 ms with a dark panel. Each pixel is the mean light over its
// area, then encoded. Not modelled: rolling shutter, automatic exposure, uneven panel light, a hand.
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

struct WebcamScene {
  ScreenCorners panel;  ///< true corners of the framebuffer image
  std::optional<Plane<World>> mirror{};
  double plate_mm = 0.0;  ///< glass behind the mirroring face; 0: no refraction, no ghost
  double refractive_index = 1.52;
  double ghost = 0.0;         ///< brightness of the far face's image relative to the front face's
  double panel_light = 0.8;   ///< of white; 1 saturates the camera
  double room_light = 0.004;  ///< ambient
};

/// Ball at the stylus tip: painted, or lit from inside.
struct LitTip {
  Point<World> middle_W;
  double radius_mm = 1.5;
  double light = 0.7;       ///< at its brightest
  double lamp_share = 0.0;  ///< of its light that comes from a lamp and leaves its far side dark
  Vector<World> to_lamp_W{{0, 1, 0}};
  Vector<World> smear_mm{};  ///< motion during the exposure, centred on `middle_W`
};

/// The true camera.
struct Webcam {
  CameraModel model;
  Pose<World, Camera> X_WC;
  double defocus_px = 0.6;  ///< one sigma
  double noise_grey = 1.5;  ///< one sigma, grey levels
  double vignetting = 0.2;  ///< light loss at the image corners
  double gamma = 2.2;       ///< encoded value = light^(1/gamma); the panel shows value^2.2
};

/// One fixed webcam; what its images share is computed once.
class WebcamRenderer {
 public:
  WebcamRenderer(const WebcamScene& scene, const Webcam& webcam);

  /// `shown`: the framebuffer; null: the panel is dark. Its size may be an integer fraction of the panel's pixels.
  GreyImage image(const GreyImage* shown, const std::optional<LitTip>& tip, std::uint64_t seed) const;

 private:
  using PanelMap = std::vector<glm::vec2>;  ///< at each pixel corner: 0..1 across and down the panel; NaN outside
  template <class SightOf>
  PanelMap panelMap(const SightOf& ray_of) const;
  void addPanel(const PanelMap& map, const GreyImage& shown, double share, std::vector<float>& light) const;
  void addTip(const LitTip& tip, std::vector<float>& light) const;
  Ray rayOf(const glm::dvec2& pixel) const;

  WebcamScene scene_;
  Webcam webcam_;
  std::optional<GlassPlate> plate_;
  PanelMap seen_, ghost_;
};

/// Pose of a camera at `from_W` looking at `at_W`, the image's up towards `up_W`.
Pose<World, Camera> lookingAt(const Point<World>& from_W, const Point<World>& at_W, const glm::dvec3& up_W);

/// Camera positions: at the eyes, and to the right and left of them, about the case.
inline constexpr std::array<double, 3> kCameraAside_deg = {0.0, 25.0, -25.0};
/// A camera placed there by eye, 1 cm off, one sigma an axis.
Pose<World, Camera> roughlyPlacedCamera(const Rig& rig, double aside_deg, std::mt19937& rng);

}  // namespace calibration
