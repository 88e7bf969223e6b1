// A page in the plane of the virtual screen: millimetres from its middle, x to the viewer's right, y down. Reads the
// right way round for every panel and mirror, and is undistorted by non-square pixels (halved displays). Text is bold.
// Any one thread.
#pragma once

#include <cstdint>
#include <string>

#include <glm/glm.hpp>

#include "app/report/drawing.h"
#include "calibration/rig.h"
#include "render/display/eye_projection.h"
#include "render/image.h"

namespace app {

/// Grey with this share of the luminance of white.
Ink greyOfLight(double share);
/// Linear light as a byte of sRGB.
std::uint8_t encoded(double light);

class ScreenPage : public Drawing {
 public:
  /// `px`: pixels of the rig's whole screen.
  ScreenPage(const calibration::Rig& rig, glm::ivec2 px);

  glm::dvec2 size_mm() const { return size_mm_; }
  /// Width of a device pixel along x.
  double pixel_mm() const;
  /// Where an eye of the rig sees, on the screen, a point that many mm in front of it.
  glm::dvec2 seenAt(const calibration::Rig& rig, render::Eye eye, const glm::dvec2& place_mm, double before_mm) const;
  /// The same for a point of the world.
  glm::dvec2 seenAt(const calibration::Rig& rig, render::Eye eye,
                    const calibration::Point<calibration::World>& p_W) const;
  /// Position on the virtual screen of a point of the page.
  calibration::Point<calibration::World> placeOf(const glm::dvec2& place_mm) const;

  /// Copies another page of the same size.
  void copy(const ScreenPage& other) const;
  /// A box with its edges on device pixels.
  void pixelBox(const glm::dvec2& corner, const glm::dvec2& size, const Ink& ink) const;
  void frame(double width_mm, const Ink& ink) const;
  /// Text on black, centred.
  void label(const std::string& words, const glm::dvec2& centre, double height_mm, const Ink& ink) const;

 private:
  glm::dvec2 size_mm_{0.0};
  glm::dvec3 middle_W_{0.0}, right_W_{0.0}, down_W_{0.0}, towards_W_{0.0};
};

}  // namespace app
