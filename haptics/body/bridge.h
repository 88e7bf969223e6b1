// What still holds two parts of a tooth together, as a section of material: its area, sides and place. Found by
// bridge_search.h; plain values in the frame and mm of the tooth's grid. Any thread.
#pragma once

#include <array>
#include <cstddef>

#include <glm/glm.hpp>

namespace haptics {

struct Bridge {
  std::array<std::size_t, 2> between{};  ///< parts; the second is the nearest beyond the cut
  double area_mm2 = 0.0;
  double width_mm = 0.0, thickness_mm = 0.0;  ///< longer and shorter side of the rectangle with these second moments
  double half_width_mm = 0.0, half_thickness_mm = 0.0;  ///< from the centre to the farthest edge
  glm::dvec3 centre_mm{0.0};
  glm::dvec3 normal{0.0};      ///< unit, from the first part to the second
  glm::dvec3 width_axis{0.0};  ///< unit, in the plane of the cut

  /// Unit, in the plane of the cut, from the centre towards what was cut: the floor of the slot.
  glm::dvec3 floorwards() const { return glm::cross(normal, width_axis); }

  bool operator==(const Bridge&) const = default;
};

}  // namespace haptics
