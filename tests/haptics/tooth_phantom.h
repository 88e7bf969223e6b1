// Volumes for tests of tooth pieces: boxes, and two blocks joined by a straight bridge. Frame P, mm.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "assets/volume_grid.h"

namespace haptics::phantom {

struct ToothPhantom {
  assets::VolumeGrid grid;
  std::vector<std::uint8_t> solid;

  ToothPhantom(glm::ivec3 size, double spacing_mm)
      : grid{size, spacing_mm, -0.5 * spacing_mm * glm::dvec3(size - 1)}, solid(grid.voxelCount(), 0) {}
};

/// Voxels from `first` to before `end`.
inline void fill(ToothPhantom& tooth, glm::ivec3 first, glm::ivec3 end, std::uint8_t value = 255) {
  assets::forVoxels(first, end, [&](glm::ivec3 ijk) { tooth.solid[tooth.grid.index(ijk)] = value; });
}

inline std::array<std::uint8_t, 512> brickOf(const ToothPhantom& tooth, glm::ivec3 brick) {
  std::array<std::uint8_t, 512> bytes{};
  std::size_t n = 0;
  assets::forVoxels(brick * 8, brick * 8 + 8, [&](glm::ivec3 ijk) {
    bytes[n++] = tooth.grid.contains(ijk) ? tooth.solid[tooth.grid.index(ijk)] : std::uint8_t{0};
  });
  return bytes;
}

/// Partly solid where a surface runs through a voxel: signed distance d_mm, negative inside.
inline std::uint8_t softEdge(double d_mm, double spacing_mm) {
  return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(0.5 - d_mm / spacing_mm, 0.0, 1.0)));
}

/// Two blocks of 10 x 10 x 6 mm, 2.4 mm apart along the axis w, and a bridge of thickness x width between them; turned
/// about y by `angle_rad`. Without `slotted` the gap is full: the tooth before the cut.
inline ToothPhantom bridged(double spacing_mm, double angle_rad, double thickness_mm, double width_mm, bool slotted) {
  const int n = static_cast<int>(std::ceil(24.0 / spacing_mm));
  ToothPhantom tooth({n, static_cast<int>(std::ceil(12.0 / spacing_mm)), n}, spacing_mm);
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  const auto box = [](const glm::dvec3& at, const glm::dvec3& half) {
    const glm::dvec3 d = glm::abs(at) - half;
    return std::max({d.x, d.y, d.z});
  };
  assets::forVoxels(tooth.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p = tooth.grid.centre_P_mm(ijk);
    const glm::dvec3 at(p.x * c - p.z * s, p.y, p.x * s + p.z * c);
    double d_mm = box(at, {5.0, 5.0, 7.2});
    if (slotted) {
      const double slot = std::abs(at.z) - 1.2;
      const double bridge = std::max(std::abs(at.x) - 0.5 * thickness_mm, std::abs(at.y) - 0.5 * width_mm);
      d_mm = std::max(d_mm, std::min(-slot, bridge));
    }
    tooth.solid[v] = softEdge(d_mm, spacing_mm);
  });
  return tooth;
}

}  // namespace haptics::phantom
