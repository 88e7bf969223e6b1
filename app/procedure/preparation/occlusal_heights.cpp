#include "app/procedure/preparation/occlusal_heights.h"

#include <algorithm>
#include <array>

#include "assets/tissue.h"

namespace app {

float OcclusalRaster::at(const glm::dvec2& place_mm) const {
  const glm::dvec2 at_cell = (place_mm + kHalf_mm) / kStep_mm, low = glm::floor(at_cell);
  const int x = static_cast<int>(low.x), y = static_cast<int>(low.y);
  if (x < 0 || y < 0 || x + 1 >= kSide || y + 1 >= kSide) return kNone;
  const glm::vec2 f(at_cell - low);
  return glm::mix(glm::mix(at(x, y), at(x + 1, y), f.x), glm::mix(at(x, y + 1), at(x + 1, y + 1), f.x), f.y);
}

namespace {

/// Nine columns over a voxel, across the way: linear between voxels a ball of 2 mm is a tenth of a µm too low between
/// them, which first contacts would see.
std::array<glm::dvec3, 9> columnsAcross(const glm::dvec3& up_P, double voxel_mm) {
  const glm::dvec3 along = glm::abs(up_P);
  const int up = along.x > along.y && along.x > along.z ? 0 : along.y > along.z ? 1 : 2;
  std::array<glm::dvec3, 9> columns{};
  for (int n = 0; n < 9; ++n) {
    glm::dvec3& aside = columns[static_cast<std::size_t>(n)];
    aside[(up + 1) % 3] = (n % 3 - 1) * voxel_mm / 3.0;
    aside[(up + 2) % 3] = (n / 3 - 1) * voxel_mm / 3.0;
    // Aside and not along the way.
    aside -= glm::dot(aside, up_P) * up_P;
  }
  return columns;
}

/// By 1 2 1 both ways, where all neighbours are: the voxels' last digit is noise, whose highest place would meet first.
OcclusalRaster smoothed(const OcclusalRaster& rough) {
  OcclusalRaster smooth = rough;
  for (int y = 1; y + 1 < OcclusalRaster::kSide; ++y)
    for (int x = 1; x + 1 < OcclusalRaster::kSide; ++x) {
      const auto row = [&](int at) { return rough.at(x - 1, at) + 2.0F * rough.at(x, at) + rough.at(x + 1, at); };
      const float mean = (row(y - 1) + 2.0F * row(y) + row(y + 1)) / 16.0F;
      if (!std::isnan(mean)) smooth.at(x, y) = mean;
    }
  return smooth;
}

}  // namespace

OcclusalRaster occlusalHeights(const Crown& crown, const BoxBytes& solid) {
  constexpr double kOver_mm = 1.2;  // as a filling may stand
  const double voxel_mm = solid.grid().spacing_mm, reach_mm = crown.reach_mm + kOver_mm;
  const double half_mm = wallReach_mm(solid.grid());
  const glm::dvec3 up_P = crown.frame.axes_P[2];
  const std::array<glm::dvec3, 9> columns = columnsAcross(up_P, voxel_mm);
  OcclusalRaster heights;
  for (int y = 0; y < OcclusalRaster::kSide; ++y)
    for (int x = 0; x < OcclusalRaster::kSide; ++x) {
      const glm::dvec2 place = OcclusalRaster::place_mm(x, y);
      if (glm::dot(place, place) > reach_mm * reach_mm) continue;
      for (double z = crown.top_mm + kOver_mm; z > 0.0; z -= voxel_mm) {
        const glm::dvec3 p_P = crown.frame.inP({place, z});
        if (solid.nearest(p_P) < 64 || solid.at(p_P) < 0.5) continue;
        if (crown.label.nearest(p_P) == static_cast<std::uint8_t>(assets::Tissue::other_teeth)) break;
        // The surface lies up to a voxel higher: as much of the stretch as is solid lies under it.
        const double from_mm = z + 0.5 * voxel_mm - half_mm;
        const glm::dvec3 from_P = crown.frame.inP({place, from_mm});
        double sum_mm = 0.0;
        for (const glm::dvec3& aside_P : columns)
          sum_mm += solid.solidBetween_mm(from_P + aside_P, up_P, half_mm) +
                    solid.solidBetween_mm(from_P + aside_P + half_mm * up_P, up_P, half_mm);
        heights.at(x, y) = static_cast<float>(from_mm + sum_mm / static_cast<double>(columns.size()));
        break;
      }
    }
  return smoothed(heights);
}

}  // namespace app
