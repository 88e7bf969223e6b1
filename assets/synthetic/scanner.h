// CT scanner model: grey value and tissue label of a voxel of the synthetic anatomy. Hounsfield, mm. Pure functions;
// any thread. Point spread: Gaussian of 0.3 mm FWHM convolved with the voxel's box, in closed form at every interface
// (exact for flat ones, thin parallel layers included). Labels: tissue at the voxel's centre. Noise: Gaussian, sd 35
// HU, a hash of seed and voxel index, independent of the order of evaluation. No rings, no beam hardening.
#pragma once

#include <cstdint>

#include "assets/synthetic/jaw_anatomy.h"
#include "assets/synthetic/trabecular_texture.h"
#include "assets/tissue.h"

namespace assets {

inline constexpr double kPointSpread_mm = 0.3 / 2.354820045;  ///< sd
inline constexpr double kScannerNoise_hu = 35.0;

/// Sd of point spread and voxel box together.
double edgeSpread_mm(double spacing_mm);

Tissue tissueAt(const TissueDistances& distances);

/// Position from the midline of the tooth around a voxel of that tissue; 0 for none.
int toothAt(const TissueDistances& distances, Tissue tissue);

/// Mean grey value of a voxel centred at p_J, before noise.
double greyValue_hu(const TissueDistances& distances, const glm::dvec3& p_J, const TrabecularTexture& texture,
                    double edge_spread_mm);

/// Noise of one voxel, zero mean, sd kScannerNoise_hu.
double scannerNoise_hu(std::uint64_t seed, std::uint64_t voxel);

}  // namespace assets
