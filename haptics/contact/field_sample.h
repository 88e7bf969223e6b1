// The solid field at a point between voxels: the solid fraction interpolated linearly along the three axes, and the
// label of the nearest voxel. Frame P, mm. Outside the grid is air. Any thread that may read the field; some 10 ns.
// Half a voxel of smear either way, without bias on flat bone. Not a volume (contact/overlap).
#pragma once

#include <array>
#include <cstdint>

#include "haptics/bone/solid_field.h"

namespace haptics {

struct FieldSample {
  double solid = 0.0;      ///< 0..1
  std::uint8_t label = 0;  ///< assets::Tissue
};

FieldSample sampleField(const SolidField& field, const glm::dvec3& at_P_mm) noexcept;

}  // namespace haptics
