// What a CT scanner makes of the synthetic anatomy: a grey value and a tissue label for a voxel.
// Hounsfield, mm. Pure functions; any thread. Point spread: Gaussian of 0.3 mm full width at half maximum together with
// the voxel's own box, applied in closed form at every interface (exact for flat ones, thin parallel layers included),
// so edges are sub-voxel smooth. Labels are crisp: the tissue at the voxel's centre. Noise: Gaussian, sd 35 HU, a hash
// of seed and voxel index, so it depends on no order of evaluation. No rings, no beam hardening.
#pragma once

#include <cstdint>

#include "assets/synthetic/jaw_anatomy.h"
#include "assets/synthetic/trabecular_texture.h"
#include "assets/tissue.h"

namespace assets {

inline constexpr double kPointSpread_mm =
    0.3 / 2.354820045;  ///< sd of the Gaussian of 0.3 mm full width at half maximum
inline constexpr double kScannerNoise_hu = 35.0;

/// Sd of point spread and voxel box together: what an edge shows.
double edgeSpread_mm(double spacing_mm);

Tissue tissueAt(const TissueDistances& distances);

/// Place from the midline of the tooth that holds a voxel of that tissue; 0 for none.
int toothAt(const TissueDistances& distances, Tissue tissue);

/// Mean grey value of a voxel centred at p_J, before noise.
double greyValue_hu(const TissueDistances& distances, const glm::dvec3& p_J, const TrabecularTexture& texture,
                    double edge_spread_mm);

/// Noise of one voxel, zero mean, sd kScannerNoise_hu.
double scannerNoise_hu(std::uint64_t seed, std::uint64_t voxel);

}  // namespace assets
