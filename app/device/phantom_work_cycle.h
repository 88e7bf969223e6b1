// A simulated Phantom in the hand of a surgeon who cuts the trough: taken from rest, brought to the site, armed, put
// back. X_WD as in the rig. Start-up only.
#pragma once

#include <memory>

#include "calibration/rig.h"
#include "haptics/device/simulated/phantom_mechanics.h"
#include "haptics/device/simulated/simulated_phantom.h"
#include "haptics/device/simulated/work_cycle.h"

namespace app {

/// The path of the tool, at `tip_H_mm` of the handle with the same rotation. Throws UsageError where the arm does not
/// reach.
haptics::WorkCycle workCycleFor(const haptics::PhantomMechanics& mechanics, const assets::PlannedCut& cut,
                                const haptics::CuttingMotion& motion, const calibration::Rig& rig,
                                const glm::dvec3& tip_H_mm = glm::dvec3(0.0));

/// The path of the handle for that of the tool.
haptics::HandScript handleScript(const haptics::WorkCycle& cycle, const glm::dvec3& tip_H_mm);

}  // namespace app
