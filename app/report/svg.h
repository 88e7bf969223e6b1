// A small drawing in a page: lines, shapes and words as inline SVG, its width as the page allows. Pixels at its natural
// size, y downwards; colours as CSS has them. All text is escaped. Pure; any one thread. Not for print at 300 dpi by
// itself (chart does that): a vector drawing prints as finely as the printer can.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace app {

/// For use in text and in attributes.
std::string escaped(std::string_view text);
/// With so many digits after the point, whatever the locale. A true minus, as in print, and none before a zero.
std::string fixedText(double value, int digits);

/// "2026-11-21T08:20:00Z" as people read it: "2026-11-21 08:20 UTC"; what is no time as it is.
std::string timeText(const std::string& utc);

/// Okabe and Ito 2008: told apart by any colour vision, and in grey by shape or dash beside them.
namespace paper {
inline constexpr const char *kInk = "#222222", *kQuiet = "#666666", *kFaint = "#d8d8d8", *kBlue = "#0072b2",
                            *kOrange = "#d55e00", *kGreen = "#009e73", *kWhite = "#ffffff", *kNone = "none";
}  // namespace paper

struct Stroke {
  std::string_view colour = paper::kInk;
  double width = 1.0;
  std::string_view dashes{};  ///< "4 3"; empty: none
};

enum class TextAnchor { start, middle, end };

class Svg {
 public:
  /// `description`: what it shows, for those who do not see it.
  Svg(glm::dvec2 size, std::string_view description);

  void line(glm::dvec2 a, glm::dvec2 b, const Stroke& stroke);
  void path(const std::vector<glm::dvec2>& points, const Stroke& stroke);
  void area(const std::vector<glm::dvec2>& points, std::string_view fill);
  void box(glm::dvec2 corner, glm::dvec2 size, std::string_view fill, const Stroke& stroke = {paper::kNone, 0.0});
  void disc(glm::dvec2 centre, double radius, std::string_view fill, const Stroke& stroke = {paper::kNone, 0.0});
  void cross(glm::dvec2 centre, double half, const Stroke& stroke);
  /// With a head; what is too short for one is a line.
  void arrow(glm::dvec2 from, glm::dvec2 to, const Stroke& stroke);
  void words(glm::dvec2 at, std::string_view text, TextAnchor anchor = TextAnchor::start,
             std::string_view colour = paper::kInk, double size = 12.0, bool bold = false);

  std::string markup() const;

 private:
  std::string body_;
};

}  // namespace app
