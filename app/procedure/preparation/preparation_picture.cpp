#include "app/procedure/preparation/preparation_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <fmt/core.h>

#include "app/procedure/preparation/deviation_colour.h"
#include "app/report/drawing.h"

namespace app {
namespace {

constexpr int kPanel = 300;
constexpr double kNamesHeight = 26.0, kLetters = 13.0, kLegend = 64.0;
constexpr glm::dvec3 kOutline(0.0, 0.447, 0.698);
constexpr glm::dvec3 kTaken(0.86, 0.89, 0.92), kLeft(0.94, 0.86, 0.72), kUncut(0.80, 0.80, 0.78);

/// The tooth's frame as a panel shows it: to the right, up, towards the viewer.
struct PanelView {
  const char* name;
  glm::dvec3 right, up, out;
};
constexpr std::array<PanelView, 5> kViews{{
    {"from the bite, mesial to the right", {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
    {"from the cheek", {1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
    {"from the tongue", {-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
    {"from mesial", {0, 1, 0}, {0, 0, 1}, {1, 0, 0}},
    {"from distal", {0, -1, 0}, {0, 0, 1}, {-1, 0, 0}},
}};

/// A square of pixels with depth.
class Panel {
 public:
  Panel() : picture_{kPanel, kPanel, std::vector<std::uint8_t>(std::size_t{4} * kPanel * kPanel, 255)} {}

  void put(int x, int y, const glm::dvec3& colour) {
    if (x < 0 || y < 0 || x >= kPanel || y >= kPanel) return;
    const std::size_t at = 4 * (static_cast<std::size_t>(y) * kPanel + static_cast<std::size_t>(x));
    for (int c = 0; c < 3; ++c)
      picture_.rgba[at + static_cast<std::size_t>(c)] =
          static_cast<std::uint8_t>(255.0 * std::clamp(colour[c], 0.0, 1.0) + 0.5);
  }
  void put(int x, int y, double depth, const glm::dvec3& colour) {
    if (x < 0 || y < 0 || x >= kPanel || y >= kPanel) return;
    double& so_far = depth_[static_cast<std::size_t>(y) * kPanel + static_cast<std::size_t>(x)];
    if (depth <= so_far) return;
    so_far = depth;
    put(x, y, colour);
  }
  const render::Image& picture() const { return picture_; }

 private:
  render::Image picture_;
  std::vector<double> depth_ = std::vector<double>(std::size_t{kPanel} * kPanel, -1e9);
};

/// From millimetres in the tooth's frame to pixels: the crown fills a panel.
struct Scale {
  double per_mm;
  glm::dvec2 middle_mm;  ///< of the panel, to the right and up
  glm::ivec2 pixel(double right_mm, double up_mm) const {
    return {static_cast<int>(std::floor(0.5 * kPanel + per_mm * (right_mm - middle_mm.x))),
            static_cast<int>(std::floor(0.5 * kPanel - per_mm * (up_mm - middle_mm.y)))};
  }
  glm::dvec2 place_mm(int x, int y) const {
    return middle_mm + glm::dvec2(x + 0.5 - 0.5 * kPanel, 0.5 * kPanel - y - 0.5) / per_mm;
  }
};

Scale scaleOf(const Crown& crown, const PanelView& view) {
  const double half_mm = std::max(crown.reach_mm, 0.5 * crown.top_mm + 0.5) + 0.4;
  return {0.5 * kPanel / half_mm, {0.0, view.up.z > 0.0 ? 0.5 * crown.top_mm : 0.0}};
}

Panel surfacePanel(const PreparationMeasure& measure, const BoxBytes& made, const PreparationOutcomes& outcomes,
                   const PanelView& view) {
  const Crown& crown = measure.crown();
  const Scale scale = scaleOf(crown, view);
  const double voxel_mm = crown.solid.grid().spacing_mm;
  const int half = static_cast<int>(std::ceil(0.6 * voxel_mm * scale.per_mm));
  Panel panel;
  const auto splat = [&](const glm::dvec3& p, double light, const glm::dvec3& colour) {
    const glm::ivec2 at = scale.pixel(glm::dot(p, view.right), glm::dot(p, view.up));
    for (int y = -half; y <= half; ++y)
      for (int x = -half; x <= half; ++x) panel.put(at.x + x, at.y + y, glm::dot(p, view.out), light * colour);
  };
  // All of the crown in grey, by rays; what is measured lies over it.
  constexpr double kOver_mm = 0.2;
  const double reach_mm = crown.reach_mm + crown.top_mm, step_mm = 1.5 * voxel_mm;
  for (int y = 0; y < kPanel; ++y)
    for (int x = 0; x < kPanel; ++x) {
      const glm::dvec2 at = scale.place_mm(x, y);
      for (double mm = reach_mm; mm > -reach_mm; mm -= step_mm) {
        const glm::dvec3 p = at.x * view.right + at.y * view.up + mm * view.out, p_P = crown.frame.inP(p);
        if (p.z < 0.0 || made.nearest(p_P) < 128 || !crown.isTooth(p_P)) continue;
        const glm::dvec3 aside_P = crown.frame.axes_P * view.right, up_P = crown.frame.axes_P * view.up,
                         out_P = crown.frame.axes_P * view.out;
        const auto slope = [&](const glm::dvec3& way_P) {
          return made.at(p_P - 2.0 * voxel_mm * way_P) - made.at(p_P + 2.0 * voxel_mm * way_P);
        };
        const glm::dvec3 out(slope(aside_P), slope(up_P), slope(out_P));
        const double facing = glm::length(out) > 0.0 ? std::max(0.0, out.z / glm::length(out)) : 0.0;
        panel.put(x, y, mm - kOver_mm, (0.45 + 0.45 * facing) * kUncut);
        break;
      }
    }
  for (const DeviationPlace& place : outcomes.deviation.places) {
    const glm::dvec3 out = glm::dvec3(place.out_P) * crown.frame.axes_P;
    const double facing = glm::dot(out, view.out);
    if (facing <= 0.0) continue;
    splat(crown.frame.local(glm::dvec3(place.p_P_mm)), 0.55 + 0.45 * facing,
          deviationColour(static_cast<double>(place.deviation_mm)));
  }
  return panel;
}

/// Upright, through the axis.
Panel sectionPanel(const PreparationMeasure& measure, const BoxBytes& made, const PanelView& view) {
  const Crown& crown = measure.crown();
  const Scale scale = scaleOf(crown, view);
  Panel panel;
  const auto value = [&](const BoxBytes& bytes, int x, int y) {
    const glm::dvec2 at = scale.place_mm(x, y);
    return bytes.at(crown.frame.inP(at.x * view.right + at.y * view.up));
  };
  for (int y = 0; y < kPanel; ++y)
    for (int x = 0; x < kPanel; ++x) {
      const glm::dvec2 at = scale.place_mm(x, y);
      const glm::dvec3 p_P = crown.frame.inP(at.x * view.right + at.y * view.up);
      if (made.at(p_P) >= 0.5)
        panel.put(x, y, crown.isTooth(p_P) ? kLeft : kUncut);
      else if (crown.solid.at(p_P) >= 0.5)
        panel.put(x, y, kTaken);
      // The ideal's outline, two pixels wide.
      const bool is_in = value(measure.ideal(), x, y) >= 0.5;
      const bool is_edge =
          is_in != (value(measure.ideal(), x + 1, y) >= 0.5) || is_in != (value(measure.ideal(), x, y + 1) >= 0.5);
      if (!is_edge || !(crown.solid.at(p_P) >= 0.25)) continue;
      panel.put(x, y, kOutline);
      panel.put(x + 1, y, kOutline);
    }
  return panel;
}

}  // namespace

render::Image preparationPicture(const PreparationMeasure& measure, const BoxBytes& made,
                                 const PreparationOutcomes& outcomes) {
  constexpr int kColumns = 4;
  const double row = kNamesHeight + kPanel;
  const glm::dvec2 size(kColumns * kPanel, 2.0 * row + kLegend);
  const Drawing drawing(glm::ivec2(size), 1.0);
  drawing.fill(paper::kWhite);
  const auto place = [&](int column, int line, const std::string& name, const Panel& panel) {
    const glm::dvec2 corner(column * kPanel, line * row);
    drawing.text(name, corner + glm::dvec2(8.0, 0.5 * kNamesHeight), kLetters, paper::kInk, Align::left, true);
    drawing.image(panel.picture(), corner + glm::dvec2(0.0, kNamesHeight), glm::dvec2(kPanel));
  };
  place(0, 0, kViews[0].name, surfacePanel(measure, made, outcomes, kViews[0]));
  place(1, 0, kViews[1].name, surfacePanel(measure, made, outcomes, kViews[1]));
  place(2, 0, kViews[2].name, surfacePanel(measure, made, outcomes, kViews[2]));
  place(0, 1, kViews[3].name, surfacePanel(measure, made, outcomes, kViews[3]));
  place(1, 1, kViews[4].name, surfacePanel(measure, made, outcomes, kViews[4]));
  place(3, 0, "section, distal to mesial", sectionPanel(measure, made, kViews[1]));
  place(3, 1, "section, tongue to cheek", sectionPanel(measure, made, kViews[3]));

  // How wide a share of the surface is off by how much.
  const glm::dvec2 corner(2 * kPanel + 8.0, row);
  drawing.text("share of the surface within", corner + glm::dvec2(0.0, 0.5 * kNamesHeight), kLetters, paper::kInk,
               Align::left, true);
  for (std::size_t n = 0; n < kTolerances_mm.size(); ++n) {
    const double y = kNamesHeight + 24.0 + 40.0 * static_cast<double>(n), share = outcomes.deviation.within[n];
    constexpr double kBar = 150.0;
    drawing.text(fmt::format("{:g} mm", kTolerances_mm[n]), corner + glm::dvec2(0.0, y), kLetters, paper::kInk,
                 Align::left);
    drawing.box(corner + glm::dvec2(64.0, y - 8.0), {kBar, 16.0}, paper::kFaint);
    drawing.box(corner + glm::dvec2(64.0, y - 8.0), {kBar * share, 16.0}, paper::kGreen);
    drawing.text(fmt::format("{:.0f} %", 100.0 * share), corner + glm::dvec2(72.0 + kBar, y), kLetters, paper::kInk,
                 Align::left);
  }

  const double y = size.y - 0.5 * kLegend;
  constexpr double kStrip = 240.0;
  for (int n = 0; n < 60; ++n) {
    const double mm = kFullColour_mm * (n - 29.5) / 30.0;
    const glm::dvec3 colour = deviationColour(mm);
    drawing.box({8.0 + kStrip * n / 60.0, y - 18.0}, {kStrip / 60.0 + 0.5, 16.0}, Ink{colour.r, colour.g, colour.b});
  }
  drawing.text(fmt::format("{:g} mm too deep", kFullColour_mm), {8.0, y + 12.0}, kLetters, paper::kInk, Align::left);
  drawing.text(fmt::format("{:g} mm too high", kFullColour_mm), {8.0 + kStrip, y + 12.0}, kLetters, paper::kInk,
               Align::right);
  drawing.text("Coloured: what is cut or was to be cut. Sections: taken grey, left yellow, the ideal's outline blue.",
               {kStrip + 40.0, y - 10.0}, kLetters, paper::kQuiet, Align::left);
  return drawing.picture();
}

}  // namespace app
