#include "assets/import/lower_jaw.h"

#include <gtest/gtest.h>

#include <functional>

#include "assets/scan/image_file.h"
#include "tests/shared_data.h"

namespace {

using assets::CtVolume;
using assets::lowerJawCentre_P_mm;

const assets::VolumeGrid kHead{{80, 100, 90}, 2.0, {-80, 0, 0}};

CtVolume volumeOf(const assets::VolumeGrid& grid, const std::function<bool(const glm::dvec3&)>& is_bone) {
  CtVolume ct;
  ct.grid = grid;
  for (int k = 0; k < grid.size.z; ++k)
    for (int j = 0; j < grid.size.y; ++j)
      for (int i = 0; i < grid.size.x; ++i) ct.solid.push_back(is_bone(grid.centre_P_mm({i, j, k})) ? 255 : 0);
  return ct;
}

/// A horseshoe open to the back, 12 mm thick.
bool inHorseshoe(const glm::dvec3& p, double front_mm, double length_mm, double half_width_mm) {
  const double y = (p.y - front_mm) / length_mm, x = std::abs(p.x);
  if (y < 0.0 || y > 1.0) return false;
  const double outer = half_width_mm * std::sqrt(std::min(1.0, 1.6 * y + 0.05));
  return x < outer && (x > outer - 12.0 || p.y < front_mm + 12.0);
}

bool spine(const glm::dvec3& p) { return std::abs(p.x) < 15.0 && std::abs(p.y - 105.0) < 15.0; }
bool jaw(const glm::dvec3& p) { return p.z > 30.0 && p.z < 66.0 && inHorseshoe(p, 20.0, 85.0, 48.0); }
bool skull(const glm::dvec3& p) {
  const bool upper_arch = p.z > 70.0 && p.z < 84.0 && inHorseshoe(p, 18.0, 45.0, 32.0);
  const bool palate = p.z > 84.0 && p.z < 110.0 && std::abs(p.x) < 32.0 && p.y > 18.0 && p.y < 65.0;
  const double r = glm::length((p - glm::dvec3(0.0, 95.0, 125.0)) / glm::dvec3(70.0, 85.0, 50.0));
  return upper_arch || palate || (r < 1.0 && r > 0.9);
}

TEST(LowerJaw, IsTheLowestArchOfTheFace) {
  const auto found = lowerJawCentre_P_mm(volumeOf(kHead, [](auto& p) { return spine(p) || jaw(p) || skull(p); }), {});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->x, 0.0, 4.0);
  EXPECT_GT(found->y, 18.0);
  EXPECT_LT(found->y, 45.0);
  EXPECT_GT(found->z, 30.0);
  EXPECT_LT(found->z, 66.0);
}

TEST(LowerJaw, IsNotFoundInASkullWithoutIt) {
  EXPECT_FALSE(lowerJawCentre_P_mm(volumeOf(kHead, [](auto& p) { return spine(p) || skull(p); }), {}));
  EXPECT_FALSE(lowerJawCentre_P_mm(volumeOf(kHead, [](auto&) { return false; }), {}));
  EXPECT_FALSE(lowerJawCentre_P_mm(volumeOf(kHead, [](auto& p) { return jaw(p) && p.x > 0.0; }), {}))
      << "one side of one";
}

TEST(LowerJaw, ComesFromLabelsIfThereAreAny) {
  CtVolume ct = volumeOf(kHead, skull);
  const std::vector<glm::dvec3> canal{{-30, 60, 40}, {-32, 70, 42}, {-35, 80, 50}};
  EXPECT_EQ(lowerJawCentre_P_mm(ct, canal), canal[1]);
  ct.tooth.assign(ct.solid.size(), 0);
  ct.tooth[kHead.index({30, 20, 30})] = 44;
  ct.tooth[kHead.index({30, 20, 50})] = 14;
  EXPECT_EQ(lowerJawCentre_P_mm(ct, canal), kHead.centre_P_mm({30, 20, 30})) << "upper teeth do not count";
}

/// A real skull from its segmentation, with and without its mandible (2).
TEST(LowerJawRealData, IsFoundInARealHeadButNotWithoutItsMandible) {
  const std::string path = tests::sharedData("patients/cbct_segmentation/PostDentalSurgery_Segmentation.nii.gz");
  MOLAR_NEEDS(path);
  const auto labels = assets::readLabels(path);
  CtVolume ct;
  ct.grid = labels.grid;
  glm::dvec3 low(1e9), high(-1e9);
  std::size_t v = 0;
  for (int k = 0; k < ct.grid.size.z; ++k)
    for (int j = 0; j < ct.grid.size.y; ++j)
      for (int i = 0; i < ct.grid.size.x; ++i, ++v) {
        ct.solid.push_back(labels.values[v] != 0 ? 255 : 0);
        if (labels.values[v] != 2) continue;
        low = glm::min(low, ct.grid.centre_P_mm({i, j, k}));
        high = glm::max(high, ct.grid.centre_P_mm({i, j, k}));
      }
  const auto found = lowerJawCentre_P_mm(ct, {});
  ASSERT_TRUE(found);
  EXPECT_TRUE(glm::all(glm::greaterThan(*found, low)) && glm::all(glm::lessThan(*found, high)));
  EXPECT_LT(found->y, low.y + 40.0) << "its front";
  for (std::size_t n = 0; n < ct.solid.size(); ++n)
    if (labels.values[n] == 2 || labels.values[n] >= 4) ct.solid[n] = 0;
  EXPECT_FALSE(lowerJawCentre_P_mm(ct, {}));
}

}  // namespace
