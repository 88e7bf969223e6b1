// Bones whose every number can be worked out by hand: half-spaces and plates of any orientation, solid blocks. Grey, as
// a scanner would give them: the face is one voxel soft.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "haptics/body/bodies.h"
#include "haptics/bone/carved_bone.h"
#include "haptics/bone/cubelets.h"

namespace haptics::phantom {

using calibration::Patient;
using calibration::Point;
using calibration::Vector;

struct Phantom {
  assets::VolumeGrid grid;
  std::vector<std::uint8_t> solid;
  /// Of `solid` as it is at the first call.
  SolidField field() const {
    if (!cubelets) cubelets.emplace(grid, solid, std::span<const std::uint8_t>{});
    return cubelets->field();
  }
  CarvedBone bone(std::uint8_t label = 0) const {
    const std::vector<std::uint8_t> labels(solid.size(), label);
    return CarvedBone(grid, solid, labels);
  }
  Bodies bodies(std::uint8_t label = 0) const { return Bodies(bone(label)); }
  mutable std::optional<Cubelets> cubelets{};
};

/// A cube about the origin, `half_mm` to each side, filled where `height_mm(p)` is below 0; one voxel soft at the face.
inline Phantom filled(double half_mm, double spacing_mm, const std::function<double(const glm::dvec3&)>& height_mm,
                      const glm::dvec3& shift_mm = glm::dvec3(0.0)) {
  const int n = static_cast<int>(std::ceil(2.0 * half_mm / spacing_mm));
  Phantom phantom;
  phantom.grid = {glm::ivec3(n), spacing_mm, glm::dvec3(-0.5 * (n - 1) * spacing_mm) + shift_mm};
  phantom.solid.resize(phantom.grid.voxelCount());
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const double fraction = std::clamp(0.5 - height_mm(phantom.grid.centre_P_mm({i, j, k})) / spacing_mm, 0.0, 1.0);
        phantom.solid[phantom.grid.index({i, j, k})] = static_cast<std::uint8_t>(fraction * 255.0 + 0.5);
      }
  return phantom;
}

/// Bone where n.x < 0; `normal` is a unit vector, `shift` moves the lattice under it.
inline Phantom halfSpace(double half_mm, double spacing_mm, const glm::dvec3& normal = {0.0, 0.0, 1.0},
                         const glm::dvec3& shift_mm = glm::dvec3(0.0)) {
  return filled(
      half_mm, spacing_mm, [=](const glm::dvec3& p) { return glm::dot(p, normal); }, shift_mm);
}

inline Phantom block(double half_mm, double spacing_mm) {
  return filled(half_mm, spacing_mm, [](const glm::dvec3&) { return -1e3; });
}

}  // namespace haptics::phantom
