// A block of bone with a third molar buried in it and the second molar in front, right side: for plans by closed form.
#pragma once

#include "assets/patient.h"

namespace app::test {

inline constexpr double kMolarRadius_mm = 5.0, kMolarTop_mm = -2.0, kCervix_mm = -8.0, kSecondMolar_y_mm = 28.0;

/// Bone up to z = 0; both teeth are upright cylinders, the third molar 2 mm under bone, enamel down to z = -8 mm.
inline assets::Patient blockWithMolar() {
  using assets::Tissue;
  assets::Patient patient;
  assets::CtVolume& ct = patient.ct;
  ct.grid = {{80, 90, 70}, 0.5, {-40.0, 18.0, -28.0}};
  ct.solid.assign(ct.grid.voxelCount(), 0);
  ct.label.assign(ct.grid.voxelCount(), 0);
  patient.site = {48, {-20.0, 40.0, -9.0}, {0.0, 0.0, 1.0}};
  assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p = ct.grid.centre_P_mm(ijk);
    const bool molar =
        glm::length(glm::dvec2(p.x + 20.0, p.y - 40.0)) < kMolarRadius_mm && p.z < kMolarTop_mm && p.z > -18.0;
    const bool second = glm::length(glm::dvec2(p.x + 20.0, p.y - kSecondMolar_y_mm)) < kMolarRadius_mm && p.z < 4.0;
    if (!molar && !second && p.z > 0.0) return;
    ct.solid[v] = 255;
    ct.label[v] = static_cast<std::uint8_t>(molar    ? (p.z > kCervix_mm ? Tissue::enamel : Tissue::dentine)
                                            : second ? Tissue::other_teeth
                                                     : Tissue::cortical);
  });
  return patient;
}

}  // namespace app::test
