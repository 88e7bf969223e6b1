// The ideal preparation of one tooth, built from the intact tooth by a rule. A crown: its outline at the margin, drawn
// in by the margin's width and by the taper, under the biting surface lowered by a ball (so that every direction keeps
// the material's thickness), with round line angles. A cavity: a groove along the fissure and, in class II, a box at
// one side. Distances square to the faces. Frame of the tooth, mm. Immutable; any thread; about 0.1 s to make, 1 µs a
// place, 0.2 s for the crown of a molar at 0.05 mm.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "app/procedure/preparation/crown.h"
#include "app/procedure/preparation/ideal_rule.h"

namespace app {

/// Where a place of a preparation belongs.
enum class PreparedZone { occlusal, axial, margin };
inline constexpr std::size_t kPreparedZones = 3;
std::string_view nameOf(PreparedZone zone);

/// Highest tooth over a place of its cross-section, on a square raster of the tooth's frame.
class OcclusalMap {
 public:
  static constexpr double kStep_mm = 0.1, kHalf_mm = 8.0;
  static constexpr int kSide = 161;
  static constexpr float kNone = -100.0F;

  explicit OcclusalMap(const Crown& crown) : OcclusalMap(crown, crown.solid) {}
  /// Of what is left of it.
  OcclusalMap(const Crown& crown, const BoxBytes& solid);
  /// Lowered by a ball that rolls beneath. Sides steeper than 65 degrees do not bite and lower nothing.
  OcclusalMap lowered(double radius_mm) const;

  /// Linear between its places; kNone beside the tooth.
  double at(const glm::dvec2& p_mm) const;
  /// 1 over the length of the surface's normal: of a height to a distance.
  double steepness(const glm::dvec2& p_mm) const;

 private:
  float& cell(int x, int y) { return height_mm_[static_cast<std::size_t>(y * kSide + x)]; }
  bool isSteep(int x, int y) const;
  float cell(int x, int y) const { return height_mm_[static_cast<std::size_t>(y * kSide + x)]; }

  std::vector<float> height_mm_;
};

class PreparedIdeal {
 public:
  static constexpr std::size_t kAround = 180;

  /// Throws UsageError, beginning with `option`: the tooth is too small for it, or lies upside down.
  PreparedIdeal(const Crown& crown, const IdealRule& rule, const std::string& option);

  const IdealRule& rule() const { return rule_; }
  /// Into what is to be left, beside the intact surface; of a place in the tooth's frame.
  double depth_mm(const glm::dvec3& p_mm) const;
  PreparedZone zone(const glm::dvec3& p_mm) const;
  /// What is to be left of the crown: never more than it has, nothing of a neighbour.
  BoxBytes left(const Crown& crown) const;

 private:
  double crown_mm(const glm::dvec3& p_mm) const;
  double wall_mm(const glm::dvec3& p_mm) const;
  double occlusal_mm(const glm::dvec3& p_mm) const;
  double cavity_mm(const glm::dvec3& p_mm) const;

  IdealRule rule_;
  OcclusalMap lowered_;
  std::array<double, kAround> outline_mm_{}, square_{};  ///< crowns: radius at the margin; to a distance square to it
  double length_mm_ = 0.0, floor_mm_ = 0.0;              ///< cavities: of the groove; its floor
  double box_from_mm_ = 0.0;                             ///< class II: where its axial wall stands
};

}  // namespace app
