// What metal in a tooth adds to a radiograph: the chord of each pixel's beam through the round cones of a broken file,
// exact for a straight one, averaged over the pixel. Frame P, mm. Steel weakens a beam of 40 to 50 keV about 20 times
// as much as cortical bone, nickel-titanium 16 times (from Hubbell and Seltzer's tables, NISTIR 5632; dental tubes at
// 60 to 70 kV), ours to choose among beams. Pure; any thread; a millisecond a fragment.
#pragma once

#include <span>
#include <vector>

#include "assets/metal_fragment.h"
#include "assets/scan/periapical.h"

namespace assets {

inline constexpr double kSteelToBone = 20.0, kNickelTitaniumToBone = 16.0;

/// To what radiographOf() or fineRadiographOf() gave for `view`: mm of cortical bone that weaken as much.
void addMetal(const PeriapicalView& view, std::span<const MetalFragment> fragments, std::vector<float>& bone_mm);

/// Of a beam from a point, `way` unit, through a round cone with flat ends; 0: it passes by.
double chord_mm(const glm::dvec3& from, const glm::dvec3& way, const glm::dvec3& cone_from, double from_radius_mm,
                const glm::dvec3& cone_to, double to_radius_mm);

}  // namespace assets
