#include "assets/synthetic/scanner.h"

#include <gtest/gtest.h>

#include <cmath>

namespace assets {
namespace {

TEST(Scanner, HasNoiseOfTheStatedDeviationAndZeroMean) {
  constexpr int kVoxels = 200000;
  double sum = 0.0, squares = 0.0, neighbours = 0.0, before = 0.0;
  for (int n = 0; n < kVoxels; ++n) {
    const double noise = scannerNoise_hu(7, static_cast<std::uint64_t>(n));
    sum += noise;
    squares += noise * noise;
    neighbours += noise * before;
    before = noise;
  }
  EXPECT_NEAR(sum / kVoxels, 0.0, 0.4);
  EXPECT_NEAR(std::sqrt(squares / kVoxels), kScannerNoise_hu, 0.4);
  EXPECT_NEAR(neighbours / squares, 0.0, 0.01);
}

TEST(Scanner, SpreadsAnEdgeByPointSpreadAndVoxel) {
  // Grey values across a flat face of bone in air: their slope is a Gaussian, its variance the sum of both.
  const TrabecularTexture texture(1, 0.15);
  const double edge_mm = edgeSpread_mm(0.25);
  EXPECT_NEAR(edge_mm * edge_mm, kPointSpread_mm * kPointSpread_mm + 0.25 * 0.25 / 12.0, 1e-12);
  constexpr double kStep_mm = 0.01;
  double weight = 0.0, variance = 0.0;
  for (double depth_mm = -1.0; depth_mm < 1.0; depth_mm += kStep_mm) {
    TissueDistances here, next;
    here.bone = here.gingiva = depth_mm;
    next.bone = next.gingiva = depth_mm + kStep_mm;
    const double slope = greyValue_hu(here, {}, texture, edge_mm) - greyValue_hu(next, {}, texture, edge_mm);
    weight += slope;
    variance += slope * std::pow(depth_mm + 0.5 * kStep_mm, 2.0);
  }
  EXPECT_NEAR(weight, 2350.0, 1.0);
  EXPECT_NEAR(std::sqrt(variance / weight), edge_mm, 0.002);
}

TEST(Scanner, AveragesAThinLigamentInsteadOfLosingIt) {
  // A gap of 0.25 mm between dentine and bone: the grey value dips by the share of the gap in the blurred voxel.
  const TrabecularTexture texture(1, 0.15);
  TissueDistances middle;
  middle.third_molar.outer = middle.third_molar.core = 0.125;
  middle.ligament = -0.125;
  middle.bone = middle.gingiva = -5.0;
  const double edge_mm = edgeSpread_mm(0.25);
  const double gap = std::erf(0.125 / edge_mm / std::sqrt(2.0));
  const double expected = gap * 60.0 + 0.5 * (1.0 - gap) * (1650.0 + 1350.0);
  EXPECT_NEAR(greyValue_hu(middle, {}, texture, edge_mm), expected, 1.0);
  EXPECT_EQ(tissueAt(middle), Tissue::ligament);
}

TEST(Scanner, LabelsTheInnermostTissue) {
  TissueDistances d;
  EXPECT_EQ(tissueAt(d), Tissue::unlabelled);
  d.gingiva = -1.0;
  EXPECT_EQ(tissueAt(d), Tissue::gingiva);
  d.bone = -1.0;
  EXPECT_EQ(tissueAt(d), Tissue::cortical);
  d.trabecular = -1.0;
  EXPECT_EQ(tissueAt(d), Tissue::trabecular);
  d.mandibular_canal = -1.0;
  EXPECT_EQ(tissueAt(d), Tissue::mandibular_canal);
  d.third_molar.outer = -1.0;
  EXPECT_EQ(tissueAt(d), Tissue::enamel);
}

}  // namespace
}  // namespace assets
