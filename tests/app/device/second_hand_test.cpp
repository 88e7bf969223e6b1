#include "app/device/second_hand.h"

#include <gtest/gtest.h>

#include "app/session/session_writer.h"
#include "app/text/usage_error.h"
#include "tests/app/session/small_session.h"
#include "tests/scratch_folder.h"

namespace app {
namespace {

using calibration::Patient;
using calibration::Point;

/// A jaw of air: where the tooth is, is all that is asked.
assets::Patient patient(bool right_side) {
  assets::Patient patient;
  patient.ct.grid = {glm::ivec3(8), 1.0, glm::dvec3(0.0)};
  patient.ct.solid.assign(512, 0);
  patient.ct.label.assign(512, 0);
  patient.site = {right_side ? 48 : 38, {-27.0, 38.0, -5.0}, {0.0, 0.0, 1.0}};
  return patient;
}

calibration::Rig rigAround(const assets::Patient& patient) {
  calibration::Rig rig = calibration::desktopRig({640, 400});
  rig.X_WP = {glm::angleAxis(0.8, glm::normalize(glm::dvec3(1, 2, -1))), {5, 4, 3}};
  rig.X_WP.translation_mm -= (rig.X_WP * Point<Patient>{patient.focus_P_mm()}).mm;
  return rig;
}

constexpr SecondTool kTools[] = {SecondTool::mirror, SecondTool::retractor};

TEST(ScriptedHold, OfALeftToothIsTheMirrorImageOfARightOne) {
  for (const SecondTool tool : kTools) {
    const auto right = scriptedHold(tool, true), left = scriptedHold(tool, false);
    EXPECT_NEAR(glm::dot(right.rotation, right.rotation), 1.0, 1e-12);
    const glm::dvec3 flip(-1, 1, 1);
    EXPECT_LT(glm::distance(left.translation_mm, flip * right.translation_mm), 1e-12);
    // Both instruments are alike on either side of their own plane x = 0.
    for (const glm::dvec3 axis : {glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)})
      EXPECT_LT(glm::distance(left.rotation * axis, flip * (right.rotation * axis)), 1e-9);
  }
}

TEST(ScriptedHold, LeadsTheHandleOutOfTheMouthTowardsTheViewer) {
  for (const SecondTool tool : kTools) EXPECT_GT((scriptedHold(tool, true).rotation * glm::dvec3(0, 0, 1)).z, 0.4);
}

TEST(ScriptedHold, TurnsTheGlassSoThatTheEyeWouldSeeTheToothInIt) {
  const auto hold = scriptedHold(SecondTool::mirror, true);
  const glm::dvec3 out = hold.rotation * glm::normalize(glm::dvec3(0, -1, 1)), glass = hold.translation_mm;
  // From an eye half a metre away to the middle of the glass and on from there.
  const glm::dvec3 seen = glm::normalize(glm::reflect(glass - glm::dvec3(0, 0, 500), out));
  EXPECT_GT(glm::dot(-glass, seen), 0.0);
  EXPECT_LT(glm::length(-glass - glm::dot(-glass, seen) * seen), 4.0) << "past the middle of the tooth";
}

TEST(SecondHand, HoldsItsInstrumentNextToTheToothForAnyPoseOfThePatient) {
  for (const bool right_side : {true, false}) {
    const assets::Patient jaw = patient(right_side);
    const calibration::Rig rig = rigAround(jaw);
    SecondHand hand({"scripted", SecondTool::mirror}, {}, jaw, rig, Ticking::stepped);
    EXPECT_EQ(hand.name(), "mirror, scripted still hand");
    render::Frame frame;
    hand.place(frame);
    EXPECT_FALSE(frame.second_visible) << "nothing was measured yet";
    hand.start();
    hand.stepTo(0.01);
    hand.place(frame);
    ASSERT_TRUE(frame.second_visible);
    const auto X_WO = rig.X_WP * frame.X_PO, hold = scriptedHold(SecondTool::mirror, right_side);
    EXPECT_LT(glm::distance(X_WO.translation_mm, hold.translation_mm), 1e-9);
    EXPECT_NEAR(std::abs(glm::dot(X_WO.rotation, hold.rotation)), 1.0, 1e-9);
    EXPECT_FALSE(hand.takeNews());
  }
}

TEST(SecondHand, IsRecordedWhereItMovedAndReplayedFromThere) {
  const tests::ScratchFolder folder;
  const assets::Patient jaw = patient(true);
  SecondHandPlace first{SecondTool::mirror, true, {}}, second = first;
  first.X_PO = {glm::normalize(glm::dquat(0.9, 0.1, -0.3, 0.2)), {1.0 / 3.0, -2.0, 7.5}};
  second.X_PO = {first.X_PO.rotation, {4.0, -2.0, 7.5}};
  {
    const test::SmallBone bone;
    SessionWriter writer(folder.file("s.molar"), false, bone.start());
    writer.write({{},
                  test::imaginedTicks(0, 3000),
                  {{15, kSecondHandEvent, secondHandText(first)}, {2000, kSecondHandEvent, secondHandText(second)}}});
  }
  SecondHand hand({"replay:" + folder.file("s.molar"), SecondTool::mirror}, {}, jaw, rigAround(jaw), Ticking::stepped);
  hand.start();
  render::Frame frame;
  EXPECT_FALSE(hand.takeMoved()) << "nothing was placed yet";
  const auto placedAt = [&](double t_s) {
    hand.stepTo(t_s);
    hand.place(frame);
    return hand.takeMoved();
  };
  const auto begun = placedAt(0.02);
  ASSERT_TRUE(begun);
  EXPECT_TRUE(isSamePlace(*begun, first)) << "to the last bit";
  EXPECT_FALSE(placedAt(1.9)) << "it held still until it moved";
  const auto moved = placedAt(2.5);
  ASSERT_TRUE(moved);
  EXPECT_LT(glm::distance(moved->X_PO.translation_mm, second.X_PO.translation_mm), 1e-12);
}

TEST(SecondHand, RefusesASourceThatCannotHoldAnInstrument) {
  for (const char* device : {"simulated", "simulated:omni", "nonsense"})
    EXPECT_THROW(refuseUnlessSecondHand({device, SecondTool::mirror}, "scripted"), UsageError) << device;
  EXPECT_THROW(refuseUnlessSecondHand({"wooden:1-2", SecondTool::mirror}, "wooden:1-2"), UsageError);
  try {
    refuseUnlessSecondHand({"practice:Z", SecondTool::mirror}, "scripted");
    FAIL();
  } catch (const UsageError& refused) {
    EXPECT_TRUE(std::string(refused.what()).starts_with("practice:Z: ")) << "it is nobody's --device";
  }
  for (const char* device : {"", "scripted", "mouse", "replay:s.molar", "wooden:1-2", "openhaptics:Left"})
    EXPECT_NO_THROW(refuseUnlessSecondHand({device, SecondTool::retractor}, "wooden:1-3")) << device;
}

TEST(SecondHand, OfAMouseBeginsAtTheSiteAndGoesWhereTheMouseMovesIt) {
  const assets::Patient jaw = patient(true);
  const calibration::Rig rig = rigAround(jaw);
  SecondHand hand({"mouse", SecondTool::mirror}, {}, jaw, rig, Ticking::stepped);
  EXPECT_EQ(hand.name(), "mirror, mouse");
  auto held = hand.startOfMouse().value();
  hand.start();
  hand.stepTo(0.01);
  render::Frame frame;
  const auto away_mm = [&] {
    hand.place(frame);
    EXPECT_TRUE(frame.second_visible);
    const auto X_WO = rig.X_WP * frame.X_PO;
    return glm::distance(X_WO.translation_mm, held.translation_mm) +
           (1.0 - std::abs(glm::dot(X_WO.rotation, held.rotation)));
  };
  EXPECT_LT(away_mm(), 1e-6);
  held.translation_mm += glm::dvec3(12.0, -3.0, 5.0);
  held.rotation = glm::normalize(glm::angleAxis(0.4, glm::dvec3(0, 1, 0)) * held.rotation);
  hand.moveMouse(held);
  EXPECT_GT(away_mm(), 1.0);
  hand.stepTo(3.0);
  EXPECT_LT(away_mm(), 0.01);
  EXPECT_FALSE(SecondHand({"scripted", SecondTool::mirror}, {}, jaw, rig, Ticking::stepped).startOfMouse());
}

TEST(SecondHand, TheGlassOfAMirrorReflectsAndARetractorDoesNot) {
  const assets::Patient jaw = patient(true);
  for (const SecondTool tool : kTools) {
    SecondHand hand({"scripted", tool}, {}, jaw, rigAround(jaw), Ticking::stepped);
    render::Frame frame;
    hand.place(frame);
    ASSERT_EQ(frame.second_glass.has_value(), tool == SecondTool::mirror);
    if (!frame.second_glass) continue;
    // The plane that the measures of sight count with.
    EXPECT_EQ(frame.second_glass->out_O, assets::mirrorGlassNormal());
    EXPECT_EQ(frame.second_glass->radius_mm, assets::kMirrorGlassRadius_mm);
  }
}

TEST(SecondHand, IsHeldAtTheCentreOfTheViewWithoutASite) {
  assets::Patient nowhere = patient(true);
  nowhere.jaw_P_mm = nowhere.site->centre_P_mm;
  nowhere.site.reset();
  EXPECT_NO_THROW(SecondHand({"scripted", SecondTool::mirror}, {}, nowhere, rigAround(nowhere)));
}

}  // namespace
}  // namespace app
