// The gutter that exposes an impacted tooth (buccal and distal ostectomy): the roof of bone over the crown, and beside
// it a gutter as wide as the bur that hugs the crown down to its cervical line. It keeps off the second molar, the
// lingual plate and the mandibular canal, and stays where the surgeon's eye sees it past the teeth. Computed like a
// tool path on a height map: on every line along the way in, the deepest place of a ball that touches none of these
// (drop cutter, Choi and Jerard 1998). Frame P, mm. Start-up only; some tenths of a second.
#pragma once

#include <optional>

#include "assets/patient.h"
#include "assets/planned_cut.h"

namespace app {

/// Width of the gutter where the bur is thinner; a thicker bur makes it as wide as itself.
inline constexpr double kGutterWidth_mm = 2.8;
/// Of the round bur that the flap is made for: 3.0 mm.
inline constexpr double kUsualBurRadius_mm = 1.5;

/// None without a site or without bone beside or over the crown.
std::optional<assets::PlannedCut> planGutter(const assets::Patient& patient, double bur_radius_mm);

}  // namespace app
