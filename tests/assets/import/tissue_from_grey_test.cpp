#include "assets/import/tissue_from_grey.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "assets/scan/solid_fraction.h"

namespace {

using assets::Tissue;
using assets::VolumeGrid;

TEST(TissueFromGrey, FollowsTheThresholds) {
  using assets::tissueFromGrey;
  EXPECT_EQ(tissueFromGrey(2500), Tissue::enamel);
  EXPECT_EQ(tissueFromGrey(1650), Tissue::dentine);
  EXPECT_EQ(tissueFromGrey(1250), Tissue::cortical);
  EXPECT_EQ(tissueFromGrey(420), Tissue::trabecular);
  EXPECT_EQ(tissueFromGrey(60), Tissue::unlabelled);
  EXPECT_EQ(tissueFromGrey(-1000), Tissue::unlabelled);
}

const VolumeGrid kBallGrid{{48, 48, 48}, 0.3, {0, 0, 0}};
const glm::dvec3 kMiddle_mm = 0.5 * 0.3 * glm::dvec3(47.0);

/// Concentric balls, outermost first, each surface blurred in closed form (sd 0.2 mm).
struct Shell {
  double radius_mm;
  double hounsfield;
};

std::vector<std::int16_t> ballsOf(double outside_hu, const std::vector<Shell>& shells) {
  std::vector<std::int16_t> hounsfield(kBallGrid.voxelCount());
  for (int k = 0; k < kBallGrid.size.z; ++k)
    for (int j = 0; j < kBallGrid.size.y; ++j)
      for (int i = 0; i < kBallGrid.size.x; ++i) {
        const double r_mm = glm::distance(kBallGrid.centre_P_mm({i, j, k}), kMiddle_mm);
        double grey = outside_hu, around = outside_hu;
        for (const Shell& shell : shells) {
          grey += (shell.hounsfield - around) * 0.5 * std::erfc((r_mm - shell.radius_mm) / (0.2 * std::sqrt(2.0)));
          around = shell.hounsfield;
        }
        hounsfield[kBallGrid.index({i, j, k})] = static_cast<std::int16_t>(std::lround(grey));
      }
  return hounsfield;
}

/// Share of the solid voxels near the surface that have the tissue.
double shareAtSurface(const std::vector<std::int16_t>& hounsfield, double radius_mm, Tissue tissue,
                      double deep_mm = 1.0) {
  const auto label = assets::labelsFromGrey(kBallGrid, hounsfield);
  double all = 0.0, right = 0.0;
  for (int k = 0; k < kBallGrid.size.z; ++k)
    for (int j = 0; j < kBallGrid.size.y; ++j)
      for (int i = 0; i < kBallGrid.size.x; ++i) {
        const std::size_t v = kBallGrid.index({i, j, k});
        const double r_mm = glm::distance(kBallGrid.centre_P_mm({i, j, k}), kMiddle_mm);
        if (label[v] == 0 || r_mm < radius_mm - deep_mm) continue;
        all += 1.0;
        right += Tissue{label[v]} == tissue ? 1.0 : 0.0;
      }
  return right / all;
}

TEST(TissueFromGrey, GivesASurfaceTheTissueBehindIt) {
  // Towards air and towards soft tissue; by thresholds alone a tenth to a half of these voxels is wrong.
  for (const double outside_hu : {-1000.0, 60.0}) {
    EXPECT_EQ(shareAtSurface(ballsOf(outside_hu, {{5.0, 1350.0}}), 5.0, Tissue::cortical), 1.0) << outside_hu;
    EXPECT_GT(shareAtSurface(ballsOf(outside_hu, {{5.0, 2500.0}}), 5.0, Tissue::enamel), 0.99) << outside_hu;
    EXPECT_GT(shareAtSurface(ballsOf(outside_hu, {{5.0, 1700.0}}), 5.0, Tissue::dentine), 0.99) << outside_hu;
    // Cortex of 1.2 mm around marrow.
    EXPECT_GT(shareAtSurface(ballsOf(outside_hu, {{5.0, 1350.0}, {3.8, 420.0}}), 5.0, Tissue::cortical), 0.99)
        << outside_hu;
  }
  // Bone too thin to reach its full grey value has a cortex too.
  EXPECT_EQ(shareAtSurface(ballsOf(-1000.0, {{5.0, 600.0}}), 5.0, Tissue::cortical, 0.3), 1.0);
}

TEST(TissueFromGrey, KeepsTrabeculaeNextToMarrowSpaces) {
  // Struts a voxel wide every fourth voxel, marrow between them.
  std::vector<std::int16_t> hounsfield(kBallGrid.voxelCount(), 1350);
  const auto inside = [](int n) { return n > 8 && n < 40; };
  for (int k = 0; k < kBallGrid.size.z; ++k)
    for (int j = 0; j < kBallGrid.size.y; ++j)
      for (int i = 0; i < kBallGrid.size.x; ++i)
        if (inside(i) && inside(j) && inside(k))
          hounsfield[kBallGrid.index({i, j, k})] = (i % 4 == 0 || j % 4 == 0) ? 500 : 60;
  const auto label = assets::labelsFromGrey(kBallGrid, hounsfield);
  std::size_t struts = 0, kept = 0;
  for (std::size_t v = 0; v < label.size(); ++v)
    if (hounsfield[v] == 500) ++struts, kept += Tissue{label[v]} == Tissue::trabecular ? 1 : 0;
  EXPECT_GT(static_cast<double>(kept) / static_cast<double>(struts), 0.95);
}

TEST(PartialVoxels, TakeTheLabelOfTheDensestNeighbour) {
  assets::CtVolume ct{kBallGrid, ballsOf(-1000.0, {{5.0, 2500.0}}), {}, {}, {}};
  ct.solid = assets::classify(kBallGrid, ct.hounsfield, {});
  // Labels that end half a voxel too early, as in hand-drawn masks.
  ct.label.assign(kBallGrid.voxelCount(), 0);
  for (int k = 0; k < kBallGrid.size.z; ++k)
    for (int j = 0; j < kBallGrid.size.y; ++j)
      for (int i = 0; i < kBallGrid.size.x; ++i)
        if (glm::distance(kBallGrid.centre_P_mm({i, j, k}), kMiddle_mm) < 4.85)
          ct.label[kBallGrid.index({i, j, k})] = static_cast<std::uint8_t>(Tissue::enamel);
  assets::labelPartialVoxels(ct);
  std::size_t bare = 0, beyond = 0;
  for (std::size_t v = 0; v < ct.label.size(); ++v) {
    bare += ct.solid[v] >= 128 && ct.label[v] == 0 ? 1 : 0;
    beyond += ct.solid[v] < 128 && ct.label[v] != 0 ? 1 : 0;
  }
  EXPECT_EQ(bare, 0u);
  EXPECT_EQ(beyond, 0u) << "only solid voxels are labelled";
}

}  // namespace
