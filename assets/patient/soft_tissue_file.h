// A soft tissue field on disk, kept because computing it takes longer than reading. Layout, little endian: "MOLARSFT",
// u64 fingerprint of what the field was computed from, i32 size[3], f64 spacing, f64 origin[3], then one zlib stream of
// the low bytes of the distances, their high bytes and the tissues; at the end the trailer of scan/file_checksum.h.
// Frame P, mm. Any thread; about 20 ms to read a field of 1.5 million voxels, 100 ms to write it.
#pragma once

#include <cstdint>
#include <string>

#include "assets/mesh.h"
#include "assets/scenery/soft_tissue_surface.h"
#include "assets/soft_tissue_field.h"

namespace assets {

/// Of everything that softTissueSurfaces and softTissueField read, and of kSoftTissueRevision. About 10 ms for 350,000
/// triangles.
std::uint64_t softTissueFingerprint(const MeshModel& gingiva_P, const MeshModel& face_P,
                                    const SoftTissueRegion& region);

/// Written whole or not at all. Throws LoadError or CalibrationError: not writable, no space.
void writeSoftTissue(const SoftTissueField& field, std::uint64_t fingerprint, const std::string& path);

/// Throws LoadError: no such file, damaged, of another fingerprint, or a value out of range.
SoftTissueField readSoftTissue(const std::string& path, std::uint64_t fingerprint);

}  // namespace assets
