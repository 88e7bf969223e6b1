// How a file in the hand is seen, and what the apex locator shows of it.
#include "app/rehearsal/file_sight.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/rehearsal/locator_watch.h"
#include "assets/tissue.h"

namespace app {
namespace {

/// One straight canal, 10 mm long.
assets::ToothCanals oneCanal() {
  assets::ToothCanals tooth;
  assets::ToothCanal canal;
  canal.name = "distal";
  for (int n = 0; n <= 10; ++n) canal.places.push_back({{0.0, 0.0, -1.0 * n}, 1.0 * n, 0.2, 0.2});
  tooth.canals.push_back(canal);
  return tooth;
}

haptics::Tick fileAt(double z_mm) {
  haptics::Tick tick;
  tick.dt_s = 0.001;
  tick.file.stay = haptics::FileStay::free;
  tick.file.tip_P_mm = {0.0, 0.0, z_mm};
  return tick;
}

TEST(FileSight, TheToothIsClearAndTheTipMagnifiedWhileAFileIsInTheHand) {
  const assets::ToothCanals tooth = oneCanal();
  const haptics::Tool file = haptics::fileTool({.size = 15});
  render::Frame frame;
  showFileSight(tooth, fileAt(-3.0), file, render::ViewMode::iso, frame);
  EXPECT_EQ(frame.mode, render::ViewMode::iso) << "nobody asked for it";
  EXPECT_FALSE(frame.magnified);
  frame.layers.clear_tooth = frame.layers.tip_inset = true;
  showFileSight(tooth, fileAt(-3.0), file, render::ViewMode::iso, frame);
  EXPECT_EQ(frame.mode, render::ViewMode::clear);
  ASSERT_TRUE(frame.magnified);
  EXPECT_EQ(frame.magnified->at_P.mm, glm::dvec3(0.0, 0.0, -3.0));
  EXPECT_EQ(frame.magnified->across_mm, 2.0);
  showFileSight(tooth, fileAt(9.0), file, render::ViewMode::iso, frame);
  EXPECT_FALSE(frame.magnified) << "in the air";
  showFileSight(tooth, fileAt(-3.0), file, render::ViewMode::dvr, frame);
  EXPECT_EQ(frame.mode, render::ViewMode::dvr) << "what was asked for stays";
  showFileSight(tooth, fileAt(-3.0), haptics::Tool(), render::ViewMode::iso, frame);
  EXPECT_EQ(frame.mode, render::ViewMode::iso) << "a bur in the hand";
  EXPECT_FALSE(frame.magnified);
  EXPECT_EQ(fromOrifice_mm(tooth, {0.0, 0.0, -5.0}), 0.0);
  EXPECT_NEAR(fromOrifice_mm(tooth, {3.0, 0.0, 4.0}), 5.0, 1e-12);
}

TEST(LocatorWatch, ShowsTenthsAndRestsBetweenThem) {
  const assets::ToothCanals tooth = oneCanal();
  assets::CtVolume scan;
  scan.grid = {glm::ivec3(40), 1.0, {-20.0, -20.0, -30.0}};
  scan.label.assign(scan.grid.voxelCount(), static_cast<std::uint8_t>(assets::Tissue::dentine));
  LocatorWatch watch(tooth, scan, ApexLocator::Mode::exact, 1);
  EXPECT_EQ(watch.settings(), "exact");
  EXPECT_FALSE(watch.follow(fileAt(5.0), false)) << "over the tooth: nothing is shown";
  EXPECT_TRUE(watch.follow(fileAt(-8.58), false));
  ASSERT_TRUE(watch.told());
  EXPECT_NEAR(watch.told()->left_mm, 1.4, 1e-12);
  EXPECT_EQ(watch.told()->where, "distal");
  EXPECT_FALSE(watch.follow(fileAt(-8.53), false)) << "1.47: rests";
  EXPECT_TRUE(watch.follow(fileAt(-8.50), false));
  EXPECT_NEAR(watch.told()->left_mm, 1.5, 1e-12);
  EXPECT_TRUE(watch.follow(fileAt(-10.2), false));
  EXPECT_TRUE(watch.told()->is_apex);
  haptics::Tick none = fileAt(-8.5);
  none.file.stay = haptics::FileStay::none;
  EXPECT_TRUE(watch.follow(none, false));
  EXPECT_FALSE(watch.told());
}

}  // namespace
}  // namespace app
