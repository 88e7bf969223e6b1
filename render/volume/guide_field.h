// Guides as distances in the volume: to the mandibular canal and to the planned cut. One coarse field on the cells of
// the ambient map (AMBIENT_CELL_VOXELS), sampled trilinearly by every back-end. Frame P, mm. Built once at start-up,
// some ten ms. Plain values; any thread.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "assets/planned_cut.h"
#include "assets/volume_grid.h"
#include "calibration/geometry/segment.h"
#include "render/frame.h"
#include "render/volume/bordered_field.h"

namespace render {

struct Guides {
  std::vector<glm::dvec3> mandibular_canal_P_mm;  ///< centre line; empty: not known
  double mandibular_canal_radius_mm = 1.4;
  std::optional<assets::PlannedCut> cut;
};

/// Per cell: distance to the canal wall and to the planned cut; 0 is GUIDE_LOW_MM, 65535 GUIDE_HIGH_MM or more.
using GuideField = BorderedField<glm::u16vec2>;

GuideField guideField(const assets::VolumeGrid& grid, const Guides& guides);

/// The guides that a frame shows, as GUIDE_ bits.
int visibleGuides(const Frame& frame);

}  // namespace render
