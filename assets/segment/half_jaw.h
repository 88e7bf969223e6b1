// A part of the lower jaw as a canal is looked for in it: what is bone, what is tooth, how deep a canal may lie, and
// how much every cell looks like a canal: a dark tube (tubeness.h) or just dark. In voxels of the scan, or in cells of
// several: four times as coarse it is sixty times as fast, and the course is the same within a cell. Frame P, mm. Any
// thread but the servo; 1 s of CPU per 10^6 cells.
#pragma once

#include <algorithm>
#include <vector>

#include "assets/segment/bite_sheet.h"
#include "assets/segment/mandible.h"
#include "assets/segment/tooth_regions.h"

namespace assets {

/// What a canal is looked for in.
struct CanalScene {
  const Mandible& jaw;
  const ToothRegions& regions;
  const JawArch& arch;
  const BiteSheet& sheet;
};

struct HalfJaw {
  VolumeGrid grid;
  std::vector<float> hounsfield;        ///< as scanned
  std::vector<float> smooth_hu, score;  ///< what cannot hold a canal as grey as marrow; score: of a canal, 0 to 2
  CellMask solid, tooth, may_hold;      ///< may_hold: deep in the bone

  bool isUsable() const;
};

/// Cells of the jaw on one side, up to a little over the bite.
CellBox boxOfHalf(const CanalScene& scene, bool is_right);

/// `box`: of the jaw; `edge`: of its voxels in a cell. Without score; hardly any bone: nothing but the masks.
HalfJaw boneIn(const CanalScene& scene, const CellBox& box, int edge);
/// With it.
HalfJaw halfIn(const CanalScene& scene, const CellBox& box, int edge);

/// Of the jaw's voxels, to make cells of about 0.7 mm.
int coarseEdge(const VolumeGrid& grid);

float valueAtShare(std::vector<float> values, double share);

}  // namespace assets
