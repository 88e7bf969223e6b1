// Checks that the screen's image reaches the eye unflipped, with a drawn F that technician and webcam can read. The
// expected orientation follows from the rig's corners and mirror; here it is verified and the remedy named. px, rows
// from the top. Any thread; milliseconds, reading an F 20 ms at 1080p. Orientation in quarter turns only; the camera
// must be level within 40 degrees.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "calibration/rig.h"
#include "calibration/webcam/camera.h"

namespace calibration {

/// How an image reaches the eye: mirrored left to right or not, then rotated clockwise by quarter turns.
struct ImageOrientation {
  bool mirrored = false;
  int quarters = 0;  ///< 0 to 3

  bool isUpright() const { return !mirrored && quarters == 0; }
  bool operator==(const ImageOrientation&) const = default;
};

inline constexpr std::array<ImageOrientation, 8> kImageOrientations{
    {{false, 0}, {false, 1}, {false, 2}, {false, 3}, {true, 0}, {true, 1}, {true, 2}, {true, 3}}};

ImageOrientation inverseOf(const ImageOrientation& orientation);
/// "right", "mirrored", "upside down", "turned to the right", "mirrored and turned to the left", …
std::string_view nameOf(const ImageOrientation& orientation);
/// One sentence for the technician.
std::string remedyFor(const ImageOrientation& orientation);

/// The image as it reaches the eye; an odd number of quarter turns swaps width and height.
GreyImage oriented(const ImageOrientation& orientation, const GreyImage& image);

/// Orientation of the rig's framebuffer as seen from the near side of its virtual screen.
ImageOrientation framebufferOrientation(const Rig& rig);
/// The framebuffer that shows this image upright.
GreyImage framebufferFor(const Rig& rig, const GreyImage& as_seen);
/// Size of an image that fills the rig's screen as seen.
glm::ivec2 seenSize_px(const Rig& rig);

/// Corners on the virtual screen of an upright image as seen, with its size in `px`.
ScreenCorners seenScreen(const Rig& rig);
/// Position of one of its pixels on the virtual screen, centres at integers.
Point<World> positionOn(const ScreenCorners& seen_screen, const glm::dvec2& px);

/// A black F in a white square on black, upright.
GreyImage letterF(const glm::ivec2& size_px);
/// Orientation of the F in an image. None: no F found.
std::optional<ImageOrientation> orientationOfF(const GreyImage& seen);

}  // namespace calibration
