#include "app/check_page/import_view.h"

#include <gtest/gtest.h>

#include "app/check_page/import_page.h"
#include "app/check_page/jaw_views.h"
#include "assets/tissue.h"

namespace app {
namespace {

constexpr std::array<glm::ivec2, 3> kSizes{{{90, 60}, {90, 60}, {70, 50}}};

/// Air with one dense cube: on the patient's right, in front, low.
struct Scan {
  explicit Scan(glm::ivec3 size) : grid{size, 0.5, {-10.0, 20.0, 5.0}}, hounsfield(grid.voxelCount(), -1000) {
    assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
      if (isCube(ijk)) hounsfield[v] = 2500;
    });
  }
  bool isCube(const glm::ivec3& ijk) const {
    const glm::dvec3 share = glm::dvec3(ijk) / glm::dvec3(grid.size);
    return glm::all(glm::greaterThan(share, glm::dvec3(0.15))) && glm::all(glm::lessThan(share, glm::dvec3(0.25)));
  }

  assets::VolumeGrid grid;
  std::vector<std::int16_t> hounsfield;
};

/// Middle of the pixels of that kind, as a share of the picture; none: x < 0.
template <class IsSeen>
glm::dvec2 middleOf(const render::Image& picture, const IsSeen& is_seen) {
  glm::dvec2 sum(0.0);
  double count = 0.0;
  for (int y = 0; y < picture.h; ++y)
    for (int x = 0; x < picture.w; ++x)
      if (is_seen(picture.rgba.data() + 4 * (y * picture.w + x))) sum += glm::dvec2(x + 0.5, y + 0.5), count += 1.0;
  return count > 0.0 ? sum / count / glm::dvec2(picture.w, picture.h) : glm::dvec2(-1.0);
}
bool isBright(const std::uint8_t* rgba) { return rgba[0] > 180 && rgba[1] > 180 && rgba[2] > 180; }
bool isColoured(const std::uint8_t* rgba) { return std::abs(rgba[0] - rgba[2]) > 20; }

TEST(ImportView, ShowsTheDensestPlanesOfAScanWithThePatientsRightOnTheLeft) {
  ImportView view;
  EXPECT_FALSE(view.pictures(kSizes));
  // One that is kept as it is, and one that is not.
  for (const int edge : {60, 300}) {
    const Scan scan({edge, edge, edge});
    const std::uint64_t before = view.changes();
    view.takeGrey(scan.grid, scan.hounsfield);
    EXPECT_GT(view.changes(), before);
    const auto pictures = view.pictures(kSizes);
    ASSERT_TRUE(pictures);
    const glm::dvec2 axial = middleOf((*pictures)[ImportView::axial], isBright),
                     coronal = middleOf((*pictures)[ImportView::coronal], isBright),
                     sagittal = middleOf((*pictures)[ImportView::sagittal], isBright);
    // The scan is a square in the middle: 60 px of 90, 50 of 70.
    EXPECT_NEAR(axial.x, (15.0 + 0.2 * 60.0) / 90.0, 0.03) << edge;
    EXPECT_NEAR(axial.y, 0.2, 0.03) << "in front is above";
    EXPECT_NEAR(coronal.x, axial.x, 0.02);
    EXPECT_NEAR(coronal.y, 0.8, 0.03) << "low is below";
    EXPECT_NEAR(sagittal.x, (10.0 + 0.2 * 50.0) / 70.0, 0.03);
    EXPECT_NEAR(sagittal.y, 0.8, 0.03);
  }
}

TEST(ImportView, ColoursWhatWasFoundAndGoesToTheThirdMolar) {
  const Scan scan({60, 60, 60});
  ImportView view;
  view.takeJaw({});  // before there are grey values: nothing
  view.takeGrey(scan.grid, scan.hounsfield);
  assets::JawSegmentation jaw;
  jaw.label.assign(scan.grid.voxelCount(), 0), jaw.tooth = jaw.label;
  // 48 lies elsewhere.
  assets::forVoxels({40, 40, 40}, {50, 50, 50}, [&](glm::ivec3 ijk) {
    jaw.label[scan.grid.index(ijk)] = static_cast<std::uint8_t>(assets::Tissue::dentine);
    jaw.tooth[scan.grid.index(ijk)] = 48;
  });
  const std::uint64_t before = view.changes();
  view.takeJaw({nullptr, nullptr, &jaw});
  EXPECT_GT(view.changes(), before);
  const glm::dvec2 at = middleOf((*view.pictures(kSizes))[ImportView::axial], isColoured);
  EXPECT_NEAR(at.x, (15.0 + 0.75 * 60.0) / 90.0, 0.03);
  EXPECT_NEAR(at.y, 0.75, 0.03);
  // Turned away and back, not beyond the end.
  view.turn(ImportView::axial, 100.0);
  EXPECT_LT(middleOf((*view.pictures(kSizes))[ImportView::axial], isColoured).x, 0.0);
  view.turn(ImportView::axial, -15.0);
  EXPECT_GT(middleOf((*view.pictures(kSizes))[ImportView::axial], isColoured).x, 0.0);
  // Whoever turned it is not taken elsewhere.
  view.turn(ImportView::axial, -30.0);
  view.takeJaw({nullptr, nullptr, &jaw});
  EXPECT_LT(middleOf((*view.pictures(kSizes))[ImportView::axial], isColoured).x, 0.0);
}

TEST(ImportView, ItsBoxesLieBesideTheStagesAndTheButton) {
  for (const glm::ivec2 px : {glm::ivec2(1280, 800), glm::ivec2(1000, 700), glm::ivec2(1920, 1080)}) {
    const auto boxes = importViewBoxes(px);
    for (std::size_t n = 0; n < boxes.size(); ++n) {
      const glm::ivec2 end = boxes[n].corner_px + boxes[n].size_px;
      EXPECT_GT(boxes[n].size_px.x, 150) << px.x;
      EXPECT_GT(boxes[n].size_px.y, 150) << px.x;
      EXPECT_TRUE(glm::all(glm::lessThanEqual(end, px))) << px.x;
      for (int y = boxes[n].corner_px.y; y < end.y; y += 3)
        for (int x = boxes[n].corner_px.x; x < end.x; x += 3) ASSERT_FALSE(isCancelAt({x, y}, px));
      for (std::size_t m = 0; m < n; ++m) {
        const glm::ivec2 low = glm::max(boxes[n].corner_px, boxes[m].corner_px),
                         high = glm::min(end, boxes[m].corner_px + boxes[m].size_px);
        EXPECT_TRUE(glm::any(glm::greaterThanEqual(low, high))) << n << " over " << m;
      }
    }
  }
  EXPECT_EQ(importViewBoxes({800, 600})[0].size_px.x, 0);
}

TEST(ImportView, ItsSlicesAreOnThePage) {
  const Scan scan({60, 60, 60});
  ImportView view;
  view.takeGrey(scan.grid, scan.hounsfield);
  const auto boxes = importViewBoxes({1280, 800});
  const auto slices = view.pictures({boxes[0].size_px, boxes[1].size_px, boxes[2].size_px});
  const render::Image with =
      importPage(ImportStages(expectedImportStages()), 1.0, {"Importing", "", true}, {1280, 800}, &*slices);
  for (std::size_t n = 0; n < boxes.size(); ++n)
    for (int y = 0; y < boxes[n].size_px.y; y += 7)
      ASSERT_TRUE(std::equal((*slices)[n].rgba.begin() + 4 * y * boxes[n].size_px.x,
                             (*slices)[n].rgba.begin() + 4 * (y + 1) * boxes[n].size_px.x,
                             with.rgba.begin() + 4 * ((boxes[n].corner_px.y + y) * 1280 + boxes[n].corner_px.x)))
          << n << " " << y;
}

}  // namespace
}  // namespace app
