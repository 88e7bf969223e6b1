// What a practice block tells beside over- and under-cut against its target (O2 to O4): of the plate the bone left, and
// what is broken through; of the ball how much of its upper half lies bare, and what was cut of it. Frame P, mm, mm2,
// mm3. Pure; any thread; some ms.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "app/session/measures/measure_value.h"
#include "assets/synthetic/practice_block.h"
#include "assets/volume_grid.h"

namespace app {

/// In the order of the grid, solid before and after.
std::vector<MeasureValue> practiceMeasures(assets::PracticeTask task, const assets::VolumeGrid& grid,
                                           std::span<const std::uint8_t> label, std::span<const std::uint8_t> before,
                                           std::span<const std::uint8_t> after);

}  // namespace app
