#include "app/procedure/root_canal/section_picture.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "app/report/drawing.h"

namespace app {
namespace {

constexpr double kPanel = 250.0, kNames = 26.0, kWords = 13.0, kHalf_mm = 3.2;
constexpr double kPerMm = 0.5 * kPanel / kHalf_mm;
constexpr Ink kDentine = inkOf(0xf0e2c4), kLaid = inkOf(0xd9756a);

/// As it lies in a panel, seen towards the apex: the furcation to the right. What is farther ends at the panel's edge.
std::vector<glm::dvec2> shapeOf(const CanalSection& section, const CanalSection::Radii& radii_mm,
                                const glm::dvec2& centre, double half, double half_mm) {
  std::vector<glm::dvec2> shape;
  for (std::size_t ray = 0; ray < radii_mm.size(); ++ray) {
    const glm::dvec2 way = section.wayOf(ray);
    const double most_mm = half_mm / std::max(std::abs(way.x), std::abs(way.y));
    shape.push_back(centre + half / half_mm * std::min(radii_mm[ray], most_mm) * way);
  }
  return shape;
}

/// Row by row.
void drawLaid(const Drawing& drawing, const CanalSection& section, const glm::dvec2& centre, double per_mm) {
  constexpr int kEdge = CanalSection::kLaidEdge;
  const double cell = per_mm * CanalSection::kLaidCell_mm;
  for (int row = 0; row < kEdge; ++row)
    for (int from = 0; from < kEdge; ++from) {
      const auto is_laid = [&](int column) {
        return column < kEdge && section.is_laid[static_cast<std::size_t>(row * kEdge + column)];
      };
      int end = from;
      while (is_laid(end)) ++end;
      if (end == from) continue;
      const glm::dvec2 corner = centre + cell * (glm::dvec2(from, row) - 0.5 * kEdge);
      drawing.box(corner, {cell * (end - from), 1.05 * cell}, kLaid);
      from = end;
    }
}

void drawPanel(const Drawing& drawing, const CanalSection& section, const glm::dvec2& corner) {
  drawSection(drawing, section, corner, kPanel - 4.0, kHalf_mm, 2.0);
  drawing.text(fmt::format("{:g} mm", section.from_foramen_mm), corner + glm::dvec2(8.0, 14.0), kWords, paper::kInk,
               Align::left, true);
  if (const std::string moved = movedWords(section); !moved.empty())
    drawing.text(moved, corner + glm::dvec2(8.0, kPanel - 36.0), kWords, paper::kInk, Align::left);
  drawing.text(fmt::format("dentine {:.2f} mm", std::max(0.0, leastDentine_mm(section))),
               corner + glm::dvec2(8.0, kPanel - 18.0), kWords, paper::kInk, Align::left);
}

}  // namespace

double leastDentine_mm(const CanalSection& section) {
  double least_mm = section.wall_mm(0);
  for (std::size_t ray = 0; ray < CanalSection::kRays; ++ray) least_mm = std::min(least_mm, section.wall_mm(ray));
  return least_mm;
}

std::string movedWords(const CanalSection& section) {
  const double shift_mm = transportation_mm(section);
  if (!(std::abs(shift_mm) >= 0.005)) return "";
  return fmt::format("moved {:.2f} mm {} the furcation", std::abs(shift_mm), shift_mm > 0.0 ? "to" : "off");
}

void drawSection(const Drawing& drawing, const CanalSection& section, const glm::dvec2& corner, double edge,
                 double half_mm, double line) {
  const glm::dvec2 centre = corner + 0.5 * edge;
  const auto shape = [&](const CanalSection::Radii& radii_mm) {
    return shapeOf(section, radii_mm, centre, 0.5 * edge, half_mm);
  };
  drawing.box(corner, glm::dvec2(edge), paper::kFaint);
  drawing.polygon(shape(section.root_mm), kDentine);
  drawing.polygon(shape(section.after_mm), paper::kWhite);
  if (!section.is_laid.empty())
    drawing.inside(corner, glm::dvec2(edge), [&] { drawLaid(drawing, section, centre, 0.5 * edge / half_mm); });
  if (section.after_mm != section.before_mm) drawing.path(shape(section.after_mm), line, paper::kOrange, true);
  drawing.path(shape(section.before_mm), 0.75 * line, paper::kBlue, true, {2.0 * line, 1.5 * line});
}

render::Image sectionPicture(const std::vector<CanalRow>& canals) {
  std::size_t columns = 1;
  for (const CanalRow& canal : canals) columns = std::max(columns, canal.sections.size());
  const double width = kPanel * static_cast<double>(columns), row = kNames + kPanel;
  const glm::dvec2 size(width, row * static_cast<double>(canals.size()) + kNames);
  const Drawing drawing(glm::ivec2(size), 1.0);
  drawing.fill(paper::kWhite);
  for (std::size_t n = 0; n < canals.size(); ++n) {
    const double top = row * static_cast<double>(n);
    drawing.text(canals[n].name, {8.0, top + 0.5 * kNames}, kWords + 1.0, paper::kInk, Align::left, true);
    for (std::size_t c = 0; c < canals[n].sections.size(); ++c)
      drawPanel(drawing, canals[n].sections[c], {kPanel * static_cast<double>(c) + 2.0, top + kNames});
  }
  const double y = size.y - 0.5 * kNames;
  drawing.line({8.0, y}, {8.0 + kPerMm, y}, 2.0, paper::kInk);
  drawing.text(
      "1 mm; blue as it was, orange as it is, rose what was laid; seen towards the apex, the furcation to the right",
      {16.0 + kPerMm, y}, kWords, paper::kQuiet, Align::left);
  return drawing.picture();
}

}  // namespace app
