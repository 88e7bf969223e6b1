#include "app/session/measures/sight.h"
#include "app/session/measures/sight_lines.h"

#include <gtest/gtest.h>

#include "tests/app/session/measures/removal.h"

namespace app {
namespace {

using test::Removal;

constexpr double kSurface_mm = 4.0;

Removal flatCut() {
  Removal cut({40, 40, 40});
  cut.fill([](const glm::dvec3& p) { return p.z - kSurface_mm; });
  for (int n = 0; n < 30; ++n) cut.ball({3.0 + 0.1 * n, 5.0, kSurface_mm + 0.6});
  return cut;
}

std::optional<double> outOfSight(const Removal& cut, const EyesPlace& eyes, const assets::SoftTissueField& soft = {},
                                 bool held = false) {
  const std::vector<EyesFrom> from{{0.0, eyes}};
  const std::vector<HeldFrom> holds{{0.0, held, held}};
  return shareOutOfSight(cut.clock(), {cut.before, cut.after, soft, from, holds});
}

constexpr EyesPlace kAbove{{-26.0, 5.0, 400.0}, {36.0, 5.0, 400.0}, true},
    kBelow{{5.0, 5.0, -400.0}, {6.0, 5.0, -400.0}, true};

TEST(Sight, WhatIsCutBeforeTheEyesIsSeen) { EXPECT_NEAR(outOfSight(flatCut(), kAbove).value(), 0.0, 0.05); }

TEST(Sight, WhatIsCutBehindAWallIsNot) {
  EXPECT_EQ(outOfSight(flatCut(), kBelow), 1.0);
  EXPECT_NEAR(outOfSight(flatCut(), {kBelow.left_P_mm, kAbove.right_P_mm, true}).value(), 0.0, 0.05)
      << "one eye is enough";
}

TEST(Sight, SoftTissueHidesUntilItIsHeldAside) {
  assets::SoftTissueField cheek;
  cheek.grid = {{14, 14, 14}, 1.5, {-4.0, -4.0, 0.0}};
  cheek.distance.assign(cheek.grid.voxelCount(), assets::SoftTissueField::stored(10.0));
  cheek.tissue.assign(cheek.grid.voxelCount(), static_cast<std::uint8_t>(assets::SoftTissue::cheek));
  assets::forVoxels(cheek.grid, [&](glm::ivec3 ijk, std::size_t v) {
    cheek.distance[v] = assets::SoftTissueField::stored(std::abs(cheek.grid.centre_P_mm(ijk).z - 12.0) - 3.0);
  });
  EXPECT_EQ(outOfSight(flatCut(), kAbove, cheek), 1.0);
  EXPECT_NEAR(outOfSight(flatCut(), kAbove, cheek, true).value(), 0.0, 0.05);
}

TEST(Sight, WhereTheBurWorksIsSeenOrNotWhileItWorks) {
  Removal cut({40, 40, 40});
  cut.fill([](const glm::dvec3& p) { return p.z - kSurface_mm; });
  haptics::Tick tick;
  tick.proxy_P.mm = {5.0, 5.0, kSurface_mm + 0.6};
  cut.ball(tick.proxy_P.mm);
  const assets::SoftTissueField none;
  const SightLines lines{cut.grid, cut.after, none, {}};
  tick.drilling = true;
  tick.removed_mm3 = 0.01;
  const haptics::BurShape ball{haptics::ShapeKind::sphere, 1.0, 0.0};
  EXPECT_FALSE(worksOutOfSight(lines, tick, ball, kAbove));
  EXPECT_TRUE(worksOutOfSight(lines, tick, ball, kBelow));
  EXPECT_FALSE(worksOutOfSight(lines, tick, ball, {kBelow.left_P_mm, kAbove.right_P_mm, true})) << "one eye is enough";
  tick.removed_mm3 = 0.0;
  EXPECT_FALSE(worksOutOfSight(lines, tick, ball, kBelow)) << "nothing goes";
  tick.removed_mm3 = 0.01;
  tick.proxy_P.mm.z = 8.0;
  EXPECT_FALSE(worksOutOfSight(lines, tick, ball, kBelow)) << "off the bone";
}

TEST(Sight, NothingCutHasNoShare) {
  Removal cut({8, 8, 8});
  cut.fill([](const glm::dvec3& p) { return p.z - 1.0; });
  EXPECT_FALSE(outOfSight(cut, kAbove));
}

TEST(EyesEvent, ReadsWhatItWrites) {
  const EyesPlace eyes{{1.5, -2.0, 1e3}, {64.5, -2.0, 1e3}, true};
  const auto read = eyesFrom(eyesText(eyes));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->left_P_mm, eyes.left_P_mm);
  EXPECT_EQ(read->right_P_mm, eyes.right_P_mm);
  EXPECT_TRUE(read->in_stereo);
  for (const char* text : {"", "{}", "[1]", R"({"left_P_mm":[1,2],"right_P_mm":[1,2,3]})",
                           R"({"left_P_mm":[1,2,1e9],"right_P_mm":[1,2,3]})"})
    EXPECT_FALSE(eyesFrom(text)) << text;
}

}  // namespace
}  // namespace app
