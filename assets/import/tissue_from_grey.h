// Tissues of a scan without segmentation, a guess from grey values alone: which tissue has such a HU. Enamel of every
// tooth counts; nothing tells soft tissues, canal or ligament. Good enough to make enamel cut slower than bone, no
// basis for a measurement. Thresholds: enamel 2071-2955, dentine 1323-1899 HU (Reshetnikov 2024); cortical from Misch
// D2-D1 (850-1250 HU) upwards, trabecular D4-D3 (150-850 HU), here from the surface the classification draws. A voxel
// that a surface towards air or soft tissue divides has a grey value of neither side: it takes the tissue of what lies
// behind it, up the gradient, and bare bone is cortical there, since bone wears a cortex. Void counts as outside from 1
// mm depth on, so that marrow spaces leave their trabeculae alone. Any thread; 5 ns a voxel, 100 ns one at a surface.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/ct_volume.h"

namespace assets {

inline constexpr int kSoftBelow_hu = 250;

/// Of a voxel that lies wholly in one tissue.
constexpr Tissue tissueFromGrey(int hounsfield) {
  if (hounsfield > 2100) return Tissue::enamel;
  if (hounsfield > 1500) return Tissue::dentine;
  if (hounsfield > 700) return Tissue::cortical;
  if (hounsfield > kSoftBelow_hu) return Tissue::trabecular;
  return Tissue::unlabelled;
}

std::vector<std::uint8_t> labelsFromGrey(const VolumeGrid& grid, const std::vector<std::int16_t>& hounsfield);

/// Gives the voxels of numbered teeth (ct.tooth) that are labelled as nothing, as bone or as gingiva a tissue of teeth:
/// enamel above 2100 HU; pulp up to 700 HU where all neighbours are of the same tooth, as a tooth's skin is soft in a
/// scan too; else dentine.
void labelNumberedTeeth(CtVolume& ct);

/// Gives what is drawn (solid at least half) but labelled as nothing or as gingiva the label of the densest hard
/// neighbour, and the number of its tooth: labels end in voxel steps, often inside of where the grey values end.
void labelPartialVoxels(CtVolume& ct);

}  // namespace assets
