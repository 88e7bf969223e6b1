// What the preparation of one canal has come to (reference/sisters 2.4): E1 volume, E2 transportation, E3 centring, E4
// untouched wall, E5 straightening, E6 least dentine, E7 working length, E9 apical form. From the field before and
// after, the canal's axis and the side of the furcation. Frame P, mm, rad. Pure; any thread; some 0.1 s a canal.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "app/procedure/root_canal/canal_sections.h"

namespace app {

/// From the foramen: where sections are shown and transportation is told.
inline constexpr std::array<double, 4> kSections_mm{1.0, 3.0, 5.0, 7.0};
/// Dentine thinner than this is a danger.
inline constexpr double kThinWall_mm = 0.5;

struct CanalOutcomes {
  double removed_mm3 = 0.0;
  std::array<CanalSection, kSections_mm.size()> sections;
  double untouched = 1.0;  ///< share of the canal's wall
  double schneider_before_rad = 0.0, schneider_after_rad = 0.0;
  std::vector<glm::dvec3> axis_before_P_mm, axis_after_P_mm;  ///< through the middles of the sections
  double least_wall_mm = 0.0;
  glm::dvec3 thinnest_P_mm{0.0};
  double thin_share = 0.0;                             ///< of the wall with less dentine behind than kThinWall_mm
  double apical_long_mm = 0.0, apical_short_mm = 0.0;  ///< diameters at the working length
  double taper = 0.0;                                  ///< growth of the diameter over its last 5 mm
  double foramen_moved_mm = 0.0;                       ///< the most that its wall went outwards
};

/// `removed_mm3`: of it (removedOfCanals()).
CanalOutcomes canalOutcomes(CanalSections& sections, double removed_mm3);

/// What was cut of blocks, added to that of each canal.
void removedOfCanals(const ToothBlocks& before, const FineSolid& after, const std::vector<assets::ToothCanal>& canals,
                     std::span<const glm::ivec3> blocks, std::span<double> removed_mm3);

/// Towards the middle of the tooth's other orifices; of a tooth with one canal to distal.
glm::dvec3 furcationSide_P(const assets::ToothCanals& tooth, std::size_t canal);

/// Of a file's tip from the working length, 0.5 mm short of the foramen; positive: too long.
struct LengthError {
  double at_rest_mm = 0.0;    ///< last
  double deepest_mm = 0.0;    ///< so far
  double most_over_mm = 0.0;  ///< beyond the foramen
  double over_s = 0.0;        ///< the same
};

/// E7, place by place: no memory of the way. O(1) a place.
class TipTrack {
 public:
  explicit TipTrack(double canal_length_mm) : length_mm_(canal_length_mm) {}
  /// In the order of time; `along_mm` of the canal, beyond its end where the tip is outside.
  void add(double t_s, double along_mm);
  bool isEmpty() const { return !last_s_; }
  const LengthError& error() const { return error_; }

 private:
  double length_mm_;
  std::optional<double> last_s_;
  bool was_over_ = false;
  LengthError error_;
};

}  // namespace app
