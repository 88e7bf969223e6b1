// Where beside the operated tooth bone was removed (reference/product 4.2: O1). Six zones fill the space around it: a
// place belongs to the side of the tooth's box, in the directions of the case, that it lies out of the farthest, in
// half edges of the box. Our definition, as the sources name zones by case. Frame P, mm. Pure; any thread; a pass over
// the grid.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>

#include <glm/glm.hpp>

#include "app/session/measures/session_case.h"
#include "assets/volume_grid.h"

namespace app {

enum class Zone : std::uint8_t { occlusal, buccal, distal, mesial, lingual, apical };
inline constexpr std::size_t kZones = 6;

class Zones {
 public:
  /// `is_tooth`: of a voxel. None: there is no such voxel.
  static std::optional<Zones> around(const assets::VolumeGrid& grid, const std::function<bool(std::size_t)>& is_tooth,
                                     const CaseDirections& directions);

  Zone at(const glm::dvec3& p_P_mm) const;

 private:
  std::array<glm::dvec3, 3> axes_P_{};        ///< to distal, buccal, up
  glm::dvec3 centre_mm_{0.0}, half_mm_{1.0};  ///< of the box, along these
};

/// Around the operated tooth; none: it, or where its sides are, is not known.
std::optional<Zones> zonesOfCase(const StoredStart& start, const SessionCase& about);

}  // namespace app
