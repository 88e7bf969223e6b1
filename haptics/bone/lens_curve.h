// Overlap of a spherical bur and a voxel sphere as two polynomials in the squared distance: lens volume and bur-side
// cap of two spheres R and eta (bone/voxel_sphere), without root or division in the sum over the shell. Voxel units.
// With
//   t = (R^2 + eta^2 + 2 R eta - d^2) / (2 R eta), clamped to 0..2:  0 where the voxel is just outside, 2 just inside,
//   volume = t^2 q(t),  cap = t^2 q_cap(t),  both as a fraction of the voxel.
// In the plane limit q is (3 - t)/4 exactly (reference/physics 5); elsewhere q is interpolated at Chebyshev nodes.
// Largest measured error, as a fraction of a voxel: 3e-5 at R = 3, 5e-6 from R = 4 on, 1e-7 wholly inside.
// Building: 1 µs, no allocation; servo thread.
#pragma once

#include <array>

namespace haptics {

struct LensCurve {
  static constexpr int kMaxCoefficients = 8;
  /// Below this the closed form is summed.
  static constexpr double kMinRadius = 3.0;

  /// `radius` in voxels, at least kMinRadius.
  explicit LensCurve(double radius) noexcept;

  int coefficients = kMaxCoefficients;  ///< 4, 5, 6 or 8: q = c[0] + c[1] t + …
  std::array<float, kMaxCoefficients> volume{}, cap{};
  double scale = 0.0;  ///< t = offset - scale d^2
  double offset = 0.0;
};

}  // namespace haptics
