#include "app/device/access_script.h"

#include <algorithm>
#include <limits>

namespace app {
namespace {

constexpr double kLayer_mm = 0.35, kLine_mm = 0.35;  ///< apart
constexpr double kOverCusp_mm = 1.0, kThroughRoof_mm = 0.2, kOverFloor_mm = 0.3;
constexpr double kTaper = 0.10;          ///< wider a mm over the roof, as files need it
constexpr double kLeastAside_mm = 0.05;  ///< of an outline that is a point or a line

glm::dvec2 middleOf(const std::vector<glm::dvec2>& outline) {
  glm::dvec2 low(std::numeric_limits<double>::max()), high(-std::numeric_limits<double>::max());
  for (const glm::dvec2& p : outline) low = glm::min(low, p), high = glm::max(high, p);
  return 0.5 * (low + high);
}

/// Lines to and fro where the bur's middle may be.
std::vector<glm::dvec2> layer(const std::vector<glm::dvec2>& outline, double aside_mm) {
  const glm::dvec2 middle = middleOf(outline);
  double reach_mm = aside_mm;
  for (const glm::dvec2& p : outline) reach_mm = std::max(reach_mm, glm::distance(p, middle) + aside_mm);
  const int lines = static_cast<int>(reach_mm / kLine_mm) + 1;
  constexpr int kSteps = 400;
  std::vector<glm::dvec2> way;
  for (int line = -lines; line <= lines; ++line) {
    const double y = middle.y + line * kLine_mm;
    double low = std::numeric_limits<double>::max(), high = -low;
    for (int n = 0; n <= kSteps; ++n) {
      const double x = middle.x + reach_mm * (2.0 * n / kSteps - 1.0);
      if (assets::outlineDistance_mm(outline, {x, y}) > aside_mm) continue;
      low = std::min(low, x), high = std::max(high, x);
    }
    if (low > high) continue;
    const bool back = way.size() % 4 >= 2;
    way.emplace_back(back ? high : low, y);
    way.emplace_back(back ? low : high, y);
  }
  return way;
}

}  // namespace

std::vector<glm::dvec3> accessWay_P(const assets::ToothCanals& tooth) {
  const assets::PulpChamber& chamber = tooth.chamber;
  const double top_mm = tooth.frame.local(tooth.canals[0].reference_P_mm).z + kOverCusp_mm;
  const double bottom_mm =
      std::max(chamber.roof_mm - kThroughRoof_mm, chamber.floor_mm + kAccessBurRadius_mm + kOverFloor_mm);
  const int layers = std::max(1, static_cast<int>((top_mm - bottom_mm) / kLayer_mm + 0.999));
  std::vector<glm::dvec3> way_P;
  for (int n = 0; n <= layers; ++n) {
    const double z = top_mm + (bottom_mm - top_mm) * n / layers, over_mm = std::max(0.0, z - chamber.roof_mm);
    const double fitting_mm = chamber.round_mm + kTaper * over_mm - kAccessBurRadius_mm;
    const double aside_mm = chamber.outline_mm.size() > 2 ? fitting_mm : std::max(kLeastAside_mm, fitting_mm);
    std::vector<glm::dvec2> lines = layer(chamber.outline_mm, aside_mm);
    // On from where the last one ended.
    if (n % 2 == 1) std::ranges::reverse(lines);
    for (const glm::dvec2& at : lines) way_P.push_back(tooth.frame.inP({at, z}));
  }
  const glm::dvec2 middle = middleOf(chamber.outline_mm);
  way_P.push_back(tooth.frame.inP({middle, bottom_mm}));
  way_P.push_back(tooth.frame.inP({middle, top_mm + kOverCusp_mm}));
  return way_P;
}

}  // namespace app
