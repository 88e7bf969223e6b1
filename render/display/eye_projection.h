// View of one eye through the screen: generalised off-axis projection, with the panel reflected in the mirror.
// With a mirror the basis of the virtual screen is left-handed; nothing else is flipped, however the panel is mounted.
// Eyes are never reflected, so the left eye stays the left eye. Frame W, mm. Any thread; pure.
// Formula: Kooima, "Generalized Perspective Projection" (2009), with the reflected corners and the screen normal
// towards the eye.
#pragma once

#include "calibration/geometry/plane.h"
#include "calibration/geometry/pose.h"
#include "calibration/rig.h"

namespace render {

/// `magnified`: cyclopean, of a picture within the picture.
enum class Eye { left, right, cyclopean, magnified };
inline constexpr std::size_t kEyes = 4;

struct EyeView {
  glm::dmat4 clip_from_W{1.0};  ///< OpenGL clip space, z from -1 (near) to 1 (far)
  calibration::Point<calibration::World> eye_W;
  calibration::Point<calibration::World> lower_left_W;   ///< of the image on the virtual screen
  calibration::Vector<calibration::World> right_edge_W;  ///< along a row of the image, full width
  calibration::Vector<calibration::World> up_edge_W;     ///< along a column, full height
  bool mirrored = false;                                 ///< left-handed: front faces are clockwise in the image
};

/// Near and far plane, in eye-to-screen distances.
inline constexpr double kNearOfScreen = 0.1, kFarOfScreen = 20.0;

EyeView eyeView(const calibration::Rig& rig, Eye eye);

/// What the eye sees in a flat mirror in front of it: the eye and its screen reflected, so that a pixel of this view is
/// the reflected ray of the same pixel, and shows a point where the eye's view shows its mirror image. Its near plane
/// is the glass, or lies in front of it by `begins_mm`.
EyeView reflected(const EyeView& view, const calibration::Plane<calibration::World>& glass_W, double begins_mm = 0.0);

}  // namespace render
