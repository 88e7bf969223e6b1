// Small things at the site as one mesh: places that are marked, loose chips of bone and tooth, soft remnants, stitches.
// Frame P, mm. Pure; 20 to 80 triangles each; whenever they change.
#pragma once

#include <span>

#include "assets/mesh.h"
#include "render/frame.h"

namespace render {

/// A part for each kind that occurs, named and shaded as in models.h; chips are splinters, all others balls, or patches
/// of about their volume.
assets::MeshModel beadMesh(std::span<const Bead> beads);

}  // namespace render
