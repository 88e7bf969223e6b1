// What a scripted hand does to cut a cavity to its ideal: layer by layer with an upright bur, nowhere deeper than the
// ideal under the whole of the bur. The hand plans from the ideal and feels nothing: a demonstration and a test of the
// measures, no master. Frame P; mm, s. Start-up only, some 0.3 s.
#pragma once

#include <vector>

#include "app/procedure/preparation/preparation_outcomes.h"
#include "haptics/device/simulated/pose_list_device.h"
#include "haptics/tool/bur_shape.h"

namespace app {

/// Frame D is P, the handle is the tool. Throws UsageError for a crown, and for a bur that is no cylinder.
std::vector<haptics::TimedHandlePose> preparationScript(const PreparationMeasure& measure,
                                                        const haptics::BurShape& bur);

}  // namespace app
