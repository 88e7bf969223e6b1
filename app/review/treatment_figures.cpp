#include "app/review/treatment_figures.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/core.h>

#include "app/procedure/root_canal/section_picture.h"
#include "app/report/axes.h"
#include "app/report/drawing.h"

namespace app {
namespace {

constexpr double kPage = 800.0, kGap = 8.0;
constexpr Ink kCanalInk = inkOf(0xf0e2c4);

/// A bar of so many mm with its words, at the lower left of a panel.
void scaleBar(const Drawing& drawing, const glm::dvec2& left, double px_per_mm, double mm) {
  drawing.line(left, left + glm::dvec2(mm * px_per_mm, 0.0), 2.0, paper::kInk);
  drawing.text(fmt::format("{:g} mm", mm), left + glm::dvec2(mm * px_per_mm + 5.0, 0.0), kNumberLine, paper::kInk,
               Align::left);
}

/// Across a figure and along it, downwards to the apex.
struct SideView {
  std::string_view from;
  int across;  ///< axis of the tooth's frame
};
constexpr SideView kSides[] = {{"from the cheek, mesial to the right", 0}, {"from mesial, the cheek to the right", 1}};

}  // namespace

std::string sectionsFigure(const TreatedCanal& canal) {
  constexpr double kRoot_mm = 3.2, kCanal_mm = 0.8, kWordsHeight = 40.0;
  const auto& sections = canal.outcomes.sections;
  const double column = kPage / static_cast<double>(sections.size()), edge = column - kGap;
  Drawing drawing({kPage, 2.0 * (edge + kGap) + kWordsHeight});
  for (std::size_t n = 0; n < sections.size(); ++n) {
    const glm::dvec2 top(static_cast<double>(n) * column, 0.0), below = top + glm::dvec2(0.0, edge + kGap);
    drawSection(drawing, sections[n], top, edge, kRoot_mm, 1.2);
    drawSection(drawing, sections[n], below, edge, kCanal_mm, 2.0);
    drawing.text(fmt::format("{:g} mm from the foramen", sections[n].from_foramen_mm), top + glm::dvec2(6.0, 12.0),
                 kNumberLine, paper::kInk, Align::left, true);
    if (n == 0) {
      scaleBar(drawing, top + glm::dvec2(6.0, edge - 10.0), 0.5 * edge / kRoot_mm, 1.0);
      scaleBar(drawing, below + glm::dvec2(6.0, edge - 10.0), 0.5 * edge / kCanal_mm, 0.25);
    }
    const double least_mm = leastDentine_mm(sections[n]);
    if (std::isfinite(least_mm))
      drawing.text(fmt::format("least dentine {:.2f} mm", std::max(0.0, least_mm)),
                   below + glm::dvec2(0.0, edge + 12.0), kNumberLine, paper::kInk, Align::left,
                   least_mm < kThinWall_mm);
    const std::string moved = movedWords(sections[n]);
    drawing.text(moved.empty() ? "not moved" : moved, below + glm::dvec2(0.0, edge + 29.0), kNumberLine, paper::kInk,
                 Align::left);
  }
  return drawing.markup(fmt::format("Sections of the {} canal before and after", canal.name));
}

std::string axisFigure(const assets::ToothCanals& tooth, std::size_t number, const CanalOutcomes& outcomes) {
  constexpr double kAround_mm = 1.0, kHeight = 340.0, kTop = 24.0;
  const assets::ToothCanal& canal = tooth.canals[number];
  const auto locally = [&](const std::vector<glm::dvec3>& axis_P) {
    std::vector<glm::dvec3> axis;
    for (const glm::dvec3& p_P : axis_P) axis.push_back(tooth.frame.local(p_P));
    return axis;
  };
  const std::vector<glm::dvec3> before = locally(outcomes.axis_before_P_mm), after = locally(outcomes.axis_after_P_mm);
  glm::dvec3 low(1e9), high(-1e9);
  for (const assets::CanalPlace& place : canal.places) {
    const glm::dvec3 p = tooth.frame.local(place.p_P_mm);
    low = glm::min(low, p), high = glm::max(high, p);
  }
  const double px_per_mm = kHeight / (high.z - low.z + 2.0 * kAround_mm);
  constexpr double kColumn = 0.5 * kPage;
  Drawing drawing({kPage, kTop + kHeight});
  for (std::size_t view = 0; view < std::size(kSides); ++view) {
    const SideView& side = kSides[view];
    const double middle_mm = 0.5 * (low[side.across] + high[side.across]);
    const glm::dvec2 foot((static_cast<double>(view) + 0.5) * kColumn, kTop + kHeight);
    const auto at = [&](const glm::dvec3& p) {
      return foot + px_per_mm * glm::dvec2(p[side.across] - middle_mm, low.z - kAround_mm - p.z);
    };
    const auto line = [&](const std::vector<glm::dvec3>& axis) {
      std::vector<glm::dvec2> points;
      std::ranges::transform(axis, std::back_inserter(points), at);
      return points;
    };
    // The canal as it was made, as wide as its section seen from here.
    std::vector<glm::dvec2> wall;
    for (const double sign : {-1.0, 1.0}) {
      std::vector<glm::dvec2> edge;
      for (const assets::CanalPlace& place : canal.places) {
        const double half_mm = side.across == 0 ? place.narrow_mm : place.wide_mm;
        edge.push_back(at(tooth.frame.local(place.p_P_mm)) + glm::dvec2(sign * half_mm * px_per_mm, 0.0));
      }
      if (sign > 0.0) std::ranges::reverse(edge);
      wall.insert(wall.end(), edge.begin(), edge.end());
    }
    drawing.polygon(wall, kCanalInk);
    drawing.path(line(after), 2.2, paper::kOrange);
    drawing.path(line(before), 1.5, paper::kBlue, false, {4.0, 3.0});
    const double left = static_cast<double>(view) * kColumn;
    drawing.text(std::string(side.from), {left, 10.0}, kNumberLine, paper::kInk, Align::left, true);
    drawing.text("orifice", at(tooth.frame.local(canal.orifice_P_mm())) + glm::dvec2(34.0, -6.0), kNumberLine,
                 paper::kQuiet, Align::left);
    drawing.text("foramen", at(tooth.frame.local(canal.foramen_P_mm())) + glm::dvec2(24.0, 6.0), kNumberLine,
                 paper::kQuiet, Align::left);
    if (view == 0) scaleBar(drawing, {left, kTop + kHeight - 12.0}, px_per_mm, 1.0);
  }
  return drawing.markup(fmt::format("Axis of the {} canal before and after", canal.name));
}

std::string filmsFigure(const FilmPair& films) {
  constexpr double kColumn = 0.5 * kPage;
  const double height = (kColumn - kGap) * films.before.h / films.before.w;
  Drawing drawing({kPage, height});
  drawing.image(films.before, {0.0, 0.0}, {kColumn - kGap, height});
  drawing.image(films.after, {kColumn, 0.0}, {kColumn - kGap, height});
  return drawing.markup("Radiographs before and after");
}

}  // namespace app
