// What a filled tooth has come to against the tooth it was (reference/sisters 5.4): how much was laid and set, voids,
// overhangs, contour, increments; raw mm and mm³, no single mark. From the intact crown, the tooth as it is prepared
// and what was laid into it, over one box. Frame P, mm. Any thread but the servo's; the intact tooth's distance field
// is made once (some 0.3 s), the outcomes some 0.2 s.
#pragma once

#include <array>
#include <vector>

#include "app/procedure/preparation/deviation.h"
#include "app/procedure/root_canal/air_parts.h"
#include "haptics/bone/filling.h"

namespace app {

inline constexpr double kDeepestIncrement_mm = 2.0;  ///< of what light sets
inline constexpr double kLeastOverhang_mm = 0.1;

struct Increment {
  int number = 0;  ///< in the order laid
  double laid_mm3 = 0.0;
  double depth_mm = 0.0;  ///< where it is thickest, along the tooth's axis
  double cured_share = 0.0;
  bool is_cured_by_light = false;
  bool isTooDeep() const { return is_cured_by_light && depth_mm > kDeepestIncrement_mm; }
};

struct FillingOutcomes {
  double laid_mm3 = 0.0;
  std::array<double, assets::kTissueCount> laid_of_mm3{};  ///< by material
  double curable_mm3 = 0.0, cured_mm3 = 0.0;               ///< of what light sets
  double cavity_mm3 = 0.0;                                 ///< that the tooth lacks
  double filled_mm3 = 0.0;                                 ///< of it
  std::vector<EnclosedAir> voids;                          ///< of at least kLeastVoid_mm3, the largest first
  double overhang_mm3 = 0.0;  ///< laid more than kLeastOverhang_mm outside of the intact tooth
  double overhang_mm = 0.0;   ///< the farthest of it
  double contour_mm2 = 0.0;   ///< of the filling's free surface
  double contour_rms_mm = 0.0, contour_mean_mm = 0.0;
  double too_high_mm = 0.0, too_low_mm = 0.0;  ///< 99th percentiles of area
  std::vector<Increment> increments;

  double filledShare() const { return cavity_mm3 > 0.0 ? filled_mm3 / cavity_mm3 : 0.0; }
  double curedShare() const { return curable_mm3 > 0.0 ? cured_mm3 / curable_mm3 : 0.0; }
};

/// What was laid, in the crown's box.
struct LaidBoxes {
  BoxBytes laid, tissue, increment;
};

/// `filling` in the order of `grid`, of which the box is a part.
LaidBoxes laidBoxes(const haptics::Filling::Volumes& filling, const assets::VolumeGrid& grid,
                    const assets::VolumeGrid& box);

/// What opposing teeth meet: the tooth as it is made and what was laid into it; no filling: the tooth.
BoxBytes filledTooth(const BoxBytes& made, const haptics::Filling::Volumes& filling, const assets::VolumeGrid& grid);

class FillingMeasure {
 public:
  /// `intact` must outlive it.
  explicit FillingMeasure(const Crown& intact);

  /// `made`: the tooth itself as it is now.
  FillingOutcomes outcomesOf(const BoxBytes& made, const LaidBoxes& filling) const;

 private:
  const Crown& intact_;
  BoxBytes own_;  ///< of the intact box, without neighbours
  IdealDistance distance_;
};

}  // namespace app
