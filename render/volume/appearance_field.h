// The colour and finish of the matter in every voxel, melted over its neighbours so that neither voxel edges nor the
// air beside a surface show: a quadratic B-spline over 27 voxels, weighted by what each holds (solid squared) and by
// the colour_weight of its tissue. Made once from the scan; carving uncovers it and never changes it. RGBA8: red,
// green, blue as the square root of linear light, alpha the finish (tissue_look.h). Start-up, all cores; about 0.1 s
// for a jaw of 256^3 voxels.
#pragma once

#include <cstdint>
#include <span>

#include "render/volume/bordered_field.h"

namespace render {

/// Red in the lowest byte. `label` in the order of the voxels, or empty: all unlabelled.
BorderedField<std::uint32_t> appearanceField(const BorderedField<std::uint8_t>& solid,
                                             std::span<const std::uint8_t> label);

}  // namespace render
