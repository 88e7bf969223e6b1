// What a root-canal file that broke has left in a tooth: its wire from the break to its tip, as round cones along a
// line of nodes. Frame P, mm. Plain values; any thread.
#pragma once

#include <cstddef>
#include <vector>

#include <glm/glm.hpp>

namespace assets {

/// In one tooth, and nodes of one: more are not kept.
inline constexpr std::size_t kMostMetalFragments = 8, kMostMetalNodes = 65;

struct MetalFragment {
  int size = 25;  ///< of the file, 1/100 mm at its tip
  bool nickel_titanium = false;
  std::vector<glm::dvec3> node_P_mm;  ///< from the break to the tip; two at least
  std::vector<double> radius_mm;      ///< at each node

  bool operator==(const MetalFragment&) const = default;

  const glm::dvec3& tip_P_mm() const { return node_P_mm.back(); }
  double length_mm() const {
    double length_mm = 0.0;
    for (std::size_t n = 1; n < node_P_mm.size(); ++n) length_mm += glm::distance(node_P_mm[n - 1], node_P_mm[n]);
    return length_mm;
  }
};

}  // namespace assets
