// A label map from elsewhere, on any grid of the same patient, as tissues and tooth numbers of a scan: brought onto its
// voxels (nearest), a mandible of cortex alone filled, bone and teeth divided into tissues by their grey values, pulps
// numbered by the teeth round them, sides checked. Any thread; about 30 ns a voxel.
#pragma once

#include <string>
#include <vector>

#include "assets/ct_volume.h"
#include "assets/import/label_table.h"

namespace assets {

/// The file's meanings: by its names, else by the stated set. Throws LoadError: neither.
LabelTable foreignLabelTable(const std::string& path, const std::optional<LabelSet>& stated);

/// Sets ct.label, and ct.tooth where teeth are numbered. Returns remarks. Throws LoadError: cannot be read, less than
/// half of it lies in the scan, nothing of a lower jaw in it, or its left teeth lie on the right.
std::vector<std::string> takeForeignLabels(const std::string& path, const LabelTable& table, CtVolume& ct);

/// Fills what is enclosed in slices along any axis. `is_in`: not 0 inside, i fastest.
void fillHoles(glm::ivec3 size, std::vector<std::uint8_t>& is_in);

}  // namespace assets
