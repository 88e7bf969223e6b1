// How near a tool's surface is to a structure of the patient (canal, second molar, …): from head and shaft, negative
// where it lies inside. Frame P, mm. A pure function of its arguments, so a recording gives the live numbers. Any
// thread but the servo; allocates where they touch; 2 to 4 µs for a bur of R = 2 mm with its shaft, 11 to 18 touching
// (clearance_bench).
//
// Outside: the least distance of the structure's voxels from the tool, a closed form. Touching: the least of the signed
// field over the tool's surface, a sphere by D(p) - R (reference/product 4.1); the surface is divided where it can be
// nearest, as D changes by no more than the way, until the middle of a patch is its least within 0.15 voxels.
#pragma once

#include <array>
#include <optional>

#include "assets/risk_structures.h"
#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "haptics/tool/tool.h"

namespace haptics {

/// `structure` not empty (assert), `tool` sanitised.
double clearance_mm(const assets::StructureDistance& structure, const Tool& tool,
                    const calibration::Pose<calibration::Patient, calibration::Tool>& X_PT);

/// In the order of assets::RiskStructure; none where the case has no such structure.
using Clearances = std::array<std::optional<double>, assets::kRiskStructures>;
Clearances clearances_mm(const assets::RiskStructures& structures, const Tool& tool,
                         const calibration::Pose<calibration::Patient, calibration::Tool>& X_PT);

}  // namespace haptics
