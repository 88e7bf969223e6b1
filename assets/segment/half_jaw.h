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
  std::vector<float> smooth_hu, score;  ///< score: of a canal, 0 to 2
  CellMask solid, tooth, may_hold;      ///< may_hold: deep in the bone

  bool isUsable() const;
};

/// Cells of the jaw on one side, up to a little over the bite.
CellBox boxOfHalf(const CanalScene& scene, bool is_right);

/// Along a root the ligament is a dark sheet, which a proposal keeps off as off the bone's surface. Between the ends of
/// a canal that a person knows its roots may touch it.
enum class Roots { keep_off, may_touch };

/// `box`: of the jaw; `edge`: of its voxels in a cell. No score where there is hardly any bone.
HalfJaw halfIn(const CanalScene& scene, const CellBox& box, Roots roots, int edge);

/// Of the jaw's voxels, to make cells of about 0.7 mm.
int coarseEdge(const VolumeGrid& grid);

/// What a step through each cell costs; not positive: no way leads through it. `least`: in what looks most like canal;
/// the higher, the more a detour through marrow costs.
struct CanalCosts {
  float least = 0.03F, in_tooth = 6.0F, near_surface = 6.0F;
};
std::vector<float> canalCost(const HalfJaw& half, const CanalCosts& costs);

float valueAtShare(std::vector<float> values, double share);

}  // namespace assets
