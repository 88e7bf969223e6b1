#include "haptics/contact/shape_overlap.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "haptics/bone/bur_coverage.h"
#include "haptics/bone/voxel_sphere.h"
#include "haptics/contact/overlap.h"
#include "haptics/tool/flat_overlap.h"
#include "tests/haptics/phantom.h"

namespace haptics {
namespace {

using namespace phantom;
using calibration::Pose;
using calibration::Tool;

const std::vector<BurShape> kShapes = {{ShapeKind::sphere, 1.3, 0.0},
                                       {ShapeKind::capsule, 1.0, 2.5},
                                       {ShapeKind::cylinder, 1.0, 3.0},
                                       {ShapeKind::cone, 1.2, 3.0}};

const std::vector<BurShape> kRevolved = {{ShapeKind::revolved, 1.2, 1.2, assets::BurProfile::wheel},
                                         {ShapeKind::revolved, 1.0, 1.5, assets::BurProfile::inverted_cone},
                                         {ShapeKind::revolved, 1.1, 3.0, assets::BurProfile::taper},
                                         {ShapeKind::revolved, 1.1, 3.0, assets::BurProfile::round_taper},
                                         {ShapeKind::revolved, 1.0, 3.0, assets::BurProfile::torpedo},
                                         {ShapeKind::revolved, 1.0, 3.5, assets::BurProfile::flame},
                                         {ShapeKind::revolved, 1.1, 3.0, assets::BurProfile::pear},
                                         {ShapeKind::revolved, 1.2, 2.8, assets::BurProfile::egg},
                                         {ShapeKind::revolved, 1.0, 3.0, assets::BurProfile::round_cylinder}};

class Poses {
 public:
  explicit Poses(unsigned seed) : random_(seed) {}
  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  glm::dquat turn() {
    std::normal_distribution<double> normal;
    return glm::normalize(glm::dquat(normal(random_), normal(random_), normal(random_), normal(random_)));
  }
  glm::dvec3 place(double most) { return {number(-most, most), number(-most, most), number(-most, most)}; }
  glm::dvec3 direction() { return turn() * glm::dvec3(0.0, 0.0, 1.0); }

 private:
  std::mt19937 random_;
};

/// The sum voxel by voxel.
ShapeOverlap slowShapeOverlap(const SolidField& field, const BurShape& shape, const Pose<Patient, Tool>& X_PT) {
  const BurCoverage bur(field.grid, shape, X_PT, 1);
  const TissueStiffness tissue;
  const auto solidAt = [&](glm::ivec3 ijk) { return field.grid.contains(ijk) ? field.solidAt(ijk) / 255.0 : 0.0; };
  ShapeOverlap sum;
  glm::dvec3 moment_T(0.0), rise(0.0);
  for (int k = bur.box.first.z; k <= bur.box.last.z; ++k)
    for (int j = bur.box.first.y; j <= bur.box.last.y; ++j)
      for (int i = bur.box.first.x; i <= bur.box.last.x; ++i) {
        const glm::ivec3 ijk{i, j, k};
        const VoxelShare share = bur.shareAt(ijk);
        for (int axis = 0; axis < 3; ++axis) {
          glm::ivec3 step{0};
          step[axis] = 1;
          rise[axis] += share.fraction * (solidAt(ijk + step) - solidAt(ijk - step));
        }
        const double w = solidAt(ijk);
        if (w == 0.0) continue;
        sum.volume_mm3 += w * share.fraction;
        sum.stiff_mm3 += w * share.fraction * tissue.of(field.labelAt(ijk));
        sum.grey_mm3 += w * (1.0 - w) * share.fraction;
        moment_T += w * share.moment;
      }
  const double s = field.grid.spacing_mm, voxel_mm3 = s * s * s;
  for (double* volume : {&sum.volume_mm3, &sum.stiff_mm3, &sum.grey_mm3}) *volume *= voxel_mm3;
  sum.first_moment_P_mm4.xyz = glm::transpose(bur.to_T) * moment_T * (voxel_mm3 * s);
  sum.area_P_mm2.xyz = rise * (-0.5 * s * s);
  return sum;
}

void expectSame(const ShapeOverlap& a, const ShapeOverlap& b, double size) {
  EXPECT_NEAR(a.volume_mm3, b.volume_mm3, 1e-6 * size);
  EXPECT_NEAR(a.stiff_mm3, b.stiff_mm3, 1e-6 * size);
  EXPECT_NEAR(a.grey_mm3, b.grey_mm3, 1e-6 * size);
  EXPECT_LT(glm::length(a.first_moment_P_mm4.xyz - b.first_moment_P_mm4.xyz), 1e-6 * size);
  EXPECT_LT(glm::length(a.area_P_mm2.xyz - b.area_P_mm2.xyz), 1e-5 * size);
}

TEST(ShapeOverlap, EqualsTheSumVoxelByVoxelInRandomBone) {
  Poses poses(11);
  Phantom phantom = block(3.1, 0.25);
  std::vector<std::uint8_t> label(phantom.solid.size());
  for (auto& solid : phantom.solid) solid = static_cast<std::uint8_t>(std::max(0.0, poses.number(-128.0, 255.0)));
  for (auto& tissue : label) tissue = static_cast<std::uint8_t>(poses.number(0.0, 12.0));
  const Cubelets cubelets(phantom.grid, phantom.solid, label);
  const SolidField field = cubelets.field();
  for (int trial = 0; trial < 200; ++trial) {
    BurShape shape{static_cast<ShapeKind>(trial % kShapeKinds), poses.number(0.1, 2.5), poses.number(0.2, 5.0)};
    if (shape.kind == ShapeKind::revolved) {
      shape.profile = static_cast<assets::BurProfile>(trial / kShapeKinds % 9);
      shape.length_mm = std::max(shape.length_mm, assets::leastBurLength_mm(shape.profile, shape.radius_mm));
    }
    const Pose<Patient, Tool> X_PT{poses.turn(), poses.place(4.0)};
    expectSame(shapeOverlap(field, shape, X_PT, {}), slowShapeOverlap(field, shape, X_PT), 20.0);
  }
}

TEST(ShapeOverlap, IsTheSumOfSpheresForASphere) {
  Poses poses(5);
  const Phantom phantom = halfSpace(3.0, 0.1, glm::normalize(glm::dvec3(0.3, -0.2, 0.9)));
  for (int trial = 0; trial < 50; ++trial) {
    const BurShape shape{ShapeKind::sphere, poses.number(0.1, 1.5), 0.0};
    const Pose<Patient, Tool> X_PT{poses.turn(), poses.place(1.5)};
    const ShapeOverlap any = shapeOverlap(phantom.field(), shape, X_PT, {});
    const SphereOverlap sphere = sphereOverlapVoxelByVoxel(phantom.field(), {X_PT.translation_mm}, shape.radius_mm);
    EXPECT_NEAR(any.volume_mm3, sphere.volume_mm3, 1e-5);
    EXPECT_NEAR(any.grey_mm3, sphere.grey_mm3, 2e-6);
    EXPECT_LT(glm::length(any.first_moment_P_mm4.xyz - sphere.first_moment_P_mm4.xyz), 1e-5);
  }
}

TEST(ShapeOverlap, IsTheWholeHeadInsideSolidBone) {
  Poses poses(6);
  const Phantom phantom = block(4.0, 0.1);
  std::vector<BurShape> all = kShapes;
  all.insert(all.end(), kRevolved.begin(), kRevolved.end());
  for (const BurShape& shape : all)
    for (int trial = 0; trial < 5; ++trial) {
      const ShapeOverlap overlap = shapeOverlap(phantom.field(), shape, {poses.turn(), poses.place(0.5)}, {});
      const double whole = volume_mm3(shape);
      EXPECT_NEAR(overlap.volume_mm3, whole, 2e-3 * whole) << static_cast<int>(shape.kind);
      EXPECT_LT(glm::length(overlap.area_P_mm2.xyz), 0.02);
    }
}

TEST(ShapeOverlap, HasTheVolumeCentroidAndDirectionOfFlatBone) {
  // Grey faces at any angle, R at least ten voxels; the voxels' smear taken away.
  Poses poses(7);
  const double s = 0.1, sigma = std::sqrt(0.2 * kVoxelSphereRadius * kVoxelSphereRadius + 1.0 / 12.0) * s;
  double volume2 = 0.0, centroid2 = 0.0, angle2 = 0.0;
  int deep = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const glm::dvec3 normal = poses.direction();
    const Phantom phantom = halfSpace(2.6, s, normal, poses.place(0.5 * s));
    for (const BurShape& shape : kShapes) {
      const glm::dquat turn = poses.turn();
      const glm::dvec3 axis = turn * glm::dvec3(0.0, 0.0, 1.0);
      const double cos = glm::dot(axis, normal);
      const double h = poses.number(0.1, 0.9) * std::min(shape.radius_mm, fullDepth_mm(shape, cos));
      const glm::dvec3 place = normal * (reach_mm(shape, -cos) - h) + 0.2 * glm::cross(normal, poses.direction());
      const ShapeOverlap overlap = shapeOverlap(phantom.field(), shape, {turn, place}, {});

      // From a voxel's depth on the depth is right to some micrometres.
      const double depth = flatDepth_mm(shape, overlap.volume_mm3, cos, sigma);
      EXPECT_NEAR(depth, h, 0.008);
      if (h < 0.3 * shape.radius_mm) continue;
      const FlatOverlap flat = flatOverlap(shape, h, cos);
      const double volume = flatOverlap(shape, depth, cos).volume_mm3 / flat.volume_mm3 - 1.0;
      const glm::dvec3 centroid =
          flat.centroid_along_mm * axis + flat.centroid_across_mm * glm::normalize(normal - cos * axis);
      const double off = glm::distance(overlap.first_moment_P_mm4.xyz / overlap.volume_mm3, centroid) / shape.radius_mm;
      const double angle =
          glm::degrees(std::acos(std::min(1.0, glm::dot(glm::normalize(overlap.area_P_mm2.xyz), normal))));
      EXPECT_NEAR(volume, 0.0, 0.02);
      EXPECT_LT(off, 0.025);
      EXPECT_LT(angle, 0.4) << static_cast<int>(shape.kind) << ' ' << h << ' ' << cos;
      EXPECT_NEAR(glm::length(overlap.area_P_mm2.xyz), flat.area_mm2, 0.02 * flat.area_mm2 + 0.05);
      volume2 += volume * volume;
      centroid2 += off * off;
      angle2 += angle * angle;
      ++deep;
    }
  }
  EXPECT_LT(std::sqrt(volume2 / deep), 0.005);
  EXPECT_LT(std::sqrt(centroid2 / deep), 0.01);
  EXPECT_LT(std::sqrt(angle2 / deep), 0.1);
}

TEST(ShapeOverlap, HasTheAreaThatItsVolumeLosesByMovingAVoxel) {
  // Also where the volume ends.
  Poses poses(8);
  constexpr double kSpacing_mm = 0.2;
  Phantom phantom = block(2.5, kSpacing_mm);
  for (auto& solid : phantom.solid) solid = static_cast<std::uint8_t>(std::max(0.0, poses.number(-128.0, 255.0)));
  std::vector<BurShape> all = kShapes;
  all.insert(all.end(), kRevolved.begin(), kRevolved.end());
  for (const BurShape& shape : all)
    for (int trial = 0; trial < 20; ++trial) {
      const Pose<Patient, Tool> X_PT{poses.turn(), poses.place(3.0)};
      const glm::dvec3 area = shapeOverlap(phantom.field(), shape, X_PT, {}).area_P_mm2.xyz;
      for (int axis = 0; axis < 3; ++axis) {
        Pose<Patient, Tool> more = X_PT, less = X_PT;
        more.translation_mm[axis] += kSpacing_mm;
        less.translation_mm[axis] -= kSpacing_mm;
        const double slope = (shapeOverlap(phantom.field(), shape, more, {}).volume_mm3 -
                              shapeOverlap(phantom.field(), shape, less, {}).volume_mm3) /
                             (2.0 * kSpacing_mm);
        EXPECT_NEAR(area[axis], -slope, 2e-5) << static_cast<int>(shape.kind);
      }
    }
}

TEST(ShapeOverlap, WeighsEveryTissueByItsStiffness) {
  const Phantom phantom = block(3.0, 0.1);
  const std::vector<std::uint8_t> label(phantom.solid.size(), static_cast<std::uint8_t>(assets::Tissue::trabecular));
  TissueStiffness tissue;
  tissue.factor[static_cast<std::size_t>(assets::Tissue::trabecular)] = 0.37;
  const Cubelets cubelets(phantom.grid, phantom.solid, label);
  const ShapeOverlap overlap = shapeOverlap(cubelets.field(), kShapes[1], {}, tissue);
  EXPECT_NEAR(overlap.stiff_mm3, 0.37 * overlap.volume_mm3, 1e-5);
}

TEST(ShapeOverlap, AnswersNothingForWhatIsNoShapeOrPose) {
  const Phantom phantom = block(2.0, 0.2);
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, inf, -1.0, 0.0})
    EXPECT_EQ(shapeOverlap(phantom.field(), {ShapeKind::cylinder, bad, 1.0}, {}, {}).volume_mm3, 0.0);
  for (const double bad : {nan, inf, -1.0, 0.0})
    EXPECT_EQ(shapeOverlap(phantom.field(), {ShapeKind::cone, 1.0, bad}, {}, {}).volume_mm3, 0.0);
  for (const double bad : {nan, inf, 1e300}) {
    EXPECT_EQ(shapeOverlap(phantom.field(), kShapes[1], {{1.0, 0.0, 0.0, 0.0}, {bad, 0.0, 0.0}}, {}).volume_mm3, 0.0);
  }
  EXPECT_EQ(shapeOverlap(phantom.field(), kShapes[1], {{nan, 0.0, 0.0, 0.0}, {}}, {}).volume_mm3, 0.0);
}

}  // namespace
}  // namespace haptics
