// Dimensions of a WoodenHaptics: links, capstans, encoders, motors. The two published builds are facts of
// forsslund/haptikfabrikenapi, haptikfabrikenapi.h (reference/devices 3.1). Joints a, b, c: turret, upper arm, forearm;
// mm, rad, N mm, mA. Plain data; any thread.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace haptics {

struct WoodenModel {
  std::string name;
  glm::dvec3 capstan_mm{10.0}, body_mm{160.0, 120.0, 120.0};  ///< diameters: motor side, body side
  glm::dvec3 length_mm{80.0, 205.0, 245.0};                   ///< shoulder above the base, upper arm, forearm
  glm::dvec3 origin_mm{220.0, 0.0, 80.0};                     ///< of frame D, from the foot of the turret
  double workspace_radius_mm = 100.0;
  glm::dvec3 motor_Nmm_per_A{25.9};
  glm::dvec3 counts_per_turn{2000.0}, direction{1.0};              ///< motor encoders, four edges counted; +1 or -1
  glm::dvec3 gimbal_counts_per_turn{0.0}, gimbal_direction{-1.0};  ///< d, e, f; 0: no gimbal
  /// At the home position: turret ahead, upper arm upright, forearm level.
  std::array<std::int16_t, 6> home_counts{0, 0, 6000, 0, 0, 0};
  double full_scale_mA = 3000.0;  ///< at full pulse width (firmware/main.cpp; there is a build for 6000)
  double max_mA = 2000.0;         ///< what an Escon 24/4 gives for longer than 4 s, and the public driver's clamp
  double peak_force_N = 5.0, max_stiffness_N_per_mm = 1.0, max_damping_Ns_per_mm = 0.008;

  bool hasGimbal() const { return glm::all(glm::greaterThan(gimbal_counts_per_turn, glm::dvec3(0.0))); }
  double clamp_mA() const { return max_mA < full_scale_mA ? max_mA : full_scale_mA; }
};

WoodenModel woodenHaptics2015();
WoodenModel woodenHaptics2019();
/// "v2015" or "v2019".
std::optional<WoodenModel> woodenModelNamed(std::string_view name);

}  // namespace haptics
