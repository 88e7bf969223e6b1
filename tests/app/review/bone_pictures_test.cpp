#include "app/review/bone_pictures.h"

#include <gtest/gtest.h>

#include "assets/cut_field.h"
#include "assets/tissue.h"

namespace app {
namespace {

/// A block of cortical bone of 24 x 24 x 12 mm with a hole from above; the plan is a ball of 3 mm beside or on it.
struct Site {
  assets::VolumeGrid grid{{61, 61, 31}, 0.4, {-12.0, -12.0, -12.0}};
  std::vector<std::uint8_t> before = std::vector<std::uint8_t>(grid.voxelCount(), 255), after = before;
  std::vector<std::uint8_t> label =
      std::vector<std::uint8_t>(grid.voxelCount(), static_cast<std::uint8_t>(assets::Tissue::cortical));

  Site() {
    assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
      const glm::dvec3 p = grid.centre_P_mm(ijk);
      if (glm::length(p.z < 0.0 ? p : glm::dvec3(p.x, p.y, 0.0)) < 3.0) after[v] = 0;
    });
  }
  static assets::PlannedCut ballAt(const glm::dvec3& p) {
    assets::PlannedCut cut;
    cut.strokes_P_mm = {{p, p + glm::dvec3(0.1, 0.0, 0.0)}};
    cut.bur_radius_mm = 3.0;
    return cut;
  }
  /// From above: pixels that are clearly red, clearly blue.
  glm::ivec2 colours(const std::optional<assets::PlannedCut>& plan) const {
    std::function<double(const glm::dvec3&)> from_plan_mm;
    if (plan)
      from_plan_mm = [field = assets::CutField(*plan, 3.0)](const glm::dvec3& p) { return field.distance_mm(p); };
    const auto pictures = bonePictures({grid, label, before, after}, {}, from_plan_mm, {120, 100});
    EXPECT_EQ(pictures.size(), 4U);
    EXPECT_EQ(pictures[0].from, "from above");
    glm::ivec2 count(0);
    const render::Image& image = pictures[0].image;
    for (std::size_t n = 0; n < image.rgba.size(); n += 4) {
      const int red = image.rgba[n], blue = image.rgba[n + 2];
      count.x += red > blue + 70;
      count.y += blue > red + 40;
    }
    return count;
  }
};

TEST(BonePictures, WithoutAPlanNothingIsColoured) { EXPECT_EQ(Site().colours({}), glm::ivec2(0)); }

TEST(BonePictures, AHoleOutsideOfThePlanIsRedAndWhatStandsOfItBlue) {
  const glm::ivec2 colours = Site().colours(Site::ballAt({8.0, 0.0, 0.0}));
  EXPECT_GT(colours.x, 100) << "the hole";
  EXPECT_GT(colours.y, 100) << "the planned ball";
}

TEST(BonePictures, WhatWasLaidIsSeenInItsColour) {
  const Site site;
  const std::size_t count = site.grid.voxelCount();
  haptics::Filling::Volumes laid{std::vector<std::uint8_t>(count), std::vector<std::uint8_t>(count),
                                 std::vector<std::uint8_t>(count)};
  for (std::size_t v = 0; v < count; ++v)
    if (site.after[v] == 0) laid.laid[v] = 255, laid.tissue[v] = static_cast<std::uint8_t>(assets::Tissue::wax);
  const auto green = [&](const haptics::Filling::Volumes* of) {
    const render::Image image =
        bonePictures({site.grid, site.label, site.before, site.after, of}, {}, {}, {120, 100})[0].image;
    int pixels = 0;
    for (std::size_t n = 0; n < image.rgba.size(); n += 4) pixels += image.rgba[n + 1] > image.rgba[n] + 20;
    return pixels;
  };
  // A disc of 6 mm in a picture of 34 mm: 244 pixels.
  EXPECT_EQ(green(nullptr), 0);
  EXPECT_NEAR(green(&laid), 244, 40);
}

TEST(BonePictures, AHoleAsPlannedIsNeither) {
  assets::PlannedCut plan = Site::ballAt({0.0, 0.0, 0.0});
  plan.strokes_P_mm = {{{0.0, 0.0, 1.0}, {0.0, 0.0, 0.0}}};
  const glm::ivec2 colours = Site().colours(plan);
  EXPECT_LT(colours.x, 30);
  EXPECT_LT(colours.y, 30);
}

}  // namespace
}  // namespace app
