// Grey values of cancellous bone: a network of plates and rods between marrow spaces, band-limited, not white noise.
// Frame J, mm; HU as a scanner of the given blur would show them. Immutable; any thread; about 0.5 us a point.
// Struts 0.2-0.3 mm thick about 0.9 mm apart, bone fraction about a third, mean 420 HU: mandibular micro-CT (Moon 2004;
// Tb.Th 0.2-0.3 mm, Tb.Sp 0.5-1 mm). Model: level sets of two Gaussian random fields; where one decides the strut is
// a plate, where both do it is a rod.
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
