// The body of the head kernels: included once by each instruction set's source. Internal linkage throughout and no
// header but those below, so that nothing of it is shared between instruction sets. Written for the compiler's
// vectoriser. The formulas and their reasons: bone/bur_coverage.
#pragma once

#include "haptics/bone/face_share_body.h"
#include "haptics/bone/head_kernels.h"

namespace haptics {
namespace {

constexpr float kPi = 3.14159265358979323846f;
constexpr int kSphere = 0, kCapsule = 1, kCylinder = 2, kCone = 3;  // ShapeKind
constexpr int kLanes = 16, kRows = 4;

/// The first moment is (radial x, radial y, axial).
struct Share {
  float fraction, radial, axial;
};

template <int kKind>
inline Share shareAt(const HeadShape& head, float x, float y, float z) {
  const float eta = head.eta, per_eta = 1.0f / eta, R = head.radius, half = head.half;
  if constexpr (kKind == kSphere) {
    // By how much farther than where the ball is wholly in: in a form in which large numbers do not cancel.
    const float inner = R - eta, away = __builtin_sqrtf(x * x + y * y + z * z), raw = away - inner;
    const float low = raw < 0.0f ? 0.0f : raw, out = low > 2.0f * eta ? 2.0f * eta : low, d = inner + out;
    const float gap = 2.0f * eta - out, per_2d = 0.5f / d, height = eta - ((out - eta) * (d + R) + eta * eta) * per_2d;
    const float per_ball = 3.0f / (4.0f * kPi * eta * eta * eta);
    const float lens = per_ball * kPi / 6.0f * per_2d * gap * gap * (out * (d + 3.0f * inner) + 4.0f * eta * d);
    const float cap = per_ball * kPi / 3.0f * height * height * (3.0f * eta - height);
    return {lens, cap, cap * z};
  }
  const float high = z < 0.0f ? -z : z, up = z < 0.0f ? -1.0f : 1.0f;
  if constexpr (kKind == kCapsule) {
    const float over = high - half, dz = over > 0.0f ? over * up : 0.0f;
    const float away = __builtin_sqrtf(x * x + y * y + dz * dz);
    const float raw = 0.5f + 0.5f * over * per_eta, low = raw < 0.0f ? 0.0f : raw, end = low > 1.0f ? 1.0f : low;
    const FaceShare face = behindFace(away - R, bendOf((1.0f + end) / R, eta), eta, per_eta);
    const float shift = face.shift / atLeast(away, 1e-6f);
    return {face.fraction, face.fraction - shift, face.fraction * z - shift * dz};
  }
  const float rho = __builtin_sqrtf(x * x + y * y), per_rho = 1.0f / atLeast(rho, 1e-6f);
  const FaceShare end = behindFace(high - half, 0.0f, eta, per_eta);
  if constexpr (kKind == kCylinder) {
    const FaceShare side = behindFace(rho - R, bendOf(1.0f / R, eta), eta, per_eta);
    const float fraction = side.fraction * end.fraction;
    return {fraction, fraction - side.shift * end.fraction * per_rho, fraction * z - side.fraction * end.shift * up};
  }
  const float distance = rho * head.side_cos - (z + half) * head.side_sin;
  const float foot = atLeast(rho - distance * head.side_cos, 1e-6f);
  const FaceShare side = behindFace(distance, bendOf(head.side_cos / foot, eta), eta, per_eta);
  const float fraction = side.fraction * end.fraction, shift = side.shift * end.fraction;
  return {fraction, fraction - shift * head.side_cos * per_rho,
          fraction * z - side.fraction * end.shift * up + shift * head.side_sin};
}

template <int kKind>
void coverAs(const HeadShape& head, const float* first, float* fraction) {
  const float fx = first[0], fy = first[1], fz = first[2];
  for (int n = 0; n < kLanes * kRows; ++n)
    fraction[n] = shareAt<kKind>(head, fx + head.x[n], fy + head.y[n], fz + head.z[n]).fraction;
}

void cover(const HeadShape& head, const float* first, float* fraction) {
  switch (head.kind) {
    case kSphere:
      return coverAs<kSphere>(head, first, fraction);
    case kCapsule:
      return coverAs<kCapsule>(head, first, fraction);
    case kCylinder:
      return coverAs<kCylinder>(head, first, fraction);
    default:
      return coverAs<kCone>(head, first, fraction);
  }
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
  for (int n = 0; n < kVoxels; ++n) {
    const float x = fx + head.x[n], y = fy + head.y[n], z = fz + head.z[n];
    const Share share = shareAt<kKind>(head, x, y, z);
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

HeadSums sum(const HeadShape& head, const HeadBlock& block) {
  switch (head.kind) {
    case kSphere:
      return sumAs<kSphere>(head, block);
    case kCapsule:
      return sumAs<kCapsule>(head, block);
    case kCylinder:
      return sumAs<kCylinder>(head, block);
    default:
      return sumAs<kCone>(head, block);
  }
}

}  // namespace
}  // namespace haptics
