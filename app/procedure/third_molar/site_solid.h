// What is solid around an operated tooth, as a bur meets it that comes from one direction or another: for cuts that are
// planned while the operation goes on. Frame P, mm. Any thread; some 50 ms to make, some ms a direction; allocates.
#pragma once

#include <vector>

#include "app/case/height_map.h"
#include "assets/patient.h"
#include "assets/planned_cut.h"

namespace app {

class SiteSolid {
 public:
  /// `now`: a patient with a site, whose solid is what is left. Borrowed.
  explicit SiteSolid(const assets::Patient& now);

  /// Middles of the voxels that are left of the tooth.
  const std::vector<glm::dvec3>& tooth_P_mm() const { return tooth_P_mm_; }
  double voxel_mm3() const { return now_.ct.grid.voxelVolume_mm3(); }
  /// From above, the cheek and the front, through the crown's middle.
  const std::vector<WayIn>& waysIn() const { return ways_; }

  /// Of a ball: `bone` where it touches what is solid first, `tooth` where it rests on the operated tooth with a radius
  /// greater by `off_tooth_mm`, `lowest` where it is off other teeth and the canal. Solid farther than `within_mm` from
  /// the middle row of the map does not count.
  Heights heightsAlong(const WayIn& way, double bur_radius_mm, double off_tooth_mm, double within_mm = 1e9) const;

 private:
  struct Point {
    glm::dvec3 p_P_mm;
    bool is_tooth, is_other_tooth;
  };
  const assets::Patient& now_;
  std::vector<Point> surface_;
  std::vector<glm::dvec3> tooth_P_mm_;
  std::vector<WayIn> ways_;
};

/// The strokes that cut these columns down to the lowest heights.
assets::PlannedCut cutAlong(const WayIn& way, const Heights& heights, const std::vector<char>& planned,
                            double bur_radius_mm);

}  // namespace app
