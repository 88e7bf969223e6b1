// Whether an eye sees a place at the site: for the share that was removed out of sight (sight.h) and for the coach
// while it is removed. What hides: bone and teeth at least half solid, the surface that is drawn; lip, cheek, tongue
// and gum unless they are held aside. The bur hides nothing. Frame P, mm. Pure; any thread; 5 µs a line.
#pragma once

#include <cstdint>
#include <span>

#include <glm/glm.hpp>

#include "app/session/eyes_event.h"
#include "assets/soft_tissue_field.h"
#include "assets/volume_grid.h"
#include "haptics/servo/tick.h"
#include "haptics/tool/bur_shape.h"

namespace app {

/// What is held aside.
struct HeldAside {
  bool lips = false, gum = false;  ///< with cheek and tongue; the flap's side
};

/// Borrows all.
struct SightLines {
  const assets::VolumeGrid& grid;
  std::span<const std::uint8_t> solid;  ///< in its order
  const assets::SoftTissueField& soft;  ///< may be empty
  HeldAside held;

  /// From the middle of a voxel, which does not hide itself.
  bool isHidden(glm::ivec3 voxel, const glm::dvec3& eye_P_mm) const;
  bool isHidden(glm::ivec3 voxel, const EyesPlace& eyes) const {
    return isHidden(voxel, eyes.left_P_mm) && isHidden(voxel, eyes.right_P_mm);
  }
};

/// Most of the wall that a turning bur takes away in this tick is hidden from both eyes: of up to 26 places on its head
/// that touch what is solid. False: it takes nothing, or less than three of them do. Some 0.1 ms.
bool worksOutOfSight(const SightLines& lines, const haptics::Tick& tick, const haptics::BurShape& head,
                     const EyesPlace& eyes);

}  // namespace app
