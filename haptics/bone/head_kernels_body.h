// The head kernels, included once by each instruction set's source, which defines MOLAR_KERNEL_SET. Helpers have
// internal linkage and there is no header but those below, so that the sets share no code. Written for the compiler's
// vectoriser.
#pragma once

#include "haptics/bone/face_share_body.h"
#include "haptics/bone/head_kernels.h"

namespace haptics {
namespace {

constexpr float kPi = 3.14159265358979323846f;
constexpr int kSphere = 0, kCapsule = kCapsuleFaces, kCylinder = kCylinderFaces, kCone = kConeFaces,
              kRevolved = kRevolvedFaces;  // ShapeKind
constexpr int kLanes = 16, kRows = 4;

template <int kKind>
inline AxialShare<float> shareAt(const HeadShape& head, float x, float y, float z) {
  if constexpr (kKind != kSphere) {
    return shareOfFaces<kKind>(head, x, y, z, 1e-6f);
  } else {
    // `out` is the distance beyond where the ball is wholly inside: no cancellation of large numbers.
    const float eta = head.eta, R = head.radius;
    const float inner = R - eta, away = __builtin_sqrtf(x * x + y * y + z * z), raw = away - inner;
    const float low = raw < 0.0f ? 0.0f : raw, out = low > 2.0f * eta ? 2.0f * eta : low, d = inner + out;
    const float gap = 2.0f * eta - out, per_2d = 0.5f / d, height = eta - ((out - eta) * (d + R) + eta * eta) * per_2d;
    const float per_ball = 3.0f / (4.0f * kPi * eta * eta * eta);
    const float lens = per_ball * kPi / 6.0f * per_2d * gap * gap * (out * (d + 3.0f * inner) + 4.0f * eta * d);
    const float cap = per_ball * kPi / 3.0f * height * height * (3.0f * eta - height);
    return {lens, cap, cap * z};
  }
}

/// The segments that can be nearest to a voxel of a block: within twice the block's radius of the nearest one.
struct NearSegments {
  int first, end;
};
inline NearSegments segmentsNear(const HeadShape& head, const float* first) {
  const float mx = first[0] + 0.5f * head.x[63], my = first[1] + 0.5f * head.y[63], mz = first[2] + 0.5f * head.z[63];
  const float rho = rootOf(mx * mx + my * my);
  float away[kMostSegments], least = 1e30f;
  for (int n = 0; n < head.segments; ++n) {
    const OutlineFoot<float> foot = nearerFoot(head.segment[n], rho, mz, OutlineFoot<float>{1e30f, 0, 0, 0, 0});
    away[n] = rootOf(foot.square);
    least = away[n] < least ? away[n] : least;
  }
  constexpr float kAcross = 5.3f;  // of a block's voxels, with room for rounding
  NearSegments near{0, head.segments};
  while (near.first + 1 < near.end && away[near.first] > least + kAcross) ++near.first;
  while (near.end - 1 > near.first && away[near.end - 1] > least + kAcross) --near.end;
  return near;
}

/// All voxels of a block under a revolved head, segment by segment.
inline void revolvedShares(const HeadShape& head, const float* first, AxialShare<float>* share) {
  constexpr int kVoxels = kLanes * kRows;
  const float fx = first[0], fy = first[1], fz = first[2];
  alignas(64) float rho[kVoxels], z[kVoxels], square[kVoxels], distance[kVoxels], out[kVoxels], up[kVoxels],
      bend[kVoxels];
  for (int n = 0; n < kVoxels; ++n) {
    const float x = fx + head.x[n], y = fy + head.y[n];
    rho[n] = rootOf(x * x + y * y);
    z[n] = fz + head.z[n];
    square[n] = 1e30f;
    distance[n] = out[n] = up[n] = bend[n] = 0.0f;
  }
  const NearSegments near = segmentsNear(head, first);
  for (int s = near.first; s < near.end; ++s) {
    const OutlineSegment<float> segment = head.segment[s];
    for (int n = 0; n < kVoxels; ++n) {
      const OutlineFoot<float> foot =
          nearerFoot(segment, rho[n], z[n], OutlineFoot<float>{square[n], distance[n], out[n], up[n], bend[n]});
      square[n] = foot.square, distance[n] = foot.distance, out[n] = foot.out, up[n] = foot.up, bend[n] = foot.bend;
    }
  }
  for (int n = 0; n < kVoxels; ++n)
    share[n] = shareOfRevolved(OutlineFoot<float>{square[n], distance[n], out[n], up[n], bend[n]}, head.end_low,
                               head.end_high, head.eta, rho[n], z[n], 1e-6f);
}

template <int kKind>
void coverAs(const HeadShape& head, const float* first, float* fraction) {
  const float fx = first[0], fy = first[1], fz = first[2];
  if constexpr (kKind == kRevolved) {
    AxialShare<float> share[kLanes * kRows];
    revolvedShares(head, first, share);
    for (int n = 0; n < kLanes * kRows; ++n) fraction[n] = share[n].fraction;
    return;
  }
  for (int n = 0; n < kLanes * kRows; ++n)
    fraction[n] = shareAt<kKind>(head, fx + head.x[n], fy + head.y[n], fz + head.z[n]).fraction;
}

float allOf(const float* lane) {
  float pair[8], four[4];
  for (int n = 0; n < 8; ++n) pair[n] = lane[n] + lane[n + 8];
  for (int n = 0; n < 4; ++n) four[n] = pair[n] + pair[n + 4];
  return (four[0] + four[2]) + (four[1] + four[3]);
}

template <int kKind>
HeadSums sumAs(const HeadShape& head, const HeadBlock& block) {
  constexpr int kVoxels = kLanes * kRows;
  const float fx = block.first[0], fy = block.first[1], fz = block.first[2];
  alignas(64) float fraction[kVoxels], moment[3][kVoxels], w[kVoxels];
  [[maybe_unused]] AxialShare<float> revolved[kKind == kRevolved ? kVoxels : 1];
  if constexpr (kKind == kRevolved) revolvedShares(head, block.first, revolved);
  for (int n = 0; n < kVoxels; ++n) {
    const float x = fx + head.x[n], y = fy + head.y[n], z = fz + head.z[n];
    const AxialShare<float> share = [&] {
      if constexpr (kKind == kRevolved)
        return revolved[n];
      else
        return shareAt<kKind>(head, x, y, z);
    }();
    fraction[n] = share.fraction;
    moment[0][n] = share.radial * x;
    moment[1][n] = share.radial * y;
    moment[2][n] = share.axial;
  }
  for (int n = 0; n < kVoxels; ++n) w[n] = static_cast<float>(static_cast<int>(block.solid[n]));
  alignas(64) float volume[kLanes] = {}, stiff[kLanes] = {}, grey[kLanes] = {}, mx[kLanes] = {}, my[kLanes] = {},
                    mz[kLanes] = {};
  for (int row = 0; row < kRows; ++row)
    for (int lane = 0; lane < kLanes; ++lane) {
      const int n = row * kLanes + lane;
      const float covered = w[n] * fraction[n];
      volume[lane] += covered;
      grey[lane] += covered * (255.0f - w[n]);
      mx[lane] += w[n] * moment[0][n];
      my[lane] += w[n] * moment[1][n];
      mz[lane] += w[n] * moment[2][n];
    }
  HeadSums sums{allOf(volume), 0.0f, allOf(grey), {allOf(mx), allOf(my), allOf(mz)}, {0.0f, 0.0f, 0.0f}};
  sums.stiff = sums.volume * block.only_factor;
  if (block.factor != nullptr) {
    for (int row = 0; row < kRows; ++row)
      for (int lane = 0; lane < kLanes; ++lane) {
        const int n = row * kLanes + lane;
        stiff[lane] += w[n] * fraction[n] * block.factor[n];
      }
    sums.stiff = allOf(stiff);
  }
  if (block.rise[0] == nullptr) return sums;
  for (int axis = 0; axis < 3; ++axis) {
    alignas(64) float rise[kLanes] = {};
    for (int row = 0; row < kRows; ++row)
      for (int lane = 0; lane < kLanes; ++lane) {
        const int n = row * kLanes + lane;
        rise[lane] += fraction[n] * static_cast<float>(static_cast<int>(block.rise[axis][n]));
      }
    sums.rise[axis] = allOf(rise);
  }
  return sums;
}

}  // namespace

namespace MOLAR_KERNEL_SET {

void coverUnderHead(const HeadShape& head, const float first[3], float* fraction) noexcept {
  switch (head.kind) {
    case kSphere:
      return coverAs<kSphere>(head, first, fraction);
    case kCapsule:
      return coverAs<kCapsule>(head, first, fraction);
    case kCylinder:
      return coverAs<kCylinder>(head, first, fraction);
    case kCone:
      return coverAs<kCone>(head, first, fraction);
    default:
      return coverAs<kRevolved>(head, first, fraction);
  }
}

HeadSums sumUnderHead(const HeadShape& head, const HeadBlock& block) noexcept {
  switch (head.kind) {
    case kSphere:
      return sumAs<kSphere>(head, block);
    case kCapsule:
      return sumAs<kCapsule>(head, block);
    case kCylinder:
      return sumAs<kCylinder>(head, block);
    case kCone:
      return sumAs<kCone>(head, block);
    default:
      return sumAs<kRevolved>(head, block);
  }
}

}  // namespace MOLAR_KERNEL_SET
}  // namespace haptics
