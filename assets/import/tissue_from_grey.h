// Tissues of a scan without segmentation, a guess from grey values alone: which tissue has such a HU, voxel by voxel,
// no connectivity. Enamel of every tooth counts as third molar's; nothing tells soft tissues, canal or ligament. Good
// enough to make enamel cut slower than bone, no basis for a measurement. Thresholds: enamel 2071-2955, dentine
// 1323-1899 HU (Reshetnikov 2024); cortical from Misch D2-D1 (850-1250 HU) upwards, trabecular D4-D3 (150-850 HU), here
// from the surface the classification draws. Any thread; about 1 ns a voxel.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/tissue.h"

namespace assets {

constexpr Tissue tissueFromGrey(int hounsfield) {
  if (hounsfield > 2100) return Tissue::enamel;
  if (hounsfield > 1500) return Tissue::dentine;
  if (hounsfield > 700) return Tissue::cortical;
  if (hounsfield > 250) return Tissue::trabecular;
  return Tissue::unlabelled;
}

inline std::vector<std::uint8_t> labelsFromGrey(const std::vector<std::int16_t>& hounsfield) {
  std::vector<std::uint8_t> label(hounsfield.size());
  for (std::size_t v = 0; v < label.size(); ++v) label[v] = static_cast<std::uint8_t>(tissueFromGrey(hounsfield[v]));
  return label;
}

}  // namespace assets
