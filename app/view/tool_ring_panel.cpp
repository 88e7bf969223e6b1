#include "app/view/tool_ring_panel.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/core.h>

#include "app/view/ring_shape.h"
#include "calibration/geometry/units.h"

namespace app {
namespace {

constexpr Ink kRingGround{0.05, 0.06, 0.08, 0.45}, kNamePlate{0.05, 0.06, 0.08, 0.78}, kNameInk{0.96, 0.97, 0.98},
    kChosenPlate{0.97, 0.97, 0.95, 0.97}, kChosenInk{0.06, 0.05, 0.04}, kInHandInk{0.55, 0.78, 0.98},
    kSectorInk{1.0, 1.0, 1.0, 0.28}, kMiddleInk{0.05, 0.06, 0.08, 0.8};
constexpr double kUpright = 0.25;  ///< names whose direction is that near to the vertical stand centred

struct Name {
  std::string words;
  glm::dvec2 corner{0.0}, size{1.0};  ///< from the middle
};

/// Beside the ring, from its rim outwards.
std::vector<Name> namesAround(const HeadUpRing& ring, double radius, double text) {
  const Drawing measure(glm::ivec2(1), 1.0);
  std::vector<Name> names;
  for (std::size_t n = 0; n < ring.names.size(); ++n) {
    Name name{ring.names[n]};
    name.size = {std::ceil(measure.textWidth(name.words, text, true) + 1.4 * text), std::ceil(1.7 * text)};
    const glm::dvec2 way = ringDirection(n, ring.names.size()), at = radius * way;
    const bool is_upright = std::abs(way.x) < kUpright;
    const double left = is_upright ? 0.5 : way.x > 0.0 ? 0.0 : 1.0;
    name.corner = at - glm::dvec2(left, 0.5) * name.size;
    // Clear of its neighbours beside it.
    if (is_upright) name.corner.y += (way.y > 0.0 ? 0.75 : -0.75) * name.size.y;
    names.push_back(std::move(name));
  }
  return names;
}

std::vector<glm::dvec2> sector(const glm::dvec2& middle, double inner, double outer, std::size_t n, std::size_t of) {
  const double half = calibration::kPi / static_cast<double>(of), at = 2.0 * half * static_cast<double>(n);
  constexpr int kSteps = 24;
  std::vector<glm::dvec2> corners;
  const auto add = [&](double angle, double radius) {
    corners.push_back(middle + radius * glm::dvec2(std::sin(angle), -std::cos(angle)));
  };
  for (int k = 0; k <= kSteps; ++k) add(at - half + 2.0 * half * k / kSteps, outer);
  for (int k = kSteps; k >= 0; --k) add(at - half + 2.0 * half * k / kSteps, inner);
  return corners;
}

}  // namespace

ToolRingPanel toolRingPanel(const HeadUpRing& ring, const HeadUpPlace& place, double text_px) {
  const glm::dvec2 screen(place.screen_px);
  const double margin = 4.0;
  // As large as it fits.
  double scale = 1.0, radius = 0.0, text = 0.0;
  std::vector<Name> names;
  glm::dvec2 low(0.0), high(0.0);
  for (int tries = 0; tries < 4; ++tries) {
    radius = scale * kRingRadius * screen.y;
    text = scale * text_px;
    names = namesAround(ring, radius, text);
    low = glm::dvec2(-radius), high = glm::dvec2(radius);
    for (const Name& name : names) {
      low = glm::min(low, name.corner);
      high = glm::max(high, name.corner + name.size);
    }
    const glm::dvec2 room = (screen - 2.0 * margin) / (high - low);
    const double fits = std::min(room.x, room.y);
    if (fits >= 1.0) break;
    scale *= 0.99 * fits;
  }
  const glm::dvec2 size = glm::ceil(high - low);
  const glm::dvec2 wanted = ring.middle * screen.y + low;
  const glm::ivec2 corner(glm::clamp(wanted, glm::dvec2(margin), glm::max(screen - size - margin, glm::dvec2(margin))));

  std::string content = fmt::format("ring {} {}", ring.in_hand, ring.chosen ? static_cast<int>(*ring.chosen) : -1);
  for (const std::string& name : ring.names) content += "\n" + name;
  const double inner = scale * kRingMiddle * screen.y;
  return {content, corner, glm::ivec2(size),
          [names, middle = -low, radius, inner, text, chosen = ring.chosen, in_hand = ring.in_hand](const Drawing& to) {
            to.disc(middle, 0.98 * radius, kRingGround);
            if (chosen) to.polygon(sector(middle, inner, 0.98 * radius, *chosen, names.size()), kSectorInk);
            to.disc(middle, inner, chosen ? kMiddleInk : kChosenPlate);
            to.text("keep", middle, 0.8 * text, chosen ? kNameInk : kChosenInk, Align::centre, true);
            for (std::size_t n = 0; n < names.size(); ++n) {
              const bool is_chosen = chosen == n;
              const glm::dvec2 at = middle + names[n].corner;
              to.box(at, names[n].size, is_chosen ? kChosenPlate : kNamePlate);
              if (n == in_hand) to.outline(at + 1.0, names[n].size - 2.0, 2.0, kInHandInk);
              to.text(names[n].words, at + 0.5 * names[n].size, text, is_chosen ? kChosenInk : kNameInk, Align::centre,
                      true);
            }
          }};
}

}  // namespace app
