// Course of the mandibular canal: from the ramus, under the molars' roots, to the mental foramen. Frame J
// (dental_arch.h), mm. Immutable; any thread. Radius 1.4 mm, cortical wall 0.55 mm: CBCT means (diameter 2.5-3 mm).
// Position by region (lingual at the third molar, buccal at the premolars): reference/product, 3.2.
#pragma once

#include <cstddef>
#include <vector>

#include "assets/synthetic/dental_arch.h"

namespace assets {

class MandibularCanalPath {
 public:
  static constexpr double kRadius_mm = 1.4;
  static constexpr double kWall_mm = 0.55;

  /// The mean course, lowered by `drop_mm` at the arc length of the third molar.
  MandibularCanalPath(const DentalArch& arch, double third_molar_along_mm, double drop_mm);

  /// Segments of the course from `first` to before `end`.
  struct Stretch {
    std::size_t first = 0, end = 0;
  };
  Stretch whole() const { return {0, points_J_mm_.size() - 1}; }
  /// Holds the segment nearest to any point of a ball.
  Stretch stretchNear(const glm::dvec3& centre_J, double radius_mm) const;

  /// Distance to the lumen's wall, negative inside; about 2 ns a segment.
  double lumen_mm(const glm::dvec3& p_J) const { return lumen_mm(p_J, whole()); }
  /// The same for a point of the ball that the stretch is near.
  double lumen_mm(const glm::dvec3& p_J, const Stretch& stretch) const;
  const std::vector<glm::dvec3>& points_J_mm() const { return points_J_mm_; }

 private:
  double square_mm2(const glm::dvec3& p_J, std::size_t segment) const;

  std::vector<glm::dvec3> points_J_mm_;
};

}  // namespace assets
