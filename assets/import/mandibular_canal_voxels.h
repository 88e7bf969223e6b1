// The voxels of one labelled canal, and how far along it each lies: the raw material of mandibular_canal_line.h.
// Voxels are gathered in 0.8 mm cells; cells at most one empty cell apart are neighbours, and parts of a canal up to 8
// mm apart are joined at their nearest cells. Along = length of the shortest way over the cells from one end
// (Dijkstra). Frame P, mm. Any thread; 2 ns a voxel of the volume, the rest is small.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "assets/volume_grid.h"

namespace assets {

struct OrderedVoxels {
  std::vector<glm::dvec3> centre_P_mm;
  std::vector<double> along_mm;  ///< one per centre, to a cell's width
};

/// Of several canals the one nearest to `near_P_mm`, or without that the largest. Empty if none is labelled.
OrderedVoxels orderedMandibularCanal(const VolumeGrid& grid, const std::vector<std::uint8_t>& label,
                                     const std::optional<glm::dvec3>& near_P_mm);

}  // namespace assets
