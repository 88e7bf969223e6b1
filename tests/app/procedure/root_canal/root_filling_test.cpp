// Root fillings of straight canals against closed forms: canal prepared to radius b, 10 mm long, working length 9.5.
#include "app/procedure/root_canal/root_filling.h"

#include <gtest/gtest.h>

#include "app/procedure/root_canal/laid_blocks.h"
#include "app/procedure/root_canal/tooth_blocks.h"
#include "app/procedure/root_canal/treatment_meter.h"
#include "tests/app/procedure/root_canal/shapes.h"

namespace app::filled_root {
namespace {

using shapes::Depth;
using shapes::ShapeSolid;

constexpr double kA = 0.15, kRo = 1.2, kLength_mm = 10.0, kPi = std::numbers::pi;
/// Off the voxels' centres.
constexpr glm::dvec3 kOff{0.013, -0.007, 0.0};

double aside(const glm::dvec3& p) { return std::hypot(p.x - kOff.x, p.y - kOff.y); }
/// Dentine from the floor of the chamber to the apex, with a canal of that radius.
double root(const glm::dvec3& p, double canal_mm) {
  return std::min({kRo - aside(p), aside(p) - canal_mm, p.z + kLength_mm, 0.02 - p.z});
}
double frustum_mm3(double r0, double r1, double h) { return kPi * h / 3.0 * (r0 * r0 + r0 * r1 + r1 * r1); }

struct Filled {
  assets::VolumeGrid grid = shapes::gridOf({-1.4, -1.4, -11.9}, {1.4, 1.4, 0.5}, 0.04);
  ToothBlocks before;
  assets::ToothCanals tooth;

  Filled()
      : before(shapes::ShapeTooth(
            grid, [](const glm::dvec3& p) { return root(p, kA); },
            [](const glm::dvec3& p) {
              if (kRo - aside(p) < 0.0 || p.z < -kLength_mm) return assets::Tissue::ligament;
              return aside(p) < kA ? assets::Tissue::pulp : assets::Tissue::dentine;
            })) {
    tooth.fdi = 34;
    tooth.chamber.floor_mm = 0.0;
    tooth.canals = {shapes::straightCanal(kLength_mm, kA, kOff)};
  }
  /// `canal_mm`: its radius by height; `laid`: depth in what was laid, from the axis.
  std::optional<RootFilling> of(const std::function<double(double)>& canal_mm, const Depth& laid) const {
    const ShapeSolid now(grid, [&](const glm::dvec3& p) { return root(p, canal_mm(p.z)); });
    const ShapeSolid filling(grid, laid);
    CanalSections sections(before, now, tooth.canals[0], {1.0, 0.0, 0.0});
    return rootFilling(sections, now, filling, tooth, 0);
  }
};

const Filled& canal() {
  static const Filled kCanal;
  return kCanal;
}

TEST(RootFilling, OfACylinderHasItsLengthAndItsShare) {
  constexpr double kB = 0.30;
  for (const double end_mm : {-3.3, -0.77, 0.0, 0.4}) {
    const double low = -(kLength_mm - 0.5 + end_mm);
    const auto filling = canal().of([](double) { return kB; },
                                    [&](const glm::dvec3& p) {
                                      return std::min({kB - aside(p), p.z - low, -p.z});
                                    });
    ASSERT_TRUE(filling) << end_mm;
    EXPECT_NEAR(filling->end_mm, end_mm, 0.05);
    EXPECT_NEAR(filling->canal_mm3, kPi * kB * kB * 9.5, 0.02 * kPi * kB * kB * 9.5);
    EXPECT_NEAR(filling->share(), std::min(1.0, (9.5 + end_mm) / 9.5), 0.02) << end_mm;
    EXPECT_TRUE(filling->voids.empty());
    EXPECT_NEAR(filling->extruded_mm3, 0.0, 1e-9);
    EXPECT_STREQ(lengthWord(*filling), end_mm < -0.5 ? "short" : "right");
  }
}

TEST(RootFilling, OfAConeInItsCanalFillsItsShareOfIt) {
  // A dry cone of 30, 4 % in a canal of 0.7 mm at the orifice, 0.4 at the foramen.
  const auto radius_mm = [](double z) { return 0.35 + 0.15 * z / kLength_mm; };
  const auto filling = canal().of(radius_mm, [](const glm::dvec3& p) {
    return std::min({0.15 + 0.02 * (p.z + 9.3) - aside(p), p.z + 9.3, -p.z});
  });
  ASSERT_TRUE(filling);
  EXPECT_NEAR(filling->end_mm, -0.2, 0.05);
  const double canal_mm3 = frustum_mm3(0.35, radius_mm(-9.5), 9.5),
               cone_mm3 = frustum_mm3(0.15 + 0.02 * 9.3, 0.15, 9.3);
  EXPECT_NEAR(filling->canal_mm3, canal_mm3, 0.02 * canal_mm3);
  EXPECT_NEAR(filling->share(), cone_mm3 / canal_mm3, 0.02);
}

TEST(RootFilling, BeyondTheForamenIsTold) {
  constexpr double kB = 0.25;
  const auto filling = canal().of([](double) { return kB; },
                                  [](const glm::dvec3& p) {
                                    return std::min({kB - aside(p), p.z + 10.8, -p.z});
                                  });
  ASSERT_TRUE(filling);
  EXPECT_NEAR(filling->end_mm, 1.3, 0.05);
  EXPECT_STREQ(lengthWord(*filling), "long");
  EXPECT_NEAR(filling->extruded_mm3, kPi * kB * kB * 0.8, 0.03 * kPi * kB * kB * 0.8);
  EXPECT_NEAR(filling->share(), 1.0, 0.02);
  EXPECT_EQ(fillingWords(*filling), "filled to +1.3 mm, long, 100 %, no void, 0.16 mm³ beyond the foramen");
}

TEST(RootFilling, ABallOfAirInItIsAVoid) {
  constexpr double kB = 0.5, kBall_mm3 = 4.0 / 3.0 * kPi * 0.3 * 0.3 * 0.3;
  const auto ball = [](const glm::dvec3& p, double radius_mm) {
    return glm::distance(p, kOff + glm::dvec3(0.02, 0.01, -5.0)) - radius_mm;
  };
  const auto with_ball = [&](double radius_mm) {
    return canal().of([](double) { return kB; },
                      [&, radius_mm](const glm::dvec3& p) {
                        return std::min({kB - aside(p), p.z + 9.5, -p.z, ball(p, radius_mm)});
                      });
  };
  const auto filling = with_ball(0.3);
  ASSERT_TRUE(filling);
  ASSERT_EQ(filling->voids.size(), 1U);
  EXPECT_NEAR(filling->voids[0].volume_mm3, kBall_mm3, 0.03 * kBall_mm3);
  EXPECT_NEAR(filling->voids[0].middle_P_mm.z, -5.0, 0.02);
  const double canal_mm3 = kPi * kB * kB * 9.5;
  EXPECT_NEAR(filling->share(), 1.0 - kBall_mm3 / canal_mm3, 0.01);
  // A smaller one is told by its size alone.
  const auto small = with_ball(0.2);
  ASSERT_TRUE(small);
  EXPECT_TRUE(small->voids.empty());
  EXPECT_NEAR(small->largest_void_mm3, 4.0 / 3.0 * kPi * 0.008, 0.05 * 4.0 / 3.0 * kPi * 0.008);
}

TEST(RootFilling, IsNoneWhereNothingWasLaid) {
  EXPECT_FALSE(canal().of([](double) { return 0.3; }, [](const glm::dvec3&) { return -1.0; }));
}

TEST(RootFilling, IsMeasuredAgainWhenItChanges) {
  const Filled& at = canal();
  TreatmentMeter meter(at.tooth, at.before);
  const FileUse files(at.tooth);
  EXPECT_FALSE(meter.measure(files).canals[0].filling);
  const auto lay = [&](double low) {
    const ShapeSolid laid(at.grid, [&](const glm::dvec3& p) { return std::min({kA - aside(p), p.z - low, -p.z}); });
    assets::forVoxels(glm::ivec3(0), at.grid.size / 4, [&](glm::ivec3 block) {
      LaidBlocks::Bytes bytes;
      for (std::size_t v = 0; v < bytes.size(); ++v) bytes[v] = laid.block(block).at(v);
      meter.lay(block, bytes);
    });
    return meter.measure(files).canals[0];
  };
  EXPECT_NEAR(lay(-8.0).filling->end_mm, -1.5, 0.05);
  const TreatedCanal now = lay(-9.5);
  EXPECT_NEAR(now.filling->end_mm, 0.0, 0.05);
  EXPECT_FALSE(now.outcomes.sections[0].is_laid.empty()) << "drawn at 1 mm";
  const TreatedCanal gone = lay(0.0);
  EXPECT_FALSE(gone.filling);
  EXPECT_TRUE(gone.outcomes.sections[0].is_laid.empty());
}

}  // namespace
}  // namespace app::filled_root
