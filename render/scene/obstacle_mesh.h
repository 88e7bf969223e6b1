// Bone that has to go before a piece of tooth comes out, as one closed surface around its voxels: smooth, and a
// quarter of a voxel outside of them, so that a layer one voxel thick is seen; a stray voxel is not. Frame P, mm. Pure;
// 1 ms per 10 mm³ at 0.25 mm voxels; whenever it changes.
#pragma once

#include "assets/mesh.h"
#include "render/frame.h"

namespace render {

/// Empty for none.
assets::MeshModel obstacleMesh(const Obstacles& obstacles);

}  // namespace render
