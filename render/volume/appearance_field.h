// Colour and finish of every voxel, blended across tissue boundaries once at load; carving uncovers it and does not
// change it, a filling does, brick by brick. RGBA8: red, green, blue as the square root of linear light, alpha the
// finish (tissue_appearance.h). Start-up, all cores; about 0.1 s for a jaw of 256^3 voxels.
#pragma once

#include <cstdint>
#include <span>

#include "render/volume/bordered_field.h"

namespace render {

/// Red in the lowest byte. `label` in the order of the voxels, or empty: all unlabelled.
BorderedField<std::uint32_t> appearanceField(const BorderedField<std::uint8_t>& solid,
                                             std::span<const std::uint8_t> label);

/// The same of one brick anew; `label` of every voxel now.
void blendBrick(const BorderedField<std::uint8_t>& solid, const BorderedField<std::uint8_t>& label, glm::ivec3 brick,
                BorderedField<std::uint32_t>& field);

}  // namespace render
