// What a scripted hand does to prepare a tooth to its ideal: layer by layer with an upright bur, nowhere deeper than
// the ideal under the whole of the bur, then, for a crown, once around its walls with the bur leaning as they do. The
// hand plans from the ideal and feels nothing: a demonstration and a test of the measures, no master. Frame P; mm, s.
// Start-up only, some 0.3 s.
#pragma once

#include <vector>

#include "app/procedure/preparation/preparation_outcomes.h"
#include "haptics/device/simulated/pose_list_device.h"
#include "haptics/tool/bur_shape.h"

namespace app {

/// Frame D is P, the handle is the tool. `bur`: a cylinder; throws UsageError, beginning with "--tool", for another.
std::vector<haptics::TimedHandlePose> preparationScript(const PreparationMeasure& measure,
                                                        const haptics::BurShape& bur);

}  // namespace app
