// A simulated Phantom in the hand of a surgeon who cuts the trough: taken from where it rests, brought to the site,
// armed, put back. X_WD as the rig has it. Start-up only.
#pragma once

#include <memory>

#include "calibration/rig.h"
#include "haptics/device/simulated/phantom_mechanics.h"
#include "haptics/device/simulated/simulated_phantom.h"
#include "haptics/device/simulated/work_cycle.h"

namespace app {

/// Of the tool, which stands at `tip_H_mm` of the handle, turned as it is. Throws UsageError
/// where the arm does not reach all of it.
haptics::WorkCycle workCycleFor(const haptics::PhantomMechanics& mechanics, const assets::PlannedCut& cut,
                                const haptics::CuttingMotion& manner, const calibration::Rig& rig,
                                const glm::dvec3& tip_H_mm = glm::dvec3(0.0));

/// The handle's way for the tool's.
haptics::HandScript handleScript(const haptics::WorkCycle& round, const glm::dvec3& tip_H_mm);

}  // namespace app
