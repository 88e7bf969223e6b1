// What holds a piece, summed over its samples: energy, gradient and Hessian at a pose with the torn shares as they are,
// and what a tick leaves in the samples. Plain values, one set of functions per instruction set and the same bits from
// all of them: floats without fused multiply-add, sixteen lanes of fixed order added in double. Servo thread; no
// allocation, no mathematics library; 11 µs for 1900 samples in a field with AVX-512, 16 with AVX2. Private to
// ligament/. Formulas: reference/extraction 3.1, 3.2, 3.4, 4.2; Hessian of the distance terms by Gauss and Newton.
#pragma once

namespace haptics {

/// Of a law and a tick's length.
struct HoldConstants {
  float fibre, stiffening, peak_stretch, peak_stress, per_softening, shear;
  float wall, wall_stiffening, wall_slope, wall_end, wall_end_slope;
  float fluid, fluid_kept, contact;
  float creep, creep_floor, yield, widening;
};

/// Structure of arrays; counts are multiples of sixteen.
struct HoldSamples {
  const float *x, *y, *z, *nx, *ny, *nz, *area, *width, *rest_gap;
  const float *torn, *fluid, *strain, *widened;  ///< of the ligament's samples
  int ligament, all;
};

/// Turn less the unit matrix, by rows; way of the centre. Null `distance`: each sample of ligament against the plane of
/// its own socket point, no contact.
struct HoldPlace {
  float turn[9], shift[3];
  const float* distance;
  int size[3];
  float centre[3], per_mm;  ///< the samples' centre as an index of the field
};

struct HoldSums {
  double energy, contact_energy;  ///< the second is part of the first
  double gradient[6];             ///< along and about the axes of P, about the samples' centre
  double hessian[21];             ///< rows of the upper triangle
};

struct HoldAge {
  double torn_Nmm;    ///< by this tick
  double stored_Nmm;  ///< in fibres, wall and fluid
  double torn_area_mm2;
};

struct HoldMemory {
  float *torn, *fluid, *strain, *widened;
};

HoldSums sumHold(const HoldConstants& law, const HoldSamples& samples, const HoldPlace& place) noexcept;
/// After a tick at the place where it ended. `memory` is that of the samples.
HoldAge ageHold(const HoldConstants& law, const HoldSamples& samples, const HoldPlace& place,
                const HoldMemory& memory) noexcept;

namespace portable {
HoldSums sumHold(const HoldConstants& law, const HoldSamples& samples, const HoldPlace& place) noexcept;
HoldAge ageHold(const HoldConstants& law, const HoldSamples& samples, const HoldPlace& place,
                const HoldMemory& memory) noexcept;
}  // namespace portable
#if defined(__x86_64__)
namespace avx2 {
HoldSums sumHold(const HoldConstants& law, const HoldSamples& samples, const HoldPlace& place) noexcept;
HoldAge ageHold(const HoldConstants& law, const HoldSamples& samples, const HoldPlace& place,
                const HoldMemory& memory) noexcept;
}  // namespace avx2
namespace avx512 {
HoldSums sumHold(const HoldConstants& law, const HoldSamples& samples, const HoldPlace& place) noexcept;
HoldAge ageHold(const HoldConstants& law, const HoldSamples& samples, const HoldPlace& place,
                const HoldMemory& memory) noexcept;
}  // namespace avx512
#endif

}  // namespace haptics
