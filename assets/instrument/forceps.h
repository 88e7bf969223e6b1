// Extraction forceps for a lower molar, in frame T: origin between the tips of the beaks, where they grip; +z from the
// beaks to the handles; the beaks open along x, the handles fall 20 degrees towards -y, beside the line of sight. mm.
// Pattern: American No. 17 - pointed beaks for the furcation, screw joint 25 mm behind the tips, handles 120 mm long
// with a gentle S. Simplified: the beaks lie along the hand's axis (in life bent off the handles by about 90 degrees),
// both handles are alike and ridged. Sizes by appearance; there is no source. Parts "Right half" (its beak at +x),
// "Left half", "Screw" and "Slot", each closed, 5,712 triangles. Any thread; under 1 ms. Drawn only: it grips nothing.
#pragma once

#include "assets/mesh.h"

namespace assets {

inline constexpr double kLeastForcepsOpening_mm = 1.0, kMostForcepsOpening_mm = 14.0;

/// `opening_mm`: clear width between the tips, clamped.
MeshModel forceps(double opening_mm);

}  // namespace assets
