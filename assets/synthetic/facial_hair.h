// Eyebrows and lashes as single hairs: thin tapered tubes. Frame of the mandible with the operated side at +x
// (face_frames.h), mm. Deterministic from the seed. Some ms.
#pragma once

#include <cstdint>

#include "assets/mesh.h"
#include "assets/synthetic/head_shape.h"

namespace assets {

MeshPart facialHair(const HeadShape& head, std::uint32_t seed);

}  // namespace assets
