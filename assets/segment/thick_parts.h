// Divides a body at its necks: the watershed of its thickness (the distance to its surface). A part is a peak of
// thickness with what lies around it; two parts are one where the thinner peak rises less than `least_rise` above the
// neck between them (its dynamics, Grimaud 1992: the h-maxima of the thickness, and their watershed, in one pass over
// the cells from thick to thin). Serial, deterministic, 100 ns a cell of the body. Any thread but the servo.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "assets/segment/cell_masks.h"

namespace assets {

/// The number of each cell's part from 1, 0 outside the mask; by descending peak.
CellPieces thickParts(glm::ivec3 size, std::span<const float> thickness, std::span<const std::uint8_t> mask,
                      double least_rise);

/// The thickest neck between parts that touch, by their numbers, the smaller first.
std::map<std::pair<std::int32_t, std::int32_t>, float> necksBetween(glm::ivec3 size, std::span<const float> thickness,
                                                                    std::span<const std::int32_t> part);

}  // namespace assets
