// What a prepared tooth bites on, and how: the lowest surface of the opposing teeth over it where the teeth meet, as a
// mesh or the patient's own scan gave it, and the way on which the jaws close. Heights of the tooth's frame, the hinge
// of P, mm. Plain data; any thread.
#pragma once

#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace assets {

enum class Closing { axis, hinge, balance };

struct ToothBite {
  Closing closing = Closing::axis;
  glm::dvec3 hinge_P_mm{0.0};  ///< a place on the axis of the condyles, which runs along x of P
};

struct OpposingTeeth {
  /// Places of the raster on each side, and between them: of the tooth's cross-section, its axis in the middle.
  static constexpr int kSide = 301;
  static constexpr double kStep_mm = 0.05;

  std::string digest;            ///< SHA-256 of the file, hexadecimal, its name and place are not kept; empty: the scan
  std::vector<float> height_mm;  ///< mesial fastest, then buccal; not a number: nothing opposes there
};

}  // namespace assets
