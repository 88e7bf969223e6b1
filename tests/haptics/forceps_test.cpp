#include "haptics/servo/forceps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "haptics/body/piece_split.h"
#include "haptics/servo/servo.h"
#include "tests/haptics/socketed_tooth.h"

namespace haptics {
namespace {

using namespace phantom;

double model_N(const Tick& tick) { return glm::length(tick.grip_force_P_N.xyz); }

TEST(Forceps, GripOnlyAPieceThatIsReadyAndBetweenTheBeaks) {
  Mouth mouth;
  mouth.grip();
  EXPECT_EQ(mouth.tick.gripped, 0) << "not ready";
  mouth.hand.drill_pedal = false;
  mouth.step();
  mouth.makeReady();
  ASSERT_EQ(mouth.tick.site, SiteAnswer::ready);
  mouth.hand.drill_pedal = true;
  mouth.step();
  EXPECT_EQ(mouth.tick.gripped, 1);
  EXPECT_FALSE(mouth.tick.drilling);
  EXPECT_EQ(mouth.tick.spindle_rad_per_s, 0.0);
  mouth.hand.drill_pedal = false;
  mouth.step();
  EXPECT_EQ(mouth.tick.gripped, 0);
  // In the air, with the pedal down beforehand, and with a bur.
  mouth.go({12.0, 0.0, 2.0}, 0.2);
  mouth.hand.drill_pedal = true;
  mouth.step();
  EXPECT_EQ(mouth.tick.gripped, 0);
  mouth.go({2.0, 0.0, 2.0}, 0.2);
  EXPECT_EQ(mouth.tick.gripped, 0) << "the beaks were closed before";
}

TEST(Forceps, AnOrderHoldsForTheBodiesItWasMadeFrom) {
  Mouth mouth;
  mouth.makeReady();
  ASSERT_EQ(mouth.tick.site, SiteAnswer::ready);
  mouth.command.site.bodies_digest ^= 1;
  ++mouth.command.site.serial;
  mouth.step();
  EXPECT_EQ(mouth.tick.site, SiteAnswer::refused);
  mouth.command.site = {mouth.command.site.serial + 1, mouth.bodies.digest(), 0, nullptr};
  mouth.step();
  EXPECT_EQ(mouth.tick.site, SiteAnswer::refused);
  mouth.command.site = {mouth.command.site.serial + 1, mouth.bodies.digest(), 3, mouth.sites.back().get()};
  mouth.step();
  EXPECT_EQ(mouth.tick.site, SiteAnswer::refused);
}

TEST(Forceps, AFirmToothHoldsAndSpringsBack) {
  Mouth mouth;
  mouth.makeReady();
  mouth.grip();
  ASSERT_EQ(mouth.tick.gripped, 1);
  mouth.go({2.0, 0.0, 4.0}, 0.5);
  // 25 N of the model a mm between hand and beaks, and a fiftieth felt; 50 N are below what makes fibres creep.
  const glm::dvec3 apart_mm = mouth.hand.X_PT.translation_mm - mouth.tick.proxy_P.mm;
  EXPECT_LT(glm::distance(mouth.tick.grip_force_P_N.xyz, 25.0 * apart_mm), 0.1);
  EXPECT_LT(glm::distance(mouth.tick.law_force_P_N.xyz, -0.5 * apart_mm), 0.002);
  EXPECT_GT(model_N(mouth.tick), 40.0);
  EXPECT_LT(glm::length(mouth.tick.X_PQ[0].translation_mm), 0.2);
  EXPECT_LT(mouth.tick.torn_share, 1e-3);
  EXPECT_LT(glm::distance(mouth.tick.proxy_P.mm, glm::dvec3(2.0, 0.0, 2.0)), 1.0) << "the tool stays at the tooth";
  mouth.hand.drill_pedal = false;
  mouth.step(400);
  EXPECT_LT(glm::length(mouth.tick.X_PQ[0].translation_mm), 0.05);
  EXPECT_EQ(mouth.tick.gripped, 0);
}

TEST(Forceps, RockingTearsTheLigamentThenTheToothComesOutAndIsSetAside) {
  Mouth mouth;
  mouth.makeReady();
  mouth.grip();
  mouth.rockOut(0.6);
  EXPECT_GE(mouth.tick.torn_share, 0.999);
  EXPECT_GT(mouth.tick.X_PQ[0].translation_mm.z, kOutOfPlace_mm);
  // At least what tears an area of fibres: 0.367 N mm a mm2; the root has some 70 mm2.
  EXPECT_GT(mouth.tick.torn_total_Nmm, 15.0);
  EXPECT_LT(mouth.tick.torn_total_Nmm, 45.0);
  bool was_set_aside = false;
  mouth.hand.drill_pedal = false;
  for (int n = 0; n < 5; ++n) {
    mouth.step();
    was_set_aside = was_set_aside || mouth.tick.set_aside;
  }
  EXPECT_TRUE(was_set_aside);
  EXPECT_TRUE(mouth.bodies.isSetAside(0));
  // Its place is empty: the tool goes in without touching.
  mouth.go({0.0, 0.0, 10.0}, 0.2);
  mouth.go({0.0, 0.0, -1.0}, 0.5);
  EXPECT_EQ(mouth.tick.depth_mm, 0.0);
}

TEST(Forceps, AToothUnderALedgeOfBoneStays) {
  Mouth mouth;
  // Bone over the crown's edge: half of the phantom's top.
  Phantom& phantom = mouth.phantom;
  std::vector<std::uint8_t> solid = phantom.solid;
  assets::forVoxels(phantom.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p = phantom.grid.centre_P_mm(ijk);
    if (p.z > 3.8 && p.z < 5.5 && p.x < 1.0) solid[v] = 255;
  });
  Bodies bodies(phantom.grid, solid, mouth.label, mouth.is_tooth);
  const SocketSource sockets(bodies);
  std::array<PiecePose, kMaxPieces> X_PQ;
  const auto site = makePieceSite(sockets.scene(0, X_PQ), sockets.firstSocket());
  PieceDrive drive;
  drive.spring = {{{1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 12.0}}, {{0.0, 0.0, 2.0}}, 25.0, 8000.0, 165.0, 3000.0};
  for (int n = 0; n < 3000; ++n) site->hold.step(drive, &site->obstacles, 1e-3);
  EXPECT_LT(site->hold.state().X_PQ.translation_mm.z, 1.0);
}

TEST(Forceps, ForceIsBoundedWhateverTheHandDoes) {
  Mouth mouth;
  mouth.makeReady();
  mouth.grip();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> jump(-30.0, 30.0), turn(-1.0, 1.0);
  for (int n = 0; n < 4000; ++n) {
    if (n % 40 == 0) {
      mouth.hand.X_PT.translation_mm = glm::dvec3(4.0, 0.0, 2.0) + glm::dvec3(jump(random), jump(random), jump(random));
      mouth.hand.X_PT.rotation = glm::normalize(glm::dquat(1.0, turn(random), turn(random), turn(random)));
    }
    if (n % 900 == 899) mouth.hand.X_PT.translation_mm.x = std::nan("");
    mouth.hand.drill_pedal = n % 700 < 600;
    mouth.step();
    ASSERT_LE(glm::length(mouth.tick.commanded_force_P_N.xyz), mouth.command.safety.peak_force_N + 1e-9);
    ASSERT_LE(model_N(mouth.tick), ForcepsLaw::kMost_N + 1e-6);
    ASSERT_TRUE(calibration::isFinite(mouth.tick.X_PQ[0].translation_mm));
    ASSERT_TRUE(calibration::isFinite(mouth.tick.commanded_force_P_N.xyz));
  }
}

TEST(Forceps, AToothInANewSocketRemembersWhatIsTorn) {
  Mouth mouth;
  mouth.makeReady();
  mouth.grip();
  const double torn = mouth.loosen();
  ASSERT_GT(torn, 0.3);
  mouth.hand.drill_pedal = false;
  mouth.step(500);
  const auto X_PQ = mouth.tick.X_PQ[0];
  mouth.makeReady();
  ASSERT_EQ(mouth.tick.site, SiteAnswer::ready);
  mouth.hand.X_PT = {{1.0, 0.0, 0.0, 0.0}, mouth.tick.proxy_P.mm};
  mouth.step(5);
  mouth.grip();
  ASSERT_EQ(mouth.tick.gripped, 1);
  EXPECT_GE(mouth.tick.torn_share, torn - 1e-6);
  EXPECT_NEAR(mouth.tick.X_PQ[0].translation_mm.z, X_PQ.translation_mm.z, 0.1);
}

TEST(Forceps, AToothOrBoneThatWasCutSinceIsNotReady) {
  for (const glm::dvec3& where : {glm::dvec3(0.0, 0.0, 3.5), glm::dvec3(5.0, 0.0, 0.0)}) {
    Mouth mouth;
    mouth.makeReady();
    ErosionStep step;
    step.loss.fill(0.5);
    carveTool(mouth.bodies, {ShapeKind::sphere, 0.6, 0.0}, {{1.0, 0.0, 0.0, 0.0}, where}, step, 1);
    mouth.grip();
    EXPECT_EQ(mouth.tick.gripped, 0);
    mouth.hand.drill_pedal = false;
    mouth.step();
    mouth.makeReady();
    mouth.grip();
    EXPECT_EQ(mouth.tick.gripped, 1);
  }
}

TEST(Forceps, PartsOfALooseToothLieWhereItLayAndAreAsLoose) {
  Mouth mouth;
  mouth.makeReady();
  mouth.grip();
  const double torn = mouth.loosen();
  ASSERT_GT(torn, 0.3);
  mouth.hand.drill_pedal = false;
  mouth.go({12.0, 0.0, 6.0}, 0.5);
  // One half comes off.
  const CarvedBone& tooth = mouth.bodies.bones()[1];
  std::vector<std::uint8_t> half = tooth.solidInGridOrder();
  assets::forVoxels(tooth.grid(), [&](glm::ivec3 ijk, std::size_t v) {
    if (tooth.grid().centre_P_mm(ijk).x > 0.0) half[v] = 0;
  });
  const SplitPlan plan = splitPlan(tooth.grid(), half);
  mouth.command.split = {1, mouth.bodies.digest(), 0, &plan};
  mouth.step(60);
  ASSERT_EQ(mouth.tick.split, SplitAnswer::done);
  EXPECT_EQ(mouth.tick.X_PQ[1].translation_mm, mouth.tick.X_PQ[0].translation_mm);
  EXPECT_FALSE(mouth.bodies.isAtRest(1));
  mouth.makeReady(1);
  ASSERT_EQ(mouth.tick.site, SiteAnswer::ready);
  EXPECT_GE(mouth.sites.back()->hold.tornShare(), torn - 1e-6);
  mouth.makeReady(0);
  ASSERT_EQ(mouth.tick.site, SiteAnswer::ready);
  EXPECT_GE(mouth.sites.back()->hold.tornShare(), torn - 1e-6);
}

TEST(Forceps, ThePedalIsReleasedBetweenBurAndForceps) {
  Mouth mouth;
  mouth.makeReady();
  const Tool bur{{ShapeKind::sphere, 0.5, 0.0}, {}, true, false};
  mouth.command.tool = bur;
  mouth.go({2.0, 0.0, 6.0}, 0.2);
  mouth.hand.drill_pedal = true;
  mouth.step(3);
  EXPECT_TRUE(mouth.tick.drilling);
  mouth.command.tool = forcepsTool();
  mouth.go({2.0, 0.0, 2.0}, 0.2);
  EXPECT_EQ(mouth.tick.gripped, 0);
  mouth.hand.drill_pedal = false;
  mouth.step();
  mouth.hand.drill_pedal = true;
  mouth.step();
  EXPECT_EQ(mouth.tick.gripped, 1);
  mouth.command.tool = bur;
  mouth.step(100);
  EXPECT_EQ(mouth.tick.gripped, 0);
  EXPECT_FALSE(mouth.tick.drilling);
  EXPECT_EQ(mouth.tick.removed_mm3, 0.0);
  mouth.hand.drill_pedal = false;
  mouth.step();
  mouth.hand.drill_pedal = true;
  mouth.step();
  EXPECT_TRUE(mouth.tick.drilling);
}

}  // namespace
}  // namespace haptics
