// How well a segmentation covers the truth: Dice coefficients, 2 |a b| / (|a| + |b|).
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "assets/segment/jaw_segmentation.h"

namespace tests {

/// A true tooth, and the found one that covers most of it.
struct ToothOverlap {
  int found_fdi = 0;
  double dice = 0.0;
};
std::map<int, ToothOverlap> toothOverlaps(const std::vector<std::uint8_t>& found,
                                          const std::vector<std::uint8_t>& truth);

/// Where both predicates hold, of voxels.
template <class InFound, class InTruth>
double diceOf(std::size_t voxels, const InFound& in_found, const InTruth& in_truth) {
  double both = 0.0, sum = 0.0;
  for (std::size_t v = 0; v < voxels; ++v) {
    const bool a = in_found(v), b = in_truth(v);
    both += a && b ? 1.0 : 0.0;
    sum += (a ? 1.0 : 0.0) + (b ? 1.0 : 0.0);
  }
  return sum > 0.0 ? 2.0 * both / sum : 0.0;
}

/// Voxels lower than 25 mm over the bite: condyles are not judged.
std::size_t workingVoxels(const assets::VolumeGrid& grid, const std::vector<std::uint8_t>& true_tooth);

/// Mean distances of the proposal to the true line and back, mm; the former between the true ends.
struct CanalMisses {
  double to_truth_mm = 0.0, from_truth_mm = 0.0, worst_mm = 0.0;
};
CanalMisses canalMisses(const assets::VolumeGrid& grid, const std::vector<std::uint8_t>& tissue,
                        const assets::CanalProposal& canal);

/// A table for people.
std::string comparison(const assets::VolumeGrid& grid, const assets::JawSegmentation& jaw,
                       const std::vector<std::uint8_t>& tissue, const std::vector<std::uint8_t>& tooth,
                       const std::vector<std::uint8_t>& mandible);

}  // namespace tests
