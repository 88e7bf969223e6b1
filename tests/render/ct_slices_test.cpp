#include "render/volume/ct_slices.h"

#include <gtest/gtest.h>

#include <functional>

#include "render/gpu/gpu_error.h"
#include "render/volume/bur_distance.h"
#include "render/volume/volume_fields.h"
#include "tests/render/ball_volume.h"

namespace render {
namespace {

constexpr int kEdge = 160;
constexpr double kMmPerPx = CtSlices::kWidth_mm / kEdge;

struct Rgb {
  int r, g, b;
  bool operator==(const Rgb&) const = default;
};

Rgb at(const Image& image, int x, int y) {
  const std::uint8_t* p = &image.rgba[4 * static_cast<std::size_t>(y * image.w + x)];
  return {p[0], p[1], p[2]};
}

/// The pixel at an offset from the centre of the image, mm to the right and downwards.
Rgb pixelAt(const Image& image, double right_mm, double down_mm) {
  return at(image, static_cast<int>(0.5 * kEdge + right_mm / kMmPerPx),
            static_cast<int>(0.5 * kEdge + down_mm / kMmPerPx));
}

struct Scene {
  assets::CtVolume ct;
  std::vector<std::uint8_t> scanned;
  CtScan scan;
  Frame frame;

  /// Grey values by position; solid at 300 HU and more.
  explicit Scene(const std::function<double(glm::dvec3)>& hounsfield, glm::ivec3 size = {150, 160, 170}) {
    const assets::VolumeGrid grid = testing::smallGrid(size, 0.25);
    ct = {grid, {}, {}, {}, {}};
    for (int k = 0; k < size.z; ++k)
      for (int j = 0; j < size.y; ++j)
        for (int i = 0; i < size.x; ++i) {
          const double hu = hounsfield(grid.centre_P_mm({i, j, k}));
          ct.hounsfield.push_back(static_cast<std::int16_t>(std::lround(hu)));
          ct.solid.push_back(hu >= 300.0 ? 255 : 0);
        }
    scan.hounsfield = ct.hounsfield;
    scan.solid = scanned = ct.solid;
    frame.bur_radius_mm = 2.0;
  }
  Image image(SlicePlane plane) const {
    return CtSlices(ct.grid, scan).image(plane, frame, testing::borderedSolid(ct), kEdge);
  }
};

TEST(CtSlices, ShowGreyValuesInABoneWindow) {
  // -750 HU is black, 500 HU middle grey, 1750 HU white; a ramp along x shows in two planes and is even in the third.
  Scene scene([](glm::dvec3 p) { return 500.0 + 100.0 * p.x; });
  for (const SlicePlane plane : {SlicePlane::axial, SlicePlane::coronal}) {
    const Image image = scene.image(plane);
    for (const double x_mm : {-7.0, -3.5, 4.0, 7.0}) {
      const Rgb seen = pixelAt(image, x_mm, 5.0);
      EXPECT_NEAR(seen.r, 127.5 + 255.0 * 100.0 * x_mm / 2500.0, 1.5);
      EXPECT_EQ(seen.r, seen.g);
      EXPECT_EQ(seen.r, seen.b);
    }
  }
  const Image sagittal = scene.image(SlicePlane::sagittal);
  for (const double y_mm : {-7.0, 7.0}) EXPECT_NEAR(pixelAt(sagittal, y_mm, 5.0).r, 127, 2);
}

TEST(CtSlices, HaveRadiologicalOrientation) {
  // One dense block left, posterior and superior of the centre.
  Scene scene([](glm::dvec3 p) { return p.x > 3.0 && p.y > 4.0 && p.z > 5.0 ? 1750.0 : -1000.0; });
  scene.frame.X_PT.translation_mm = {0.0, 0.0, 8.0};
  EXPECT_EQ(pixelAt(scene.image(SlicePlane::axial), 6.0, 7.0).r, 255);  // left to the right, posterior down
  EXPECT_EQ(pixelAt(scene.image(SlicePlane::axial), 6.0, -7.0).r, 0);
  scene.frame.X_PT.translation_mm = {0.0, 8.0, 0.0};
  EXPECT_EQ(pixelAt(scene.image(SlicePlane::coronal), 6.0, -8.0).r, 255);  // superior up
  EXPECT_EQ(pixelAt(scene.image(SlicePlane::coronal), -6.0, -8.0).r, 0);
  scene.frame.X_PT.translation_mm = {8.0, 0.0, 0.0};
  EXPECT_EQ(pixelAt(scene.image(SlicePlane::sagittal), 7.0, -8.0).r, 255);  // posterior to the right
  EXPECT_EQ(pixelAt(scene.image(SlicePlane::sagittal), -7.0, -8.0).r, 0);
}

TEST(CtSlices, MarkCarvedMaterial) {
  Scene scene([](glm::dvec3) { return 1500.0; });
  const Image whole = scene.image(SlicePlane::axial);
  // A pit of 3 mm next to the bur.
  for (std::size_t n = 0; n < scene.ct.solid.size(); ++n) {
    const auto v = static_cast<int>(n);
    const glm::ivec3 size = scene.ct.grid.size;
    const glm::dvec3 p = scene.ct.grid.centre_P_mm({v % size.x, v / size.x % size.y, v / size.x / size.y});
    if (glm::length(p - glm::dvec3(6.0, 6.0, 0.0)) < 3.0) scene.ct.solid[n] = 0;
  }
  const Image carved = scene.image(SlicePlane::axial);
  EXPECT_LT(pixelAt(carved, 6.0, 6.0).g, 20);
  EXPECT_EQ(pixelAt(whole, 6.0, 6.0).g, pixelAt(whole, -6.0, 6.0).g);
  EXPECT_EQ(pixelAt(carved, -6.0, 6.0), pixelAt(whole, -6.0, 6.0));
}

/// Expects the bur's colour within 1.5 px of a point, and not 0.5 mm further in or out.
void expectOutlineAt(const Image& image, glm::dvec2 at_mm, glm::dvec2 outward) {
  const auto is_bur = [&](double off_mm) {
    const Rgb c = pixelAt(image, at_mm.x + off_mm * outward.x, at_mm.y + off_mm * outward.y);
    return c.b > c.r + 60;
  };
  EXPECT_TRUE(is_bur(0.0)) << at_mm.x << " " << at_mm.y;
  EXPECT_FALSE(is_bur(0.5)) << at_mm.x << " " << at_mm.y;
  EXPECT_FALSE(is_bur(-0.5)) << at_mm.x << " " << at_mm.y;
}

TEST(CtSlices, ShowAMovedPieceWithItsGreyValuesWhereItIs) {
  const auto is_tooth = [](const glm::dvec3& p) { return glm::all(glm::lessThan(glm::abs(p), glm::dvec3(2.0))); };
  // Half of it dark: a quarter turn brings that to another side.
  Scene scene([&](const glm::dvec3& p) { return is_tooth(p) ? (p.x < 0.0 ? 600.0 : 1700.0) : -1000.0; });
  const VolumeFields piece(scene.ct.grid, scene.ct.solid, {});
  assets::CtVolume jaw = scene.ct;
  std::ranges::fill(jaw.solid, std::uint8_t{0});
  const glm::dquat quarter(std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5));
  const PlacedFields moved[] = {{&piece, {quarter, {6.0, 0.0, 0.0}}}};
  const Image image = CtSlices(scene.ct.grid, scene.scan)
                          .image(SlicePlane::axial, scene.frame, testing::borderedSolid(jaw), kEdge, nullptr, moved);
  // About z the dark half at -x comes to -y, which an axial slice has above.
  EXPECT_NEAR(pixelAt(image, 6.0, -1.0).r, 255.0 * ((600.0 - 500.0) / 2500.0 + 0.5), 1.0);
  EXPECT_NEAR(pixelAt(image, 6.0, 1.0).r, 255.0 * ((1700.0 - 500.0) / 2500.0 + 0.5), 1.0);
  EXPECT_EQ(pixelAt(image, 9.5, 5.0), (Rgb{0, 0, 0}));
}

TEST(CtSlices, OutlineTheBurExactly) {
  Scene scene([](glm::dvec3) { return 300.0; }, {60, 60, 60});
  scene.frame.bur_radius_mm = 2.5;
  for (const SlicePlane plane : kSlicePlanes) {
    const Image round = scene.image(plane);
    for (const double turn : {0.3, 1.2, 2.0, 4.0})
      expectOutlineAt(round, 2.5 * glm::dvec2(std::cos(turn), std::sin(turn)), {std::cos(turn), std::sin(turn)});
  }
  // A cylinder lying along x (T's z turned to P's x) is a rectangle from above and a circle along its axis.
  scene.frame.bur_form = assets::BurForm::cylinder;
  scene.frame.bur_length_mm = 8.0;
  scene.frame.bur_radius_mm = 1.5;
  scene.frame.X_PT.rotation = glm::dquat(glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0));
  const Image lying = scene.image(SlicePlane::axial);
  expectOutlineAt(lying, {4.0, 0.7}, {1, 0});
  expectOutlineAt(lying, {-4.0, -0.7}, {-1, 0});
  expectOutlineAt(lying, {2.5, 1.5}, {0, 1});
  expectOutlineAt(scene.image(SlicePlane::sagittal), {1.06, 1.06}, {0.71, 0.71});
}

TEST(CtSlices, MeasureTheBurWithTheSignOfItsInside) {
  Frame frame;
  frame.bur_radius_mm = 1.0;
  frame.bur_length_mm = 4.0;
  const auto distance = [&](assets::BurForm form, glm::dvec3 p) {
    frame.bur_form = form;
    return burDistance_mm(frame, p);
  };
  using assets::BurForm;
  EXPECT_NEAR(distance(BurForm::round, {0, 3, 0}), 2.0, 1e-12);
  EXPECT_NEAR(distance(BurForm::capsule, {0, 0, 2.5}), -0.5, 1e-12);
  EXPECT_NEAR(distance(BurForm::capsule, {2, 0, 1}), 1.0, 1e-12);
  EXPECT_NEAR(distance(BurForm::cylinder, {0, 0, 2.5}), 0.5, 1e-12);
  EXPECT_NEAR(distance(BurForm::cylinder, {4, 0, 6}), 5.0, 1e-12);
  EXPECT_NEAR(distance(BurForm::cylinder, {0.75, 0, 0}), -0.25, 1e-12);
  EXPECT_NEAR(distance(BurForm::cone, {0, 0, -2}), 0.0, 1e-12);  // the tip
  EXPECT_NEAR(distance(BurForm::cone, {0, 0, -3}), 1.0, 1e-12);
  EXPECT_NEAR(distance(BurForm::cone, {0, 0, 1.9}), -0.1, 1e-9);  // under its base
  EXPECT_NEAR(distance(BurForm::cone, {0.5, 0, 0}), 0.0, 1e-12);  // half way up
  frame.bur_profile = assets::BurProfile::taper;
  EXPECT_NEAR(distance(BurForm::revolved, {0.6, 0, -2}), 0.0, 1e-12);  // the lower rim
  EXPECT_NEAR(distance(BurForm::revolved, {0.8, 0, 0}), 0.0, 1e-12);   // half way up
  EXPECT_NEAR(distance(BurForm::revolved, {0, 0, -3}), 1.0, 1e-12);
  EXPECT_NEAR(distance(BurForm::revolved, {0, 0, 1.9}), -0.1, 1e-9);
}

TEST(CtSlices, OutlineTheCanal) {
  Scene scene([](glm::dvec3) { return 300.0; }, {60, 60, 60});
  scene.scan.mandibular_canal_P_mm = {{4.0, -20.0, 5.0}, {4.0, 0.0, 5.0}, {4.0, 20.0, 5.0}};
  scene.scan.mandibular_canal_radius_mm = 1.5;
  const Image coronal = scene.image(SlicePlane::coronal);  // across it: a circle, 4 mm to the right, 5 mm up
  const auto is_canal = [&](double x, double y) { return pixelAt(coronal, x, y).r > pixelAt(coronal, x, y).b + 60; };
  for (const double turn : {0.5, 2.5, 4.5})
    EXPECT_TRUE(is_canal(4.0 + 1.5 * std::cos(turn), -5.0 + 1.5 * std::sin(turn))) << turn;
  EXPECT_FALSE(is_canal(4.0, -5.0));
  EXPECT_FALSE(is_canal(4.0 + 2.2, -5.0));
}

TEST(CtSlices, OutlineThePlannedCutWithItsLayerOnly) {
  Scene scene([](glm::dvec3) { return 300.0; }, {80, 80, 80});
  assets::PlannedCut cut;
  cut.bur_radius_mm = 3.0;
  cut.strokes_P_mm = {{{4.0, 3.0, 0.0}}};
  const GuideField guides = guideField(scene.ct.grid, {{}, 1.4, cut});
  const CtSlices slices(scene.ct.grid, scene.scan);
  const auto is_plan = [&](double x, double y) {
    const Image axial = slices.image(SlicePlane::axial, scene.frame, testing::borderedSolid(scene.ct), kEdge, &guides);
    return pixelAt(axial, x, y).b > pixelAt(axial, x, y).r + 60;
  };
  EXPECT_FALSE(is_plan(7.0, 3.0));
  scene.frame.layers.planned_cut = true;
  EXPECT_TRUE(is_plan(7.0, 3.0)) << "3 mm to the right of its middle";
  EXPECT_TRUE(is_plan(4.0, 6.0));
  EXPECT_FALSE(is_plan(4.0, 3.0));
  EXPECT_FALSE(is_plan(8.0, 3.0));
}

TEST(CtSlices, MeasureTheWayFromBurToCanal) {
  CtScan scan;
  Frame frame;
  frame.bur_radius_mm = 1.5;
  EXPECT_FALSE(canalDistance_mm(frame, scan)) << "no canal is known";
  scan.mandibular_canal_P_mm = {{-20.0, 6.0, 0.0}, {20.0, 6.0, 0.0}};
  scan.mandibular_canal_radius_mm = 1.2;
  EXPECT_NEAR(*canalDistance_mm(frame, scan), 6.0 - 1.5 - 1.2, 0.01);
  frame.bur_form = assets::BurForm::cylinder;
  frame.bur_length_mm = 6.0;
  frame.X_PT.rotation = glm::dquat(glm::dvec3(0, 0, 1), glm::dvec3(0, 1, 0));  // its end towards the canal
  EXPECT_NEAR(*canalDistance_mm(frame, scan), 6.0 - 3.0 - 1.2, 0.01);
  frame.X_PT.translation_mm.y = 4.0;
  EXPECT_EQ(*canalDistance_mm(frame, scan), 0.0) << "in touch";
}

TEST(CtSlices, ShowTheWayToTheCanalWhereThereIsRoom) {
  Scene scene([](glm::dvec3) { return -1000.0; }, {60, 60, 60});
  const auto bright = [&] {
    const Image image = scene.image(SlicePlane::axial);
    int count = 0;
    for (int y = kEdge - 28; y < kEdge - 14; ++y)
      for (int x = 0; x < 80; ++x) count += at(image, x, y).r > 150;
    return count;
  };
  EXPECT_EQ(bright(), 0);
  scene.scan.mandibular_canal_P_mm = {{-20.0, 0.0, 30.0}, {20.0, 0.0, 30.0}};
  EXPECT_GT(bright(), 40);
}

TEST(CtSlices, DrawTheRulerWhereItPassesThrough) {
  Scene scene([](glm::dvec3) { return -1000.0; }, {60, 60, 60});
  const auto is_ruler = [&](SlicePlane plane, double x, double y) {
    const Rgb seen = pixelAt(scene.image(plane), x, y);
    return seen.g > 180 && seen.g > seen.r + 100;
  };
  // In the axial plane at its height; it crosses the sagittal one (x = 0) at y = 3.
  scene.frame.ruler = RulerLine{{{-5.0, 3.0, 0.2}}, calibration::Point<calibration::Patient>{{5.0, 3.0, 0.2}}};
  EXPECT_TRUE(is_ruler(SlicePlane::axial, 4.0, 3.0));
  EXPECT_TRUE(is_ruler(SlicePlane::axial, -5.0, 3.0)) << "its first point";
  EXPECT_FALSE(is_ruler(SlicePlane::axial, 6.0, 3.0));
  EXPECT_FALSE(is_ruler(SlicePlane::axial, 4.0, -3.0));
  EXPECT_TRUE(is_ruler(SlicePlane::sagittal, 3.0, -0.2)) << "where it passes through";
  EXPECT_FALSE(is_ruler(SlicePlane::sagittal, 4.5, -0.2));
  const auto words = [&](SlicePlane plane) {
    const Image image = scene.image(plane);
    int bright = 0;
    for (int y = 15; y < 27; ++y)
      for (int x = 0; x < 80; ++x) bright += at(image, x, y).r > 150;
    return bright;
  };
  EXPECT_GT(words(SlicePlane::axial), 40) << "its length";
  scene.frame.ruler->from_P.mm.z = scene.frame.ruler->to_P->mm.z = 2.0;
  EXPECT_FALSE(is_ruler(SlicePlane::axial, 4.0, 3.0)) << "2 mm above";
  EXPECT_EQ(words(SlicePlane::axial), 0);
}

TEST(CtSlices, CanLieBesideTheBur) {
  // Grey values tell the height.
  Scene scene([](glm::dvec3 p) { return 500.0 + 100.0 * p.z; }, {60, 60, 60});
  scene.frame.slices_beside_bur_P_mm = {0.0, 0.0, 4.0};
  const Rgb beside = pixelAt(scene.image(SlicePlane::axial), 5.0, 5.0);
  scene.frame.slices_beside_bur_P_mm = {};
  const Rgb through = pixelAt(scene.image(SlicePlane::axial), 5.0, 5.0);
  EXPECT_NEAR(beside.r - through.r, 255.0 * 400.0 / 2500.0, 2.0);
  // In the other planes the bur's outline is where the bur is.
  scene.frame.slices_beside_bur_P_mm = {0.0, 0.0, 3.0};
  expectOutlineAt(scene.image(SlicePlane::coronal), {0.0, 3.0 + scene.frame.bur_radius_mm}, {0.0, 1.0});
}

TEST(CtSlices, ShowNameSidesAndScale) {
  Scene scene([](glm::dvec3) { return -1000.0; }, {20, 20, 20});
  const Image image = scene.image(SlicePlane::axial);
  const auto bright = [&](int x0, int y0, int x1, int y1) {
    int count = 0;
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) count += at(image, x, y).r > 150;
    return count;
  };
  EXPECT_GT(bright(0, 0, 60, 20), 30);              // the name
  EXPECT_GT(bright(0, 70, 14, 90), 8);              // one side
  EXPECT_GT(bright(kEdge - 14, 70, kEdge, 90), 8);  // the other side
  // The scale: a line of 5 mm.
  int longest = 0;
  for (int y = kEdge - 20; y < kEdge; ++y)
    for (int x = 0, run = 0; x < kEdge; ++x) {
      run = at(image, x, y).r > 200 ? run + 1 : 0;
      longest = std::max(longest, run);
    }
  EXPECT_NEAR(longest * kMmPerPx, 5.0, 2.0 * kMmPerPx);
}

TEST(CtSlices, ShowAirOutsideTheVolume) {
  Scene scene([](glm::dvec3) { return 1750.0; }, {20, 20, 20});
  for (const glm::dvec3& far : {glm::dvec3(500, 0, 0), glm::dvec3(-1e4, 3, 1e6)}) {
    scene.frame.X_PT.translation_mm = far;
    EXPECT_EQ(pixelAt(scene.image(SlicePlane::axial), -7.0, 5.0), (Rgb{0, 0, 0}));
  }
}

TEST(CtSlices, RefuseAScanOfAnotherSize) {
  const assets::VolumeGrid grid = testing::smallGrid({8, 8, 8});
  const std::vector<std::int16_t> hounsfield(511);
  const std::vector<std::uint8_t> solid(512);
  EXPECT_THROW(CtSlices(grid, CtScan{hounsfield, solid, {}, 1.0}), GpuError);
}

}  // namespace
}  // namespace render
