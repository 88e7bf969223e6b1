#include "app/procedure/gutter_watch.h"

#include <gtest/gtest.h>

#include "app/case/enamel_exposure.h"
#include "app/case/gutter_plan.h"
#include "assets/cut_field.h"
#include "assets/tissue.h"
#include "tests/app/case/block_with_molar.h"

namespace app {
namespace {

struct Site {
  assets::Patient patient = test::blockWithMolar();
  assets::PlannedCut cut = planGutter(patient, 1.5).value();
  assets::CutField field{cut, 1.0};

  /// With the plan carried out where `is_done`.
  template <class IsDone>
  std::vector<std::uint8_t> cutWhere(const IsDone& is_done) const {
    std::vector<std::uint8_t> solid = patient.ct.solid;
    assets::forVoxels(patient.ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
      const glm::dvec3 p = patient.ct.grid.centre_P_mm(ijk);
      if (field.contains(p) && !assets::isTooth(patient.ct.label[v]) && is_done(p)) solid[v] = 0;
    });
    return solid;
  }
  GutterWatch::Shares shares(std::span<const std::uint8_t> solid) const {
    const haptics::Bodies bodies(patient.ct.grid, solid, patient.ct.label);
    GutterWatch watch(patient, patient.ct.solid, cut, bodies);
    EXPECT_FALSE(watch.newest());
    watch.follow({}, 0.0, true);
    return watch.newest().value();
  }
};

TEST(GutterWatch, IsNothingBeforeAndAllAfterThePlan) {
  const Site site;
  const GutterWatch::Shares before = site.shares(site.patient.ct.solid);
  EXPECT_EQ(before.gutter_removed, 0.0);
  EXPECT_EQ(before.crown_bared, 0.0);
  const GutterWatch::Shares after = site.shares(site.cutWhere([](const glm::dvec3&) { return true; }));
  EXPECT_EQ(after.gutter_removed, 1.0);
  EXPECT_EQ(after.crown_bared, 1.0);
}

TEST(GutterWatch, CountsHalfOfThePlanAsASlowCountDoes) {
  const Site site;
  const auto in_front = [](const glm::dvec3& p) { return p.y < 40.0; };
  const std::vector<std::uint8_t> solid = site.cutWhere(in_front);
  const GutterWatch::Shares half = site.shares(solid);
  double gone = 0.0, all = 0.0;
  assets::forVoxels(site.patient.ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p = site.patient.ct.grid.centre_P_mm(ijk);
    if (!site.field.contains(p) || assets::isTooth(site.patient.ct.label[v]) || site.patient.ct.solid[v] < 128) return;
    all += 1.0;
    gone += solid[v] < 128 ? 1.0 : 0.0;
  });
  EXPECT_DOUBLE_EQ(half.gutter_removed, gone / all);
  EXPECT_GT(half.gutter_removed, 0.3);
  EXPECT_LT(half.gutter_removed, 0.7);
  const EnamelExposure slow(site.patient.ct, site.patient.ct.solid, *site.patient.site, site.cut);
  EXPECT_DOUBLE_EQ(half.crown_bared, slow.share(solid));
}

/// By the bricks alone that were named as changed.
TEST(GutterWatch, FollowsTheBurOnceASecond) {
  const Site site;
  haptics::Bodies bodies(site.patient.ct.grid, site.patient.ct.solid, site.patient.ct.label);
  GutterWatch watch(site.patient, site.patient.ct.solid, site.cut, bodies);
  watch.follow({}, 0.0, true);
  const glm::dvec3 at = site.cut.strokes_P_mm.back().front();
  haptics::ErosionStep step;
  step.loss.fill(0.2);
  for (std::uint64_t tick = 0; tick < 10; ++tick)
    haptics::carveTool(bodies, haptics::BurShape{}, {{1.0, 0.0, 0.0, 0.0}, at}, step, tick);
  std::vector<glm::ivec3> bricks;
  bodies.takeDirtyBricks(bricks);
  ASSERT_FALSE(bricks.empty());
  watch.follow(bricks, 0.5, true);
  EXPECT_EQ(watch.newest()->gutter_removed, 0.0) << "half a second later";
  watch.follow({}, 1.0, true);
  const double share = watch.newest()->gutter_removed;
  EXPECT_GT(share, 0.0);
  EXPECT_EQ(share, site.shares(bodies.solidInGridOrder()).gutter_removed);
}

}  // namespace
}  // namespace app
