// Whether what the screen shows reads right to the eye before it: a drawn F says it to a technician and to a webcam.
// The rig's corners and mirror alone say how a framebuffer should reach the eye; here that is proved, and the remedy
// named. px, rows from the top. Any thread; milliseconds, reading an F 20 ms at 1080p. Not a measurement: the turn is
// known to the nearest quarter, the camera must be level within 40 degrees.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "calibration/rig.h"
#include "calibration/webcam/camera.h"

namespace calibration {

/// How a image reaches the eye: mirrored left to right or not, and then turned, clockwise by so many quarters.
struct ImageOrientation {
  bool mirrored = false;
  int quarters = 0;  ///< 0 to 3

  bool right() const { return !mirrored && quarters == 0; }
  bool operator==(const ImageOrientation&) const = default;
};

inline constexpr std::array<ImageOrientation, 8> kImageOrientations{
    {{false, 0}, {false, 1}, {false, 2}, {false, 3}, {true, 0}, {true, 1}, {true, 2}, {true, 3}}};

/// What undoes it.
ImageOrientation inverseOf(const ImageOrientation& reading);
/// "right", "mirrored", "upside down", "turned to the right", "mirrored and turned to the left", …
std::string_view nameOf(const ImageOrientation& reading);
/// One sentence for the technician: what to do about it.
std::string remedyFor(const ImageOrientation& reading);

/// What reaches the eye of this image; turned by one or three quarters it is as wide as it was high.
GreyImage oriented(const ImageOrientation& reading, const GreyImage& image);

/// How the rig's framebuffer reaches an eye on the near side of its virtual screen, from its corners and mirror alone.
ImageOrientation framebufferOrientation(const Rig& rig);
/// What has to be in the framebuffer for this image to read right.
GreyImage framebufferFor(const Rig& rig, const GreyImage& as_seen);
/// Size of a image that fills the rig's screen as it is seen.
glm::ivec2 seenSize_px(const Rig& rig);

/// Corners, on the virtual screen, of a image as it is seen: its left is the eye's left, its upper edge up. How many
/// pixels it has, each way, is its `px`.
ScreenCorners seenScreen(const Rig& rig);
/// Where on the virtual screen a pixel of it lies, centres at whole numbers.
Point<World> positionOn(const ScreenCorners& seen_screen, const glm::dvec2& px);

/// A black F in a white square on black, as it should be read.
GreyImage letterF(const glm::ivec2& size_px);
/// How the F reads in a image of it. None: no F can be made out.
std::optional<ImageOrientation> orientationOfF(const GreyImage& seen);

}  // namespace calibration
