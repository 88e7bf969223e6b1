// The biting surface of a tooth as heights over its cross-section, along the way on which the jaws close: straight,
// along the tooth's axis. A height is the sum of the solid along its column, some tenths of a µm at 0.05 mm. A
// neighbour does not count; whatever else is solid does, so a filling that was laid. Frame of the tooth, mm. Immutable;
// any thread; some 0.4 s a molar.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "app/procedure/preparation/crown.h"

namespace app {

/// Of any square raster over the cross-section, mesial along x, buccal along y.
class OcclusalRaster {
 public:
  static constexpr double kStep_mm = 0.05, kHalf_mm = 7.5;
  static constexpr int kSide = 301;
  static constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

  OcclusalRaster() : value_(static_cast<std::size_t>(kSide) * kSide, kNone) {}

  static glm::dvec2 place_mm(int x, int y) { return {kStep_mm * x - kHalf_mm, kStep_mm * y - kHalf_mm}; }
  float& at(int x, int y) { return value_[index(x, y)]; }
  float at(int x, int y) const { return value_[index(x, y)]; }
  bool has(int x, int y) const { return !std::isnan(at(x, y)); }
  /// Linear between its places; kNone where one of them has none.
  float at(const glm::dvec2& place_mm) const;

 private:
  static std::size_t index(int x, int y) { return static_cast<std::size_t>(y * kSide + x); }
  std::vector<float> value_;
};

/// Of the tooth's highest solid; `solid`: the crown as it is. None beside it and below its cervical line.
OcclusalRaster occlusalHeights(const Crown& crown, const BoxBytes& solid);

}  // namespace app
