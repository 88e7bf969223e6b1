// A head with known teeth as a cone-beam scanner shows it: the jaws, teeth and canals of a real person's segmentation
// (patients/cbct_segmentation: upper skull, mandible, upper and lower teeth, canals), third molars 48 and 38 after that
// of patients/right_third_molar, and grey values made up: tissues with blur and noise, cupping, an uncalibrated scale,
// closed contacts, metal with streaks. Frame P as the segmentation's. Truth of single teeth: the segmentation's one
// label for lower teeth divided at its necks into 14, which shares its idea with the method that is judged.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "assets/volume_grid.h"

namespace tests {

struct HeadPhantomOptions {
  double spacing_mm = 0.56;
  double noise_hu = 110.0;
  double cupping_hu = 120.0;
  double slope = 1.0 / 1.613, offset = 400.0;  ///< stored value = slope * HU + offset
  bool has_metal = false;                      ///< crowns on 46 and 26
};

struct HeadPhantom {
  assets::VolumeGrid grid;
  std::vector<std::int16_t> grey;
  std::vector<std::uint8_t> tissue;    ///< of the lower jaw: Tissue
  std::vector<std::uint8_t> tooth;     ///< FDI number of lower teeth
  std::vector<std::uint8_t> mandible;  ///< solid, with teeth and canal
};

HeadPhantom headPhantom(const std::filesystem::path& patients, const HeadPhantomOptions& options);

/// The same without grey values, on the grid of patients/right_third_molar: its truth of single teeth.
std::vector<std::uint8_t> teethOfRightThirdMolar(const std::filesystem::path& patients);

}  // namespace tests
