#include "app/check_page/solid_picture.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace app {
namespace {

constexpr double kReach_mm = 90.0, kBoneShare = 0.5;
constexpr float kStep = 0.7F;  ///< voxels
constexpr glm::dvec3 kBackground(13.0, 15.0, 18.0);

}  // namespace

/// In voxels, whose cells begin at whole numbers.
struct SolidPicture::Rays {
  Rays(const assets::VolumeGrid& grid, const JawViews::Plane& at)
      : plane(at),
        direction(at.normal_P()),
        reach(static_cast<float>(2.0 * kReach_mm / grid.spacing_mm)),
        size(grid.size) {
    for (int a = 0; a < 3; ++a) {
      const float along = std::abs(direction[a]) < 1e-7F ? 1e-7F : direction[a];
      per[a] = 1.0F / along;
      is_up[a] = along > 0.0F ? 1 : 0;
    }
  }
  /// Where a ray leaves the bricks that are nearer than so many to this one.
  float exitOf(const glm::vec3& from, const glm::ivec3& brick, int bricks) const {
    const glm::vec3 face((brick + (is_up * (2 * bricks - 1) - (bricks - 1))) * LabelBricks::kEdge);
    const glm::vec3 t = (face - from) * per;
    return std::min({t.x, t.y, t.z});
  }

  const JawViews::Plane& plane;
  glm::vec3 direction, per{0.0F};
  float reach;
  glm::ivec3 size, is_up{0};
};

// Samples lie at whole steps from the picture's plane, whatever is passed over.
SolidPicture::Seen SolidPicture::along(const Rays& rays, const glm::dvec2& at_px, bool sees_bone) const {
  const glm::vec3 from(grid_.indexFromPoint(rays.plane.at(at_px) - kReach_mm * rays.plane.normal_P()) + 0.5);
  const glm::vec3 low = -from * rays.per, high = (glm::vec3(rays.size) - from) * rays.per;
  const glm::vec3 in = glm::min(low, high), out = glm::max(low, high);
  const float begins = std::max({in.x, in.y, in.z, 0.0F}), ends = std::min({out.x, out.y, out.z, rays.reach});
  const auto row = static_cast<std::size_t>(rays.size.x), layer = row * static_cast<std::size_t>(rays.size.y);
  Seen seen;
  LabelBricks::Wanted wanted = sees_bone ? LabelBricks::bone_or_tooth : LabelBricks::tooth_alone;
  const auto step_at = [](float t) {
    const float steps = t * (1.0F / kStep);
    const int below = static_cast<int>(steps);
    return below + (static_cast<float>(below) < steps ? 1 : 0);
  };
  for (int n = step_at(begins); static_cast<float>(n) * kStep < ends;) {
    const glm::vec3 at = from + static_cast<float>(n) * kStep * rays.direction;
    const glm::ivec3 voxel = glm::clamp(glm::ivec3(at), glm::ivec3(0), rays.size - 1);
    const glm::ivec3 brick = voxel / LabelBricks::kEdge;
    if (const int empty = bricks_.distanceAt(brick, wanted); empty > 0) {
      n = std::max(n + 1, step_at(rays.exitOf(from, brick, empty)));
      continue;
    }
    const std::uint8_t what = what_[static_cast<std::size_t>(voxel.x) + row * static_cast<std::size_t>(voxel.y) +
                                    layer * static_cast<std::size_t>(voxel.z)];
    if (what != 0 && what != kBoneVoxel) {
      seen.tooth = what, seen.voxel = voxel;
      return seen;
    }
    if (what == kBoneVoxel && !seen.is_through_bone) {
      seen.is_through_bone = true, seen.bone = voxel;
      wanted = LabelBricks::tooth_alone;
    }
    ++n;
  }
  return seen;
}

/// How far a surface at a voxel faces along a direction, 1 straight: by what lies outside it two voxels around.
float SolidPicture::facing(const glm::ivec3& voxel, std::uint8_t own, bool is_own_inside,
                           const glm::vec3& direction) const {
  constexpr std::uint64_t kEach = 0x0101010101ULL;
  constexpr int kReach = 2;
  // Sums over rows of five: of all, of their places, and of those two and one before and behind.
  int sum = 0, along_j = 0, along_k = 0;
  const std::uint64_t owns = kEach * own, turned = is_own_inside ? 0 : kEach;
  const auto add = [&](std::uint64_t five, int j, int k) {
    const std::uint64_t other = five ^ owns;
    // 1 in each byte that differs.
    const std::uint64_t is_out = (((((other & (0x7f * kEach)) + 0x7f * kEach) | other) >> 7) & kEach) ^ turned;
    const int count = static_cast<int>((is_out * kEach) >> 32 & 0xff);
    // Places 0 to 4 times: the sum in the fifth byte of a product.
    const int places = static_cast<int>((is_out * 0x0403020100ULL >> 32) & 0xff);
    sum += 2 * count - places;
    along_j += count * j, along_k += count * k;
  };
  const glm::ivec3 low = voxel - kReach, high = voxel + kReach;
  const bool is_whole = low.x >= 0 && low.y >= 0 && low.z >= 0 && high.x + 3 < grid_.size.x && high.y < grid_.size.y &&
                        high.z < grid_.size.z;
  if (is_whole) {
    const auto row = static_cast<std::ptrdiff_t>(grid_.size.x), layer = row * grid_.size.y;
    const std::uint8_t* const first = what_.data() + grid_.index(low);
    for (int k = 0; k < 5; ++k)
      for (int j = 0; j < 5; ++j) {
        std::uint64_t eight = 0;
        std::memcpy(&eight, first + k * layer + j * row, 8);
        add(eight & 0xffffffffffULL, j - kReach, k - kReach);
      }
  } else {
    for (int k = -kReach; k <= kReach; ++k)
      for (int j = -kReach; j <= kReach; ++j) {
        std::uint64_t five = 0;
        for (int i = 0; i < 5; ++i)
          if (const glm::ivec3 at = voxel + glm::ivec3(i - kReach, j, k); grid_.contains(at))
            five |= std::uint64_t{what_[grid_.index(at)]} << (8 * i);
        add(five, j, k);
      }
  }
  const glm::vec3 normal(sum, along_j, along_k);
  return glm::dot(normal, direction) / std::max(glm::length(normal), 1e-9F);
}

void SolidPicture::draw(const JawViews::Plane& plane, const PixelBox& box, render::Image& image) const {
  const Rays rays(grid_, plane);
  tbb::parallel_for(box.low.y, box.end.y, [&](int y) {
    for (int x = box.low.x; x < box.end.x; ++x) {
      const Seen seen = along(rays, {x + 0.5, y + 0.5}, true);
      glm::dvec3 colour = kBackground;
      if (seen.tooth != 0) {
        // The side that is lit is the one that is seen.
        const float light = std::max(0.0F, -facing(seen.voxel, seen.tooth, true, rays.direction));
        colour = colourOf(seen.tooth) * (0.22 + 0.78 * static_cast<double>(light));
      }
      if (seen.is_through_bone) {
        const double bone = std::abs(facing(seen.bone, 0, false, rays.direction));
        colour = glm::mix(colour, colourOf(kBoneVoxel) * (0.15 + 0.6 * bone), kBoneShare * (1.1 - 0.6 * bone));
      }
      std::uint8_t* const to = &image.rgba[4 * static_cast<std::size_t>(y * image.w + x)];
      for (int c = 0; c < 3; ++c) to[c] = static_cast<std::uint8_t>(std::clamp(colour[c] + 0.5, 0.0, 255.0));
    }
  });
}

std::optional<glm::dvec3> SolidPicture::toothAt(const JawViews::Plane& plane, const glm::dvec2& at_px) const {
  const Seen seen = along(Rays(grid_, plane), at_px, false);
  return seen.tooth != 0 ? std::optional(grid_.centre_P_mm(seen.voxel)) : std::nullopt;
}

}  // namespace app
