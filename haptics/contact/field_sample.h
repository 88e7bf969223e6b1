// The solid field at a point between voxels: the solid fraction interpolated linearly along the three axes, and the
// label of the nearest voxel. Frame P, mm. Outside the grid is air. Any thread that may read the field; some 10 ns.
// Half a voxel of smear either way, without bias on flat bone. Not a volume (contact/overlap).
#pragma once

#include <array>
#include <cstdint>

#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "haptics/bone/solid_field.h"

namespace haptics {

struct FieldSample {
  double solid = 0.0;      ///< 0..1
  std::uint8_t label = 0;  ///< assets::Tissue
};

FieldSample sampleField(const SolidField& field, const glm::dvec3& at_P_mm) noexcept;

/// The field as a tool at X_PT meets it: for many points of one head, three products a point instead of a turn and a
/// division.
class ToolSampler {
 public:
  ToolSampler(const SolidField& field, const calibration::Pose<calibration::Patient, calibration::Tool>& X_PT) noexcept;
  FieldSample at(const glm::dvec3& position_T_mm) const noexcept;

 private:
  const SolidField& field_;
  glm::dmat3 turn_;    ///< mm in T to voxels
  glm::dvec3 origin_;  ///< continuous index of T's origin
};

}  // namespace haptics
