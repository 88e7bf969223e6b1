// Grey values of cancellous bone: plates and rods between marrow spaces, band-limited. Frame J, mm; HU as seen by a
// scanner of the given blur. Immutable; any thread; about 0.5 us a point. Struts 0.2-0.3 mm thick about 0.9 mm apart,
// bone fraction about 1/3, mean 420 HU: mandibular micro-CT (Moon 2004; Tb.Th 0.2-0.3 mm, Tb.Sp 0.5-1 mm). Level sets
// of two Gaussian random fields: one alone gives a plate, both together a rod.
#pragma once

#include <cstdint>

#include "assets/synthetic/band_limited_noise.h"

namespace assets {

class TrabecularTexture {
 public:
  TrabecularTexture(std::uint64_t seed, double blur_mm);

  double hounsfield(const glm::dvec3& p_J) const;

 private:
  BandLimitedNoise plate_;
  BandLimitedNoise rod_;
  BandLimitedNoise density_;
  double softness_;
};

}  // namespace assets
