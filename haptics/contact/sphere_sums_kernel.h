// The kernel of sphereSums…, included once by each instruction set's source. Internal linkage throughout, and no header
// but the three below, so that the sets share no code. Blocks wholly inside add their sums; of the others every plane
// of 4x4 voxels is sixteen lanes of the lens curve (bone/lens_curve), which is 0 outside and 1 inside: no branches.
#pragma once

#include <cstdint>

#include "haptics/contact/lanes.h"
#include "haptics/contact/sphere_sums.h"

namespace haptics {
namespace {

constexpr float kSphereVoxel = 0.62035049089940001667f;  // bone/voxel_sphere

inline int floorOf(float x) {
  const int i = static_cast<int>(x);
  return i - (static_cast<float>(i) > x ? 1 : 0);
}
inline int ceilOf(float x) {
  const int i = static_cast<int>(x);
  return i + (static_cast<float>(i) < x ? 1 : 0);
}
inline int least(int a, int b) { return a < b ? a : b; }
inline int most(int a, int b) { return a > b ? a : b; }
inline float mostOf(float a, float b) { return a > b ? a : b; }
inline float magnitude(float x) { return x < 0.0f ? -x : x; }

/// Distance from the centre of the nearest and farthest of four voxels from `first` on.
struct Reach {
  float near, far;
};
inline Reach reachOf(float first) {
  const float last = first + 3.0f;
  return {mostOf(0.0f, mostOf(first, -last)), mostOf(magnitude(first), magnitude(last))};
}

template <int kCoefficients, bool kLabels, bool kIndexed>
class SphereSum {
 public:
  explicit SphereSum(const SphereSumsInput& in) : in_(in) {
    for (int axis = 0; axis < 3; ++axis) {
      const float centre = static_cast<float>(in.centre[axis]);
      first_[axis] = most(0, floorOf((centre - outer_) * 0.25f));
      last_[axis] = least(in.blocks[axis] - 1, floorOf((centre + outer_) * 0.25f));
    }
    for (int n = 0; n < kCoefficients; ++n) volume_[n] = all(in.volume[n]), cap_[n] = all(in.cap[n]);
    for (int b = 0; b <= last_[0] - first_[0]; ++b)
      for (int lane = 0; lane < 16; ++lane) {
        const double dx = 4 * (first_[0] + b) + (lane & 3) - in.centre[0];
        dx_[b][lane] = static_cast<float>(dx);
        tx_[b][lane] = static_cast<float>(-in.scale * dx * dx);
      }
  }

  void sumInto(SphereSums& out) {
    for (int bz = first_[2]; bz <= last_[2]; ++bz) {
      const Reach z = reachOf(static_cast<float>(4 * bz - in_.centre[2]));
      for (int by = first_[1]; by <= last_[1]; ++by) {
        const Reach y = reachOf(static_cast<float>(4 * by - in_.centre[1]));
        if (y.near * y.near + z.near * z.near < outer_ * outer_) sumRow(by, bz, y, z, out);
      }
      flush(out);
    }
  }

 private:
  void sumRow(int by, int bz, const Reach& y, const Reach& z, SphereSums& out) {
    const std::int64_t row = (static_cast<std::int64_t>(bz) * in_.blocks[1] + by) * in_.blocks[0];
    const float centre = static_cast<float>(in_.centre[0]);
    const float room = inner_ * inner_ - y.far * y.far - z.far * z.far;
    int whole_first = last_[0] + 1, whole_last = last_[0];
    if (inner_ > 0.0f && room > 0.0f) {
      const float half = __builtin_sqrtf(room);
      whole_first = most(first_[0], ceilOf((centre - half) * 0.25f));
      whole_last = least(last_[0], floorOf((centre + half - 3.0f) * 0.25f));
      if (whole_last < whole_first) whole_first = last_[0] + 1, whole_last = last_[0];
    }
    if (whole_first <= whole_last) addWhole(row, whole_first, whole_last, by, bz, out);

    float dy[16], ty[16];
    for (int lane = 0; lane < 16; ++lane) {
      const double d = 4 * by + (lane >> 2) - in_.centre[1];
      dy[lane] = static_cast<float>(d);
      ty[lane] = static_cast<float>(-in_.scale * d * d);
    }
    float half[4], dz[4];
    for (int n = 0; n < 4; ++n) {
      dz[n] = static_cast<float>(4 * bz + n - in_.centre[2]);
      half[n] = outer_ * outer_ - y.near * y.near - dz[n] * dz[n];
    }
    for (float& h : half) h = __builtin_sqrtf(h > 0.0f ? h : 0.0f);
    const Lanes dy_lanes = load(dy), ty_lanes = load(ty);
    for (int n = 0; n < 4; ++n) {
      if (!(half[n] > 0.0f)) continue;
      const int from = most(first_[0], floorOf((centre - half[n]) * 0.25f));
      const int to = least(last_[0], floorOf((centre + half[n]) * 0.25f));
      const double d = 4 * bz + n - in_.centre[2];
      const Lanes tyz = ty_lanes + all(static_cast<float>(in_.offset - in_.scale * d * d));
      Lanes caps = all(0.0f);
      addPlanes(row, from, least(to, whole_first - 1), n, tyz, caps);
      addPlanes(row, most(from, whole_last + 1), to, n, tyz, caps);
      y_ = timesPlus(caps, dy_lanes, y_);
      z_ = timesPlus(caps, all(dz[n]), z_);
    }
  }

  /// Blocks wholly inside: integers, the same whatever the order.
  void addWhole(std::int64_t row, int first, int last, int by, int bz, SphereSums& out) const {
    std::uint32_t weight = 0, along = 0, x = 0, y = 0, z = 0, grey = 0;
    for (int b = first; b <= last; ++b) {
      const std::int64_t slot = slotOf(row + b);
      const std::uint32_t w = in_.weight[slot];
      weight += w;
      along += w * static_cast<std::uint32_t>(b - first);
      x += in_.weight_x[slot];
      y += in_.weight_y[slot];
      z += in_.weight_z[slot];
      grey += in_.grey[slot];
    }
    const std::int64_t total = weight;
    out.weight += total;
    out.x += 4 * (static_cast<std::int64_t>(along) + total * first) + x;
    out.y += 4 * total * by + y;
    out.z += 4 * total * bz + z;
    out.grey += grey;
    if constexpr (kLabels)
      for (int b = first; b <= last; ++b) out.stiff_steps += stiffStepsOf(slotOf(row + b));
  }

  std::int64_t slotOf(std::int64_t block) const {
    if constexpr (kIndexed)
      return in_.slot_of[block];
    else
      return block;
  }

  std::int64_t stiffStepsOf(std::int64_t slot) const {
    const std::uint8_t only = in_.only_label[slot];
    if (only != 255) return static_cast<std::int64_t>(in_.weight[slot]) * in_.factor_steps[only];
    if (in_.weight[slot] == 0) return 0;
    std::int64_t steps = 0;
    for (int n = 0; n < 64; ++n)
      steps += static_cast<std::int64_t>(in_.solid[64 * slot + n]) * in_.factor_steps[in_.label[64 * slot + n]];
    return steps;
  }

  /// Plane `n` of the blocks from..to of a row, through the lens curve.
  void addPlanes(std::int64_t row, int from, int to, int n, const Lanes& tyz, Lanes& caps) {
    const Lanes none = all(0.0f), full = all(2.0f), solid = all(255.0f);
    for (int b = from; b <= to; ++b) {
      const std::int64_t slot = slotOf(row + b);
      if (in_.weight[slot] == 0) continue;
      const std::int64_t plane = 64 * slot + 16 * n;
      const Lanes w = load(in_.solid + plane);
      const Lanes t = clamped(load(tx_[b - first_[0]]) + tyz, none, full);
      const Lanes t2w = t * t * w;
      Lanes q = volume_[kCoefficients - 1], q_cap = cap_[kCoefficients - 1];
      for (int c = kCoefficients - 2; c >= 0; --c)
        q = timesPlus(q, t, volume_[c]), q_cap = timesPlus(q_cap, t, cap_[c]);
      const Lanes lens = t2w * q, moment = t2w * q_cap;
      weight_ = weight_ + lens;
      grey_ = timesPlus(lens, solid - w, grey_);
      x_ = timesPlus(moment, load(dx_[b - first_[0]]), x_);
      caps = caps + moment;
      if constexpr (kLabels) stiff_ = timesPlus(lens, factorsOf(slot, plane), stiff_);
    }
  }

  Lanes factorsOf(std::int64_t slot, std::int64_t plane) const {
    constexpr float kStep = 1.0f / static_cast<float>(kFactorSteps);
    const std::uint8_t only = in_.only_label[slot];
    if (only != 255) return all(static_cast<float>(in_.factor_steps[only]) * kStep);
    float factor[16];
    for (int lane = 0; lane < 16; ++lane)
      factor[lane] = static_cast<float>(in_.factor_steps[in_.label[plane + lane]]) * kStep;
    return load(factor);
  }

  /// Before the float sums grow long.
  void flush(SphereSums& out) {
    out.shell_weight += sumOf(weight_), out.shell_grey += sumOf(grey_), out.shell_stiff += sumOf(stiff_);
    out.shell_x += sumOf(x_), out.shell_y += sumOf(y_), out.shell_z += sumOf(z_);
    weight_ = grey_ = stiff_ = x_ = y_ = z_ = all(0.0f);
  }

  const SphereSumsInput& in_;
  const float outer_ = static_cast<float>(in_.radius) + kSphereVoxel,
              inner_ = static_cast<float>(in_.radius) - kSphereVoxel;
  int first_[3], last_[3];
  Lanes volume_[kCoefficients], cap_[kCoefficients];
  Lanes weight_ = all(0.0f), grey_ = all(0.0f), stiff_ = all(0.0f), x_ = all(0.0f), y_ = all(0.0f), z_ = all(0.0f);
  alignas(64) float dx_[kMaxBlocksAcross][16];
  alignas(64) float tx_[kMaxBlocksAcross][16];
};

template <int kCoefficients, bool kIndexed>
inline void sumSphereWith(const SphereSumsInput& in, SphereSums& out) {
  if (in.label != nullptr)
    SphereSum<kCoefficients, true, kIndexed>(in).sumInto(out);
  else
    SphereSum<kCoefficients, false, kIndexed>(in).sumInto(out);
}

template <bool kIndexed>
inline void sumSphereOf(const SphereSumsInput& in, SphereSums& out) {
  if (in.coefficients <= 4)
    sumSphereWith<4, kIndexed>(in, out);
  else if (in.coefficients <= 5)
    sumSphereWith<5, kIndexed>(in, out);
  else if (in.coefficients <= 6)
    sumSphereWith<6, kIndexed>(in, out);
  else
    sumSphereWith<8, kIndexed>(in, out);
}

inline void sumSphere(const SphereSumsInput& in, SphereSums& out) {
  if (in.slot_of != nullptr)
    sumSphereOf<true>(in, out);
  else
    sumSphereOf<false>(in, out);
}

}  // namespace
}  // namespace haptics
