// A head of any shape over one block of 4x4x4 voxels: plain values, one set of functions per instruction set and the
// same bits from all of them (floats without fused multiply-add, sums in sixteen lanes of fixed order). Equal to
// bone/bur_coverage to 1e-6. Voxel units, positions in T. Servo thread; no allocation; about 0.1 µs a block with AVX2.
// Private to bone/ and contact/.
#pragma once

#include <cstdint>

namespace haptics {

/// A piece of a revolved head's outline, from a knot upwards: (out, up) is the normal, `bend` the sum of the
/// curvatures, both at the knot and what they gain per length. Its line goes on beyond the knots at a flat end.
template <class Real>
struct OutlineSegment {
  Real rho, z, way_rho, way_z, length, first, last;
  Real out, up, more_out, more_up, bend, more_bend;
};
inline constexpr int kMostSegments = 15;

struct HeadShape {
  int kind;  ///< ShapeKind
  float radius, half, side_sin, side_cos, eta;
  float x[64], y[64], z[64];  ///< of a block's voxels from its first
  float end_low, end_high;    ///< heights of flat ends from the middle; far away: none
  int segments;               ///< of a revolved head
  OutlineSegment<float> segment[kMostSegments];
};

struct HeadBlock {
  float first[3];               ///< position of its first voxel
  const std::uint8_t* solid;    ///< 64
  const std::int16_t* rise[3];  ///< 64 each: difference of a voxel's neighbours along i, j, k; all null: no differences
  const float* factor;          ///< 64, of stiffness; null: `only_factor` of all
  float only_factor;
};

/// In steps of 1/255 (of 1/255² for the greyness). Moments along T, about its origin; rises along i, j, k.
struct HeadSums {
  float volume, stiff, grey, moment[3], rise[3];
};

/// `fraction`: 64, the covered part of each voxel, -1e-6..1+1e-6.
void coverUnderHead(const HeadShape& head, const float first[3], float* fraction) noexcept;
HeadSums sumUnderHead(const HeadShape& head, const HeadBlock& block) noexcept;

namespace portable {
void coverUnderHead(const HeadShape& head, const float first[3], float* fraction) noexcept;
HeadSums sumUnderHead(const HeadShape& head, const HeadBlock& block) noexcept;
}  // namespace portable
#if defined(__x86_64__)
namespace avx2 {
void coverUnderHead(const HeadShape& head, const float first[3], float* fraction) noexcept;
HeadSums sumUnderHead(const HeadShape& head, const HeadBlock& block) noexcept;
}  // namespace avx2
namespace avx512 {
void coverUnderHead(const HeadShape& head, const float first[3], float* fraction) noexcept;
HeadSums sumUnderHead(const HeadShape& head, const HeadBlock& block) noexcept;
}  // namespace avx512
#endif

}  // namespace haptics
