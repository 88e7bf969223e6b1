#include "app/procedure/preparation/resting_plane.h"

#include <algorithm>
#include <cmath>

namespace app {
namespace {

constexpr double kFarSupport_mm = 1e3;

/// Shares of three supports in a load.
glm::dvec3 sharesOf(const std::array<Support, 3>& on, const glm::dvec2& load) {
  const glm::dvec2 a = on[1].place_mm - on[0].place_mm, b = on[2].place_mm - on[0].place_mm, p = load - on[0].place_mm;
  const double area = a.x * b.y - a.y * b.x;
  const double s = (p.x * b.y - p.y * b.x) / area, t = (a.x * p.y - a.y * p.x) / area;
  return {1.0 - s - t, s, t};
}

/// The plane through three supports.
glm::dvec3 planeOf(const std::array<Support, 3>& on) {
  const glm::dmat3 rows(glm::dvec3(on[0].place_mm, 1.0), glm::dvec3(on[1].place_mm, 1.0),
                        glm::dvec3(on[2].place_mm, 1.0));
  return glm::dvec3(on[0].height_mm, on[1].height_mm, on[2].height_mm) * glm::inverse(rows);
}

}  // namespace

std::optional<RestingPlane> restingPlane(const std::vector<Support>& supports, const glm::dvec2& load_mm) {
  constexpr double kLow_mm = -1e4, kOver_mm = 1e-6;
  std::array<Support, 3> on{{{{-kFarSupport_mm, -kFarSupport_mm}, kLow_mm},
                             {{kFarSupport_mm, -kFarSupport_mm}, kLow_mm},
                             {{0.0, kFarSupport_mm}, kLow_mm}}};
  for (int n = 0; n < 1000; ++n) {
    const glm::dvec3 plane = planeOf(on);
    const Support* highest = nullptr;
    double over = kOver_mm;
    for (const Support& one : supports)
      if (const double by = one.height_mm - glm::dot(plane, glm::dvec3(one.place_mm, 1.0)); by > over)
        over = by, highest = &one;
    if (highest == nullptr) break;
    std::optional<std::array<Support, 3>> best;
    double least = -1e300;
    for (std::size_t k = 0; k < 3; ++k) {
      std::array<Support, 3> next = on;
      next[k] = *highest;
      const glm::dvec3 shares = sharesOf(next, load_mm);
      const double worst = std::min({shares.x, shares.y, shares.z});
      if (std::isfinite(worst) && worst > least) least = worst, best = next;
    }
    if (!best) break;
    on = *best;
  }
  RestingPlane plane{planeOf(on), {}};
  for (std::size_t k = 0; k < 3; ++k) {
    if (on[k].height_mm <= kLow_mm) return {};
    plane.on_mm[k] = on[k].place_mm;
  }
  return plane;
}

}  // namespace app
