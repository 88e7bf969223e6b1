// A page to draw on that is the screen as the person before it sees it: millimetres, x to the person's right, y down,
// the middle of the screen in the middle. However panel and mirror hang, what is drawn reads the right way round, and
// pixels that are not square (halved displays) change no shape. Cairo and Pango inside. Any one thread.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "calibration/rig.h"
#include "render/display/eye_projection.h"
#include "render/picture.h"

namespace app {

/// As the screen encodes it, 0..1.
struct Ink {
  double red, green, blue;
};
/// Grey that gives this share of white's light.
Ink ofLight(double share);
/// Linear light as a byte of sRGB.
std::uint8_t encoded(double light);

enum class Align { left, centre, right };

class ScreenPage {
 public:
  /// `px` pixels over the whole of the rig's screen.
  ScreenPage(const calibration::Rig& rig, glm::ivec2 px);
  ~ScreenPage();

  glm::dvec2 size_mm() const { return size_mm_; }
  /// Width of a device pixel along x.
  double pixel_mm() const;
  /// Where an eye of the rig sees, on the screen, a point that many mm before it.
  glm::dvec2 seenAt(const calibration::Rig& rig, render::Eye eye, const glm::dvec2& place_mm, double before_mm) const;
  /// The same of a point of the world.
  glm::dvec2 seenAt(const calibration::Rig& rig, render::Eye eye,
                    const calibration::Point<calibration::World>& p_W) const;
  /// Where on the virtual screen a place of the page is.
  calibration::Point<calibration::World> placeOf(const glm::dvec2& place_mm) const;

  /// All that is on another page of the same size.
  void copy(const ScreenPage& other) const;
  void fill(const Ink& ink) const;
  void box(const glm::dvec2& corner, const glm::dvec2& size, const Ink& ink) const;
  /// Its edges on the edges of device pixels.
  void pixelBox(const glm::dvec2& corner, const glm::dvec2& size, const Ink& ink) const;
  void frame(double width_mm, const Ink& ink) const;
  void line(const glm::dvec2& from, const glm::dvec2& to, double width_mm, const Ink& ink) const;
  void circle(const glm::dvec2& centre, double radius_mm, double width_mm, const Ink& ink) const;
  /// Through all points, round at corners and ends.
  void path(const std::vector<glm::dvec2>& points, double width_mm, const Ink& ink, bool closed = false) const;
  void polygon(const std::vector<glm::dvec2>& corners, const Ink& ink) const;
  void disc(const glm::dvec2& centre, double radius_mm, const Ink& ink) const;
  /// From the top, clockwise; `share` of the whole circle.
  void arc(const glm::dvec2& centre, double radius_mm, double share, double width_mm, const Ink& ink) const;

  /// Of one line.
  double textWidth_mm(const std::string& words, double height_mm) const;
  /// Of all lines that paragraph() would draw.
  double paragraphHeight_mm(const std::string& words, double width_mm, double height_mm) const;
  /// Lines broken where they would be wider than `width_mm`; `top` is the left, middle or right of its upper edge.
  /// Returns the height of them all.
  double paragraph(const std::string& words, const glm::dvec2& top, double width_mm, double height_mm, const Ink& ink,
                   Align align = Align::centre) const;
  /// Centred; `height_mm` is that of the letters' line.
  void text(const std::string& words, const glm::dvec2& centre, double height_mm, const Ink& ink) const;
  /// The same on black.
  void label(const std::string& words, const glm::dvec2& centre, double height_mm, const Ink& ink) const;

  render::Picture picture() const;

 private:
  struct Sheet;
  std::unique_ptr<Sheet> sheet_;
  glm::dvec2 size_mm_{0.0};
  glm::dvec3 middle_W_{0.0}, right_W_{0.0}, down_W_{0.0}, towards_W_{0.0};
};

}  // namespace app
