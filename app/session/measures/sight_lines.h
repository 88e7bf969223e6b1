// Whether an eye sees a place at the site, straight or in the mirror of the second hand: for the share that was removed
// out of sight (sight.h) and for the coach while it is removed. What hides: bone and teeth at least half solid, the
// surface that is drawn; lip, cheek, tongue and gum unless they are held aside; the mirror itself. The bur hides
// nothing. In the mirror a place is seen where the way from it to the eye's image behind the glass meets the glass from
// in front, and neither part of the way is hidden. Frame P, mm. Pure; any thread; 5 µs a line, 15 with a mirror.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include <glm/glm.hpp>

#include "app/session/eyes_event.h"
#include "app/session/second_hand_event.h"
#include "assets/soft_tissue_field.h"
#include "assets/volume_grid.h"
#include "haptics/servo/tick.h"
#include "haptics/tool/bur_shape.h"

namespace app {

/// What is held aside.
struct HeldAside {
  bool lips = false, gum = false;  ///< with cheek and tongue; the flap's side
};

/// Glass and casing as flat discs about one centre.
struct MirrorDisc {
  glm::dvec3 centre_P_mm{0.0};
  glm::dvec3 out_P{0.0, 0.0, 1.0};  ///< unit, out of the glass
};
/// None: no mirror, or it is lost.
std::optional<MirrorDisc> mirrorDiscOf(const std::optional<SecondHandPlace>& second_hand);

/// Borrows all.
struct SightLines {
  const assets::VolumeGrid& grid;
  std::span<const std::uint8_t> solid;  ///< in its order
  const assets::SoftTissueField& soft;  ///< may be empty
  HeldAside held;
  std::optional<MirrorDisc> mirror = {};

  /// From the middle of a voxel, which does not hide itself; straight or in the mirror.
  bool isHidden(glm::ivec3 voxel, const glm::dvec3& eye_P_mm) const;
  bool isHidden(glm::ivec3 voxel, const EyesPlace& eyes) const {
    return isHidden(voxel, eyes.left_P_mm) && isHidden(voxel, eyes.right_P_mm);
  }
  /// Whether either eye sees the place in the mirror, whatever they see straight. Of a place: of the voxel around it.
  bool isInMirror(glm::ivec3 voxel, const EyesPlace& eyes) const;
  bool isInMirror(const glm::dvec3& place_P_mm, const EyesPlace& eyes) const;
};

/// Most of the wall that a turning bur takes away in this tick is hidden from both eyes: of up to 26 places on its head
/// that touch what is solid. False: it takes nothing, or less than three of them do. Some 0.1 ms.
bool worksOutOfSight(const SightLines& lines, const haptics::Tick& tick, const haptics::BurShape& head,
                     const EyesPlace& eyes);

}  // namespace app
