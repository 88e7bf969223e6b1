// Distances to structures on disk, kept because computing them takes longer than reading. As they lie in memory, little
// endian: 8 bytes "MOLARSTR", CRC-32 of all that follows, u64 fingerprint of what they were computed from, u64 count;
// for each: grid, counts, field, surface, clusters. The checksum finds accidents, not forgery; values are judged. Frame
// P, mm. Any thread; about 15 ms for 30 MB.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "assets/structure_distance.h"

namespace assets {

/// Written whole or not at all, over what is there. Throws CalibrationError.
void writeStructures(std::span<const StructureDistance> structures, std::uint64_t fingerprint, const std::string& path);

/// Throws LoadError: no such file, damaged, of another fingerprint or count, a value out of range.
std::vector<StructureDistance> readStructures(const std::string& path, std::uint64_t fingerprint, std::size_t count);

}  // namespace assets
