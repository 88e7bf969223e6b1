// Ideal preparations by rule: the numbers a tooth is prepared to. Crowns: lithium disilicate 1.5 mm occlusal and axial
// with a margin of 1.0 mm (Inside Dentistry 2022/08), zirconia 1.0 to 1.5 mm occlusal with a chamfer of 0.5 mm, total
// occlusal convergence 10 to 20 degrees, height at least 4 mm on molars and 3 on others, height over width at least
// 0.4, round line angles (Goodacre 2001, 10.1067/mpr.2001.114685). Metal-ceramic and the cavities: usual teaching, not
// verified. mm, rad. Plain data; any thread.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include <glm/glm.hpp>

namespace app {

enum class IdealKind { crown, cavity, free };  ///< free: of a file, and no crown

struct IdealRule {
  std::string_view name;  ///< on the command line
  std::string_view for_people;
  IdealKind kind = IdealKind::crown;
  // Crowns.
  double occlusal_mm = 1.5;       ///< taken from the biting surface, in every direction
  double margin_mm = 1.0;         ///< width of the shelf
  double margin_height_mm = 1.0;  ///< of the margin over the cervical line
  double half_angle_rad = 0.0;    ///< of a wall to the axis
  double edge_mm = 0.5;           ///< radius of line angles between wall and biting surface
  double fillet_mm = 0.5;         ///< radius between margin and wall: the margin's width makes a chamfer
  // Cavities.
  double depth_mm = 2.0;       ///< below the middle of the biting surface
  double isthmus_mm = 1.5;     ///< from cheek to tongue
  double length_share = 0.55;  ///< of the tooth's width from mesial to distal
  int box_side = 0;            ///< class II: 1 mesial, -1 distal; 0: none
  double box_mm = 3.0;         ///< from cheek to tongue
  double box_axial_mm = 1.5;   ///< from the side of the tooth inwards
  double box_height_mm = 1.0;  ///< of its floor over the cervical line
  glm::dvec2 groove_mm{0.0};   ///< a place of its middle line, of the tooth's cross-section
  double groove_rad = 0.0;     ///< of that line, from mesial towards the cheek
};

/// What crowns are asked for, whatever the material.
inline constexpr double kLeastConvergence_deg = 10.0, kMostConvergence_deg = 20.0;
inline constexpr double kLeastHeightOverWidth = 0.4;
constexpr double leastHeight_mm(bool is_molar) { return is_molar ? 4.0 : 3.0; }

std::span<const IdealRule> idealRules();
/// Throws UsageError, beginning with `option`.
const IdealRule& idealRule(std::string_view name, const std::string& option);

}  // namespace app
