// A workstation for images in tests: the virtual screen in the plane z = 0, a mirror at 45 degrees 200 mm in front of
// it, the panel face down above the hand, a webcam at the eye. Writes its images as PNG where MOLAR_PICTURES names a
// folder.
#pragma once

#include <cstdlib>
#include <string>

#include "calibration/png_file.h"
#include "calibration/synthetic/webcam_image.h"

namespace calibration {

/// Corners of the framebuffer's image on the virtual screen, or any arrangement of it.
inline ScreenCorners uprightScreen(glm::ivec2 px = {1920, 1080}, double width_mm = 531.0) {
  return desktopRig(px, width_mm).screen;
}

inline Plane<World> slantedMirror() { return {glm::normalize(glm::dvec3(0, 1, 1)), 200.0 * std::sqrt(0.5)}; }

/// The panel whose mirror image this is.
inline ScreenCorners inTheMirror(ScreenCorners corners) {
  for (Point<World>* p : {&corners.lower_left, &corners.lower_right, &corners.upper_left})
    *p = slantedMirror().reflect(*p);
  return corners;
}

/// A monitor face down over the hand, its upper edge away from the surgeon: in the mirror its left is on the right, and
/// its plain content reads mirrored.
inline ScreenCorners hangingMonitor(glm::ivec2 px = {1920, 1080}, double width_mm = 531.0) {
  const ScreenCorners seen = uprightScreen(px, width_mm);
  return inTheMirror(
      {px, seen.lower_right, seen.lower_left, {seen.upper_left.mm + (seen.lower_right.mm - seen.lower_left.mm)}});
}

/// 1920 x 1080, or smaller with the same field of view.
inline Webcam webcamAtEye(glm::ivec2 size_px = {1920, 1080}, const Point<World>& from_W = {{0, 0, 450}}) {
  const double scale = size_px.x / 1920.0;
  Webcam webcam;
  webcam.model = {size_px, glm::dvec2(1400.0 * scale), 0.5 * glm::dvec2(size_px) - 0.5, 0.05, -0.1, 0.0005, -0.0004};
  webcam.X_WC = lookingAt(from_W, {{0, 0, 0}}, {0, 1, 0});
  return webcam;
}

inline Webcam perfect(Webcam webcam) {
  webcam.defocus_px = webcam.noise_grey = webcam.vignetting = 0.0;
  return webcam;
}

inline void keepPicture(const std::string& name, const GreyImage& image) {
  const char* const folder = std::getenv("MOLAR_PICTURES");
  if (folder == nullptr || *folder == '\0') return;
  std::vector<std::uint8_t> rgba;
  for (const std::uint8_t grey : image.grey) rgba.insert(rgba.end(), {grey, grey, grey, 255});
  writePng(std::string(folder) + "/" + name + ".png", image.size_px, rgba);
}

}  // namespace calibration
