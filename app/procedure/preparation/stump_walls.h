// The walls of a prepared tooth in cylinder coordinates about its axis: the radius in every direction at every height,
// and from it P3 convergence and P6 smoothness (reference/sisters 5.3). A wall lies where the sum of the solid along
// the ray says, 2 µm at 0.05 mm; its slope is that of such radii: the normals of voxels are biased by a degree. Other
// teeth do not count. Frame of the tooth (mesial, buccal, occlusal), mm, rad. Immutable; any thread; some 50 ms.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "app/procedure/preparation/crown.h"

namespace app {

class StumpWalls {
 public:
  static constexpr std::size_t kAround = 180;
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  /// `solid`: the crown as it is.
  StumpWalls(const Crown& crown, const BoxBytes& solid, double from_mm, double to_mm);

  std::size_t heights() const { return heights_; }
  double height_mm(std::size_t level) const { return from_mm_ + static_cast<double>(level) * step_mm_; }
  double step_mm() const { return step_mm_; }
  /// From the axis to the wall; none: no tooth there.
  double radius_mm(std::size_t around, std::size_t level) const { return radius_mm_[level * kAround + around]; }
  std::size_t levelAt(double height_mm) const;

  /// From mesial to buccal.
  static double turn_rad(std::size_t around);
  /// Of the wall's radius to its distance square to the outline: 1 on a circle about the axis.
  double squareness(std::size_t around, std::size_t level) const;

 private:
  double from_mm_, step_mm_;
  std::size_t heights_;
  std::vector<double> radius_mm_;
};

/// Straight part of a wall in one direction: r = at_mm - slope (height - from_mm), square to the outline.
struct WallLine {
  double angle_rad = StumpWalls::kNone;  ///< to the axis, positive: converges towards the bite
  double from_mm = 0.0, to_mm = 0.0;     ///< heights
  double at_mm = 0.0;                    ///< radius at from_mm, not squared
  double slope = 0.0;                    ///< of the radius, not squared

  bool isThere() const { return to_mm > from_mm; }
  double radiusAt_mm(double height_mm) const { return at_mm - slope * (height_mm - from_mm); }
};

struct WallForm {
  std::array<WallLine, StumpWalls::kAround> lines;
  double convergence_rad = StumpWalls::kNone;                                        ///< P3: mean over opposite pairs
  double mesiodistal_rad = StumpWalls::kNone, buccolingual_rad = StumpWalls::kNone;  ///< within 30 degrees of it
  double height_mm = 0.0;  ///< mean, from the margin to where the wall turns
  double height_over_width = 0.0;
  double roughness_mm = 0.0;  ///< P6: root mean square beside a plane of 1 mm
  double sharp_share = 0.0;   ///< P6: of directions whose line angle has a radius below 0.2 mm
};

/// `margin_mm`: height of the margin, of every direction.
WallForm wallForm(const StumpWalls& walls, const std::array<double, StumpWalls::kAround>& margin_mm);

}  // namespace app
