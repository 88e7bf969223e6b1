// How much a dark tube runs through a cell: of the Hessian's eigenvalues e1 >= e2 >= e3 at one scale, e2 - |e3| / 2,
// where the grey value rises across the tube in every direction and hardly along it (after Frangi 1998). Parallel
// (TBB); 0.5 µs of CPU a cell. Any thread but the servo.
#pragma once

#include <vector>

#include "assets/volume_grid.h"

namespace assets {

/// In the unit of `values`, 0 where there is none; `sigma_cells`: about the tube's radius.
std::vector<float> darkTubeness(glm::ivec3 size, double sigma_cells, const std::vector<float>& values);

}  // namespace assets
