// The plane on which something loaded at a place comes to rest over supports of different heights: over all of them,
// on three whose triangle holds the load (the dual simplex method: the highest support over the plane replaces one of
// its three such that the load stays among them). mm. Pure; any thread; some ms for 20,000 supports.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

namespace app {

struct Support {
  glm::dvec2 place_mm{0.0};
  double height_mm = 0.0;
};

struct RestingPlane {
  glm::dvec3 slopes_and_height{0.0};  ///< along x, along y; at the origin, mm
  std::array<glm::dvec2, 3> on_mm{};

  double at_mm(const glm::dvec2& place_mm) const { return glm::dot(slopes_and_height, glm::dvec3(place_mm, 1.0)); }
};

/// None: the load lies beside all triangles of supports, it would tip over.
std::optional<RestingPlane> restingPlane(const std::vector<Support>& supports, const glm::dvec2& load_mm);

}  // namespace app
