// Sixteen rays of a file's section into the wall: along each, inwards from the surface, a smooth solid fraction
// (quadratic B-spline of the field's bytes, 27 of them, whose slope is continuous) is added up until it is 0 or the
// axis is reached. Depth of overlap, and its first and second derivatives by a shift of the section. Plain values, one
// function per instruction set and the same bits from all: floats without fused multiply-add. Voxel units. Servo
// thread; no allocation; 0.4 µs where nothing is met. Private to file/. Source: reference/sisters 1.3.
#pragma once

#include <cstdint>

namespace haptics {

inline constexpr int kRays = 16;

/// Blocks of 4x4x4 bytes as bone/cubelets stores them.
struct WallVoxels {
  const std::uint32_t* slot_of;  ///< by block, and one value more; null: the block's number
  const std::uint8_t* solid;
  int size[3], blocks[3];
};

struct SectionRays {
  float centre[3];        ///< as an index
  float along[3][kRays];  ///< unit, from the axis out
  float radius, step;     ///< step at most 1
  float flat_face;        ///< depth that a flat face gives at touch, taken off
  int samples;            ///< at most
};

struct RayDepths {
  float depth[kRays];
  float slope[3][kRays];
  float curve[6][kRays];  ///< xx yy zz xy xz yz
};

/// False: no ray meets anything.
bool castRays(const WallVoxels& wall, const SectionRays& rays, RayDepths& out) noexcept;

namespace portable {
bool castRays(const WallVoxels& wall, const SectionRays& rays, RayDepths& out) noexcept;
}
#if defined(__x86_64__)
namespace avx2 {
bool castRays(const WallVoxels& wall, const SectionRays& rays, RayDepths& out) noexcept;
}
namespace avx512 {
bool castRays(const WallVoxels& wall, const SectionRays& rays, RayDepths& out) noexcept;
}
#endif

}  // namespace haptics
