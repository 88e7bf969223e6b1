// Scans without a lower jaw, in closed form: other dense bones of the body, an implant, rods of a test object. As grey
// as in life, Hounsfield, with noise. For tests that nothing of them is taken for teeth.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "assets/volume_grid.h"

namespace tests {

struct NoJawPhantom {
  std::string name;
  assets::VolumeGrid grid;
  std::vector<std::int16_t> hounsfield;
};

/// Sizes and places by the seed.
std::vector<NoJawPhantom> noJawPhantoms(unsigned seed);

}  // namespace tests
