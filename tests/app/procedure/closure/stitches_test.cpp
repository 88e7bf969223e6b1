#include "app/procedure/closure/stitches.h"

#include <gtest/gtest.h>

#include "app/case/impaction_measures.h"

namespace app {
namespace {

const std::vector<glm::dvec3> kPlaces{{0, 0, 0}, {0, 6, 0}, {8, -4, 0}};

struct Hand {
  Stitches stitches{kPlaces};
  haptics::Tool tool = haptics::forcepsTool();
  haptics::Tick tick;

  Hand() {
    tick.dt_s = 1e-3;
    tick.hand.drill_pedal = true;
  }
  /// How many were confirmed.
  int hold(const glm::dvec3& at_P_mm, double seconds) {
    tick.proxy_P.mm = at_P_mm;
    int confirmed = 0;
    for (int n = 0; n < static_cast<int>(1000.0 * seconds + 0.5); ++n) confirmed += stitches.follow(tick, tool) ? 1 : 0;
    return confirmed;
  }
};

TEST(Stitches, AreConfirmedOneByOneByHolding) {
  Hand hand;
  EXPECT_EQ(hand.hold({0.5, 0, 1}, kStitchHold_s - 0.05), 0);
  EXPECT_EQ(hand.hold({0.5, 0, 1}, 0.1), 1);
  EXPECT_TRUE(hand.stitches.places()[0].is_made);
  EXPECT_EQ(hand.hold({0.5, 0, 1}, 2.0), 0) << "its neighbour is too far";
  EXPECT_EQ(hand.hold(kPlaces[1], 1.0) + hand.hold(kPlaces[2], 1.0), 2);
  EXPECT_EQ(hand.stitches.made(), 3);
  EXPECT_EQ(hand.hold(kPlaces[0], 1.0), 0);
}

TEST(Stitches, ABreakBeginsAnew) {
  Hand hand;
  hand.hold(kPlaces[0], 0.8 * kStitchHold_s);
  hand.hold(kPlaces[0] + glm::dvec3(0, 0, 20), 0.01);
  EXPECT_EQ(hand.hold(kPlaces[0], 0.8 * kStitchHold_s), 0);
}

TEST(Stitches, NeitherABurNorAnOpenPedalNorAFullGripMakesOne) {
  Hand bur;
  bur.tool = {};
  EXPECT_EQ(bur.hold(kPlaces[0], 1.0), 0);
  Hand open;
  open.tick.hand.drill_pedal = false;
  EXPECT_EQ(open.hold(kPlaces[0], 1.0), 0);
  Hand holding;
  holding.tick.gripped = 1;
  EXPECT_EQ(holding.hold(kPlaces[0], 1.0), 0);
}

/// A ridge of bone along y, up z, its second molar 37 in the middle: two places behind it, one before on the cheek's
/// side, all over the bone.
TEST(Stitches, LieBehindTheSecondMolarAndAtItsPapilla) {
  assets::Patient patient;
  assets::CtVolume& ct = patient.ct;
  ct.grid = {{80, 160, 80}, 0.5, {-20.0, -40.0, -20.0}};
  ct.solid.assign(ct.grid.voxelCount(), 0);
  ct.label = ct.tooth = ct.solid;
  assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p = ct.grid.centre_P_mm(ijk);
    const bool is_molar = std::abs(p.x) < 5.0 && std::abs(p.y) < 5.0 && p.z > 0.0 && p.z < 8.0;
    const bool is_bone = std::abs(p.x) < 8.0 && p.z < 0.0 && p.z > -12.0;
    ct.solid[v] = is_molar || is_bone ? 255 : 0;
    ct.label[v] = static_cast<std::uint8_t>(is_molar ? assets::Tissue::enamel : assets::Tissue::cortical);
    ct.tooth[v] = is_molar ? 37 : 0;
  });
  EXPECT_TRUE(stitchPlaces_P_mm(patient).empty()) << "no site";
  patient.site.emplace();
  patient.site->fdi = 38;
  const std::vector<glm::dvec3> places = stitchPlaces_P_mm(patient);
  ASSERT_EQ(places.size(), 3u);
  for (const glm::dvec3& p : places) EXPECT_NEAR(p.z, 1.25, 0.6) << "gum over the bone";
  // The arch may run obliquely through the tooth: what it reaches along and across the arch.
  const ArchFrame arch = archFrame(patient);
  double back_mm = -1e9, front_mm = 1e9, cheek_mm = -1e9;
  assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (ct.tooth[v] != 37) return;
    const glm::dvec3 p = ct.grid.centre_P_mm(ijk);
    back_mm = std::max(back_mm, glm::dot(p, arch.distal_P));
    front_mm = std::min(front_mm, glm::dot(p, arch.distal_P));
    cheek_mm = std::max(cheek_mm, glm::dot(p, arch.buccal_P));
  });
  EXPECT_NEAR(glm::dot(places[0], arch.distal_P), back_mm + 2.0, 1e-6);
  EXPECT_NEAR(glm::dot(places[1], arch.distal_P), back_mm + 6.0, 1e-6);
  EXPECT_NEAR(glm::dot(places[2], arch.distal_P), front_mm, 1e-6);
  EXPECT_NEAR(glm::dot(places[2], arch.buccal_P), cheek_mm + 2.5, 1e-6);
  patient.site->fdi = 48;
  EXPECT_TRUE(stitchPlaces_P_mm(patient).empty()) << "no second molar on that side";
}

}  // namespace
}  // namespace app
