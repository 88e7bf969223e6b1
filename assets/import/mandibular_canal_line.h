// The mandibular canal as a line, from its labelled voxels: a surgeon's distance-to-nerve is measured against it.
// Method: a geodesic over 0.8 mm cells from one end of the canal to the other orders its voxels (gaps to 1.6 mm are
// bridged); the line through their means is then refined as a principal curve (Hastie & Stuetzle 1989): voxels are
// projected onto it, averaged every millimetre of its length, smoothed; gaps that teeth leave are bridged beside them
// (canal_bridge.h). The radius is that of a tube of the same volume
// and length. Frame P, mm. Any thread; about 50 ns a voxel of the volume plus 1 us a voxel of the canal. Not a
// segmentation.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "assets/volume_grid.h"

namespace assets {

struct MandibularCanalLine {
  std::vector<glm::dvec3> line_P_mm;  ///< about 1 mm apart, from the anterior (mental) end
  double radius_mm = 0.0;
};

/// Of several canals the one nearest to `near_P_mm`, or without that the largest. None if nothing of at least 5 mm
/// length is labelled Tissue::mandibular_canal.
std::optional<MandibularCanalLine> mandibularCanalLine(const VolumeGrid& grid, const std::vector<std::uint8_t>& label,
                                                       const std::optional<glm::dvec3>& near_P_mm);

}  // namespace assets
