// Scenes for the search of a way out: pieces and holes in a block of bone given by signed distances (negative inside).
// Frame P, mm; those of reference/extraction 7.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "haptics/body/way_out.h"
#include "tests/haptics/tooth_phantom.h"

namespace haptics::phantom {

using SignedDistance = std::function<double(const glm::dvec3&)>;

inline double boxDistance_mm(const glm::dvec3& p, const glm::dvec3& half) {
  const glm::dvec3 q = glm::abs(p) - half;
  return glm::length(glm::max(q, 0.0)) + std::min(std::max({q.x, q.y, q.z}), 0.0);
}

/// True coverage of the voxels at the surface, from 4^3 points.
inline ToothPhantom solidOf(glm::ivec3 size, double spacing_mm, const SignedDistance& inside) {
  ToothPhantom solid(size, spacing_mm);
  assets::forVoxels(solid.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p = solid.grid.centre_P_mm(ijk);
    const double d_mm = inside(p);
    double share = d_mm < 0.0 ? 1.0 : 0.0;
    if (std::abs(d_mm) < 0.9 * spacing_mm) {
      share = 0.0;
      assets::forVoxels(glm::ivec3(0), glm::ivec3(4), [&](glm::ivec3 part) {
        const glm::dvec3 at = p + spacing_mm / 4.0 * (glm::dvec3(part) - 1.5);
        share += std::clamp(0.5 - 4.0 * inside(at) / spacing_mm, 0.0, 1.0) / 64.0;
      });
    }
    solid.solid[v] = static_cast<std::uint8_t>(std::lround(255.0 * share));
  });
  return solid;
}

inline SolidVoxels view(const ToothPhantom& phantom) { return {phantom.grid, phantom.solid}; }

struct WayOutScene {
  std::string name;
  ToothPhantom bone, piece;
  double exit_mm;

  WayOut answer() const { return findWayOut(view(bone), view(piece), {{0.0, 0.0, 1.0}, exit_mm}); }
  /// With what stood in the way taken away.
  WayOutScene without(const std::vector<std::size_t>& voxels) const {
    WayOutScene scene = *this;
    for (const std::size_t v : voxels) scene.bone.solid[v] = 0;
    return scene;
  }
};

constexpr double kSceneVoxel_mm = 0.25;

/// Bone up to `top_mm` with a hole in it.
inline ToothPhantom boneAround(const SignedDistance& hole, double top_mm) {
  return solidOf({120, 120, 130}, kSceneVoxel_mm,
                 [&](const glm::dvec3& p) { return std::max(p.z - top_mm, -hole(p)); });
}

/// 8 x 8 x 10 mm, edges rounded.
inline ToothPhantom blockPiece() {
  return solidOf({40, 40, 48}, kSceneVoxel_mm, [](const glm::dvec3& p) {
    return boxDistance_mm(p, {3.5, 3.5, 4.5}) - 0.5;
  });
}

inline double slot_mm(const glm::dvec3& p) { return boxDistance_mm(p - glm::dvec3(0, 0, 10), {4.3, 4.3, 15.3}); }

inline WayOutScene openSlot() { return {"open slot, 0.3 mm play", boneAround(slot_mm, 6.0), blockPiece(), 12.0}; }

/// 1 mm thick and 8 mm wide, over the piece.
inline WayOutScene ledge(double overhang_mm) {
  const auto hole = [=](const glm::dvec3& p) {
    return std::max(slot_mm(p), -boxDistance_mm(p - glm::dvec3(0, overhang_mm - 5.8, 5.5), {4.4, 1.5, 0.5}));
  };
  return {"ledge of " + std::to_string(overhang_mm).substr(0, 3) + " mm", boneAround(hole, 6.0), blockPiece(), 12.0};
}

/// 5 mm to one side under a roof, then up.
inline WayOutScene keyAndSlot() {
  const auto hole = [](const glm::dvec3& p) {
    return std::min(boxDistance_mm(p - glm::dvec3(0, 2.5, 0), {4.4, 6.9, 5.4}),
                    boxDistance_mm(p - glm::dvec3(0, 5, 10), {4.4, 4.4, 15.4}));
  };
  return {"key: 5 mm to one side, then up", boneAround(hole, 7.5), blockPiece(), 14.0};
}

/// Part of a ring about y through (-10, 0, 0).
inline double arc_mm(const glm::dvec3& p, double inner, double outer, double half, double from, double to) {
  const double r = std::hypot(p.x + 10.0, p.z), angle = std::atan2(p.z, p.x + 10.0);
  const double across = std::abs(r - 0.5 * (inner + outer)) - 0.5 * (outer - inner);
  const double along = (std::abs(angle - 0.5 * (from + to)) - 0.5 * (to - from)) * r;
  return std::max({across, along, std::abs(p.y) - half});
}

/// Only a turn gets it out.
inline WayOutScene curvedRoot(bool has_lid) {
  const auto hole = [=](const glm::dvec3& p) {
    const double free = arc_mm(p, 7.9, 12.1, 2.3, -0.78, 3.0);
    return has_lid ? std::max(free, -boxDistance_mm(p - glm::dvec3(0.5, 0, 2.2), {1.2, 3.0, 0.8})) : free;
  };
  const auto root = [](const glm::dvec3& p) { return arc_mm(p, 8.2, 11.8, 2.0, -0.75, 0.35); };
  return {has_lid ? "curved root under a lid" : "curved root, 0.3 mm play", boneAround(hole, 3.0),
          solidOf({64, 24, 72}, kSceneVoxel_mm, root), 13.0};
}

}  // namespace haptics::phantom
