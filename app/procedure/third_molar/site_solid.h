// What is solid around an operated tooth, as a bur meets it that comes from one direction or another: for cuts that are
// planned while the operation goes on. Frame P, mm. Any thread; some 50 ms to make, some ms a direction; allocates.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "app/case/height_map.h"
#include "assets/patient.h"
#include "assets/planned_cut.h"

namespace app {

/// How far the bur's surface keeps off what it must not open.
struct Margins {
  double canal_mm = 1.5;            ///< where it has to be
  std::optional<double> tongue_mm;  ///< off the jaw's outer surface there; none: it may go through
};

class SiteSolid {
 public:
  /// `now`: a patient with a site, whose solid is what is left. `tongue_P_mm`: the jaw's outer surface where it faces
  /// the tongue, as scanned. Borrows both.
  explicit SiteSolid(const assets::Patient& now, std::span<const glm::dvec3> tongue_P_mm = {});

  /// Middles of the voxels that are left of the tooth, and their grid.
  const std::vector<glm::dvec3>& tooth_P_mm() const { return tooth_P_mm_; }
  std::span<const glm::dvec3> tongue_P_mm() const { return tongue_P_mm_; }
  const assets::VolumeGrid& grid() const { return now_.ct.grid; }
  /// From above, the cheek and the front, through the crown's middle.
  const std::vector<WayIn>& waysIn() const { return ways_; }

  /// Of a ball: `bone` where it touches what is solid first, `tooth` where it rests on the operated tooth with a radius
  /// greater by `off_tooth_mm`, `lowest` where it is off other teeth, the canal and the tongue's side of the jaw. Solid
  /// farther than `within_mm` from the middle row of the map does not count.
  Heights heightsAlong(const WayIn& way, double bur_radius_mm, double off_tooth_mm, const Margins& margins,
                       double within_mm = 1e9) const;

 private:
  struct Point {
    glm::dvec3 p_P_mm;
    bool is_tooth, is_other_tooth;
  };
  const assets::Patient& now_;
  std::span<const glm::dvec3> tongue_P_mm_;
  std::vector<Point> surface_;
  std::vector<glm::dvec3> tooth_P_mm_;
  std::vector<WayIn> ways_;
};

/// The strokes that cut these columns down to the lowest heights.
assets::PlannedCut cutAlong(const WayIn& way, const Heights& heights, const std::vector<char>& planned,
                            double bur_radius_mm);

}  // namespace app
