// Flutes that fill, are washed and wiped, and edges that get dull; fragments that later files meet.
#include "haptics/file/file_flutes.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "haptics/file/canal_wear.h"
#include "haptics/file/file_fragments.h"
#include "haptics/servo/servo.h"
#include "tests/haptics/file_scene.h"

namespace haptics::flutes {
namespace {

constexpr double kTick_s = 1e-3;

TEST(FileFlutes, TakeAsMuchAsLiesBetweenTheWireAndItsCircle) {
  const FileChain chain = phantom::steelFile(25);
  FileFlutes flutes;
  flutes.takeUp(chain);
  // Square wire of the largest diameter D: pi D^2 / 4 - D^2 / 2.
  const std::size_t section = 20;
  const double D = 2.0 * chain.radius_mm[section], room_mm3 = (std::numbers::pi / 4.0 - 0.5) * D * D * chain.link_mm;
  // A fifth of what is taken never stays in them.
  const double taken_mm3 = room_mm3 / (1.0 - kLooseChips);
  flutes.add(section, 0.999 * taken_mm3);
  EXPECT_FALSE(flutes.isFull(section));
  EXPECT_GT(flutes.eta(section), 0.98);
  flutes.add(section, 0.002 * taken_mm3);
  EXPECT_TRUE(flutes.isFull(section));
  EXPECT_EQ(flutes.eta(section), 0.0);
  EXPECT_GT(flutes.eta(section - 1), 0.98) << "that section alone";
  flutes.rinse(kTick_s, false, false);
  EXPECT_EQ(flutes.fullest(), 1.0);
  EXPECT_NEAR(flutes.held_mm3(), 1.001 * room_mm3, 1e-12);
  EXPECT_NEAR(flutes.left_mm3(), 1.001 * taken_mm3, 1e-12);
}

TEST(FileFlutes, AreWashedByAnExponentialAndWipedOutside) {
  const FileChain chain = phantom::steelFile(25);
  FileFlutes flutes;
  flutes.takeUp(chain);
  flutes.add(20, 0.01);
  const double loose_mm3 = flutes.loose_mm3(), held_mm3 = 0.01 - loose_mm3;
  for (int n = 0; n < static_cast<int>(kWashedBeside_s / kTick_s); ++n) flutes.rinse(kTick_s, true, false);
  EXPECT_NEAR(flutes.held_mm3(), held_mm3 * std::exp(-1.0), 1e-3 * held_mm3);
  flutes.rinse(kTick_s, false, true);
  EXPECT_EQ(flutes.held_mm3(), 0.0) << "wiped";
  EXPECT_NEAR(flutes.loose_mm3(), loose_mm3 * std::exp(-1.0), 1e-3 * loose_mm3) << "what is loose stays";
  for (int n = 0; n < 10000; ++n) flutes.rinse(kTick_s, true, true);
  EXPECT_LT(flutes.left_mm3(), 0.002 * loose_mm3);
}

TEST(FileFlutes, EdgesGetDullByWhatTheyTook) {
  FileFlutes flutes;
  flutes.takeUp(phantom::steelFile(40));
  for (int n = 0; n < 20000; ++n) flutes.add(5, 1e-4);
  EXPECT_NEAR(flutes.sharpness(), std::exp(-2.0 / kDulled_mm3), 1e-5);
  flutes.takeUp(phantom::steelFile(40));
  EXPECT_EQ(flutes.sharpness(), 1.0) << "another file";
}

/// A straight fragment along -z with its break at z = -10 mm, of 0.15 mm.
FileFragments oneFragment(const StrokeHistory& strokes, double taper = 0.0) {
  FileChain broken = phantom::steelFile(25);
  broken.links = 20;
  FileFragment left;
  left.links = 4;
  for (std::size_t n = 0; n <= left.links; ++n) {
    left.node_P_mm[n] = {0.0, 0.0, -10.0 - static_cast<double>(n)};
    broken.radius_mm[broken.links + n] = 0.15 - taper * static_cast<double>(n);
  }
  FileFragments fragments;
  fragments.leave(left, broken, strokes);
  ChainShape away;
  away.node_mm.fill(glm::dvec3(50.0));
  fragments.wake(broken, away);
  return fragments;
}

TEST(FileFragments, PressAsTheGradientOfAnEnergy) {
  const StrokeHistory strokes(CarvedBone({glm::ivec3(8), 0.1, glm::dvec3(0.0)}, std::vector<std::uint8_t>(512), {}));
  for (const double taper : {0.0, 0.02}) {
    const FileFragments fragments = oneFragment(strokes, taper);
    ASSERT_TRUE(fragments.isMet());
    const auto at = [&](const glm::dvec3& p) {
      SectionContact contact;
      fragments.press(p, 0.1, contact);
      return contact;
    };
    EXPECT_EQ(at({0.26, 0.0, -12.0}).normal_N, 0.0) << "beside it is a way past";
    for (const glm::dvec3& p :
         {glm::dvec3(0.2, 0.05, -11.3), glm::dvec3(0.03, 0.02, -9.8), glm::dvec3(-0.1, 0.1, -13.9)}) {
      const SectionContact contact = at(p);
      ASSERT_GT(contact.normal_N, 0.0);
      for (int axis = 0; axis < 3; ++axis) {
        constexpr double h = 1e-6;
        glm::dvec3 step(0.0);
        step[axis] = h;
        EXPECT_NEAR(contact.force_N[axis], -(at(p + step).energy_Nmm - at(p - step).energy_Nmm) / (2.0 * h), 1e-4);
      }
    }
  }
}

/// Servo, tooth and a hand with a file over the orifice.
struct Breaking {
  phantom::CanalWall canal{phantom::bentCanal(0.7)};
  Bodies bodies{CarvedBone(canal.field.grid, canal.field.solid, {})};
  Servo servo{bodies};
  HandSample hand;
  Command command;
  Tick tick;

  Breaking() {
    command.serial = 1;
    command.safety.must_be_armed = false;
    command.irrigating = false;
    hand.held = hand.fresh = hand.calibrated = hand.device_healthy = true;
    take(25);
  }
  void take(int size) {
    hand.X_PT = {};
    hand.X_PT.translation_mm = {0.0, 0.0, 21.5};
    command.tool = fileTool({static_cast<std::uint64_t>(size), 21.0});
    ++command.serial;
    for (int n = 0; n < 100; ++n) move(0.0);
  }
  void move(double down_mm, double turn_rad = 0.0) {
    hand.X_PT.translation_mm.z -= down_mm;
    hand.X_PT.rotation = glm::normalize(hand.X_PT.rotation * glm::angleAxis(turn_rad, glm::dvec3(0.0, 0.0, -1.0)));
    tick = servo.step(hand, command, kTick_s);
  }
  void to(double deep_mm, double step_mm) {
    while ((21.0 - hand.X_PT.translation_mm.z - deep_mm) * step_mm < 0.0) move(step_mm);
  }
  double tip_mm() const { return canal.canal.nearest_mm(tick.file.tip_P_mm); }
};

TEST(RootCanalFile, AFragmentIsMetByLaterFilesUntilItsStrokeIsUndone) {
  Breaking at;
  at.to(15.3, 0.01);
  for (int n = 0; n < 3000 && at.tick.file.broken_from_tip_mm == 0.0; ++n) at.move(0.0, 0.029);
  ASSERT_GT(at.tick.file.broken_from_tip_mm, 0.0);
  EXPECT_EQ(at.tick.file.fragments, 1);
  const double break_mm = at.tip_mm();
  at.to(-0.5, -0.03);
  ASSERT_GT(at.tick.strokes, 0);

  // A thin file comes to it and no farther, though the hand goes on.
  at.take(10);
  at.to(break_mm + 1.5, 0.01);
  EXPECT_EQ(at.tick.file.fragments, 1);
  EXPECT_LT(at.tip_mm(), break_mm + 0.4);
  EXPECT_GT(at.tip_mm(), break_mm - 1.0);
  const double held_mm = at.tip_mm();
  at.to(-0.5, -0.03);

  // Undone, stroke by stroke, until the one in which it broke is.
  for (int n = 0; n < 20 && at.tick.file.fragments > 0; ++n) {
    ++at.command.undo_serial;
    ++at.command.serial;
    for (int wait = 0; wait < 200; ++wait) at.move(0.0);
  }
  EXPECT_EQ(at.tick.file.fragments, 0);
  at.take(10);
  at.to(15.0, 0.01);
  EXPECT_GT(at.tip_mm(), held_mm + 2.0) << "the way is free";
}

/// All strokes, until so many fragments lie in the tooth.
void redo(Breaking& at, int fragments) {
  for (int n = 0; n < 20 && at.tick.file.fragments != fragments; ++n) {
    ++at.command.redo_serial;
    ++at.command.serial;
    for (int wait = 0; wait < 200; ++wait) at.move(0.0);
  }
}

TEST(RootCanalFile, AFragmentComesBackWithItsStroke) {
  Breaking at;
  at.to(15.3, 0.01);
  for (int n = 0; n < 3000 && at.tick.file.broken_from_tip_mm == 0.0; ++n) at.move(0.0, 0.029);
  ASSERT_EQ(at.tick.file.fragments, 1);
  const double break_mm = at.tip_mm();
  at.to(-0.5, -0.03);
  for (int n = 0; n < 20 && at.tick.file.fragments > 0; ++n) {
    ++at.command.undo_serial;
    ++at.command.serial;
    for (int wait = 0; wait < 200; ++wait) at.move(0.0);
  }
  ASSERT_EQ(at.tick.file.fragments, 0);
  redo(at, 1);
  EXPECT_EQ(at.tick.file.fragments, 1);
  at.take(10);
  at.to(break_mm + 1.5, 0.01);
  EXPECT_LT(at.tip_mm(), break_mm + 0.4) << "met again";
  at.to(-0.5, -0.03);

  // Undone once more, and the tooth is filed on: it cannot come back.
  for (int n = 0; n < 20 && at.tick.file.fragments > 0; ++n) {
    ++at.command.undo_serial;
    ++at.command.serial;
    for (int wait = 0; wait < 200; ++wait) at.move(0.0);
  }
  ASSERT_EQ(at.tick.file.fragments, 0);
  at.take(20);
  at.to(13.0, 0.01);
  at.to(-0.5, -0.03);
  redo(at, 1);
  EXPECT_EQ(at.tick.file.fragments, 0);
}

TEST(RootCanalFile, TheTickOfABreakHasTheWholeFile) {
  Breaking at;
  at.to(15.3, 0.01);
  Tick before;
  for (int n = 0; n < 3000 && at.tick.file.broken_from_tip_mm == 0.0; ++n) {
    before = at.tick;
    at.move(0.0, 0.029);
  }
  ASSERT_GT(at.tick.file.broken_from_tip_mm, 0.0);
  for (std::size_t n = 0; n < before.file.node_P_mm.size(); ++n)
    EXPECT_LT(glm::distance(at.tick.file.node_P_mm[n], before.file.node_P_mm[n]), 0.05) << n;
  const auto broken = static_cast<std::size_t>(
      std::lround((21.0 - at.tick.file.broken_from_tip_mm) / 21.0 * static_cast<double>(kUsualLinks)));
  EXPECT_LT(glm::distance(glm::dvec3(at.tick.file.node_P_mm[broken]), at.tick.file.tip_P_mm), 1e-5);
  at.move(0.0);
  EXPECT_EQ(at.tick.file.node_P_mm[broken], at.tick.file.node_P_mm.back()) << "then what is left of it";
}

TEST(FileFragments, OfBeforeAreMetAtOnceAndNoStrokeTakesThemBack) {
  const StrokeHistory strokes(CarvedBone({glm::ivec3(8), 0.1, glm::dvec3(0.0)}, std::vector<std::uint8_t>(512), {}));
  const assets::MetalFragment steel{25, false, {{0.0, 0.0, 0.0}, {0.0, 0.0, -2.0}}, {0.15, 0.13}};
  FileFragments fragments(std::span(&steel, 1));
  EXPECT_TRUE(fragments.isMet());
  EXPECT_EQ(fragments.lying(), 1u);
  SectionContact contact;
  fragments.press({0.1, 0.0, -1.0}, 0.1, contact);
  // Radii 0.1 and 0.14, 0.1 apart.
  EXPECT_NEAR(contact.normal_N, FileFragments::kMet_N_per_mm * 0.14, 0.02);
  fragments.follow(strokes, true);
  EXPECT_EQ(fragments.lying(), 1u);
}

TEST(CanalWear, TakesNothingWhereFlutesAreFull) {
  phantom::CanalWall canal(phantom::bentCanal(0.7));
  CarvedBone bone(canal.field.grid, canal.field.solid, {});
  const FileChain chain = phantom::steelFile(20);
  FilePose hand = phantom::above(chain, 0.5);
  FileInCanal file(chain, FileLaw{}, FileGrip{}, hand);
  FileFlutes flutes;
  flutes.takeUp(chain);
  CanalWear wear;
  std::uint64_t tick = 0;
  const auto move = [&](double down_mm) {
    hand.translation_mm.z -= down_mm;
    const SolidField wall = bone.field();
    file.step(hand, {&wall, {}, nullptr});
    wear.step(file, bone, nullptr, tick++, &flutes);
  };
  constexpr double kTaken_mm3 = 0.09;  // more than any of its flutes holds
  for (std::size_t i = 1; i <= chain.links; ++i) flutes.add(i, kTaken_mm3);
  const double sharpness = flutes.sharpness();
  while (hand.translation_mm.z > chain.length_mm() - 14.0) move(0.01);
  EXPECT_EQ(wear.due_mm3(), 0.0);
  flutes.rinse(kTick_s, false, true);
  for (int n = 0; n < 100; ++n) move(n % 50 < 25 ? -0.03 : 0.03);
  flutes.rinse(kTick_s, false, false);
  EXPECT_GT(wear.due_mm3(), 1e-8);
  EXPECT_NEAR(flutes.held_mm3() + flutes.loose_mm3(), wear.removed_mm3() + kTaken_mm3 * kLooseChips * kUsualLinks,
              1e-9);
  EXPECT_LT(flutes.sharpness(), sharpness);
}

TEST(RootCanalFile, WaterWashesWhatItFiles) {
  const auto filed = [](bool irrigates) {
    Breaking at;
    at.take(20);
    at.command.irrigating = irrigates;
    ++at.command.serial;
    at.to(14.0, 0.01);
    for (int stroke = 0; stroke < 20; ++stroke)
      for (const double way_mm : {-0.03, 0.03})
        for (int n = 0; n < 50; ++n) at.move(way_mm);
    return at.tick.file;
  };
  const FileWork dry = filed(false), wet = filed(true);
  EXPECT_GT(dry.flutes_full, wet.flutes_full);
  EXPECT_LT(wet.debris_mm3, 0.9 * wet.removed_total_mm3);
  EXPECT_NEAR(dry.debris_mm3, dry.removed_total_mm3, 1e-9) << "nothing has left the canal";
  EXPECT_LT(dry.sharpness, 1.0);
}

}  // namespace
}  // namespace haptics::flutes
