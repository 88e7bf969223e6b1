#include "app/rehearsal/warnings.h"

#include <gtest/gtest.h>

#include <optional>

#include "assets/soft_tissue.h"

namespace app {
namespace {

using assets::SoftTissue;
using haptics::SafetyState;

struct Scene {
  haptics::Tick tick;
  haptics::Command command;
  assets::Patient patient;
  bool has_motors = false, recording_ended = false;
  std::optional<double> jaw_N_per_mm2, root_N_per_mm2, canal_mm;
  bool is_crown = false, is_blind = false;
  Warnings warnings;

  Scene() {
    tick.dt_s = 0.001;
    tick.state = SafetyState::active;
    patient.ct.grid = {{40, 40, 40}, 0.5, {-10, -10, -10}};
    patient.ct.solid.assign(64000, 255);
    patient.ct.label.assign(64000, 0);
    patient.site.emplace().fdi = 48;
  }
  std::vector<HeadUpWarning> shown() {
    Situation situation = situationOf(tick, command, patient, has_motors, recording_ended);
    situation.jaw_N_per_mm2 = jaw_N_per_mm2;
    situation.root_N_per_mm2 = root_N_per_mm2;
    situation.is_crown = is_crown;
    situation.canal_mm = canal_mm;
    situation.is_blind = is_blind;
    return warnings.update(situation);
  }
  std::string first() {
    const auto all = shown();
    return all.empty() ? "" : all.front().words;
  }
};

TEST(Warnings, NoneAtOrdinaryWork) {
  Scene scene;
  scene.tick.drilling = true;
  scene.tick.depth_mm = 0.2;
  scene.tick.contact_tissue = static_cast<std::uint8_t>(assets::Tissue::cortical);
  scene.tick.law_force_P_N = {{0.0, 0.0, 1.0}};
  EXPECT_TRUE(scene.shown().empty());
}

TEST(Warnings, DryOnlyWhileTurningAndCutting) {
  Scene scene;
  scene.command.irrigating = false;
  scene.tick.drilling = true;
  EXPECT_EQ(scene.first(), "") << "in the air";
  scene.tick.depth_mm = 0.1;
  EXPECT_EQ(scene.first(), "Cutting dry: water on with I");
  scene.tick.t_s = 5.0;
  scene.command.irrigating = true;
  EXPECT_EQ(scene.first(), "");
}

TEST(Warnings, TheNeckOfABurAndNotForceps) {
  Scene scene;
  scene.tick.law_force_P_N = {{0.0, 0.0, 1.0}};
  EXPECT_EQ(scene.first(), "The bur's neck touches");
  Scene with_forceps;
  with_forceps.tick.law_force_P_N = {{0.0, 0.0, 1.0}};
  with_forceps.command.tool = haptics::forcepsTool();
  EXPECT_EQ(with_forceps.first(), "");
}

TEST(Warnings, AnElevatorThatRestsOnANeighbour) {
  Scene scene;
  scene.tick.lever = {1, 400.0, 90.0, 4.0, 100.0, 0.0, {}};
  EXPECT_EQ(scene.first(), "") << "below 5 N";
  scene.tick.lever.on_teeth_N = 40.0;
  EXPECT_EQ(scene.first(), "") << "less than a fifth of what the blade bears";
  scene.tick.lever.on_teeth_N = 60.0;
  EXPECT_EQ(scene.first(), "Elevator rests on a neighbouring tooth");
}

TEST(Warnings, AJawThatAnElevatorBends) {
  Scene scene;
  scene.jaw_N_per_mm2 = 29.0;
  EXPECT_EQ(scene.first(), "");
  scene.jaw_N_per_mm2 = 34.4;
  EXPECT_EQ(scene.first(), "Jaw stressed, 34 MPa");
  scene.jaw_N_per_mm2 = 72.0;
  EXPECT_EQ(scene.first(), "Jaw at risk, 72 MPa: less force");
}

TEST(Warnings, ARootThatForcepsBend) {
  Scene scene;
  scene.root_N_per_mm2 = 39.0;
  EXPECT_EQ(scene.first(), "");
  scene.root_N_per_mm2 = 44.4;
  EXPECT_EQ(scene.first(), "Root stressed, 44 of 60 MPa");
  scene.root_N_per_mm2 = 72.0;
  EXPECT_EQ(scene.first(), "Root would break, 72 MPa: loosen it first");
  scene.is_crown = true;
  EXPECT_EQ(scene.first(), "Crown would break, 72 MPa: loosen it first");
}

TEST(Warnings, StayLongEnoughToBeReadAndAreCountedOnce) {
  Scene scene;
  scene.command.irrigating = false;
  scene.tick.drilling = true;
  for (int n = 0; n < 50; ++n) {
    scene.tick.t_s = 0.01 * n;
    scene.tick.depth_mm = n % 5 == 0 ? 0.1 : 0.0;  // chatter
    EXPECT_NE(scene.first(), "") << n;
  }
  scene.tick.depth_mm = 0.0;
  scene.tick.t_s = 1.2;
  EXPECT_NE(scene.first(), "");
  scene.tick.t_s = 1.3;
  EXPECT_EQ(scene.first(), "");
  ASSERT_EQ(scene.warnings.counts().size(), 1u);
  EXPECT_EQ(scene.warnings.counts()[0].name, "cutting dry");
  EXPECT_EQ(scene.warnings.counts()[0].times, 1);
}

TEST(Warnings, NeighbourToothButNotTheOperatedOne) {
  Scene scene;
  assets::CtVolume& ct = scene.patient.ct;
  ct.tooth.assign(64000, 0);
  assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    ct.tooth[v] = ijk.x >= 30 ? 47 : ijk.x < 10 ? 48 : 0;
  });
  scene.command.tool.head = {haptics::ShapeKind::sphere, 1.5, 0.0};
  scene.tick.contact_tissue = static_cast<std::uint8_t>(assets::Tissue::enamel);
  scene.tick.depth_mm = 0.1;
  scene.tick.proxy_P = {glm::dvec3(4.0, 0.0, 0.0)};  // tooth 47 begins at x = 5
  EXPECT_EQ(scene.first(), "Lower right second molar touched");
  EXPECT_TRUE(scene.shown().front().danger);
  scene.tick.t_s = 2.0;
  scene.tick.proxy_P = {glm::dvec3(3.0, 0.0, 0.0)};
  EXPECT_EQ(scene.first(), "") << "out of reach";
  scene.tick.proxy_P = {glm::dvec3(-5.0, 0.0, 0.0)};
  EXPECT_EQ(scene.first(), "") << "the operated tooth";
}

TEST(Warnings, DistanceToTheNerveBelowTwoMillimetres) {
  Scene scene;
  scene.canal_mm = 3.5;
  EXPECT_EQ(scene.first(), "");
  scene.canal_mm = 1.5;
  scene.is_blind = true;
  EXPECT_EQ(scene.first(), "") << "counted, not told";
  scene.is_blind = false;
  EXPECT_EQ(scene.first(), "Nerve 1.5 mm");
  EXPECT_EQ(scene.warnings.counts().front().times, 1);
  scene.tick.contact_tissue = static_cast<std::uint8_t>(assets::Tissue::mandibular_canal);
  scene.tick.overlap_mm3 = 0.1;
  scene.tick.drilling = true;
  EXPECT_EQ(scene.first(), "Mandibular canal opened");
}

TEST(Warnings, LipAndCheekButNotTheFlapThatIsHeld) {
  Scene scene;
  scene.tick.soft.tissues =
      static_cast<std::uint8_t>(assets::bitOf(SoftTissue::flap) | assets::bitOf(SoftTissue::gingiva));
  EXPECT_EQ(scene.first(), "");
  scene.tick.soft.tissues = static_cast<std::uint8_t>(assets::bitOf(SoftTissue::flap) + assets::bitOf(SoftTissue::lip) +
                                                      assets::bitOf(SoftTissue::cheek));
  EXPECT_EQ(scene.first(), "Lip, cheek touched");
  scene.tick.soft.bur_cuts = SoftTissue::lip;
  EXPECT_EQ(scene.first(), "Bur cuts the lip");
}

TEST(Warnings, MotorsOnlyWhereThereAreMotors) {
  for (const bool motors : {false, true}) {
    Scene scene;
    scene.has_motors = motors;
    scene.tick.faults = haptics::Fault::clamped | haptics::Fault::hot;
    EXPECT_EQ(scene.first(), motors ? "Motors warm: press less or rest" : "");
    Scene off;
    off.has_motors = motors;
    off.tick.state = SafetyState::off;
    EXPECT_EQ(off.first(),
              motors ? "The force is off for the rest of the session. End the rehearsal and start it again." : "");
    Scene ready;
    ready.has_motors = motors;
    ready.tick.state = SafetyState::ready;
    EXPECT_EQ(ready.first().empty(), !motors);
  }
}

TEST(Warnings, DangersComeFirst) {
  Scene scene;
  scene.command.irrigating = false;
  scene.tick.drilling = true;
  scene.tick.depth_mm = 0.1;
  scene.recording_ended = true;
  const auto all = scene.shown();
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0], (HeadUpWarning{"Not recording any more", true}));
  EXPECT_FALSE(all[1].danger);
}

}  // namespace
}  // namespace app
