// The lower jaw with its teeth. First in cells of about 0.7 mm: hard tissue is divided by a watershed between seeds of
// the lower jaw, below the bite near the arch, and seeds of everything else, placed in the axes of the bite (heads are
// tilted in scanners): upper teeth, palate, cheek bones, skull base, temporal bone, spine. Upper and lower teeth are
// cut apart along the bite sheet only where both stand (elsewhere the sheet would cut through the ramus). Then in
// voxels: solid, marrow included, with its surface at half the grey value of thin bone. Frame P, mm, Hounsfield. Any
// thread but the servo; 4 s of CPU for 512^3.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/segment/bite_sheet.h"
#include "assets/segment/jaw_arch.h"

namespace assets {

/// Hard tissue of the lower jaw in the cells of `smooth_hu`.
CellMask mandibleCells(const VolumeGrid& cells, const std::vector<float>& smooth_hu, const JawArch& arch,
                       const BiteSheet& sheet);

/// A box of the scan around the lower jaw, and what of it is jaw.
struct Mandible {
  VolumeGrid grid;                ///< of the box
  glm::ivec3 first{0};            ///< its first voxel in the scan
  std::vector<float> hounsfield;  ///< as scanned
  std::vector<float> smooth_hu;   ///< over 0.3 mm
  CellMask hard;                  ///< bone and teeth that may be the jaw's
  CellMask solid;                 ///< the jaw with marrow, pulp and canal
};

/// `edge` voxels of the scan make a cell.
Mandible mandibleIn(const VolumeGrid& scan, const std::vector<std::int16_t>& hounsfield, const VolumeGrid& cells,
                    const CellMask& jaw_cells, int edge);

}  // namespace assets
