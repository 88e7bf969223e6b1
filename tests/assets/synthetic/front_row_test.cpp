// The front of a row of teeth: which teeth stand where, mirrored over the midline.
#include "assets/synthetic/front_row.h"

#include <gtest/gtest.h>

#include <map>

#include "assets/tissue.h"
#include "assets/tooth.h"

namespace assets {
namespace {

const CtVolume& row() {
  static const CtVolume kRow = frontRow(0.4);
  return kRow;
}

TEST(FrontRow, EveryToothStandsInItsFrame) {
  std::map<int, std::size_t> voxels, off;
  std::map<int, ToothFrame> frames;
  for (const int fdi : {31, 32, 33, 34, 41, 42, 43, 44}) frames[fdi] = frontToothFrame(fdi);
  forVoxels(row().grid, [&](glm::ivec3 ijk, std::size_t v) {
    const int tooth = row().tooth[v];
    if (tooth == 0) return;
    ++voxels[tooth];
    const glm::dvec3 p = frames.at(tooth).local(row().grid.centre_P_mm(ijk));
    if (std::abs(p.x) > 4.2 || std::abs(p.y) > 5.0 || p.z > 11.8 || p.z < -17.0) ++off[tooth];
  });
  ASSERT_EQ(voxels.size(), 8u);
  for (const int fdi : {31, 32, 33, 34, 41, 42, 43, 44}) {
    EXPECT_GT(voxels[fdi], 2000u) << fdi;
    EXPECT_EQ(off[fdi], 0u) << fdi;
    const ToothFrame& frame = frames.at(fdi);
    EXPECT_GT(frame.axes_P[2].z, 0.99) << fdi;
    EXPECT_GT(glm::dot(frame.axes_P[1], buccalDirection_P(fdi)), 0.9) << fdi;
  }
  // Canines are the longest.
  EXPECT_GT(voxels[33], voxels[32]);
  EXPECT_GT(voxels[32], voxels[31]);
}

TEST(FrontRow, RightTeethAreMirrorImagesOfLeftOnes) {
  forVoxels(row().grid, [&](glm::ivec3 ijk, std::size_t v) {
    const double x_mm = row().grid.centre_P_mm(ijk).x;
    if (row().tooth[v] == 0 || x_mm == 0.0) return;
    ASSERT_EQ(isRight(row().tooth[v]), x_mm < 0.0);
  });
  for (int position = 1; position <= 4; ++position) {
    const ToothFrame left = frontToothFrame(30 + position), right = frontToothFrame(40 + position);
    EXPECT_EQ(left.cervix_P_mm * glm::dvec3(-1.0, 1.0, 1.0), right.cervix_P_mm);
    EXPECT_EQ(left.axes_P[0] * glm::dvec3(-1.0, 1.0, 1.0), right.axes_P[0]);
  }
}

TEST(FrontRow, NeighboursMeetAndStandInBoneUnderGum) {
  // Teeth beside one another leave no more than half a millimetre.
  for (const auto& [a, b] : {std::pair(31, 32), std::pair(32, 33), std::pair(41, 31)}) {
    double least_mm = 1e9;
    std::vector<glm::dvec3> of_a, of_b;
    forVoxels(row().grid, [&](glm::ivec3 ijk, std::size_t v) {
      if (row().tooth[v] == a) of_a.push_back(row().grid.centre_P_mm(ijk));
      if (row().tooth[v] == b) of_b.push_back(row().grid.centre_P_mm(ijk));
    });
    for (const glm::dvec3& p : of_a)
      for (const glm::dvec3& q : of_b) least_mm = std::min(least_mm, glm::distance(p, q));
    EXPECT_LT(least_mm, 0.9) << a << " and " << b;
  }
  std::map<std::uint8_t, std::size_t> labels;
  for (const std::uint8_t label : row().label) ++labels[label];
  for (const Tissue tissue : {Tissue::enamel, Tissue::dentine, Tissue::cortical, Tissue::trabecular, Tissue::gingiva})
    EXPECT_GT(labels[static_cast<std::uint8_t>(tissue)], 1000u) << properties(static_cast<std::uint8_t>(tissue)).name;
}

}  // namespace
}  // namespace assets
