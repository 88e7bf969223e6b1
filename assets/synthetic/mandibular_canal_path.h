// Course of the mandibular canal: from the ramus, under the molars' roots, to the mental foramen. Frame J
// (dental_arch.h), mm. Immutable; any thread. Radius 1.4 mm, cortical wall 0.55 mm: CBCT means (diameter 2.5-3 mm).
// Position by region (lingual at the third molar, buccal at the premolars): reference/product, 3.2.
#pragma once

#include <vector>

#include "assets/synthetic/dental_arch.h"

namespace assets {

class MandibularCanalPath {
 public:
  static constexpr double kRadius_mm = 1.4;
  static constexpr double kWall_mm = 0.55;

  /// The mean course, lowered by `drop_mm` at the arc length of the third molar.
  MandibularCanalPath(const DentalArch& arch, double third_molar_along_mm, double drop_mm);

  /// Distance to the lumen's wall, negative inside; about 0.3 us.
  double lumen_mm(const glm::dvec3& p_J) const;
  const std::vector<glm::dvec3>& points_J_mm() const { return points_J_mm_; }

 private:
  std::vector<glm::dvec3> points_J_mm_;
};

}  // namespace assets
