#include "app/rehearsal/touches.h"

#include <gtest/gtest.h>

#include "app/case/risk_structures.h"
#include "assets/scan/label_distance.h"
#include "assets/tissue.h"

namespace app {
namespace {

/// Tooth 47 left of x = -3 mm, 48 right of x = 3 mm, bone between them; the canal along x, 6 mm below the middle.
struct Jaw {
  assets::Patient patient;
  haptics::Tool round{{haptics::ShapeKind::sphere, 1.5, 0.0}, {}};
  assets::StructureDistance canal;
  std::vector<haptics::Tick> ticks;

  Jaw() {
    assets::CtVolume& ct = patient.ct;
    ct.grid = {{40, 40, 40}, 0.5, glm::dvec3(-9.75)};
    ct.solid.assign(64000, 255);
    ct.label.assign(64000, static_cast<std::uint8_t>(assets::Tissue::cortical));
    ct.tooth.assign(64000, 0);
    for (std::size_t v = 0; v < ct.tooth.size(); ++v) {
      const double x = ct.grid.centre_P_mm({static_cast<int>(v) % 40, 0, 0}).x;
      ct.tooth[v] = x < -3.0 ? 47 : x > 3.0 ? 48 : 0;
    }
    patient.site.emplace().fdi = 48;
    patient.mandibular_canal_P_mm = {{-9.0, 0.0, -6.0}, {9.0, 0.0, -6.0}};
    patient.mandibular_canal_radius_mm = 1.0;
    canal = assets::structureDistance(ct.grid, voxelsOf(assets::RiskStructure::canal, patient), glm::dvec3(0.0));
  }
  /// Ticks of a millisecond with the bur there.
  void stay(int ms, const glm::dvec3& at_P_mm, bool in_contact, assets::Tissue tissue = assets::Tissue::enamel) {
    for (int n = 0; n < ms; ++n) {
      haptics::Tick tick;
      tick.dt_s = 0.001;
      tick.t_s = 0.001 * static_cast<double>(ticks.size());
      tick.proxy_P.mm = at_P_mm;
      tick.depth_mm = in_contact ? 0.05 : 0.0;
      tick.contact_tissue = static_cast<std::uint8_t>(tissue);
      ticks.push_back(tick);
    }
  }
};

TEST(Touches, CountTouchesShorterThanAFrameAndJoinThoseWithoutAPause) {
  Jaw jaw;
  const glm::dvec3 at_47{-4.0, 0.0, 0.0};
  jaw.stay(100, at_47, false);
  jaw.stay(3, at_47, true);
  jaw.stay(200, at_47, false);  // less than the pause: the same touch
  jaw.stay(2, at_47, true);
  jaw.stay(300, at_47, false);
  jaw.stay(40, at_47, true);
  // In frames of a sixtieth of a second.
  Touches touches(jaw.patient, jaw.canal);
  std::size_t ended = 0;
  for (std::size_t from = 0; from < jaw.ticks.size(); from += 17)
    ended +=
        touches
            .follow(std::span(jaw.ticks).subspan(from, std::min<std::size_t>(17, jaw.ticks.size() - from)), jaw.round)
            .size();
  EXPECT_EQ(ended, 1u) << "the second is still on";
  const std::vector<Touch> last = touches.finish();
  ASSERT_EQ(last.size(), 1u);
  EXPECT_EQ(last[0].what, "lower right second molar");
  EXPECT_NEAR(last[0].contact_s, 0.040, 1e-12);
  ASSERT_EQ(touches.counts().size(), 1u);
  EXPECT_EQ(touches.counts()[0].times, 2);
  EXPECT_NEAR(touches.counts()[0].contact_s, 0.045, 1e-12);
  EXPECT_TRUE(touches.finish().empty());
}

TEST(Touches, TellTheTeethApartAndLeaveBoneOut) {
  Jaw jaw;
  jaw.stay(10, {4.0, 0.0, 0.0}, true);
  jaw.stay(10, {4.0, 0.0, 0.0}, true, assets::Tissue::cortical);
  jaw.stay(10, {0.0, 0.0, 0.0}, true);  // farther than its radius and half a voxel from both
  jaw.stay(10, {-4.4, 0.0, 0.0}, false);
  Touches touches(jaw.patient, jaw.canal);
  touches.follow(jaw.ticks, jaw.round);
  touches.finish();
  ASSERT_EQ(touches.counts().size(), 1u);
  EXPECT_EQ(touches.counts()[0].what, "lower right third molar");
  EXPECT_NEAR(touches.counts()[0].contact_s, 0.010, 1e-12);
}

TEST(Touches, AreOfABurAlone) {
  Jaw jaw;
  jaw.stay(10, {-4.0, 0.0, 0.0}, true);
  jaw.stay(10, {1.0, 0.0, -3.8}, true, assets::Tissue::trabecular);
  for (const haptics::Tool& tool : {haptics::handInstrumentTool(haptics::HandInstrument::curette),
                                    haptics::elevatorTool(haptics::ElevatorKind::straight_301)}) {
    Touches touches(jaw.patient, jaw.canal);
    touches.follow(jaw.ticks, tool);
    touches.finish();
    EXPECT_TRUE(touches.counts().empty());
  }
}

TEST(Touches, ReachTheCanalWhereTheHeadMeetsItsWall) {
  Jaw jaw;
  // To half a voxel: the labels' own.
  jaw.stay(10, {1.0, 0.0, -3.2}, true, assets::Tissue::trabecular);
  jaw.stay(20, {1.0, 0.0, -3.8}, true, assets::Tissue::trabecular);
  jaw.stay(30, {1.0, 0.0, -3.8}, false, assets::Tissue::trabecular);
  Touches touches(jaw.patient, jaw.canal);
  touches.follow(jaw.ticks, jaw.round);
  touches.finish();
  ASSERT_EQ(touches.counts().size(), 1u);
  EXPECT_EQ(touches.counts()[0].what, "mandibular canal");
  EXPECT_NEAR(touches.counts()[0].contact_s, 0.020, 1e-12);
}

TEST(Touches, AreTheSameAgainFromTheEventsOfARecording) {
  std::vector<TouchCount> counts;
  for (const Touch& touch : {Touch{"lower right second molar", 0.412}, Touch{"mandibular canal", 0.1},
                             Touch{"lower right second molar", 0.42}}) {
    const auto again = touchFrom(touchText(touch));
    ASSERT_TRUE(again);
    EXPECT_EQ(again->what, touch.what);
    EXPECT_NEAR(again->contact_s, touch.contact_s, 1e-9);
    countInto(counts, *again);
  }
  EXPECT_EQ(touchesText(counts), "lower right second molar 2 times, 0.8 s; mandibular canal once, 0.1 s");
  EXPECT_FALSE(touchFrom(kTouchCounting));
  EXPECT_FALSE(touchFrom("tooth: x s"));
  EXPECT_EQ(touchesText({}), "");
}

}  // namespace
}  // namespace app
