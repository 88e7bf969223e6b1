// What is stored of a whole head: no skin that a person could be recognised by.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "assets/import/soft_tissue_removal.h"
#include "assets/scan/exact_distance.h"
#include "tests/assets/segment/head_phantom.h"
#include "tests/shared_data.h"

namespace {

constexpr int kSkin_hu = -300, kBone_hu = 300;
constexpr double kFar_mm = 12.0;

/// The largest surface in one piece, cm², between what is denser than -300 HU and farther than 12 mm from bone, and
/// what is not dense.
double largestPatch_cm2(const assets::VolumeGrid& grid, const std::vector<std::int16_t>& hounsfield,
                        const std::vector<float>& from_bone_mm) {
  constexpr std::array<glm::ivec3, 6> kFaces = {{{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};
  const auto dense = [&](const glm::ivec3& ijk) { return hounsfield[grid.index(ijk)] > kSkin_hu; };
  const auto inside = [&](const glm::ivec3& ijk) {
    return glm::all(glm::greaterThanEqual(ijk, glm::ivec3(0))) && glm::all(glm::lessThan(ijk, grid.size));
  };
  // Voxels of the surface, each with its faces to the air.
  std::vector<std::uint8_t> faces(grid.voxelCount());
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (!dense(ijk) || static_cast<double>(from_bone_mm[v]) <= kFar_mm) return;
    for (const glm::ivec3& step : kFaces)
      if (inside(ijk + step) && !dense(ijk + step)) ++faces[v];
  });
  double most = 0.0;
  for (std::size_t start = 0; start < faces.size(); ++start) {
    if (faces[start] == 0) continue;
    std::vector<std::size_t> open{start};
    double count = faces[start];
    faces[start] = 0;
    while (!open.empty()) {
      const glm::ivec3 at = assets::elementAt(grid.size, open.back());
      open.pop_back();
      assets::forVoxels(glm::max(at - 1, glm::ivec3(0)), glm::min(at + 2, grid.size), [&](glm::ivec3 near) {
        const std::size_t v = grid.index(near);
        if (faces[v] == 0) return;
        count += faces[v], faces[v] = 0;
        open.push_back(v);
      });
    }
    most = std::max(most, count);
  }
  return most * grid.spacing_mm * grid.spacing_mm / 100.0;
}

TEST(SoftTissueRemovalRealData, AWholeHeadKeepsNoFace) {
  const std::filesystem::path patients = tests::sharedData("patients");
  MOLAR_NEEDS(patients);
  tests::HeadPhantomOptions options;
  options.spacing_mm = 1.2;
  options.noise_hu = options.cupping_hu = 0.0;  // so that dense is bone, here
  options.slope = 1.0, options.offset = 0.0;
  tests::HeadPhantom head = tests::headPhantom(patients, options);
  std::vector<std::uint8_t> is_bone(head.grey.size());
  std::ranges::transform(head.grey, is_bone.begin(), [](std::int16_t hu) { return hu >= kBone_hu ? 1 : 0; });
  const std::vector<float> from_bone_mm = assets::exactDistance_mm(head.grid.size, head.grid.spacing_mm, is_bone);
  constexpr double kRecognisable_cm2 = 15.0;
  EXPECT_GT(largestPatch_cm2(head.grid, head.grey, from_bone_mm), 10.0 * kRecognisable_cm2);
  assets::removeDistantSoftTissue(head.grid, head.grey, kBone_hu);
  EXPECT_LT(largestPatch_cm2(head.grid, head.grey, from_bone_mm), kRecognisable_cm2);
}

}  // namespace
