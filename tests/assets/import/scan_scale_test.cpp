#include "assets/import/scan_scale.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "assets/load_error.h"
#include "assets/scan/grey_window.h"

namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const assets::VolumeGrid kHeadGrid{{60, 60, 60}, 0.5, {0, 0, 0}};

/// Shares of a head: air, fat, soft tissue, trabecular and cortical bone, enamel; noise of 30 HU.
std::vector<std::int16_t> head(double air, double offset_hu) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 30.0);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::vector<std::int16_t> hounsfield(kHeadGrid.voxelCount());
  for (std::int16_t& value : hounsfield) {
    double at = share(random);
    double grey = -1000.0;
    if (at > air) {
      at = (at - air) / (1.0 - air);
      grey = at < 0.15   ? -90.0
             : at < 0.7  ? 50.0
             : at < 0.85 ? 200.0 + 3000.0 * (at - 0.7)
             : at < 0.97 ? 1300.0
                         : 2400.0;
    }
    value = static_cast<std::int16_t>(std::lround(grey + offset_hu + noise(random)));
  }
  return hounsfield;
}

TEST(ScanScale, AcceptsHounsfieldWithAndWithoutAir) {
  EXPECT_THAT(assets::scaleRemarks(kHeadGrid, head(0.4, 0.0)), IsEmpty());
  EXPECT_THAT(assets::scaleRemarks(kHeadGrid, head(0.0, 0.0)), IsEmpty());
}

TEST(ScanScale, WarnsOfAnOffsetOf1024) {
  for (const double air : {0.4, 0.6, 0.8})
    EXPECT_THAT(assets::scaleRemarks(kHeadGrid, head(air, 1024.0)), ElementsAre(HasSubstr("instead of -1000"))) << air;
}

TEST(ScanScale, WarnsOfMetal) {
  auto hounsfield = head(0.4, 0.0);
  for (std::size_t v = 0; v < 200; ++v) hounsfield[v] = 3071;
  EXPECT_THAT(assets::scaleRemarks(kHeadGrid, hounsfield), ElementsAre(HasSubstr("25 mm3")));
  for (std::size_t v = 0; v < 150; ++v) hounsfield[v] = 100;
  EXPECT_THAT(assets::scaleRemarks(kHeadGrid, hounsfield), IsEmpty()) << "a few bright voxels are noise";
}

TEST(ScanScale, AcceptsTheExtremeValues) {
  const std::vector<std::int16_t> hounsfield(kHeadGrid.voxelCount(), 32767);
  EXPECT_THAT(assets::scaleRemarks(kHeadGrid, hounsfield), testing::SizeIs(1));
}

TEST(GreyWindow, IsNeededForEightBits) {
  std::vector<std::int16_t> greys{0, 51, 255};
  try {
    assets::applyGreyWindow(greys, std::nullopt, "scan.nrrd");
    FAIL();
  } catch (const assets::LoadError& error) {
    EXPECT_THAT(error.what(), HasSubstr("--window"));
  }
  assets::applyGreyWindow(greys, assets::GreyWindow{-1000.0, 3000.0}, "scan.nrrd");
  EXPECT_THAT(greys, ElementsAre(-1000, -200, 3000));
  EXPECT_THROW(assets::applyGreyWindow(greys, assets::GreyWindow{}, "scan.nrrd"), assets::LoadError) << "no 8 bits";
}

}  // namespace
