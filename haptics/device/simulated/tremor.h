// Tremor of a hand that holds an instrument: four steady waves between 8 and 12 Hz in each direction, frequencies and
// phases drawn from a seed. mm, s. 0.05 mm rms in all was measured of eye surgeons holding an instrument still
// (Riviere, Rader, Khosla 1997: 49 um); elsewhere 0.05 to 0.2 mm at 8 to 12 Hz. A pure function of time; any thread.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

namespace haptics {

class Tremor {
 public:
  Tremor(double rms_mm, std::uint32_t seed);

  glm::dvec3 at(double t_s) const;

 private:
  static constexpr std::size_t kWaves = 4;
  struct Wave {
    double rad_per_s = 0.0, phase_rad = 0.0;
  };

  std::array<std::array<Wave, kWaves>, 3> waves_;
  double height_mm_;
};

}  // namespace haptics
