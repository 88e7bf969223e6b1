// Solid bodies at points between voxels: the solid fraction interpolated linearly along the three axes, summed over the
// bodies, and the label of the nearest voxel of the body with the largest part. Outside the grids is air. Any thread
// that may read the fields; about 10 ns a point and body. Smears by half a voxel either way, without bias on flat bone.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "haptics/body/solid_bodies.h"

namespace haptics {

struct FieldSample {
  double solid = 0.0;      ///< 0..1
  std::uint8_t label = 0;  ///< assets::Tissue
};

/// The bodies around a tool at X_PT, for many points of one head.
class ToolSampler {
 public:
  ToolSampler(const SolidBodies& bodies,
              const calibration::Pose<calibration::Patient, calibration::Tool>& X_PT) noexcept;
  FieldSample at(const glm::dvec3& position_T_mm) const noexcept;

 private:
  FieldSample sumAt(const glm::dvec3& position_T_mm) const noexcept;

  struct Body {
    SolidField field;
    glm::dmat3 to_index;  ///< mm in T to voxels
    glm::dvec3 origin;    ///< continuous index of T's origin
  };
  std::array<Body, kMaxMet> bodies_;
  std::size_t count_ = 0;
};

}  // namespace haptics
