// One tick of cutting on one block of 4x4x4 voxels: plain values, one set of functions per instruction set, the same
// bits from all of them (integers, and floats without fused multiply-add). Servo thread; no allocation; about 100 ns a
// block with AVX2. Private to bone/.
#pragma once

#include <cstdint>

namespace haptics {

/// A round bur over a block. Voxel units.
struct BlockUnderBur {
  double first[3];       ///< from the bur's centre to the block's first voxel
  double scale, offset;  ///< of bone/lens_curve
  int coefficients;
  float volume[8];
  /// exposure = coverage (even + per_arm |r x axis|), r in voxels.
  float axis[3], even, per_arm;
};

/// Two sums modulo 2^32.
struct BlockDigest {
  std::uint32_t low, high;
};

/// One block's history and the effect of a step. Dose 0..65535, reach and solid 0..255.
struct BlockStep {
  const std::uint8_t* solid;  ///< 64 each
  const std::uint16_t* coverage;
  const std::uint32_t *exposure, *loss_q32;
  const std::uint8_t* first;  ///< null: no history
  std::uint8_t* reach;
  std::uint16_t* dose;
  std::uint32_t block_key, phase;  ///< of the rounding sequence
  std::uint8_t* after;             ///< out
  BlockDigest digest_change;       ///< out, before the block's own factor
  std::uint32_t removed;           ///< out, in solid steps
};

/// By the chosen instruction set.
void coverBlock(const BlockUnderBur& at, std::uint16_t* coverage, std::uint32_t* exposure) noexcept;
/// Whether the bur covers any solid voxel by at least 1/256.
bool meetsBlock(const std::uint8_t* solid, const std::uint16_t* coverage) noexcept;
void stepBlock(BlockStep& block) noexcept;
BlockDigest blockDigest(const std::uint8_t* solid, const std::uint8_t* reach, const std::uint16_t* dose) noexcept;
/// The least dose that leaves no more than `left` of a voxel's first content, `within` the block of this key; 65535 for
/// 0. Exact for every `left` up to `first`.
std::uint16_t doseLeaving(std::uint8_t first, std::uint8_t left, std::uint32_t block_key,
                          std::uint32_t within) noexcept;

namespace portable {
void coverBlock(const BlockUnderBur& at, std::uint16_t* coverage, std::uint32_t* exposure) noexcept;
bool meetsBlock(const std::uint8_t* solid, const std::uint16_t* coverage) noexcept;
void stepBlock(BlockStep& block) noexcept;
BlockDigest blockDigest(const std::uint8_t* solid, const std::uint8_t* reach, const std::uint16_t* dose) noexcept;
std::uint16_t doseLeaving(std::uint8_t first, std::uint8_t left, std::uint32_t block_key,
                          std::uint32_t within) noexcept;
}  // namespace portable

#if defined(__x86_64__)
namespace avx2 {
void coverBlock(const BlockUnderBur& at, std::uint16_t* coverage, std::uint32_t* exposure) noexcept;
bool meetsBlock(const std::uint8_t* solid, const std::uint16_t* coverage) noexcept;
void stepBlock(BlockStep& block) noexcept;
BlockDigest blockDigest(const std::uint8_t* solid, const std::uint8_t* reach, const std::uint16_t* dose) noexcept;
std::uint16_t doseLeaving(std::uint8_t first, std::uint8_t left, std::uint32_t block_key,
                          std::uint32_t within) noexcept;
}  // namespace avx2
#endif

}  // namespace haptics
