#include "assets/scan/periapical.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace assets {
namespace {

constexpr double kCylinder_mm = 4.0;

/// An upright cylinder of bone at the origin, its faces partial voxels.
VolumeGrid chordGrid() { return {{101, 101, 61}, 0.1, {-5.0, -5.0, -3.0}}; }

std::vector<std::uint8_t> uprightCylinder() {
  std::vector<std::uint8_t> solid(chordGrid().voxelCount());
  forVoxels(chordGrid(), [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p = chordGrid().centre_P_mm(ijk);
    solid[v] = static_cast<std::uint8_t>(
        std::lround(255.0 * std::clamp(0.5 + (kCylinder_mm - std::hypot(p.x, p.y)) / 0.1, 0.0, 1.0)));
  });
  return solid;
}

/// From far away along x, the film at x = 8: rays all but parallel.
PeriapicalView parallelView() {
  PeriapicalView view;
  view.source_P_mm = {-1e6, 0.0, 0.0};
  view.right_P = {0.0, -1.0, 0.0};
  view.down_P = {0.0, 0.0, -1.0};
  view.size_px = {81, 21};
  view.corner_P_mm = {8.0, 4.0, 1.0};
  return view;
}

/// A tooth of enamel above dentine in a block of air; its number in every voxel.
CtVolume enamelledTooth(int fdi, const glm::dvec3& middle_P_mm) {
  CtVolume ct;
  ct.grid = {{40, 40, 60}, 0.4, middle_P_mm - glm::dvec3(7.8, 7.8, 11.8)};
  ct.label.assign(ct.grid.voxelCount(), 0);
  ct.tooth = ct.label;
  ct.solid = ct.label;
  forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p = ct.grid.centre_P_mm(ijk) - middle_P_mm;
    if (std::abs(p.x) > 3.0 || std::abs(p.y) > 3.0 || std::abs(p.z) > 9.0) return;
    ct.label[v] = static_cast<std::uint8_t>((fdi < 30 ? -p.z : p.z) > 4.0 ? Tissue::enamel : Tissue::dentine);
    ct.tooth[v] = static_cast<std::uint8_t>(fdi);
    ct.solid[v] = 255;
  });
  return ct;
}

TEST(Periapical, ACylindersShadowIsItsChord) {
  const std::vector<std::uint8_t> solid = uprightCylinder();
  const PeriapicalView view = parallelView();
  const std::vector<float> bone_mm = radiographOf(chordGrid(), solid, {}, view);
  double squares = 0.0;
  int rays = 0;
  for (int y = 0; y < view.size_px.y; ++y)
    for (int x = 0; x < view.size_px.x; ++x) {
      const double d = 4.0 - 0.1 * x;
      // A face along the ray is a matter of one voxel.
      if (std::abs(d) > kCylinder_mm - 0.15) continue;
      const double chord = 2.0 * std::sqrt(kCylinder_mm * kCylinder_mm - d * d);
      const double error = bone_mm[static_cast<std::size_t>(y * view.size_px.x + x)] - chord;
      EXPECT_NEAR(error, 0.0, 0.05) << d;
      squares += error * error;
      ++rays;
    }
  EXPECT_LT(std::sqrt(squares / rays), 0.01);
}

TEST(Periapical, ObliqueRaysMeetTheSamplesOfASlowWalk) {
  std::mt19937 random(7);
  const VolumeGrid grid = chordGrid();
  const std::vector<std::uint8_t> solid = uprightCylinder();
  const std::vector<std::uint8_t> label(solid.size(), static_cast<std::uint8_t>(Tissue::cortical));
  for (int n = 0; n < 12; ++n) {
    PeriapicalView view = parallelView();
    std::uniform_real_distribution<double> aside(-90.0, 90.0);
    view.source_P_mm = {n % 2 == 0 ? -280.0 : -60.0, aside(random) * (n % 2 == 0 ? 1.0 : 0.4), 0.3 * aside(random)};
    const std::vector<float> bone_mm = radiographOf(grid, solid, label, view);
    for (int pixel = 0; pixel < view.size_px.x * view.size_px.y; pixel += 37) {
      const glm::dvec3 film = view.corner_P_mm + 0.1 * (pixel % view.size_px.x) * view.right_P +
                              0.1 * (pixel / view.size_px.x) * view.down_P;
      const glm::dvec3 way = film - view.source_P_mm;
      const double length_mm = glm::length(way);
      // Nearest voxel in steps of 0.01 mm.
      double expected_mm = 0.0;
      for (double mm = length_mm - 40.0; mm < length_mm; mm += 0.01) {
        const glm::ivec3 ijk(glm::round(grid.indexFromPoint(view.source_P_mm + way * (mm / length_mm))));
        if (grid.contains(ijk)) expected_mm += 0.01 * solid[grid.index(ijk)] / 255.0;
      }
      EXPECT_NEAR(bone_mm[static_cast<std::size_t>(pixel)], expected_mm, 0.2) << n << " " << pixel;
    }
  }
}

TEST(Periapical, WhatIsCarvedOrBehindTheFilmCastsNoShadow) {
  std::vector<std::uint8_t> solid = uprightCylinder();
  PeriapicalView view = parallelView();
  view.corner_P_mm.x = 0.0;
  const std::size_t middle = 10u * 81u + 40u;
  EXPECT_NEAR(radiographOf(chordGrid(), solid, {}, view)[middle], kCylinder_mm, 0.06);
  std::ranges::fill(solid, std::uint8_t{0});
  EXPECT_EQ(radiographOf(chordGrid(), solid, {}, view)[middle], 0.0f);
}

TEST(Periapical, EnamelDentineAndPulpWeakenAsTheTableSays) {
  const VolumeGrid grid{{20, 20, 20}, 0.5, {-5.0, -5.0, -5.0}};
  const std::vector<std::uint8_t> full(grid.voxelCount(), 255), none(grid.voxelCount(), 0);
  PeriapicalView view = parallelView();
  const auto through = [&](Tissue tissue, const std::vector<std::uint8_t>& solid) {
    const std::vector<std::uint8_t> label(grid.voxelCount(), static_cast<std::uint8_t>(tissue));
    return radiographOf(grid, solid, label, view)[10u * 81u + 40u];
  };
  EXPECT_NEAR(through(Tissue::enamel, full), 21.0, 1e-3);
  EXPECT_NEAR(through(Tissue::dentine, full), 14.0, 1e-3);
  EXPECT_NEAR(through(Tissue::cortical, full), 10.0, 1e-3);
  EXPECT_NEAR(through(Tissue::pulp, none), 3.0, 1e-3);
  EXPECT_EQ(through(Tissue::enamel, none), 0.0f);
}

TEST(Periapical, TheToothStandsInTheMiddleOfItsFilmWhateverTheShift) {
  for (const int fdi : {11, 16, 23, 27, 31, 36, 44, 46}) {
    for (const double shift_deg : {-20.0, 0.0, 20.0}) {
      const glm::dvec3 middle_P_mm(3.0, -4.0, 5.0);
      const CtVolume ct = enamelledTooth(fdi, middle_P_mm);
      const auto view = periapicalViewOf(ct, fdi, shift_deg);
      ASSERT_TRUE(view);
      const std::vector<float> bone_mm = radiographOf(ct.grid, ct.solid, ct.label, *view);
      glm::dvec2 moment(0.0);
      double sum = 0.0, extent_px = 0.0;
      for (std::size_t n = 0; n < bone_mm.size(); ++n) {
        const glm::dvec2 px(static_cast<double>(n % static_cast<std::size_t>(view->size_px.x)),
                            static_cast<double>(n / static_cast<std::size_t>(view->size_px.x)));
        moment += static_cast<double>(bone_mm[n]) * px;
        sum += bone_mm[n];
        if (bone_mm[n] > 0.0f) extent_px = std::max(extent_px, px.y);
      }
      const glm::dvec2 centre = moment / sum - 0.5 * glm::dvec2(view->size_px - 1);
      EXPECT_LT(std::abs(centre.x), 6.0) << fdi << " " << shift_deg;
      EXPECT_LT(std::abs(centre.y), 25.0) << fdi;  // enamel weighs more
      EXPECT_LT(extent_px, view->size_px.y - 1) << fdi;
      // Crowns of lower teeth are up in the picture, of upper ones down.
      EXPECT_EQ(centre.y<0.0, fdi> 30) << fdi;
      EXPECT_EQ(view->mesial_is_right, fdi / 10 == 1 || fdi / 10 == 4);
    }
  }
}

TEST(Periapical, WhatLiesTowardsTheTubeMovesAgainstIt) {
  // A bead at the cheek's side of the middle: with the tube moved to mesial, its shadow moves to distal.
  CtVolume ct = enamelledTooth(46, {0.0, 0.0, 0.0});
  const glm::ivec3 bead(glm::round(ct.grid.indexFromPoint({-6.0, 0.0, 0.0})));
  std::ranges::fill(ct.solid, std::uint8_t{0});
  ct.solid[ct.grid.index(bead)] = 255;
  const auto shadow_px = [&](double shift_deg) {
    const auto view = periapicalViewOf(ct, 46, shift_deg);
    const std::vector<float> bone_mm = radiographOf(ct.grid, ct.solid, ct.label, *view);
    double sum = 0.0, moment = 0.0;
    for (std::size_t n = 0; n < bone_mm.size(); ++n) {
      sum += bone_mm[n];
      moment += bone_mm[n] * static_cast<double>(n % static_cast<std::size_t>(view->size_px.x));
    }
    return moment / sum;
  };
  // Mesial is right here. 6 mm buccal of the middle: tan 20 degrees of it, enlarged by the beam.
  const double moved_mm = 0.1 * (shadow_px(20.0) - shadow_px(0.0));
  EXPECT_NEAR(moved_mm, -6.0 * std::tan(glm::radians(20.0)), 0.5);
  EXPECT_NEAR(0.1 * (shadow_px(-20.0) - shadow_px(0.0)), -moved_mm, 0.5);
}

TEST(Periapical, AToothThatIsNotThereHasNoFilm) {
  EXPECT_FALSE(periapicalViewOf(enamelledTooth(46, glm::dvec3(0.0)), 36, 0.0));
  CtVolume unnumbered = enamelledTooth(46, glm::dvec3(0.0));
  unnumbered.tooth.clear();
  EXPECT_FALSE(periapicalViewOf(unnumbered, 46, 0.0));
}

}  // namespace
}  // namespace assets
