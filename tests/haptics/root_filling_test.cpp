// A root filling in the servo: a cone of gutta-percha goes into a canal of closed form, binds, stays, is packed,
// undone.
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "haptics/bone/lay.h"
#include "haptics/bone/lay_cone.h"
#include "haptics/file/cone_chain.h"
#include "haptics/servo/servo.h"
#include "tests/haptics/allocation_count.h"
#include "tests/haptics/file_scene.h"

namespace haptics {
namespace {

constexpr double kTick_s = 1e-3, kPi = std::numbers::pi;

double frustum_mm3(double r0, double r1, double h) { return kPi * h / 3.0 * (r0 * r0 + r0 * r1 + r1 * r1); }

/// 16 mm straight, 0.6 mm wide at the orifice, 0.25 at the foramen.
assets::RootCanal straightCanal() { return {16.0, 5.0, 0.0, 0.0, 0.30, 0.125, 1.0, 0.0}; }

CanalFile coneOf(std::uint64_t size, double taper, double sealer_mm3 = 0.0) {
  CanalFile cone{.size = size, .length_mm = 21.0};
  cone.cone_taper = taper, cone.sealer_mm3 = sealer_mm3;
  return cone;
}

/// Servo, tooth and a hand with a cone over the orifice, which lies 3 mm below where files are read.
struct Obturator {
  phantom::CanalWall canal;
  Bodies bodies;
  Servo servo{bodies};
  HandSample hand;
  Command command;
  Tick tick;

  explicit Obturator(const CanalFile& cone, const assets::RootCanal& of = straightCanal())
      : canal(of), bodies(CarvedBone(canal.field.grid, canal.field.solid, {})) {
    command.serial = 1;
    command.tool = fileTool(cone);
    command.file_reference = {{0.0, 0.0, 3.0}, {0.0, 0.0, 1.0}, 3.0};
    command.safety.must_be_armed = false;
    hand.X_PT.translation_mm = {0.0, 0.0, 21.5};
    hand.held = hand.fresh = hand.calibrated = hand.device_healthy = true;
    for (int n = 0; n < 100; ++n) step();
  }
  void step() { tick = servo.step(hand, command, kTick_s); }
  void move(double up_mm) {
    hand.X_PT.translation_mm.z += up_mm;
    hand.velocity_P_mm_per_s.xyz = {0.0, 0.0, up_mm / kTick_s};
    step();
  }
  void wait(int ticks) {
    for (int n = 0; n < ticks; ++n) move(0.0);
  }
  /// The hand, so that a straight cone's tip would be there.
  void push(double to_mm) {
    while (21.0 - hand.X_PT.translation_mm.z < to_mm) move(-0.01);
    wait(100);
  }
  double tip_mm() const { return -tick.file.tip_P_mm.z; }
  void letGo() {
    hand.drill_pedal = true;
    wait(1500);
    hand.drill_pedal = false;
  }
  void takeOut() {
    while (hand.X_PT.translation_mm.z < 21.5) move(0.03);
    wait(20);
  }
  void take(const Tool& tool) {
    command.tool = tool;
    ++command.serial;
    step();
  }
  const Filling& filling() const { return *bodies.filling(); }
  /// The lowest voxel that is half laid.
  double lowest_mm() const {
    const SolidField laid = filling().field();
    for (int k = 0; k < laid.grid.size.z; ++k)
      for (int j = 0; j < laid.grid.size.y; ++j)
        for (int i = 0; i < laid.grid.size.x; ++i)
          if (laid.solidAt({i, j, k}) >= 128) return -laid.grid.centre_P_mm(glm::ivec3(i, j, k)).z;
    return 0.0;
  }
};

TEST(Cone, IsAsSoftAsItsMaterialAndItsSection) {
  const auto cone = *assets::guttaPerchaCone(30, 0.04, 21.0);
  EXPECT_DOUBLE_EQ(cone.diameter_mm(10.0), 0.7);
  const FileChain chain = coneChain(cone, kUsualLinks);
  EXPECT_DOUBLE_EQ(chain.radius_mm[kUsualLinks], 0.15);
  EXPECT_NEAR(chain.radius_mm[0], 0.5 * (0.30 + 0.04 * 21.0), 1e-12);
  // E I of the joint before the last link, 0.65625 mm from the tip.
  const double d = 0.30 + 0.04 * 21.0 / 32.0;
  EXPECT_NEAR(chain.bend[kUsualLinks].stiffness_Nmm_per_rad, 100.0 * kPi * d * d * d * d / 64.0 / (21.0 / 32.0), 1e-9);
  EXPECT_FALSE(assets::guttaPerchaCone(27, 0.04, 21.0));
  EXPECT_FALSE(assets::guttaPerchaCone(30, 0.05, 21.0));
  EXPECT_FALSE(assets::guttaPerchaCone(65, 0.04, 21.0));
  EXPECT_FALSE(assets::guttaPerchaCone(30, 0.04, std::nan("")));
}

TEST(Cone, IsLaidWithItsVolumeUpToWhereItIsSearedOff) {
  // In air, oblique, in three links.
  assets::VolumeGrid grid{glm::ivec3(120), 0.04, glm::dvec3(-2.4)};
  const std::vector<std::uint8_t> air(grid.voxelCount(), 0);
  Bodies bodies(CarvedBone(grid, air, {}));
  LaidCone cone;
  cone.nodes = 4;
  const glm::dvec3 way = glm::normalize(glm::dvec3(0.3, 0.2, -1.0)), start = -1.5 * way;
  for (std::size_t n = 0; n < 4; ++n) {
    cone.node_P_mm[n] = start + static_cast<double>(n) * way;
    cone.radius_mm[n] = 0.5 - 0.1 * static_cast<double>(n);
  }
  cone.out_P = -way;
  cone.seared_P_mm = start + way;
  ConeLaying laying;
  laying.begin(cone, 3);
  std::int64_t steps = 0;
  int ticks = 0;
  for (; laying.isRunning() && ticks < 10000; ++ticks)
    steps += laying.step(bodies.jaw().field(), *bodies.filling(), nullptr);
  EXPECT_LT(ticks, 1000);
  const double laid_mm3 = static_cast<double>(steps) * grid.voxelVolume_mm3() / 255.0;
  EXPECT_NEAR(laid_mm3, frustum_mm3(0.4, 0.2, 2.0), 0.01 * frustum_mm3(0.4, 0.2, 2.0));
  EXPECT_DOUBLE_EQ(bodies.filling()->volume_mm3(assets::Tissue::gutta_percha), laid_mm3);
  // With sealer it brings no more than it has, from the tip on: nothing of it is near the upper end.
  Bodies others(CarvedBone(grid, air, {}));
  cone.sealer_mm3 = 0.1;
  laying.begin(cone, 4);
  while (laying.isRunning()) laying.step(others.jaw().field(), *others.filling(), nullptr);
  EXPECT_NEAR(others.filling()->volume_mm3(), laid_mm3 + 0.1, 1e-3);
  const SolidField field = others.filling()->field();
  const glm::dvec3 beside = start + 1.2 * way + 0.45 * glm::normalize(glm::cross(way, glm::dvec3(1.0, 0.0, 0.0)));
  EXPECT_EQ(field.solidAt(glm::ivec3(glm::round(grid.indexFromPoint(beside)))), 0);
  cone.node_P_mm[2].x = std::nan("");
  laying.begin(cone, 5);
  EXPECT_FALSE(laying.isRunning());
}

TEST(Cone, BindsWhereItIsAsThickAsTheCanalAndTugsBack) {
  // A canal of 0.30 mm at 13.71 mm; the cone's taper is nearly its own.
  Obturator at(coneOf(30, 0.02));
  at.push(14.6);
  EXPECT_EQ(at.tick.file.stay, FileStay::wall);
  EXPECT_NEAR(at.tip_mm(), 13.71, 0.35);
  EXPECT_EQ(at.tick.removed_total_mm3[0], 0.0) << "it takes nothing";
  const double bound_mm = at.tip_mm();
  // Drawn back by what the spring was pressed, and a little more: it still holds.
  double strongest_N = 0.0;
  for (int n = 0; n < 130; ++n) {
    at.move(0.01);
    strongest_N = std::max(strongest_N, -at.tick.law_force_P_N.xyz.z);
  }
  EXPECT_GT(strongest_N, 0.05) << "tug-back";
  EXPECT_LT(at.tip_mm(), bound_mm + 0.01);
  // A thinner one goes to the end.
  Obturator thin(coneOf(15, 0.02));
  thin.push(15.5);
  EXPECT_NEAR(thin.tip_mm(), 15.5, 0.1);
}

TEST(Cone, StaysWhereItIsLetGoOfIsUndoneAndDoneAgain) {
  Obturator at(coneOf(20, 0.02));
  at.push(15.5);
  const double tip_mm = at.tip_mm();
  at.letGo();
  EXPECT_EQ(at.tick.file.stay, FileStay::through) << "nothing is felt until the hand is out";
  EXPECT_EQ(glm::length(at.tick.law_force_P_N.xyz), 0.0);
  const double expected = frustum_mm3(0.1 + 0.01 * tip_mm, 0.1, tip_mm);
  EXPECT_NEAR(at.filling().volume_mm3(), expected, 0.02 * expected);
  EXPECT_NEAR(at.lowest_mm(), tip_mm, 0.04);
  EXPECT_EQ(at.tick.filling.increment, 1);
  EXPECT_EQ(at.tick.strokes, 1);
  const std::uint64_t filled = at.tick.bone_digest;
  at.takeOut();
  EXPECT_EQ(at.tick.file.stay, FileStay::free) << "the next one";
  ++at.command.undo_serial, ++at.command.serial;
  at.wait(200);
  EXPECT_TRUE(at.filling().isEmpty());
  ++at.command.redo_serial, ++at.command.serial;
  at.wait(200);
  EXPECT_EQ(at.tick.bone_digest, filled);
}

TEST(Cone, AnUndoWhileItIsLaidEndsIt) {
  Obturator at(coneOf(20, 0.02));
  at.push(15.0);
  at.hand.drill_pedal = true;
  at.wait(20);
  EXPECT_TRUE(at.tick.filling.works);
  EXPECT_FALSE(at.filling().isEmpty());
  ++at.command.undo_serial, ++at.command.serial;
  at.wait(600);
  EXPECT_TRUE(at.filling().isEmpty());
  EXPECT_FALSE(at.tick.filling.works);
}

TEST(Cone, ItsSealerFillsWhatIsBesideIt) {
  double dry_mm3 = 0.0;
  for (const double sealer_mm3 : {0.0, 0.4, 20.0}) {
    Obturator at(coneOf(20, 0.02, sealer_mm3));
    at.push(15.0);
    at.letGo();
    if (sealer_mm3 == 0.0) dry_mm3 = at.filling().volume_mm3();
    const double more_mm3 = at.filling().volume_mm3() - dry_mm3;
    EXPECT_LE(more_mm3, sealer_mm3 + 1e-9);
    if (sealer_mm3 == 0.4) {
      EXPECT_NEAR(more_mm3, 0.4, 1e-3);
    }
    // The ring is thinner than its coat: with enough of it the canal is full down to the tip.
    const double canal_mm3 = frustum_mm3(0.3, 0.3 - 0.175 * 15.0 / 16.0, 15.0);
    if (sealer_mm3 == 20.0) {
      EXPECT_NEAR(at.filling().volume_mm3(), canal_mm3, 0.03 * canal_mm3);
    }
  }
}

TEST(Cone, TheNextOneFindsItsPlaceBesideTheFirst) {
  assets::RootCanal wide = straightCanal();
  wide.orifice_radius_mm = 0.6, wide.apex_radius_mm = 0.2;
  Obturator at(coneOf(25, 0.02), wide);
  at.push(15.0);
  at.letGo();
  at.takeOut();
  const double first_mm3 = at.filling().volume_mm3();
  at.take(fileTool(coneOf(15, 0.02)));
  at.push(14.0);
  EXPECT_EQ(at.tick.file.stay, FileStay::wall);
  EXPECT_LT(at.tip_mm(), 13.5) << "it meets the first";
  EXPECT_GT(at.tip_mm(), 5.0);
  const double second_mm = at.tip_mm();
  at.letGo();
  const double second_mm3 = frustum_mm3(0.075 + 0.01 * second_mm, 0.075, second_mm);
  EXPECT_NEAR(at.filling().volume_mm3() - first_mm3, second_mm3, 0.06 * second_mm3) << "hardly any of it in the other";
  EXPECT_EQ(at.tick.filling.increment, 2);
}

TEST(Cone, IsNotLetGoOfOutsideOfTheTooth) {
  Obturator at(coneOf(20, 0.02));
  at.letGo();
  EXPECT_TRUE(at.filling().isEmpty());
  EXPECT_EQ(at.tick.file.stay, FileStay::free);
}

TEST(RootPlugger, PressesWhatIsWarmOnWhereThereIsRoom) {
  // A dry cone that is too thin, to 12 of 16 mm.
  assets::RootCanal wide = straightCanal();
  wide.orifice_radius_mm = 0.5, wide.apex_radius_mm = 0.3;
  Obturator at(coneOf(40, 0.02), wide);
  at.push(12.0);
  at.letGo();
  at.takeOut();
  const double laid_mm3 = at.filling().volume_mm3(), tip_mm = at.lowest_mm();
  const auto below_mm3 = [&](double mm) {
    const SolidField laid = at.filling().field();
    double sum = 0.0;
    assets::forVoxels(laid.grid, [&](glm::ivec3 ijk, std::size_t) {
      if (laid.grid.centre_P_mm(ijk).z < -mm) sum += laid.solidAt(ijk) / 255.0 * laid.grid.voxelVolume_mm3();
    });
    return sum;
  };
  const double before_mm3 = below_mm3(4.0);
  at.take(handInstrumentTool(HandInstrument::root_plugger));
  at.hand.X_PT.translation_mm = {0.0, 0.0, 0.4};
  at.wait(100);
  at.hand.drill_pedal = true;
  double packed_mm3 = 0.0;
  for (int n = 0; n < 4000; ++n) {
    at.move(n < 3000 ? -0.0015 : 0.0);
    packed_mm3 += at.tick.filling.packed_mm3;
    ASSERT_NEAR(at.filling().volume_mm3(), laid_mm3, 1e-9) << "nothing is lost";
  }
  EXPECT_GT(packed_mm3, 0.3);
  EXPECT_LT(at.tick.proxy_P.mm.z, -2.0) << "it has gone down";
  EXPECT_GT(below_mm3(4.0), before_mm3 + 0.1) << "and gutta-percha with it";
  EXPECT_NEAR(at.lowest_mm(), tip_mm, 0.3) << "far ahead it is cold";
}

TEST(Cone, RunsAgainToTheLastBitAndAllocatesNothing) {
  std::vector<std::uint64_t> digests;
  for (int run = 0; run < 2; ++run) {
    Obturator at(coneOf(25, 0.02, 2.0), phantom::bentCanal(0.7));
    const std::size_t before = allocation_count::onThisThread();
    at.push(15.0);
    at.letGo();
    at.takeOut();
    at.take(fileTool(coneOf(15, 0.02, 1.0)));
    at.push(8.0);
    at.letGo();
    at.takeOut();
    at.take(handInstrumentTool(HandInstrument::root_plugger));
    at.hand.drill_pedal = true;
    at.hand.X_PT.translation_mm = {0.0, 0.0, 0.4};
    for (int n = 0; n < 500; ++n) at.move(-0.003);
    EXPECT_EQ(allocation_count::onThisThread(), before);
    digests.push_back(at.tick.bone_digest);
    EXPECT_GT(at.filling().volume_mm3(), 1.0);
  }
  EXPECT_EQ(digests[0], digests[1]);
}

TEST(Cone, ComesToRestUnderAHandThatPushesAndPulls) {
  Obturator at(coneOf(25, 0.02), phantom::bentCanal(0.7));
  phantom::WanderingHand wandering(5, {at.hand.X_PT.rotation, {0.0, 0.0, 21.0}}, 17.0);
  int unsettled = 0;
  for (int n = 0; n < 6000; ++n) {
    const FilePose next = wandering.next();
    at.hand.X_PT = {next.rotation, next.translation_mm};
    at.step();
    unsettled += at.tick.file.unsettled ? 1 : 0;
    ASSERT_TRUE(std::isfinite(at.tick.law_force_P_N.xyz.z));
    ASSERT_LE(glm::length(at.tick.commanded_force_P_N.xyz), at.command.safety.peak_force_N + 1e-9);
    ASSERT_EQ(at.tick.file.broken_from_tip_mm, 0.0);
  }
  EXPECT_LT(unsettled, 120) << "of 6000";
}

}  // namespace
}  // namespace haptics
