// Volumes of solid balls with grey rims, whose surface solid = 0.5 is known exactly; and rigs to look at them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "assets/ct_volume.h"
#include "calibration/rig.h"
#include "render/volume/bordered_field.h"

namespace render::testing {

struct Ball {
  glm::dvec3 centre_P_mm;
  double radius_mm;
};

inline assets::VolumeGrid smallGrid(glm::ivec3 size = glm::ivec3(64), double spacing_mm = 0.5) {
  return {size, spacing_mm, -0.5 * spacing_mm * glm::dvec3(size - 1)};
}

// Rims two voxels wide, linear in distance, so trilinear samples cross 0.5 on the sphere but for its curvature.
inline assets::CtVolume ballVolume(const assets::VolumeGrid& grid, const std::vector<Ball>& balls) {
  assets::CtVolume ct{grid, {}, std::vector<std::uint8_t>(grid.voxelCount(), 1), {}, {}};
  ct.solid.resize(grid.voxelCount());
  for (int k = 0; k < grid.size.z; ++k)
    for (int j = 0; j < grid.size.y; ++j)
      for (int i = 0; i < grid.size.x; ++i) {
        double solid = 0.0;
        for (const Ball& ball : balls) {
          const double inside_mm = ball.radius_mm - glm::length(grid.centre_P_mm({i, j, k}) - ball.centre_P_mm);
          solid = std::max(solid, std::clamp(0.5 + 0.25 * inside_mm / grid.spacing_mm, 0.0, 1.0));
        }
        ct.solid[grid.index({i, j, k})] = static_cast<std::uint8_t>(std::lround(255.0 * solid));
      }
  return ct;
}

/// The 8x8x8 values of a brick of `ct`, 0 outside.
inline std::vector<std::uint8_t> brickOf(const assets::CtVolume& ct, glm::ivec3 brick) {
  std::vector<std::uint8_t> values(512, 0);
  for (int k = 0; k < 8; ++k)
    for (int j = 0; j < 8; ++j)
      for (int i = 0; i < 8; ++i)
        if (const glm::ivec3 voxel = 8 * brick + glm::ivec3(i, j, k); ct.grid.contains(voxel))
          values[static_cast<std::size_t>((k * 8 + j) * 8 + i)] = ct.solid[ct.grid.index(voxel)];
  return values;
}

/// The solid fraction of `ct` with a border.
inline BorderedField<std::uint8_t> borderedSolid(const assets::CtVolume& ct) {
  BorderedField<std::uint8_t> field(ct.grid.size);
  for (int k = 0; k < ct.grid.size.z; ++k)
    for (int j = 0; j < ct.grid.size.y; ++j)
      std::copy_n(&ct.solid[ct.grid.index({0, j, k})], ct.grid.size.x, field.at({0, j, k}));
  return field;
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  glm::dvec3 inCube(double half) { return {between(-half, half), between(-half, half), between(-half, half)}; }
  glm::dvec3 direction() {
    for (;;)
      if (const glm::dvec3 v = inCube(1.0); glm::length(v) > 0.1 && glm::length(v) < 1.0) return glm::normalize(v);
  }

 private:
  std::mt19937 engine_;
};

/// A random workstation: panel anywhere, with or without mirror, both eyes in front of the virtual screen.
inline calibration::Rig randomRig(Random& random, bool mirrored, glm::ivec2 px = {320, 240}) {
  calibration::Rig rig;
  const double width_mm = 200.0, height_mm = width_mm * px.y / px.x;
  const glm::dvec3 x = random.direction(), y = glm::normalize(glm::cross(x, random.direction())), z = glm::cross(x, y);
  const glm::dvec3 centre = random.inCube(300.0);
  rig.screen.px = px;
  rig.screen.lower_left.mm = centre - 0.5 * width_mm * x - 0.5 * height_mm * y;
  rig.screen.lower_right.mm = rig.screen.lower_left.mm + width_mm * x;
  rig.screen.upper_left.mm = rig.screen.lower_left.mm + height_mm * y;
  glm::dvec3 virtual_centre = centre, toward_eye = z;
  if (mirrored) {
    rig.mirror = calibration::Plane<calibration::World>{random.direction(), random.between(-300.0, 300.0)};
    virtual_centre = rig.mirror->reflect({centre}).mm;
    toward_eye = z - 2.0 * glm::dot(rig.mirror->normal, z) * rig.mirror->normal;
  }
  const glm::dvec3 head = virtual_centre + random.between(350.0, 550.0) * toward_eye + random.inCube(60.0);
  const glm::dvec3 side = glm::normalize(glm::cross(toward_eye, random.direction()));
  rig.left_eye.mm = head - 31.5 * side;
  rig.right_eye.mm = head + 31.5 * side;
  rig.X_WP = {glm::angleAxis(random.between(0.0, 6.0), random.direction()), virtual_centre};
  return rig;
}

}  // namespace render::testing
