// Voxels of one labelled canal, ordered by arc length: input of mandibular_canal_line.h. Voxels are binned in 0.8 mm
// cells; cells with at most one empty cell between them are neighbours, and parts up to 8 mm apart are joined at their
// nearest cells. Arc length = shortest path over the cells from one end (Dijkstra). Frame P, mm. Any thread; 2 ns a
// voxel.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "assets/volume_grid.h"

namespace assets {

struct OrderedVoxels {
  std::vector<glm::dvec3> centre_P_mm;
  std::vector<double> along_mm;  ///< one per centre, accurate to a cell
};

/// The canal nearest to `near_P_mm`, or the largest. Empty if none is labelled.
OrderedVoxels orderedMandibularCanal(const VolumeGrid& grid, const std::vector<std::uint8_t>& label,
                                     const std::optional<glm::dvec3>& near_P_mm);

}  // namespace assets
