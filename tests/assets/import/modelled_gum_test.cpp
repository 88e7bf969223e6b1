#include "assets/import/modelled_gum.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "assets/tissue.h"

namespace {

using assets::Tissue;

/// A ridge of bone with 46 and 47 in it, and 48 buried in it behind them.
class ModelledGumTest : public testing::Test {
 protected:
  ModelledGumTest() {
    hounsfield_.assign(grid_.voxelCount(), 60);
    label_.assign(grid_.voxelCount(), 0);
    tooth_.assign(grid_.voxelCount(), 0);
    assets::forVoxels(grid_, [&](glm::ivec3 ijk, std::size_t v) {
      const glm::dvec3 p = grid_.centre_P_mm(ijk);
      const int fdi = toothAt(p);
      if (fdi != 0) {
        tooth_[v] = static_cast<std::uint8_t>(fdi);
        const double top = fdi == 48 ? 20.0 : 28.0;
        label_[v] = static_cast<std::uint8_t>(p.z > top - 7.0 ? Tissue::enamel : Tissue::dentine);
        hounsfield_[v] = 1700;
      } else if (isBone(p)) {
        label_[v] = static_cast<std::uint8_t>(Tissue::cortical);
        hounsfield_[v] = 1200;
      }
    });
  }
  static bool isBone(const glm::dvec3& p) { return std::abs(p.x) < 6.0 && p.y > 2.0 && p.y < 48.0 && p.z < 20.0; }
  static int toothAt(const glm::dvec3& p) {
    if (std::abs(p.x) > 4.0) return 0;
    for (const auto& [fdi, y, top] :
         {std::tuple{46, 9.0, 28.0}, std::tuple{47, 20.0, 28.0}, std::tuple{48, 36.0, 20.0}})
      if (std::abs(p.y - y) < 4.5 && p.z < top && p.z > top - 18.0) return fdi;
    return 0;
  }
  /// Exactly, of the box.
  static double offBone_mm(const glm::dvec3& p) {
    const glm::dvec3 off =
        glm::max(glm::max(glm::dvec3(-6.0, 2.0, -100.0) - p, p - glm::dvec3(6.0, 48.0, 20.0)), glm::dvec3(0.0));
    return glm::length(off);
  }

  const assets::VolumeGrid grid_{{60, 110, 70}, 0.5, {-14.75, -2.75, 0.25}};
  std::vector<std::int16_t> hounsfield_;
  std::vector<std::uint8_t> label_, tooth_;
};

TEST_F(ModelledGumTest, IsALayerOverTheBoneUpToTheNecks) {
  const std::vector<std::size_t> gum = assets::modelledGum(grid_, hounsfield_, label_, tooth_);
  ASSERT_FALSE(gum.empty());
  bool is_over_48 = false;
  for (const std::size_t v : gum) {
    const glm::dvec3 p = grid_.centre_P_mm(assets::elementAt(grid_.size, v));
    EXPECT_EQ(label_[v], 0);
    EXPECT_LE(offBone_mm(p), assets::kGumThickness_mm + 0.5);
    EXPECT_GE(p.z, 21.0 - 10.0 - 0.5);
    // The neck is at 21 mm; a crown is bare.
    if (std::abs(p.y - 9.0) < 4.0) {
      EXPECT_LE(p.z, 22.5);
    }
    if (std::abs(p.x) < 3.0 && std::abs(p.y - 36.0) < 3.0) is_over_48 = true;
  }
  EXPECT_TRUE(is_over_48) << "it covers what has not come through";
  // Sides: 2 x 46 mm by 9 mm, the top, the back: about 2 mm thick.
  const double volume_mm3 = static_cast<double>(gum.size()) * grid_.voxelVolume_mm3();
  EXPECT_GT(volume_mm3, 2000.0);
  EXPECT_LT(volume_mm3, 4500.0);
}

TEST_F(ModelledGumTest, AirBoundsItAndADryJawHasTheLayerAlone) {
  const std::vector<std::size_t> whole = assets::modelledGum(grid_, hounsfield_, label_, tooth_);
  std::vector<std::int16_t> thin = hounsfield_, dry = hounsfield_;
  assets::forVoxels(grid_, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p = grid_.centre_P_mm(ijk);
    if (label_[v] != 0) return;
    dry[v] = -1000;
    if (offBone_mm(p) > 1.2) thin[v] = -1000;
  });
  for (const std::size_t v : assets::modelledGum(grid_, thin, label_, tooth_))
    EXPECT_LE(offBone_mm(grid_.centre_P_mm(assets::elementAt(grid_.size, v))), 1.2);
  std::vector<std::size_t> layer = assets::modelledGum(grid_, dry, label_, tooth_), sorted = whole;
  std::ranges::sort(layer), std::ranges::sort(sorted);
  EXPECT_EQ(layer, sorted);
}

TEST_F(ModelledGumTest, WithoutTeethThereIsNone) {
  std::ranges::fill(tooth_, std::uint8_t{0});
  EXPECT_TRUE(assets::modelledGum(grid_, hounsfield_, label_, tooth_).empty());
}

}  // namespace
