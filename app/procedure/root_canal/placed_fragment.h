// Where what a broken file left lies: in which canal, how far its lower end is from the foramen, how long it is. Frame
// P, mm. Pure; any thread; some µs.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "assets/metal_fragment.h"
#include "assets/tooth_canals.h"

namespace app {

struct PlacedFragment {
  int size = 25;
  bool nickel_titanium = false;
  double length_mm = 0.0;
  std::string canal;             ///< empty: its tip is in none
  double from_foramen_mm = 0.0;  ///< of its tip, along the canal; negative: beyond
};

std::vector<PlacedFragment> placed(const assets::ToothCanals& tooth, std::span<const assets::MetalFragment> fragments);

/// "3.1 mm of a #20 in the distal canal, its tip 2.4 mm from the foramen".
std::string inWords(const PlacedFragment& fragment);

}  // namespace app
