#include "app/check_page/jaw_views.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "tests/app/check_page/phantom_patient.h"

namespace app {
namespace {

class JawViewsTest : public testing::Test {
 protected:
  static const assets::Patient& patient() {
    static const assets::Patient one = tests::phantomPatient(tests::archPhantom({.spacing_mm = 0.8}));
    return one;
  }
  const JawViews views_{patient(), whatOf(patient().ct)};
};

TEST_F(JawViewsTest, APointOfASliceIsWhereItIsDrawn) {
  const glm::dvec3 cursor = patient().focus_P_mm();
  for (const JawView view : {JawView::axial, JawView::across, JawView::along}) {
    const glm::ivec2 px(420, 330);
    const JawViews::Plane plane = views_.planeOf(view, cursor, {}, px);
    EXPECT_NEAR(plane.of(cursor).z, 0.0, 1e-9);
    const auto p = views_.pointAt(view, cursor, {}, px, glm::dvec2(plane.of(cursor)));
    ASSERT_TRUE(p);
    EXPECT_LT(glm::distance(*p, cursor), 1e-6);
    EXPECT_NEAR(glm::length(glm::cross(plane.right_P, plane.down_P)), 1.0, 1e-9);
  }
  // Radiological: the patient's right is on the left; crowns are up.
  const glm::ivec2 px(420, 330);
  EXPECT_GT(views_.planeOf(JawView::axial, cursor, {}, px).right_P.x, 0.9);
  EXPECT_LT(views_.planeOf(JawView::along, cursor, {}, px).down_P.z, -0.9);
  EXPECT_TRUE(views_.isRight(cursor));
}

TEST_F(JawViewsTest, AToothIsHitFromInFrontAndInThePanoramicView) {
  const tests::ArchPhantom phantom = tests::archPhantom({.spacing_mm = 0.8});
  const glm::ivec2 px(500, 330);
  const glm::dvec3 canine = tests::centreOf(phantom, 43);
  const JawViews::Plane plane = views_.planeOf(JawView::solid, canine, {}, px);
  const auto hit = views_.pointAt(JawView::solid, canine, {}, px, glm::dvec2(plane.of(canine)));
  ASSERT_TRUE(hit);
  EXPECT_LT(glm::distance(*hit, canine), 9.0);
  const auto at = views_.inPanoramic(canine, px);
  ASSERT_TRUE(at);
  const auto unrolled = views_.pointAt(JawView::panoramic, canine, {}, px, *at);
  ASSERT_TRUE(unrolled);
  EXPECT_LT(glm::distance(*unrolled, canine), 1.0);
  EXPECT_LT(glm::distance(views_.nearestOf(43, canine + glm::dvec3(3, 0, 0)), canine), 4.0);
}

TEST_F(JawViewsTest, TheBiteIsLevelInATiltedScan) {
  assets::CtVolume tilted = patient().ct;
  // Sheared by a fifth towards the back: the tops of the teeth rise by that.
  tilted.tooth.assign(tilted.tooth.size(), 0);
  assets::forVoxels(tilted.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::ivec3 to(ijk.x, ijk.y, ijk.z + ijk.y / 5 - 10);
    if (tilted.grid.contains(to)) tilted.tooth[tilted.grid.index(to)] = patient().ct.tooth[v];
  });
  const JawAxes flat = jawAxes(patient().ct), axes = jawAxes(tilted);
  EXPECT_NEAR(flat.back_P.z, 0.0, 0.03);
  EXPECT_NEAR(axes.back_P.z / axes.back_P.y, 0.2, 0.03);
  EXPECT_NEAR(glm::dot(axes.up_P, axes.back_P), 0.0, 1e-9);
}

/// What a brush changes is drawn into a picture as if all of it were drawn anew, whatever bricks held before.
TEST_F(JawViewsTest, APictureOfWhatChangedIsThatOfEverything) {
  std::mt19937 random(5);
  const auto below = [&random](int end) { return static_cast<int>(random() % static_cast<unsigned>(end)); };
  JawViews views(patient(), whatOf(patient().ct));
  const assets::VolumeGrid& grid = patient().ct.grid;
  constexpr glm::ivec2 kPx{160, 120};
  const glm::dvec3 cursor = patient().focus_P_mm();
  int drawn = 0;
  for (int round = 0; round < 24; ++round) {
    const JawView view = static_cast<JawView>(round % static_cast<int>(kJawViews));
    const SolidLook look{0.3 * round, 0.35, round % 2 == 0 ? 1.0 : 2.0};
    render::Image image = views.picture(view, cursor, look, {}, kPx);
    // A ball near the operated tooth, and a voxel anywhere.
    assets::CellBox changed = assets::noCells(grid.size);
    const auto change = [&](const glm::ivec3& ijk) {
      static constexpr std::array<std::uint8_t, 3> kLabels{0, 1, 5};
      const std::uint8_t label = kLabels[static_cast<std::size_t>(below(3))];
      views.takeVoxel(ijk, label, label == 5 ? 46 : 0);
      changed.take(ijk);
    };
    const glm::dvec3 ball = cursor + glm::dvec3(below(9) - 4, below(9) - 4, below(9) - 4);
    assets::forCellsNear(grid.indexFromPoint(ball), 0.5 + below(4), grid.spacing_mm, grid.size,
                         [&](glm::ivec3 ijk, double) { change(ijk); });
    if (round % 3 == 0) change({below(grid.size.x), below(grid.size.y), below(grid.size.z)});
    drawn += views.redraw(view, cursor, look, {}, changed, image) ? 1 : 0;
    EXPECT_TRUE(image.rgba == views.picture(view, cursor, look, {}, kPx).rgba) << round;
    std::vector<std::uint8_t> what = views.what();
    EXPECT_TRUE(views.take(std::move(what)).isEmpty());
    EXPECT_TRUE(image.rgba == views.picture(view, cursor, look, {}, kPx).rgba) << round;
  }
  EXPECT_GT(drawn, 12);
}

TEST_F(JawViewsTest, OtherTeethDifferInABox) {
  JawViews views(patient(), whatOf(patient().ct));
  const assets::VolumeGrid& grid = patient().ct.grid;
  std::vector<std::uint8_t> what = views.what();
  for (const glm::ivec3 at : {glm::ivec3(20, 31, 9), glm::ivec3(17, 40, 12)})
    what[grid.index(at)] = static_cast<std::uint8_t>(what[grid.index(at)] + 1);
  EXPECT_EQ(views.take(std::move(what)), (assets::CellBox{{17, 31, 9}, {21, 41, 13}}));
}

TEST_F(JawViewsTest, DrawsEachTooth) {
  const glm::ivec2 px(300, 240);
  for (const JawView view : {JawView::axial, JawView::across, JawView::along, JawView::panoramic, JawView::solid}) {
    const render::Image image = views_.picture(view, patient().focus_P_mm(), {}, {}, px);
    ASSERT_EQ(image.rgba.size(), 4u * 300u * 240u);
    int coloured = 0;
    for (std::size_t n = 0; n < image.rgba.size(); n += 4)
      coloured += std::abs(image.rgba[n] - image.rgba[n + 2]) > 25 ? 1 : 0;
    EXPECT_GT(coloured, 300) << static_cast<int>(view);
  }
}

}  // namespace
}  // namespace app
