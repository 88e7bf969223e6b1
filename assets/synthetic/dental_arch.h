// The curve of the lower teeth seen from above, and coordinates along it.
// Jaw frame J of the synthetic anatomy, mm: l lateral (away from the midline), y posterior, z superior; origin at the
// edge between the lower central incisors; the occlusal plane is z = 0. J is P for a left jaw and P mirrored in x for a
// right one, so both sides share one anatomy. Any thread. Arch form: adult mean (intermolar width about 46 mm, depth of
// the arch to the second molars about 41 mm; widths of teeth after Ash and Nelson, Wheeler's Dental Anatomy).
#pragma once

#include <vector>

#include <glm/glm.hpp>

namespace assets {

/// A place on the arch with its horizontal directions.
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

/// The curve between b and c at t in 0..1.
inline glm::dvec2 catmullRom(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& d,
                             double t) {
  return 0.5 *
         (2.0 * b + t * (c - a) + t * t * (2.0 * a - 5.0 * b + 4.0 * c - d) + t * t * t * (3.0 * b - a - 3.0 * c + d));
}

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
