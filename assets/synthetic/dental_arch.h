// Curve of the lower teeth seen from above, and coordinates along it.
// Jaw frame J of the synthetic anatomy, mm: l lateral (away from the midline), y posterior, z superior; origin at the
// edge between the lower central incisors; occlusal plane z = 0. J is P for a left jaw and P mirrored in x for a right
// one. Any thread. Adult mean (intermolar width about 46 mm, depth to the second molars about 41 mm; tooth widths after
// Ash and Nelson, Wheeler's Dental Anatomy).
#pragma once

#include <vector>

#include <glm/glm.hpp>

namespace assets {

/// A point of the arch with its horizontal directions.
struct ArchStation {
  glm::dvec2 centre_mm{0.0};
  glm::dvec2 distal{0.0, 1.0};  ///< unit, along the arch away from the midline
  glm::dvec2 buccal{1.0, 0.0};  ///< unit, outward
};

/// Horizontal coordinates about the arch.
struct ArchCoordinates {
  double along_mm = 0.0;   ///< arc length from the midline
  double buccal_mm = 0.0;  ///< outward positive
};

class DentalArch {
 public:
  DentalArch();

  ArchStation stationAt(double along_mm) const;
  ArchCoordinates coordinatesOf(const glm::dvec2& point_mm) const;
  double arcLengthAtPosterior(double y_mm) const;

 private:
  std::vector<glm::dvec2> points_mm_;
  std::vector<double> along_mm_;
};

}  // namespace assets
