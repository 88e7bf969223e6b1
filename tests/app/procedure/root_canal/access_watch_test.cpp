// How the access is drilled: depth and roof, from ticks whose numbers are known.
#include "app/procedure/root_canal/access_watch.h"

#include <gtest/gtest.h>

namespace app {
namespace {

/// A chamber from -1 to 1 mm about the cervix, 2 mm wide; the cusp 7.4 mm over its roof.
assets::ToothCanals molar() {
  assets::ToothCanals tooth;
  tooth.fdi = 46;
  tooth.chamber.outline_mm = {{0.0, 0.0}};
  tooth.chamber.round_mm = 1.0;
  tooth.chamber.roof_mm = 1.0, tooth.chamber.floor_mm = -1.0;
  assets::ToothCanal canal;
  canal.places = {{{0.0, 0.0, -1.0}, 0.0, 0.3, 0.3}, {{0.0, 0.0, -10.0}, 9.0, 0.2, 0.2}};
  canal.reference_P_mm = {0.0, 2.0, 8.4};
  tooth.canals.push_back(canal);
  return tooth;
}

haptics::Tick drillingAt(double t_s, double end_z_mm, double radius_mm, double force_N) {
  haptics::Tick tick;
  tick.t_s = t_s, tick.dt_s = 0.001;
  tick.drilling = true;
  tick.proxy_P.mm = {0.0, 0.0, end_z_mm + radius_mm};
  tick.law_force_P_N.xyz = {0.0, 0.0, force_N};
  return tick;
}

TEST(AccessWatch, TellsDepthBelowTheCuspWhileABurTurnsInTheCrown) {
  const assets::ToothCanals tooth = molar();
  AccessWatch watch(tooth);
  haptics::Tool bur;
  bur.head.radius_mm = 0.6;
  watch.follow(drillingAt(0.0, 9.0, 0.6, 0.0), bur);
  EXPECT_FALSE(watch.belowCusp_mm()) << "above it";
  watch.follow(drillingAt(0.1, 1.9, 0.6, 1.0), bur);
  ASSERT_TRUE(watch.belowCusp_mm());
  EXPECT_NEAR(*watch.belowCusp_mm(), 6.5, 1e-12);
  EXPECT_EQ(depthBand(*watch.belowCusp_mm()), DepthBand::amber);
  haptics::Tick aside = drillingAt(0.2, 1.9, 0.6, 1.0);
  aside.proxy_P.mm.x = 4.0;
  watch.follow(aside, bur);
  EXPECT_FALSE(watch.belowCusp_mm()) << "beside the tooth's middle";
  haptics::Tick still = drillingAt(0.3, 0.0, 0.6, 0.0);
  still.drilling = false;
  watch.follow(still, bur);
  EXPECT_FALSE(watch.belowCusp_mm());
  EXPECT_TRUE(hasDepthBands(37));
  EXPECT_FALSE(hasDepthBands(26));
  EXPECT_FALSE(hasDepthBands(45));
}

TEST(AccessWatch, TellsTheDropThroughTheRoofOnce) {
  const assets::ToothCanals tooth = molar();
  AccessWatch watch(tooth);
  haptics::Tool bur;
  bur.head.radius_mm = 0.6;
  std::vector<RoofDrop> drops;
  const auto at = [&](double t_s, double end_z, double force_N) {
    if (const auto drop = watch.follow(drillingAt(t_s, end_z, 0.6, force_N), bur)) drops.push_back(*drop);
  };
  // 2 mm/s at 1.8 N down to the roof, then 20 mm/s for 60 ms, then rest 1.2 mm below.
  int n = 0;
  for (; n < 500; ++n) at(0.001 * n, 2.0 - 0.002 * n, n < 300 ? 2.5 : 1.8);
  for (int fall = 1; fall <= 60; ++fall, ++n) at(0.001 * n, 1.0 - 0.02 * fall, 0.0);
  for (; n < 2000; ++n) at(0.001 * n, -0.2, 0.0);
  ASSERT_EQ(drops.size(), 1u);
  EXPECT_NEAR(drops[0].t_s, 0.501, 0.0021);
  EXPECT_NEAR(drops[0].force_N, 1.8, 1e-9) << "of the last 100 ms";
  EXPECT_NEAR(drops[0].speed_mm_per_s, 20.0, 0.5);
  EXPECT_NEAR(drops[0].plunge_mm, 1.2, 1e-9);
  EXPECT_EQ(roofDropText(drops[0]).substr(0, 41), "the roof of the chamber is open: 1.8 N be");
}

}  // namespace
}  // namespace app
