#include "assets/scan/metal_shadow.h"

#include <cmath>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

namespace assets {
namespace {

using glm::dvec3;

/// From far away along x, the film at x = 8: beams all but parallel.
PeriapicalView alongX() {
  PeriapicalView view;
  view.source_P_mm = {-1e6, 0.0, 0.0};
  view.right_P = {0.0, -1.0, 0.0};
  view.down_P = {0.0, 0.0, -1.0};
  view.size_px = {81, 41};
  view.corner_P_mm = {8.0, 4.0, 2.0};
  return view;
}

TEST(MetalShadow, ACylindersChordIsThatOfItsCircle) {
  for (const double aside_mm : {0.0, 0.05, 0.1, 0.149}) {
    const double across = chord_mm({-10.0, aside_mm, 0.5}, {1.0, 0.0, 0.0}, dvec3(0.0), 0.15, {0.0, 0.0, 1.0}, 0.15);
    EXPECT_NEAR(across, 2.0 * std::sqrt(0.15 * 0.15 - aside_mm * aside_mm), 1e-12);
  }
  EXPECT_EQ(chord_mm({-10.0, 0.151, 0.5}, {1.0, 0.0, 0.0}, dvec3(0.0), 0.15, {0.0, 0.0, 1.0}, 0.15), 0.0);
  EXPECT_EQ(chord_mm({-10.0, 0.0, 1.01}, {1.0, 0.0, 0.0}, dvec3(0.0), 0.15, {0.0, 0.0, 1.0}, 0.15), 0.0);
  EXPECT_NEAR(chord_mm({0.01, 0.0, -5.0}, {0.0, 0.0, 1.0}, dvec3(0.0), 0.15, {0.0, 0.0, 1.0}, 0.15), 1.0, 1e-12)
      << "along it";
}

/// Against the sum of short steps along the beam.
TEST(MetalShadow, AConesChordIsWhatLiesInside) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  int met = 0;
  for (int n = 0; n < 300; ++n) {
    const dvec3 from(0.3 * any(random), 0.3 * any(random), 0.0), to(0.3 * any(random), 0.3 * any(random), 0.8);
    const double wide_mm = 0.2 + 0.05 * any(random), slim_mm = 0.12 + 0.05 * any(random);
    const dvec3 way = glm::normalize(dvec3(1.0, 0.4 * any(random), 0.4 * any(random)));
    const dvec3 source = dvec3(0.0, 0.25 * any(random), 0.4 + 0.3 * any(random)) - 5.0 * way;
    const dvec3 axis = glm::normalize(to - from);
    constexpr double kStep_mm = 1e-4;
    double inside_mm = 0.0;
    for (double t = 4.0; t < 6.0; t += kStep_mm) {
      const dvec3 p = source + t * way - from;
      const double z = glm::dot(p, axis), share = z / glm::distance(from, to);
      if (share >= 0.0 && share <= 1.0 && glm::length(p - z * axis) <= glm::mix(wide_mm, slim_mm, share))
        inside_mm += kStep_mm;
    }
    const double chord = chord_mm(source, way, from, wide_mm, to, slim_mm);
    EXPECT_NEAR(chord, inside_mm, 3e-4) << n;
    met += chord > 0.0;
  }
  EXPECT_GT(met, 100);
}

TEST(MetalShadow, AFilmHasTheVolumeOfTheMetal) {
  const PeriapicalView view = alongX();
  // Narrower than a pixel, slanted: its mean over pixels keeps the sum.
  const MetalFragment fragment{6, false, {{1.0, -1.5, 1.4}, {1.2, 1.7, -1.1}}, {0.04, 0.03}};
  std::vector<float> bone_mm(81 * 41, 0.5f);
  addMetal(view, std::span(&fragment, 1), bone_mm);
  const double length_mm = fragment.length_mm();
  const double volume_mm3 = M_PI / 3.0 * length_mm * (0.04 * 0.04 + 0.04 * 0.03 + 0.03 * 0.03);
  double sum = 0.0;
  for (const float mm : bone_mm) sum += static_cast<double>(mm) - 0.5;
  EXPECT_NEAR(sum * view.pixel_mm * view.pixel_mm, kSteelToBone * volume_mm3, 0.02 * kSteelToBone * volume_mm3);

  // And where it lies: #25 in the middle of the film weakens as much as 5 mm of bone.
  const MetalFragment thick{25, false, {{0.0, 0.0, 1.0}, {0.0, 0.0, -1.0}}, {0.15, 0.15}};
  const MetalFragment niti{25, true, thick.node_P_mm, thick.radius_mm};
  std::vector<float> steel_mm(81 * 41), other_mm(81 * 41);
  addMetal(view, std::span(&thick, 1), steel_mm);
  addMetal(view, std::span(&niti, 1), other_mm);
  const std::size_t middle = 20 * 81 + 40;
  // The mean chord over 0.1 mm about the axis.
  const double mean_mm = 2.0 * 0.15 * 0.15 * (std::asin(1.0 / 3.0) + (1.0 / 3.0) * std::sqrt(8.0 / 9.0)) / 0.1;
  EXPECT_NEAR(steel_mm[middle], kSteelToBone * mean_mm, 0.03);
  EXPECT_NEAR(other_mm[middle], kNickelTitaniumToBone * mean_mm, 0.03);
  EXPECT_GT(steel_mm[middle + 1], 1.0f);
  EXPECT_GT(steel_mm[middle - 1], 1.0f);
  EXPECT_EQ(steel_mm[middle + 3], 0.0f);
  EXPECT_EQ(steel_mm[middle - 3], 0.0f);
}

TEST(MetalShadow, OutsideTheFilmNothingIsWritten) {
  const PeriapicalView view = alongX();
  const MetalFragment out{25, false, {{0.0, 30.0, 1.0}, {0.0, 3.9, 5.0}, {0.0, 3.99, 1.9}}, {0.2, 0.2, 0.2}};
  std::vector<float> bone_mm(81 * 41);
  addMetal(view, std::span(&out, 1), bone_mm);
  EXPECT_GT(bone_mm[0], 0.0f) << "its lower end is in the corner";
}

}  // namespace
}  // namespace assets
