// A lower jaw in closed form: teeth of Wheeler's widths on half an ellipse, in a horseshoe of bone with rami; for tests
// that need a whole arch in a second. Grey values are Hounsfield. Frame P: the middle at x = 0, crowns touch z = 0.
#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "assets/volume_grid.h"

namespace tests {

struct ArchPhantomOptions {
  std::set<int> missing{};      ///< FDI numbers
  bool is_upside_down = false;  ///< an upper arch
  bool is_mirrored = false;
  glm::ivec3 shift{0};  ///< of the jaw in the volume, voxels
  double noise_hu = 40.0;
  double spacing_mm = 0.6;
};

struct ArchPhantom {
  assets::VolumeGrid grid;
  std::vector<std::int16_t> hounsfield;
  std::vector<std::uint8_t> jaw, tooth;  ///< solid; FDI numbers
};

ArchPhantom archPhantom(const ArchPhantomOptions& options = {});

}  // namespace tests
