// Tissues of a scan without segmentation, estimated from grey values: good enough to cut enamel slower than bone, no
// basis for measurements. Soft tissues, canal and ligament are not distinguished. Thresholds: enamel 2071-2955, dentine
// 1323-1899 HU (Reshetnikov 2024); cortical from Misch D2-D1 (850-1250 HU), trabecular D4-D3 (150-850 HU). A voxel at a
// surface towards air or soft tissue takes the tissue behind it, up the gradient; bare bone is cortical. Only void
// deeper than 1 mm counts as outside, so marrow spaces do not change their trabeculae. Any thread; 5 ns a voxel, 100 ns
// at a surface.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/ct_volume.h"

namespace assets {

inline constexpr int kSoftBelow_hu = 250;

/// For a voxel inside one tissue.
constexpr Tissue tissueFromGrey(int hounsfield) {
  if (hounsfield > 2100) return Tissue::enamel;
  if (hounsfield > 1500) return Tissue::dentine;
  if (hounsfield > 700) return Tissue::cortical;
  if (hounsfield > kSoftBelow_hu) return Tissue::trabecular;
  return Tissue::unlabelled;
}

std::vector<std::uint8_t> labelsFromGrey(const VolumeGrid& grid, const std::vector<std::int16_t>& hounsfield);

/// Relabels voxels of numbered teeth (ct.tooth) that are unlabelled, bone or gingiva: enamel above 2100 HU; pulp up to
/// 700 HU where all neighbours belong to the same tooth; else dentine.
void labelNumberedTeeth(CtVolume& ct);

/// Relabels solid voxels that are unlabelled or gingiva like their densest hard neighbour, with its tooth number:
/// labels often end inside of the grey values' surface.
void labelPartialVoxels(CtVolume& ct);

}  // namespace assets
