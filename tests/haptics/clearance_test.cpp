#include "haptics/tool/clearance.h"

#include <gtest/gtest.h>

#include "calibration/geometry/units.h"
#include "tests/haptics/structure_phantom.h"

namespace haptics {
namespace {

using phantom::ToolPose;

constexpr std::array<BurShape, 6> kHeads{BurShape{ShapeKind::sphere, 2.0, 0.0},
                                         BurShape{ShapeKind::capsule, 1.2, 4.0},
                                         BurShape{ShapeKind::cylinder, 2.0, 5.0},
                                         BurShape{ShapeKind::cone, 2.0, 6.0},
                                         BurShape{ShapeKind::revolved, 1.8, 6.0, assets::BurProfile::flame},
                                         BurShape{ShapeKind::revolved, 1.8, 5.0, assets::BurProfile::pear}};

TEST(StructureDistance, IsTheDistanceToTheNearestVoxelNearAndFar) {
  const phantom::VoxelStructure crown = phantom::crown(0.5);
  const assets::StructureDistance distance = crown.distance();
  std::mt19937 random(3);
  for (int n = 0; n < 2000; ++n) {
    const glm::dvec3 p = phantom::randomPose(random, n % 2 == 0 ? 10.0 : 60.0).translation_mm;
    double nearest_mm = 1e9;
    for (const glm::dvec3& voxel : crown.voxels_P_mm) nearest_mm = std::min(nearest_mm, glm::distance(p, voxel));
    if (nearest_mm < 0.9 * 0.5) continue;  // between voxels
    EXPECT_NEAR(distance.at_mm(p), nearest_mm - 0.4 * 0.5, 0.25 * 0.5) << p.x << " " << p.y << " " << p.z;
  }
}

TEST(StructureDistance, IsNegativeInsideByTheWayOut) {
  const assets::StructureDistance distance = phantom::canal(0.25).distance();
  std::mt19937 random(4);
  std::uniform_real_distribution<double> along(-13.0, 0.0), across(-1.4, 1.4);
  for (int n = 0; n < 2000; ++n) {
    const glm::dvec3 p(along(random), across(random), across(random));
    // At the axis interpolation cuts the ridge.
    if (phantom::canalDistance_mm(p) > 0.0 || phantom::canalDistance_mm(p) < -1.25) continue;
    EXPECT_NEAR(distance.at_mm(p), phantom::canalDistance_mm(p), 0.25) << "labels are half a voxel off";
  }
}

TEST(StructureDistance, OfALargeStructureHasItsFieldWhereItIsWanted) {
  const phantom::VoxelStructure canal = phantom::canal(0.25);
  const assets::StructureDistance whole = canal.distance();
  const assets::StructureDistance part = assets::structureDistance(canal.grid, canal.belongs, {6.0, 2.0, 1.0}, 100'000);
  EXPECT_LE(part.distance.size(), 100'000u);
  EXPECT_GT(whole.distance.size(), 100'000u);
  std::mt19937 random(5);
  for (int n = 0; n < 2000; ++n) {
    const glm::dvec3 p = phantom::randomPose(random, 10.0).translation_mm;
    if (whole.at_mm(p) > 0.0) {
      EXPECT_NEAR(part.at_mm(p), whole.at_mm(p), 0.12);
    }
  }
}

TEST(Clearance, OfASphereThreeMillimetresFromTheCanalIsTwo) {
  const assets::StructureDistance canal = phantom::canal(0.25).distance();
  const Tool tool{{ShapeKind::sphere, 1.0, 0.0}, {}};
  for (int n = 0; n < 16; ++n) {
    const double angle = 2.0 * calibration::kPi * n / 16.0, away_mm = phantom::kCanalRadius_mm + 3.0;
    const ToolPose X_PT{glm::dquat(1, 0, 0, 0), {-8.0, away_mm * std::cos(angle), away_mm * std::sin(angle)}};
    EXPECT_NEAR(clearance_mm(canal, tool, X_PT), 2.0, 0.5 * 0.25);
  }
}

TEST(Clearance, OfEveryShapeIsThatOfAllVoxels) {
  for (const double spacing_mm : {0.25, 0.4})
    for (const phantom::VoxelStructure& structure : {phantom::canal(spacing_mm), phantom::crown(spacing_mm)}) {
      const assets::StructureDistance distance = structure.distance();
      std::mt19937 random(11);
      for (const BurShape& head : kHeads) {
        int compared = 0;
        for (int n = 0; n < 1000; ++n) {
          const ToolPose X_PT = phantom::randomPose(random, n % 4 == 0 ? 40.0 : 11.0);
          const double slow_mm = phantom::slowClearance_mm(structure, head, X_PT);
          if (slow_mm < 0.0) continue;
          ++compared;
          EXPECT_NEAR(clearance_mm(distance, {head, {}}, X_PT), slow_mm, 0.5 * spacing_mm);
        }
        EXPECT_GT(compared, 600);
      }
    }
}

/// The least of the field over points of the surface, a fifth of a voxel apart.
double sampled_mm(const assets::StructureDistance& distance, const BurShape& head, const ToolPose& X_PT,
                  double step_mm) {
  const double half = halfHeight_mm(head), straight = 0.5 * head.length_mm;
  double least_mm = 1e9;
  const auto ring = [&](double z, double r) {
    const int steps = 1 + static_cast<int>(2.0 * calibration::kPi * r / step_mm);
    for (int n = 0; n < steps; ++n) {
      const double angle = 2.0 * calibration::kPi * n / steps;
      const glm::dvec3 p_T(r * std::cos(angle), r * std::sin(angle), z);
      least_mm = std::min(least_mm, distance.near_mm(X_PT.rotation * p_T + X_PT.translation_mm));
    }
  };
  for (double z = -half; z < half + 1e-9; z += step_mm) {
    double r = head.radius_mm;
    if (head.kind == ShapeKind::capsule)
      r = std::sqrt(std::max(0.0, r * r - std::pow(std::max(0.0, std::abs(z) - straight), 2)));
    if (head.kind == ShapeKind::cone) r *= (z + half) / (2.0 * half);
    if (head.kind == ShapeKind::revolved) {
      const assets::BurOutline outline = revolvedOutline(head);
      std::size_t k = 0;
      while (k + 2 < outline.count && z > outline.z_mm[k + 1]) ++k;
      r = glm::mix(outline.radius_mm[k], outline.radius_mm[k + 1],
                   (z - outline.z_mm[k]) / (outline.z_mm[k + 1] - outline.z_mm[k]));
    }
    ring(z, r);
  }
  for (double r = 0.0; r < head.radius_mm + 1e-9 && head.kind != ShapeKind::capsule; r += step_mm) {
    const double top = head.kind == ShapeKind::revolved ? 0.6 * head.radius_mm : head.radius_mm;
    if (r < top + 1e-9) ring(half, r);
    if (head.kind == ShapeKind::cylinder) ring(-half, r);
  }
  return least_mm;
}

TEST(Clearance, OfEveryShapeIsTheLeastOfItsSurfaceInsideToo) {
  constexpr double kVoxel_mm = 0.25;
  for (const assets::StructureDistance& distance :
       {phantom::canal(kVoxel_mm).distance(), phantom::crown(kVoxel_mm).distance()}) {
    std::mt19937 random(12);
    for (const BurShape& head : kHeads) {
      if (head.kind == ShapeKind::sphere) continue;
      int inside = 0;
      for (int n = 0; n < 100; ++n) {
        const ToolPose X_PT = phantom::randomPose(random, 5.0);
        const double slow_mm = sampled_mm(distance, head, X_PT, 0.2 * kVoxel_mm);
        if (slow_mm < 0.0) ++inside;
        if (slow_mm < 1.0) {
          EXPECT_NEAR(clearance_mm(distance, {head, {}}, X_PT), slow_mm, 0.25 * kVoxel_mm);
        }
      }
      EXPECT_GT(inside, 20);
    }
  }
}

TEST(Clearance, OfASphereInsideIsItsCentresLessTheRadius) {
  const assets::StructureDistance distance = phantom::canal(0.25).distance();
  const ToolPose X_PT{glm::dquat(1, 0, 0, 0), {-8.0, 0.3, 0.2}};
  EXPECT_DOUBLE_EQ(clearance_mm(distance, {{ShapeKind::sphere, 2.0, 0.0}, {}}, X_PT),
                   distance.at_mm(X_PT.translation_mm) - 2.0);
}

TEST(Clearance, TheShaftCountsWhereItIsNearerThanTheHead) {
  const phantom::VoxelStructure structure = phantom::canal(0.25);
  const assets::StructureDistance distance = structure.distance();
  std::mt19937 random(13);
  int by_shaft = 0;
  for (int n = 0; n < 600; ++n) {
    const ToolPose X_PT = phantom::randomPose(random, 16.0);
    for (const BurShape& head : kHeads) {
      const Shaft shaft{1.0, 25.0};
      // The rod as a cylinder about its own middle, from T's origin up.
      const ToolPose rod{X_PT.rotation, X_PT.translation_mm + X_PT.rotation * glm::dvec3(0.0, 0.0, 12.5)};
      const double of_head = phantom::slowClearance_mm(structure, head, X_PT),
                   of_rod = phantom::slowClearance_mm(structure, {ShapeKind::cylinder, 1.0, 25.0}, rod);
      if (std::min(of_head, of_rod) < 0.0) continue;
      if (of_rod < of_head) ++by_shaft;
      EXPECT_NEAR(clearance_mm(distance, {head, shaft}, X_PT), std::min(of_head, of_rod), 0.5 * 0.25);
    }
  }
  EXPECT_GT(by_shaft, 200);
}

TEST(Clearance, ChangesNoMoreThanTheToolMoves) {
  const assets::StructureDistance distance = phantom::crown(0.25).distance();
  std::mt19937 random(14);
  for (const BurShape& head : kHeads) {
    const Tool tool{head, standardShaft(head)};
    ToolPose X_PT = phantom::randomPose(random, 12.0);
    const glm::dvec3 step = 0.02 * glm::normalize(-X_PT.translation_mm);
    double before_mm = clearance_mm(distance, tool, X_PT);
    for (int n = 0; n < 500; ++n) {
      X_PT.translation_mm += step;
      const double now_mm = clearance_mm(distance, tool, X_PT);
      EXPECT_LE(std::abs(now_mm - before_mm), 0.02 + 0.13 * 0.25);
      before_mm = now_mm;
    }
  }
}

}  // namespace
}  // namespace haptics
