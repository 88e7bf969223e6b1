// Shapes and text by Cairo and Pango, as pixels or as SVG for a page, with the same calls; y downwards. The height of a
// text line is 1.17 times the font size. SVG text stays selectable and accessible text (Cairo alone writes
// outlines with clashing ids). Any one thread.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "calibration/output_file.h"
#include "render/image.h"

struct _cairo;
using PangoLayout = struct _PangoLayout;

namespace app {

/// sRGB as encoded, 0..1.
struct Ink {
  double red, green, blue;
  double opacity = 1.0;  ///< below 1 in pixels only
};
constexpr Ink inkOf(int rgb) { return {(rgb >> 16) / 255.0, (rgb >> 8 & 255) / 255.0, (rgb & 255) / 255.0}; }

/// Okabe and Ito 2008: distinct for every colour vision; with shapes or dashes also in grey.
namespace paper {
inline constexpr Ink kInk = inkOf(0x222222), kQuiet = inkOf(0x666666), kFaint = inkOf(0xd8d8d8),
                     kBlue = inkOf(0x0072b2), kOrange = inkOf(0xd55e00), kGreen = inkOf(0x009e73),
                     kAmber = inkOf(0xe69f00), kWhite = inkOf(0xffffff);
}  // namespace paper

enum class Align { left, centre, right };
using Dashes = std::vector<double>;

class Drawing {
 public:
  /// SVG for a page, no wider than the page.
  explicit Drawing(glm::dvec2 size);
  /// Pixels, initially black or transparent.
  enum class Ground { black, clear };
  Drawing(glm::ivec2 px, double px_per_unit, Ground ground = Ground::black);
  Drawing(const Drawing&) = delete;
  Drawing& operator=(const Drawing&) = delete;

  void fill(const Ink& ink) const;
  void box(const glm::dvec2& corner, const glm::dvec2& size, const Ink& ink) const;
  void outline(const glm::dvec2& corner, const glm::dvec2& size, double width, const Ink& ink,
               const Dashes& dashes = {}) const;
  void line(const glm::dvec2& from, const glm::dvec2& to, double width, const Ink& ink,
            const Dashes& dashes = {}) const;
  /// Through all points, round corners and ends; a non-finite point interrupts it.
  void path(const std::vector<glm::dvec2>& points, double width, const Ink& ink, bool closed = false,
            const Dashes& dashes = {}) const;
  void polygon(const std::vector<glm::dvec2>& corners, const Ink& ink) const;
  void circle(const glm::dvec2& centre, double radius, double width, const Ink& ink) const;
  void disc(const glm::dvec2& centre, double radius, const Ink& ink) const;
  /// From the top, clockwise; `share` of the full circle.
  void arc(const glm::dvec2& centre, double radius, double share, double width, const Ink& ink) const;
  void cross(const glm::dvec2& centre, double half, double width, const Ink& ink) const;
  /// With a head; without one if too short.
  void arrow(const glm::dvec2& from, const glm::dvec2& to, double width, const Ink& ink) const;
  /// Clips `draw` to the box.
  void inside(const glm::dvec2& corner, const glm::dvec2& size, const std::function<void()>& draw) const;

  /// An opaque picture, scaled to the box and smoothed; of SVG below all shapes.
  void image(const render::Image& picture, const glm::dvec2& corner, const glm::dvec2& size) const;

  /// Pixels only: another drawing of pixels over this one, unscaled.
  void layer(const Drawing& other, const glm::dvec2& corner) const;

  /// Width of one line.
  double textWidth(const std::string& words, double height, bool bold = false) const;
  /// One line; `at`: its left end, middle or right end, at half height.
  void text(const std::string& words, const glm::dvec2& at, double height, const Ink& ink, Align align = Align::centre,
            bool bold = false) const;
  /// Height of the lines of paragraph().
  double paragraphHeight(const std::string& words, double width, double height) const;
  /// Lines wrapped to `width`; `top`: left end, middle or right end of the upper edge.
  /// Returns the total height.
  double paragraph(const std::string& words, const glm::dvec2& top, double width, double height, const Ink& ink,
                   Align align = Align::centre) const;

  /// SVG only: shows `words` under the pointer; a click leads to the page's element with this id, empty: nowhere.
  void hint(const glm::dvec2& corner, const glm::dvec2& size, const std::string& words, const std::string& id = "");

  /// Pixels only: a copy, premultiplied by its alpha.
  render::Image picture() const;
  /// Pixels only: those from `low` to before `end` into a picture() of this drawing.
  void copyTo(render::Image& picture, glm::ivec2 low, glm::ivec2 end) const;
  /// SVG only, called once: the element for a page. `description`: its label for screen readers.
  std::string markup(std::string_view description);
  /// Pixels only: writes a PNG and commits the file. Throws UsageError when it cannot be written.
  void save(calibration::OutputFile& file) const;

 protected:
  _cairo* pen() const { return pen_.get(); }

  bool always_bold_ = false;

 private:
  bool isSvg() const;
  void show(PangoLayout* layout, const glm::dvec2& corner, Align align, const Ink& ink) const;

  glm::dvec2 size_{0.0};
  std::string svg_;  ///< output of Cairo
  mutable std::string images_;
  mutable std::string words_;  ///< text elements of SVG, above all shapes
  std::string hints_;          ///< of SVG, above its text
  std::unique_ptr<_cairo, void (*)(_cairo*)> pen_;
};

}  // namespace app
