// Colours laid upon the drawn surface of the volume: a measure or the marks of articulating paper on a tooth. A texel a
// voxel of a box of the volume's grid, sampled trilinearly where a ray meets the surface, as colour of the matter
// there; outside of the box nothing. What it means stands beside it as a legend. Linear light, premultiplied by cover.
// Plain values; any thread; 4 bytes a voxel of the box.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "render/volume/bordered_field.h"

namespace render {

using PaintTexels = BorderedField<std::uint32_t>;  ///< RGBA bytes, red lowest

struct SurfacePaint {
  /// A line of the legend; the swatches of neighbouring rows join to a scale.
  struct Row {
    std::optional<glm::vec3> linear;  ///< none: words alone
    std::string means;
  };

  glm::ivec3 low{0};  ///< voxel of the volume that texel (0,0,0) lies on
  PaintTexels texels;
  std::string title;
  std::vector<Row> rows;  ///< empty: no legend
};

/// `cover`: 0 leaves the matter as it is, 1 hides its colour.
inline std::uint32_t paintTexel(const glm::vec3& linear, float cover) {
  const glm::vec4 rgba = 255.0F * glm::clamp(glm::vec4(cover * linear, cover), 0.0F, 1.0F) + 0.5F;
  return static_cast<std::uint32_t>(rgba.r) | static_cast<std::uint32_t>(rgba.g) << 8 |
         static_cast<std::uint32_t>(rgba.b) << 16 | static_cast<std::uint32_t>(rgba.a) << 24;
}

/// Of colours as they are written down, 0..1.
inline glm::vec3 linearFromSrgb(const glm::vec3& srgb) {
  const glm::vec3 power = glm::pow((srgb + 0.055F) / 1.055F, glm::vec3(2.4F));
  return glm::mix(srgb / 12.92F, power, glm::vec3(glm::greaterThan(srgb, glm::vec3(0.04045F))));
}

}  // namespace render
