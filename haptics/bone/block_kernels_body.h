// The block kernels, included once by each instruction set's source, which defines MOLAR_KERNEL_SET. Helpers have
// internal linkage and there is no other header, so that the sets share no code. Written for the compiler's vectoriser:
// every voxel is treated alike; untouched ones keep their values.
#pragma once

#include "haptics/bone/block_kernels.h"

namespace haptics {
namespace {

constexpr int kVoxels = 64;
constexpr std::uint32_t kFullDose = 65535;
constexpr std::uint32_t kDosePerReach = kFullDose / 255;  // 257 exactly
constexpr std::uint32_t kGoldenStep = 0x9E3779B9u;        // 2^32 over the golden ratio

/// A hash of each voxel from that of its block: Wellons' integer hash with two multiplications (2018).
constexpr std::uint32_t voxelKey(std::uint32_t block_key, std::uint32_t within) {
  std::uint32_t x = block_key + within * kGoldenStep;
  x = (x ^ (x >> 16)) * 0x21F0AAADu;
  x = (x ^ (x >> 15)) * 0x735A2D97u;
  return x ^ (x >> 15);
}

struct DigestWeights {
  std::uint32_t low[kVoxels], high[kVoxels];
};
/// Weights of a voxel's state in the two halves of the digest: odd, different for each voxel.
constexpr DigestWeights digestWeights() {
  DigestWeights weights{};
  for (std::uint32_t n = 0; n < kVoxels; ++n) {
    weights.low[n] = voxelKey(0x5EEDu, n) | 1u;
    weights.high[n] = voxelKey(0xB17E5u, n) | 1u;
  }
  return weights;
}
constexpr DigestWeights kDigest = digestWeights();

constexpr std::uint32_t stateOf(std::uint32_t solid, std::uint32_t reach, std::uint32_t dose) {
  return solid << 24 | reach << 16 | dose;
}

/// Dose units lost: golden-ratio steps from a start of each voxel keep the rounded sum within a few steps of the exact
/// one.
inline std::uint32_t lost(std::uint32_t key, std::uint32_t phase, std::uint32_t whole, std::uint32_t loss_q32) {
  return static_cast<std::uint32_t>((static_cast<std::uint64_t>(whole) * loss_q32 + (key + phase)) >> 32);
}

/// The rest of a voxel's first content, over 65535, rounded at its own threshold: it never rises with the dose, and is
/// unbiased over voxels.
inline std::uint32_t leftOf(std::uint32_t first, std::uint32_t dose, std::uint32_t key) {
  const std::uint32_t high = key >> 16, threshold = high < kFullDose ? high : kFullDose - 1;
  const std::uint32_t left = first * (kFullDose - dose) + threshold;
  return (left + 1u + (left >> 16)) >> 16;
}

void stepWithHistory(BlockStep& block) {
  alignas(64) std::uint32_t key[kVoxels], loss[kVoxels], change[kVoxels], after[kVoxels];
  alignas(64) std::uint32_t new_reach[kVoxels], new_dose[kVoxels];
  for (std::uint32_t n = 0; n < kVoxels; ++n) key[n] = voxelKey(block.block_key, n);
  for (int n = 0; n < kVoxels; ++n) loss[n] = lost(key[n], block.phase, block.exposure[n], block.loss_q32[n]);
  for (int n = 0; n < kVoxels; ++n) {
    // Reach is the largest coverage so far, (coverage + 128) / 257.
    const std::uint32_t covered = (block.coverage[n] + 128u) * 65281u >> 24, old_reach = block.reach[n];
    const std::uint32_t reach = old_reach > covered ? old_reach : covered, old_dose = block.dose[n];
    const std::uint32_t limit = reach * kDosePerReach, cap = old_dose > limit ? old_dose : limit;
    const std::uint32_t requested = old_dose + loss[n], dose = requested < cap ? requested : cap;
    after[n] = leftOf(block.first[n], dose, key[n]);
    new_reach[n] = reach;
    new_dose[n] = dose;
    change[n] = stateOf(after[n], reach, dose) - stateOf(block.solid[n], old_reach, old_dose);
  }
  BlockDigest digest{0, 0};
  for (int n = 0; n < kVoxels; ++n) {
    digest.low += kDigest.low[n] * change[n];
    digest.high += kDigest.high[n] * change[n];
  }
  block.digest_change = digest;
  for (int n = 0; n < kVoxels; ++n) block.reach[n] = static_cast<std::uint8_t>(new_reach[n]);
  for (int n = 0; n < kVoxels; ++n) block.dose[n] = static_cast<std::uint16_t>(new_dose[n]);
  for (int n = 0; n < kVoxels; ++n) block.after[n] = static_cast<std::uint8_t>(after[n]);
}

/// Without a history: voxels covered by half or more lose steps of 1/255.
void stepWithoutHistory(BlockStep& block) {
  BlockDigest digest{0, 0};
  for (std::uint32_t n = 0; n < kVoxels; ++n) {
    const std::uint32_t before = block.solid[n], whole = block.coverage[n] * 2u >= kFullDose ? 255u : 0u;
    const std::uint32_t less = lost(voxelKey(block.block_key, n), block.phase, whole, block.loss_q32[n]);
    const std::uint32_t after = before > less ? before - less : 0u;
    digest.low += kDigest.low[n] * (stateOf(after, 0, 0) - stateOf(before, 0, 0));
    digest.high += kDigest.high[n] * (stateOf(after, 0, 0) - stateOf(before, 0, 0));
    block.after[n] = static_cast<std::uint8_t>(after);
  }
  block.digest_change = digest;
}

}  // namespace

namespace MOLAR_KERNEL_SET {

void coverBlock(const BlockUnderBur& at, std::uint16_t* coverage, std::uint32_t* exposure) noexcept {
  float x[4], y[4], z[4];
  for (int n = 0; n < 4; ++n) {
    x[n] = static_cast<float>(at.scale * (at.first[0] + n) * (at.first[0] + n));
    y[n] = static_cast<float>(at.scale * (at.first[1] + n) * (at.first[1] + n));
    z[n] = static_cast<float>(at.offset - at.scale * (at.first[2] + n) * (at.first[2] + n));
  }
  // The lens curve: t is 0 just outside and 2 just inside.
  alignas(64) float t[kVoxels], q[kVoxels];
  for (int row = 0; row < 16; ++row) {
    const float across = z[row >> 2] - y[row & 3];
    for (int n = 0; n < 4; ++n) t[4 * row + n] = across - x[n];
  }
  for (int n = 0; n < kVoxels; ++n) {
    const float positive = t[n] > 0.0f ? t[n] : 0.0f;
    t[n] = positive < 2.0f ? positive : 2.0f;
    q[n] = at.volume[at.coefficients - 1];
  }
  for (int c = at.coefficients - 2; c >= 0; --c)
    for (int n = 0; n < kVoxels; ++n) q[n] = q[n] * t[n] + at.volume[c];
  for (int n = 0; n < kVoxels; ++n) {
    const float steps = t[n] * t[n] * q[n] * 65535.0f + 0.5f, most = steps < 65535.0f ? steps : 65535.0f;
    const int whole = static_cast<int>(most > 0.0f ? most : 0.0f);
    coverage[n] = static_cast<std::uint16_t>(whole);
    exposure[n] = static_cast<std::uint32_t>(whole);
  }
  if (at.per_arm == 0.0f) return;
  for (int n = 0; n < kVoxels; ++n) {
    const float rx = static_cast<float>(at.first[0]) + static_cast<float>(n & 3);
    const float ry = static_cast<float>(at.first[1]) + static_cast<float>(n >> 2 & 3);
    const float rz = static_cast<float>(at.first[2]) + static_cast<float>(n >> 4);
    const float along = rx * at.axis[0] + ry * at.axis[1] + rz * at.axis[2];
    const float across2 = rx * rx + ry * ry + rz * rz - along * along;
    const float hard = at.even + at.per_arm * __builtin_sqrtf(across2 > 0.0f ? across2 : 0.0f);
    const float bounded = hard < 16.0f ? hard : 16.0f;
    exposure[n] = static_cast<std::uint32_t>(static_cast<int>(static_cast<float>(coverage[n]) * bounded));
  }
}

bool meetsBlock(const std::uint8_t* solid, const std::uint16_t* coverage) noexcept {
  std::uint16_t met = 0;
  for (int n = 0; n < kVoxels; ++n)
    met = static_cast<std::uint16_t>(met | static_cast<std::uint16_t>((coverage[n] >> 8) * solid[n]));
  return met != 0;
}

void stepBlock(BlockStep& block) noexcept {
  if (block.first != nullptr)
    stepWithHistory(block);
  else
    stepWithoutHistory(block);
  std::uint32_t removed = 0;
  for (int n = 0; n < kVoxels; ++n) removed += static_cast<std::uint32_t>(block.solid[n] - block.after[n]);
  block.removed = removed;
}

/// Linear in the voxels' states modulo 2^32, so that it can be updated by differences.
BlockDigest blockDigest(const std::uint8_t* solid, const std::uint8_t* reach, const std::uint16_t* dose) noexcept {
  BlockDigest digest{0, 0};
  for (int n = 0; n < kVoxels; ++n) {
    const std::uint32_t state = stateOf(solid[n], reach[n], dose[n]);
    digest.low += kDigest.low[n] * state;
    digest.high += kDigest.high[n] * state;
  }
  return digest;
}

std::uint16_t doseLeaving(std::uint8_t first, std::uint8_t left, std::uint32_t block_key,
                          std::uint32_t within) noexcept {
  if (left == 0) return kFullDose;
  const std::uint32_t key = voxelKey(block_key, within);
  std::uint32_t low = 0, high = kFullDose;
  while (low < high) {
    const std::uint32_t middle = (low + high) / 2;
    if (leftOf(first, middle, key) > left)
      low = middle + 1;
    else
      high = middle;
  }
  return static_cast<std::uint16_t>(low);
}

}  // namespace MOLAR_KERNEL_SET
}  // namespace haptics
