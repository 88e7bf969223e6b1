// Gaussian smoothing and its derivatives over the cells of a box, i fastest; mirrored at the ends, cut at 3 sigma.
// Lengths in cells. Parallel (TBB), the same bytes for any number of threads; 5 ns a cell and axis. Any thread but the
// servo.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/volume_grid.h"

namespace assets {

void smoothCells(glm::ivec3 size, double sigma_cells, std::vector<float>& values);

/// Of the smoothed values, per cell.
std::vector<float> gradientOfCells(glm::ivec3 size, double sigma_cells, const std::vector<float>& values);

/// Second derivative along two axes of the smoothed values, per cell squared.
std::vector<float> secondDerivative(glm::ivec3 size, double sigma_cells, const std::vector<float>& values, int axis,
                                    int other_axis);

/// Means of cubes of `edge` voxels, of fewer at the upper ends; the grid of the cubes is that of meanGrid().
std::vector<float> meansOfCubes(const VolumeGrid& grid, const std::vector<std::int16_t>& values, int edge);
VolumeGrid meanGrid(const VolumeGrid& grid, int edge);

}  // namespace assets
