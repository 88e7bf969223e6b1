#include "app/session/measures/outcome.h"

#include <gtest/gtest.h>

#include "app/session/measures/perforation.h"
#include "app/session/measures/section_left.h"
#include "app/session/measures/trough.h"
#include "assets/scan/label_distance.h"
#include "tests/app/session/measures/measure_named.h"
#include "tests/app/session/measures/removal.h"

namespace app {
namespace {

using test::named;

using test::Removal;

constexpr CutAxes kAlongX{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
const auto kAll = [](std::size_t) { return true; };

/// A block up to a height; what the tongue sees lies beyond a side of it.
struct Wall {
  static constexpr double kSide_mm = 6.1, kTop_mm = 8.1;
  Removal cut{{48, 48, 40}};
  assets::StructureDistance tongue;

  Wall() {
    cut.fill([](const glm::dvec3& p) { return std::max(p.x - kSide_mm, p.z - kTop_mm); });
    std::vector<std::uint8_t> beyond(cut.grid.voxelCount(), 0);
    assets::forVoxels(cut.grid, [&](glm::ivec3 ijk, std::size_t v) {
      const glm::dvec3 p = cut.grid.centre_P_mm(ijk);
      beyond[v] = p.x > kSide_mm && p.z < kTop_mm ? 1 : 0;
    });
    tongue = assets::structureDistance(cut.grid, beyond, {6.0, 6.0, 5.0});
  }
  /// Takes a box of voxels away, in one tick.
  void take(const glm::dvec3& low_mm, const glm::dvec3& high_mm) {
    assets::forVoxels(cut.grid, [&](glm::ivec3 ijk, std::size_t v) {
      const glm::dvec3 p = cut.grid.centre_P_mm(ijk);
      if (glm::all(glm::greaterThan(p, low_mm)) && glm::all(glm::lessThan(p, high_mm))) cut.after[v] = 0;
    });
    cut.tool.head.radius_mm = 4.0;
    cut.stand(0.5 * (low_mm + high_mm));
  }
  std::vector<Hole> holes() const {
    const RemovalClock clock = cut.clock();
    return perforations({clock, cut.label, cut.before, cut.after}, tongue, {1.0, 0.0, 0.0});
  }
  std::optional<double> left_mm() const {
    const RemovalClock clock = cut.clock();
    return wallLeft_mm({clock, cut.label, cut.before, cut.after}, tongue);
  }
};

TEST(Perforation, AHoleOfTwoByTwoIsFourSquareMillimetres) {
  Wall wall;
  wall.cut.stand({0.0, 0.0, 0.0});
  wall.take({3.0, 4.0, 3.0}, {7.0, 6.0, 5.0});
  const std::vector<Hole> holes = wall.holes();
  ASSERT_EQ(holes.size(), 1u);
  EXPECT_NEAR(holes[0].area_mm2, 4.0, 4 * 2.0 * 0.25) << "a ring of voxels";
  ASSERT_TRUE(holes[0].first_s);
  EXPECT_NEAR(*holes[0].first_s, 0.001, 1e-9);
  EXPECT_NEAR(holes[0].centre_P_mm.y, 5.0, 0.25);
  EXPECT_EQ(wall.left_mm(), 0.0);
}

TEST(Perforation, OpeningsOfTheCaseDoNotCount) {
  Wall wall;
  assets::forVoxels(wall.cut.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p = wall.cut.grid.centre_P_mm(ijk);
    if (std::abs(p.y - 5.0) < 0.9 && std::abs(p.z - 4.0) < 0.9) wall.cut.before[v] = wall.cut.after[v] = 0;
  });
  EXPECT_TRUE(wall.holes().empty());
  EXPECT_FALSE(wall.left_mm());
}

TEST(Perforation, TheCrestsLingualCortexCutAwayIsBrokenThrough) {
  Wall wall;
  wall.take({4.0, 4.0, 6.0}, {7.0, 7.0, 9.0});
  ASSERT_EQ(wall.holes().size(), 1u);
  EXPECT_NEAR(wall.holes()[0].area_mm2, 3.0 * 2.0, 1.5);
}

TEST(Perforation, TwoHolesApartAreTwo) {
  Wall wall;
  wall.take({3.0, 2.0, 3.0}, {7.0, 4.0, 5.0});
  wall.take({3.0, 7.0, 3.0}, {7.0, 10.0, 5.0});
  ASSERT_EQ(wall.holes().size(), 2u);
  EXPECT_GT(wall.holes()[0].area_mm2, wall.holes()[1].area_mm2);
}

TEST(Perforation, AGrooveOfTwoInAWallOfThreeLeavesOne) {
  Wall wall;
  wall.take({3.0, 2.0, 2.0}, {5.0, 9.0, 9.0});
  EXPECT_TRUE(wall.holes().empty());
  ASSERT_TRUE(wall.left_mm());
  EXPECT_NEAR(*wall.left_mm(), 1.1, 0.25);
}

/// A ball of 1 mm swept 10 mm along a flat surface, half a millimetre deep.
Removal sweptBall() {
  Removal cut({60, 24, 20}, 0.25);
  cut.fill([](const glm::dvec3& p) { return p.z - 3.0; });
  for (int n = 0; n <= 100; ++n) cut.ball({2.5 + 0.1 * n, 3.0, 3.5});
  return cut;
}

TEST(Trough, ASweptBallHasItsSectionDepthAndWidth) {
  const Removal cut = sweptBall();
  const RemovalClock clock = cut.clock();
  const auto profile = troughProfile(clock, kAlongX, kAll, [](const glm::dvec3& p) { return 3.0 - p.z; });
  ASSERT_TRUE(profile);
  EXPECT_NEAR(profile->section_mm2, 0.614, 0.03);
  EXPECT_NEAR(profile->depth_mm.mean, 0.5, 0.25);
  EXPECT_NEAR(profile->width_mm.mean, 1.732, 0.4);
  EXPECT_LT(profile->depth_mm.variation, 0.05);
  EXPECT_NEAR(profile->length_mm, 11.0, 0.6) << "to where the ends are half as large";
  double volume_mm3 = 0.0;
  for (const RemovedVoxel& voxel : clock.removed()) volume_mm3 += voxel.share * cut.grid.voxelVolume_mm3();
  EXPECT_NEAR(volume_mm3, 6.80, 0.25);
}

TEST(Trough, NothingCutHasNoProfile) {
  Removal cut({20, 20, 20});
  cut.fill([](const glm::dvec3& p) { return p.z - 3.0; });
  const RemovalClock clock = cut.clock();
  EXPECT_FALSE(troughProfile(clock, kAlongX, kAll, [](const glm::dvec3&) { return 0.0; }));
  EXPECT_FALSE(gougesIn(clock, kAlongX, kAll));
}

TEST(Gouges, AFlatCutWithAPitOfAMillimetreHasOne) {
  Removal cut({48, 48, 24});
  cut.fill([](const glm::dvec3& p) { return p.z - 5.0; });
  const auto take = [&](glm::dvec3 low_mm, glm::dvec3 high_mm) {
    assets::forVoxels(cut.grid, [&](glm::ivec3 ijk, std::size_t v) {
      const glm::dvec3 p = cut.grid.centre_P_mm(ijk);
      if (glm::all(glm::greaterThan(p, low_mm)) && glm::all(glm::lessThan(p, high_mm))) cut.after[v] = 0;
    });
  };
  take({1.0, 1.0, 4.0}, {11.0, 11.0, 6.0});
  EXPECT_EQ(gougesIn(cut.clock(), kAlongX, kAll)->count, 0) << "flat";
  take({5.0, 5.0, 3.0}, {6.5, 6.5, 6.0});
  const auto gouges = gougesIn(cut.clock(), kAlongX, kAll);
  ASSERT_TRUE(gouges);
  EXPECT_EQ(gouges->count, 1);
  EXPECT_NEAR(gouges->deepest_mm, 1.0, 0.26);
  // A slope is no gouge.
  cut.after = cut.before;
  assets::forVoxels(cut.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p = cut.grid.centre_P_mm(ijk);
    if (p.z > 4.5 - 0.3 * p.x && p.x > 1.0 && p.y > 1.0) cut.after[v] = 0;
  });
  EXPECT_EQ(gougesIn(cut.clock(), kAlongX, kAll)->count, 0) << "a slope";
}

TEST(SectionLeft, ASlotThatLeavesOneByThreeIsThatBridge) {
  Removal cut({64, 28, 40});
  // A bar 3 mm wide and 6 mm high in air.
  cut.fill([](const glm::dvec3& p) {
    const glm::dvec3 q = glm::abs(p - glm::dvec3(8.0, 3.5, 5.0)) - glm::dvec3(6.0, 1.5, 3.0);
    return std::max({q.x, q.y, q.z});
  });
  const std::vector<std::uint8_t> is_tooth(cut.grid.voxelCount(), 1);
  EXPECT_FALSE(sectionLeft(cut.clock(), cut.before, cut.after, is_tooth, {}));
  assets::forVoxels(cut.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p = cut.grid.centre_P_mm(ijk);
    if (std::abs(p.x - 8.0) < 0.8 && p.z > 3.0) cut.after[v] = 0;
  });
  cut.tool.head.radius_mm = 5.0;
  cut.stand({8.0, 3.5, 6.0});
  const auto left = sectionLeft(cut.clock(), cut.before, cut.after, is_tooth, {});
  ASSERT_TRUE(left);
  EXPECT_NEAR(left->thickness_mm, 1.0, 0.26);
  EXPECT_NEAR(left->area_mm2, 3.0, 0.9);
  EXPECT_FALSE(sectionLeft(cut.clock(), cut.before, cut.after, is_tooth, 0.0)) << "before it was cut";
}

TEST(Outcome, OneVoxelOfTheSecondMolarIsItsVolume) {
  Removal cut({20, 20, 20});
  cut.fill([](const glm::dvec3& p) { return p.z - 3.0; });
  StoredStart start;
  start.grid = cut.grid, start.solid = cut.before, start.label = cut.label;
  start.teeth.assign(cut.grid.voxelCount(), 0);
  start.setup.site = assets::OperativeSite{};
  const std::size_t v = cut.grid.index({8, 8, 8});
  start.teeth[v] = 47, start.teeth[v + 1] = 47;
  cut.after[v] = 0, cut.after[v + 100] = 0;
  cut.stand(cut.grid.centre_P_mm({8, 8, 8}));
  const OriginalSurface surface(start.grid, start.solid);
  const SessionCase about;
  std::optional<SocketRecord> socket;
  const auto values = outcomeMeasures({start, cut.after, cut.clock(), &surface, about, socket, {}});
  const MeasureValue& second = named(values, "O10.second_molar");
  EXPECT_NEAR(second.value.value(), 0.25 * 0.25 * 0.25, 1e-12);
  EXPECT_EQ(second.t_s, 0.0);
  EXPECT_EQ(named(values, "O11.count").why, "no piece of the tooth was out at the end");
  EXPECT_FALSE(named(values, "O3.over").value);
  socket.emplace();
  socket->retained = {{3.0, {}}, {1.5, {}}};
  const auto left = outcomeMeasures({start, cut.after, cut.clock(), &surface, about, socket, {}});
  EXPECT_EQ(named(left, "O11.count").value, 2.0);
  EXPECT_EQ(named(left, "O11.volume").value, 4.5);
}

TEST(Outcome, BoneIsCountedByTheSideOfTheToothItLayOn) {
  // A tooth of 2 x 2 x 4 mm in a block; a ball behind it and half a ball on the cheek's side.
  Removal cut({48, 48, 48}, 0.25);
  cut.fill([](const glm::dvec3&) { return -10.0; });
  StoredStart start;
  start.grid = cut.grid, start.solid = cut.before;
  start.label.assign(cut.grid.voxelCount(), static_cast<std::uint8_t>(assets::Tissue::cortical));
  start.is_tooth.assign(cut.grid.voxelCount(), 0);
  const glm::dvec3 tooth(6.0), behind(6.0, 10.0, 6.0), beside(2.5, 6.0, 5.0);
  double behind_mm3 = 0.0, beside_mm3 = 0.0;
  assets::forVoxels(cut.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p = cut.grid.centre_P_mm(ijk), off = glm::abs(p - tooth);
    if (off.x < 1.0 && off.y < 1.0 && off.z < 2.0) {
      start.is_tooth[v] = 1;
      start.label[v] = static_cast<std::uint8_t>(assets::Tissue::dentine);
    }
    if (glm::distance(p, beside) < 1.0) cut.after[v] = 127, beside_mm3 += (128.0 / 255.0) * 0.25 * 0.25 * 0.25;
  });
  cut.tool.head.radius_mm = 1.55;
  cut.ball(behind);
  for (std::size_t v = 0; v < cut.after.size(); ++v)
    behind_mm3 += (cut.before[v] - cut.after[v]) / 255.0 * 0.25 * 0.25 * 0.25;
  behind_mm3 -= beside_mm3;
  SessionCase about;
  about.directions = CaseDirections{};  // distal +y, buccal -x
  const OriginalSurface surface(start.grid, start.solid);
  const std::optional<SocketRecord> socket;
  const auto values = outcomeMeasures({start, cut.after, cut.clock(), &surface, about, socket, {}});
  EXPECT_NEAR(behind_mm3, 15.60, 0.02 * 15.60) << "a ball of 1.55 mm";
  EXPECT_NEAR(named(values, "O1.distal").value.value(), behind_mm3, 1e-3);
  EXPECT_NEAR(named(values, "O1.buccal").value.value(), beside_mm3, 1e-3);
  EXPECT_EQ(named(values, "O1.lingual").value.value(), 0.0);
  EXPECT_NEAR(named(values, "O1.bone").value.value(), behind_mm3 + beside_mm3, 1e-3);
  EXPECT_EQ(named(values, "O1.tooth").value.value(), 0.0);
  // A tooth that is out was not removed by the bur.
  for (std::size_t v = 0; v < cut.after.size(); ++v)
    if (start.is_tooth[v] != 0) cut.after[v] = 0;
  const RemovedByTissue removed{{"dentine", 0.25}, {"cortical", 3.0}};
  EXPECT_EQ(named(outcomeMeasures({start, cut.after, cut.clock(), &surface, about, socket, {}}), "O1.tooth").value,
            0.0);
  EXPECT_EQ(
      named(outcomeMeasures({start, cut.after, cut.clock(), &surface, about, socket, {}, removed}), "O1.tooth").value,
      0.25);
  about.directions.reset();
  const auto untold = outcomeMeasures({start, cut.after, cut.clock(), &surface, about, socket, {}});
  EXPECT_EQ(named(untold, "O1.distal").why, "no operated tooth is known");
}

TEST(Outcome, HalfOfThePlanIsAHalf) {
  Removal cut({20, 20, 20});
  cut.fill([](const glm::dvec3&) { return -10.0; });
  StoredStart start;
  start.grid = cut.grid, start.solid = cut.before, start.label = cut.label;
  SessionCase about;
  about.from_plan_mm = [](const glm::dvec3& p) {
    const glm::dvec3 q = glm::abs(p - glm::dvec3(2.125)) - 1.0;
    return std::max({q.x, q.y, q.z});
  };
  assets::forVoxels(cut.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p = cut.grid.centre_P_mm(ijk);
    if (about.from_plan_mm(p) < 0.0 && p.x < 2.125) cut.after[v] = 0;
  });
  const OriginalSurface surface(start.grid, start.solid);
  const std::optional<SocketRecord> socket;
  const auto values = outcomeMeasures({start, cut.after, cut.clock(), &surface, about, socket, {}});
  EXPECT_NEAR(named(values, "O2.plan").value.value(), 0.5, 0.01);
  EXPECT_NEAR(named(values, "O3.over").value.value(), 0.0, 0.01);
  for (const MeasureValue& value : noOutcome("so")) EXPECT_EQ(value.why, "so");
}

}  // namespace
}  // namespace app
