#include "app/report/svg.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace app {
namespace {

std::string number(double value) {
  std::array<char, 400> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), std::isfinite(value) ? value : 0.0,
                                          std::chars_format::fixed, 2);
  return {text.data(), end};
}

std::string attribute(std::string_view name, std::string_view value) {
  return " " + std::string(name) + "=\"" + escaped(value) + "\"";
}

std::string attribute(std::string_view name, double value) { return attribute(name, number(value)); }

std::string strokeOf(const Stroke& stroke) {
  if (stroke.colour == paper::kNone) return "";
  return attribute("stroke", stroke.colour) + attribute("stroke-width", stroke.width) +
         (stroke.dashes.empty() ? "" : attribute("stroke-dasharray", stroke.dashes));
}

std::string listOf(const std::vector<glm::dvec2>& points) {
  std::string list;
  for (const glm::dvec2& p : points) list += (list.empty() ? "" : " ") + number(p.x) + "," + number(p.y);
  return list;
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (c == '&')
      safe += "&amp;";
    else if (c == '<')
      safe += "&lt;";
    else if (c == '>')
      safe += "&gt;";
    else if (c == '"')
      safe += "&quot;";
    else if (c == '\'')
      safe += "&#39;";
    else if (static_cast<unsigned char>(c) >= ' ')
      safe += c;
  }
  return safe;
}

std::string fixedText(double value, int digits) {
  std::array<char, 400> text{};
  const auto [end, error] =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, digits);
  std::string_view written(text.data(), static_cast<std::size_t>(end - text.data()));
  if (!written.starts_with('-')) return std::string(written);
  written.remove_prefix(1);
  return (written.find_first_not_of("0.") == std::string_view::npos ? "" : "\u2212") + std::string(written);
}

std::string timeText(const std::string& utc) {
  return utc.size() == 20 && utc[10] == 'T' ? utc.substr(0, 10) + " " + utc.substr(11, 5) + " UTC" : utc;
}

Svg::Svg(glm::dvec2 size, std::string_view description)
    : body_("<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\"" +
            attribute("viewBox", "0 0 " + number(size.x) + " " + number(size.y)) + attribute("width", size.x) +
            attribute("height", size.y) + attribute("aria-label", description) +
            attribute("font-family", "DejaVu Sans, Helvetica, Arial, sans-serif") + ">\n") {}

void Svg::line(glm::dvec2 a, glm::dvec2 b, const Stroke& stroke) {
  body_ += "<line" + attribute("x1", a.x) + attribute("y1", a.y) + attribute("x2", b.x) + attribute("y2", b.y) +
           strokeOf(stroke) + "/>\n";
}

void Svg::path(const std::vector<glm::dvec2>& points, const Stroke& stroke) {
  body_ += "<polyline" + attribute("points", listOf(points)) + attribute("fill", paper::kNone) +
           attribute("stroke-linejoin", "round") + strokeOf(stroke) + "/>\n";
}

void Svg::area(const std::vector<glm::dvec2>& points, std::string_view fill) {
  body_ += "<polygon" + attribute("points", listOf(points)) + attribute("fill", fill) + "/>\n";
}

void Svg::box(glm::dvec2 corner, glm::dvec2 size, std::string_view fill, const Stroke& stroke) {
  body_ += "<rect" + attribute("x", corner.x) + attribute("y", corner.y) + attribute("width", std::max(size.x, 0.0)) +
           attribute("height", std::max(size.y, 0.0)) + attribute("fill", fill) + strokeOf(stroke) + "/>\n";
}

void Svg::disc(glm::dvec2 centre, double radius, std::string_view fill, const Stroke& stroke) {
  body_ += "<circle" + attribute("cx", centre.x) + attribute("cy", centre.y) + attribute("r", radius) +
           attribute("fill", fill) + strokeOf(stroke) + "/>\n";
}

void Svg::cross(glm::dvec2 centre, double half, const Stroke& stroke) {
  line(centre - half, centre + half, stroke);
  line(centre + glm::dvec2(-half, half), centre + glm::dvec2(half, -half), stroke);
}

void Svg::arrow(glm::dvec2 from, glm::dvec2 to, const Stroke& stroke) {
  const double length = glm::distance(from, to), head = 4.0 + stroke.width;
  if (length < head) return line(from, to, stroke);
  const glm::dvec2 along = (to - from) / length, across(-along.y, along.x);
  line(from, to - 0.7 * head * along, stroke);
  area({to, to - head * along + 0.45 * head * across, to - head * along - 0.45 * head * across}, stroke.colour);
}

void Svg::words(glm::dvec2 at, std::string_view text, TextAnchor anchor, std::string_view colour, double size,
                bool bold) {
  constexpr std::array<std::string_view, 3> kAnchors = {"start", "middle", "end"};
  body_ += "<text" + attribute("x", at.x) + attribute("y", at.y) + attribute("font-size", size) +
           attribute("fill", colour) + attribute("text-anchor", kAnchors[static_cast<std::size_t>(anchor)]) +
           (bold ? attribute("font-weight", "bold") : "") + ">" + escaped(text) + "</text>\n";
}

std::string Svg::markup() const { return body_ + "</svg>\n"; }

}  // namespace app
