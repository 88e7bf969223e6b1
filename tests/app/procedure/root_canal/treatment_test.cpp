// Where a file's tip is, and what its ticks add up to.
#include "app/procedure/root_canal/treatment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "app/procedure/root_canal/canal_tip.h"
#include "app/procedure/root_canal/dense_tooth.h"

namespace app {
namespace {

/// Two straight canals 4 mm apart, 10 mm long, 0.2 mm thick at the radius.
assets::ToothCanals twoCanals() {
  assets::ToothCanals tooth;
  for (const double x : {0.0, 4.0}) {
    assets::ToothCanal canal;
    canal.name = x == 0.0 ? "first" : "second";
    for (int n = 0; n <= 10; ++n) canal.places.push_back({{x, 0.0, -1.0 * n}, 1.0 * n, 0.2, 0.2});
    tooth.canals.push_back(canal);
  }
  return tooth;
}

TEST(DenseTooth, ACubeAtTheGridsEndReadsNoFarther) {
  const assets::VolumeGrid grid{{20, 20, 20}, 0.1, {}};
  std::vector<std::uint8_t> solid(grid.voxelCount() + 40'000, 77);
  std::fill_n(solid.begin(), grid.voxelCount(), std::uint8_t{255});
  const std::span<const std::uint8_t> bytes(solid.data(), grid.voxelCount());
  const auto same = DenseTooth(grid, bytes, bytes).same({16, 16, 16}, 16);
  ASSERT_TRUE(same);
  EXPECT_EQ(same->solid, 255);
}

TEST(CanalTip, IsInTheNearestCanalAsFarAlongAsItIs) {
  const assets::ToothCanals tooth = twoCanals();
  EXPECT_FALSE(canalTip(tooth, {0.0, 0.0, 1.0})) << "over the orifice";
  EXPECT_FALSE(canalTip(tooth, {2.0, 0.0, -5.0})) << "between both";
  const auto first = canalTip(tooth, {0.1, 0.0, -6.25});
  ASSERT_TRUE(first);
  EXPECT_EQ(first->canal, 0u);
  EXPECT_NEAR(first->along_mm, 6.25, 1e-12);
  EXPECT_NEAR(first->aside_mm, 0.1, 1e-12);
  const auto beyond = canalTip(tooth, {4.0, 0.0, -11.5});
  ASSERT_TRUE(beyond);
  EXPECT_EQ(beyond->canal, 1u);
  EXPECT_NEAR(beyond->along_mm, 11.5, 1e-12) << "beyond its foramen";
}

TEST(FileUse, CountsWhatFilesDid) {
  const assets::ToothCanals tooth = twoCanals();
  FileUse use(tooth);
  haptics::Tick tick;
  tick.dt_s = 0.001;
  use.add(tick, 25);
  EXPECT_EQ(use.filing_s(), 0.0) << "no file in the hand";
  tick.file.stay = haptics::FileStay::wall;
  for (int n = 1; n <= 95; ++n) {
    tick.t_s = 0.001 * n;
    tick.file.tip_P_mm = {0.0, 0.0, -0.1 * n};
    tick.file.torque_share = n == 50 ? 0.6 : 0.1;
    tick.file.removed_total_mm3 = 0.001 * n;
    use.add(tick, n < 90 ? 10 : 15);
  }
  tick.file.broken_from_tip_mm = 2.0;
  tick.file.keeps_bend = true;
  use.add(tick, 30);
  tick.file.broken_from_tip_mm = 0.0;
  use.add(tick, 30);
  EXPECT_NEAR(use.filing_s(), 0.097, 1e-9);
  EXPECT_TRUE(use.tip(1).isEmpty());
  EXPECT_NEAR(use.tip(0).error().deepest_mm, 0.0, 1e-9) << "9.5 of 10 mm: the working length";
  EXPECT_EQ(use.size(0), 30) << "within a millimetre of 9.5 mm";
  EXPECT_EQ(use.size(1), 0);
  EXPECT_EQ(use.torque_share(), 0.6);
  EXPECT_NEAR(use.filed_mm3(), 0.095, 1e-12);
  EXPECT_EQ(use.broken(), 1);
  EXPECT_EQ(use.bent(), 1) << "kept through both ticks: once";
  use.add(tick, 25);
  EXPECT_EQ(use.bent(), 2) << "another file";
}

TEST(FileUse, NamesHowAFileIsMoved) {
  FileUse use(twoCanals());
  haptics::Tick tick;
  tick.dt_s = 0.001;
  tick.file.stay = haptics::FileStay::wall;
  // Two millimetres in and out in half a second, along a handle that points down.
  for (int n = 0; n < 4000; ++n) {
    tick.proxy_P.mm = {0.0, 0.0, 20.0 - 0.008 * std::abs(n % 500 - 250)};
    use.add(tick, 25);
  }
  EXPECT_NEAR(use.motion().seconds(FileMotion::filing), 4.0, 0.3);
  Treatment all;
  all.filing_s = 4.0;
  all.motion_s = {1.0, 0.0, 2.5, 0.0};
  EXPECT_EQ(motionWords(all), "watch-winding 62 %, filing 25 %");
}

}  // namespace
}  // namespace app
