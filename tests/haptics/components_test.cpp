// Pieces of a tooth against a flood fill voxel by voxel, and boxes whose pieces, centroids and inertia are known.
#include "haptics/body/components.h"

#include <random>
#include <vector>

#include "assets/ct_volume.h"
#include "tests/haptics/tooth_phantom.h"

namespace haptics {
namespace {

using phantom::fill;
using phantom::ToothPhantom;

/// Labels by a flood fill voxel by voxel, numbered as Components does: the largest first, then by first brick and
/// voxel.
std::vector<int> floodLabels(const ToothPhantom& tooth) {
  std::vector<int> label(tooth.solid.size(), -1);
  std::vector<std::pair<std::size_t, int>> sizes;
  std::vector<glm::ivec3> queue;
  const glm::ivec3 bricks = tooth.grid.bricks();
  assets::forVoxels(glm::ivec3(0), bricks, [&](glm::ivec3 brick) {
    assets::forVoxels(brick * 8, glm::min(brick * 8 + 8, tooth.grid.size), [&](glm::ivec3 start) {
      const int name = static_cast<int>(sizes.size());
      const auto visit = [&](glm::ivec3 ijk) {
        if (!tooth.grid.contains(ijk)) return;
        const std::size_t v = tooth.grid.index(ijk);
        if (tooth.solid[v] < assets::kHalfSolid || label[v] >= 0) return;
        label[v] = name;
        queue.push_back(ijk);
      };
      queue.clear();
      visit(start);
      for (std::size_t head = 0; head < queue.size(); ++head) {
        const glm::ivec3 at = queue[head];
        for (int axis = 0; axis < 3; ++axis)
          for (const int step : {-1, 1}) {
            glm::ivec3 beside = at;
            beside[axis] += step;
            visit(beside);
          }
      }
      if (!queue.empty()) sizes.emplace_back(queue.size(), name);
    });
  });
  std::stable_sort(sizes.begin(), sizes.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<int> rank(sizes.size());
  for (std::size_t n = 0; n < sizes.size(); ++n) rank[static_cast<std::size_t>(sizes[n].second)] = static_cast<int>(n);
  for (int& name : label)
    if (name >= 0) name = rank[static_cast<std::size_t>(name)];
  return label;
}

std::vector<int> labelsOf(const Components& components) {
  std::vector<int> label(components.grid().voxelCount());
  assets::forVoxels(components.grid(), [&](glm::ivec3 ijk, std::size_t v) { label[v] = components.pieceAt(ijk); });
  return label;
}

TEST(Components, TwoBoxesJoinedByAnEdgeAreTwoPieces) {
  // The edge inside a brick, and between bricks.
  for (int edge = 4; edge <= 12; ++edge) {
    ToothPhantom tooth({24, 24, 24}, 0.2);
    fill(tooth, {2, 2, 2}, {edge, edge, 20});
    fill(tooth, {edge, edge, 2}, {14, 14, 20});
    EXPECT_EQ(Components(tooth.grid, tooth.solid).pieces().size(), 2u) << edge;
  }
}

TEST(Components, TwoBoxesJoinedByAFaceAreOnePiece) {
  ToothPhantom tooth({24, 24, 24}, 0.2);
  fill(tooth, {2, 2, 2}, {8, 8, 20});
  fill(tooth, {8, 7, 5}, {14, 14, 6});
  EXPECT_EQ(Components(tooth.grid, tooth.solid).pieces().size(), 1u);
}

TEST(Components, HalfSolidHoldsAndLessDoesNot) {
  ToothPhantom tooth({24, 8, 8}, 0.2);
  fill(tooth, {2, 2, 2}, {22, 5, 5});
  fill(tooth, {10, 2, 2}, {11, 5, 5}, 128);
  EXPECT_EQ(Components(tooth.grid, tooth.solid).pieces().size(), 1u);
  fill(tooth, {10, 2, 2}, {11, 5, 5}, 127);
  EXPECT_EQ(Components(tooth.grid, tooth.solid).pieces().size(), 2u);
}

TEST(Components, ABoxHasItsVolumeCentroidAndInertia) {
  ToothPhantom tooth({60, 50, 41}, 0.2);
  tooth.grid.origin_P_mm = {-30.0, 12.0, 7.0};
  const glm::ivec3 first(5, 9, 3), end(55, 41, 35);
  fill(tooth, first, end);
  const Components components(tooth.grid, tooth.solid);
  const ToothPiece& piece = components.pieces().front();
  const glm::dvec3 edge = 0.2 * glm::dvec3(end - first);
  const double mass = edge.x * edge.y * edge.z;
  EXPECT_NEAR(piece.volume_mm3 / mass, 1.0, 1e-9);
  const glm::dvec3 centre = 0.5 * (tooth.grid.centre_P_mm(first) + tooth.grid.centre_P_mm(end - 1));
  EXPECT_NEAR(glm::distance(piece.centroid_mm, centre), 0.0, 1e-9);
  for (int axis = 0; axis < 3; ++axis) {
    const double b = edge[(axis + 1) % 3], c = edge[(axis + 2) % 3];
    EXPECT_NEAR(piece.inertia_mm5[axis][axis] / (mass * (b * b + c * c) / 12.0), 1.0, 0.005);
    EXPECT_NEAR(piece.inertia_mm5[axis][(axis + 1) % 3] / mass, 0.0, 1e-9);
  }
}

TEST(Components, AnObliqueBarHasProductsOfInertia) {
  // Two cubes apart along x and y: I_xy = -sum of m x y.
  ToothPhantom tooth({40, 40, 16}, 0.25);
  fill(tooth, {4, 4, 4}, {8, 36, 8});
  fill(tooth, {4, 32, 4}, {36, 36, 8});
  glm::dvec3 mean(0.0);
  double n = 0.0, xy = 0.0;
  assets::forVoxels(tooth.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (tooth.solid[v] == 0) return;
    mean += tooth.grid.centre_P_mm(ijk);
    n += 1.0;
  });
  mean /= n;
  assets::forVoxels(tooth.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (tooth.solid[v] == 0) return;
    const glm::dvec3 at = tooth.grid.centre_P_mm(ijk) - mean;
    xy += at.x * at.y * tooth.grid.voxelVolume_mm3();
  });
  ASSERT_GT(std::abs(xy), 1.0);
  EXPECT_NEAR(Components(tooth.grid, tooth.solid).pieces().front().inertia_mm5[0][1] / -xy, 1.0, 1e-9);
}

TEST(Components, CarvedStepByStepTheLabelsAreThoseOfAFloodFill) {
  ToothPhantom tooth({53, 44, 38}, 0.2);
  std::mt19937 random(11);
  fill(tooth, {3, 3, 3}, {50, 41, 35});
  Components components(tooth.grid, tooth.solid);
  std::size_t most = 0;
  for (int step = 0; step < 200; ++step) {
    // A rod along some axis, sometimes put back as an undo does.
    const int axis = static_cast<int>(random() % 3);
    glm::ivec3 first, end;
    for (int a = 0; a < 3; ++a) {
      const auto size = static_cast<unsigned>(tooth.grid.size[a]);
      first[a] = static_cast<int>(random() % size);
      end[a] = std::min(tooth.grid.size[a], first[a] + (a == axis ? 40 : 4));
    }
    fill(tooth, first, end, step % 7 == 6 ? 200 : static_cast<std::uint8_t>(random() % 140));
    // Grains, which touch by edges and corners too.
    assets::forVoxels(first, glm::min(first + 6, end), [&](glm::ivec3 ijk) {
      tooth.solid[tooth.grid.index(ijk)] = random() % 2 == 0 ? std::uint8_t{0} : std::uint8_t{255};
    });
    assets::forVoxels(first / 8, (end - 1) / 8 + 1,
                      [&](glm::ivec3 brick) { components.update(brick, phantom::brickOf(tooth, brick)); });
    components.join();
    most = std::max(most, components.pieces().size());
    const Components afresh(tooth.grid, tooth.solid);
    ASSERT_EQ(labelsOf(components), labelsOf(afresh)) << "step " << step;
    ASSERT_EQ(labelsOf(components), floodLabels(tooth)) << "step " << step;
  }
  EXPECT_GT(most, 5u);
}

}  // namespace
}  // namespace haptics
