// Closing the wound, as places only: where a stitch belongs, and which the surgeon has confirmed, by holding the tip of
// an instrument that does not turn there with the pedal down. No thread, no tension, no knot. Frame P, mm. Places: once
// at the start, some 20 ms; ticks below a microsecond. Pure.
#pragma once

#include <vector>

#include "assets/patient.h"
#include "haptics/servo/tick.h"
#include "haptics/tool/tool.h"

namespace app {

inline constexpr double kStitchReach_mm = 3.0, kStitchHold_s = 0.3;

/// Along the incision of a flap for a lower third molar: two behind the second molar on the crest, one at the papilla
/// before it, a bite to the cheek (reference/product 3.1: one behind the second molar may do). Empty without a second
/// molar.
std::vector<glm::dvec3> stitchPlaces_P_mm(const assets::Patient& patient);

struct StitchPlace {
  glm::dvec3 at_P_mm{0.0};
  bool is_made = false;
};

class Stitches {
 public:
  explicit Stitches(const std::vector<glm::dvec3>& places_P_mm);

  /// Every tick, in order, made with this tool, once a piece is out. True: a place was confirmed.
  bool follow(const haptics::Tick& tick, const haptics::Tool& tool);
  const std::vector<StitchPlace>& places() const { return places_; }
  int made() const;

 private:
  std::vector<StitchPlace> places_;
  double held_s_ = 0.0;  ///< at a place
};

}  // namespace app
