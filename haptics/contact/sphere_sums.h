// The sum over the voxels under a round bur: plain values in and out, one function per instruction set. Voxel units;
// weights are solid bytes 0..255. Servo thread; no allocation. Cost ~ (R/s)^2, see haptics/README. Private to
// contact/overlap.
#pragma once

#include <cstdint>

namespace haptics {

/// Limit of the blocks a bur spans along an axis.
inline constexpr int kMaxBlocksAcross = 72;
inline constexpr double kMaxSumRadius = 130.0;

/// Stiffness factors in steps of 2^-16, so that sums over whole blocks are exact.
inline constexpr double kFactorSteps = 65536.0;

struct SphereSumsInput {
  const std::uint32_t* slot_of;  ///< by block; null: the block's number
  const std::uint8_t* solid;
  const std::uint8_t* label;  ///< null: every factor is 1
  const std::uint16_t *weight, *weight_x, *weight_y, *weight_z;
  const std::uint32_t* grey;
  const std::uint8_t* only_label;
  int blocks[3];
  double centre[3];
  double radius;     ///< LensCurve::kMinRadius .. kMaxSumRadius
  int coefficients;  ///< 4, 5, 6 or 8: of the lens curve
  float volume[8], cap[8];
  double scale, offset;
  std::uint32_t factor_steps[256];  ///< by label
};

struct SphereSums {
  // Blocks wholly inside, exact.
  std::int64_t weight = 0, x = 0, y = 0, z = 0;  ///< first moments about voxel (0,0,0)
  std::int64_t grey = 0, stiff_steps = 0;
  // Other blocks, first moments about the centre.
  double shell_weight = 0.0, shell_x = 0.0, shell_y = 0.0, shell_z = 0.0, shell_grey = 0.0, shell_stiff = 0.0;
};

void sphereSumsPortable(const SphereSumsInput& in, SphereSums& out) noexcept;
#if defined(__x86_64__)
void sphereSumsAvx2(const SphereSumsInput& in, SphereSums& out) noexcept;
void sphereSumsAvx512(const SphereSumsInput& in, SphereSums& out) noexcept;
#endif

}  // namespace haptics
