#include "app/rehearsal/frame_builder.h"

#include <gtest/gtest.h>

#include "calibration/geometry/units.h"

namespace app {
namespace {

using Rotation = glm::dquat;

RehearsalPlan plan() {
  RehearsalPlan plan;
  plan.patient.jaw_P_mm = {10.0, 20.0, 30.0};
  plan.face_window_mm = 7.0;
  plan.first_frame.mode = render::ViewMode::dvr;
  plan.first_frame.layers.mandibular_canal = true;
  plan.command.tool.head.radius_mm = 1.5;
  return plan;
}

haptics::Tick tickAt(double t_s) {
  haptics::Tick tick;
  tick.t_s = t_s;
  tick.dt_s = 0.001;
  tick.hand.X_PT = {glm::angleAxis(0.3, glm::dvec3(0, 0, 1)), {1.0, 2.0, 3.0}};
  tick.proxy_P.mm = {1.0, 2.0, 3.5};
  return tick;
}

TEST(FrameBuilder, BeginsAtTheSiteWithoutATool) {
  const render::Frame frame = openingFrame(plan());
  EXPECT_EQ(frame.site_P.mm, glm::dvec3(10.0, 20.0, 30.0));
  EXPECT_EQ(frame.X_PT.translation_mm, glm::dvec3(10.0, 20.0, 30.0)) << "where slices are cut";
  EXPECT_FALSE(frame.tool_visible);
  EXPECT_EQ(frame.face_window_mm, 7.0);
  EXPECT_EQ(frame.bur_radius_mm, 1.5);
  EXPECT_EQ(frame.mode, render::ViewMode::dvr);
  EXPECT_TRUE(frame.layers.mandibular_canal);
}

TEST(FrameBuilder, DrawsTheToolAtTheSurfaceAndItsGhostAtTheHand) {
  const haptics::Tick tick = tickAt(0.5);
  const render::Frame frame = nextFrame(openingFrame(plan()), tick, plan().command);
  EXPECT_TRUE(frame.tool_visible);
  EXPECT_EQ(frame.X_PT.translation_mm, tick.proxy_P.mm);
  EXPECT_EQ(frame.X_PT_at_hand.translation_mm, tick.hand.X_PT.translation_mm);
  EXPECT_EQ(frame.X_PT.rotation, tick.hand.X_PT.rotation);
  EXPECT_EQ(frame.X_PT_at_hand.rotation, tick.hand.X_PT.rotation);
}

TEST(FrameBuilder, KeepsTheRotationAtABadPose) {
  const render::Frame believed = nextFrame(openingFrame(plan()), tickAt(0.5), plan().command);
  haptics::Tick doubtful = tickAt(0.6);
  doubtful.hand.X_PT.rotation = glm::angleAxis(2.0, glm::dvec3(1, 0, 0));
  doubtful.faults = haptics::Fault::bad_pose;
  const render::Frame frame = nextFrame(believed, doubtful, plan().command);
  EXPECT_EQ(frame.X_PT.rotation, believed.X_PT.rotation);
  EXPECT_EQ(frame.X_PT_at_hand.rotation, believed.X_PT.rotation);
}

TEST(FrameBuilder, RotatesTheBurSevenTimesASecondWhileDrilling) {
  haptics::Tick tick = tickAt(1.0 / 28.0);
  tick.drilling = true;
  const render::Frame drilling = nextFrame(openingFrame(plan()), tick, plan().command);
  EXPECT_NEAR(drilling.bur_angle_rad, 0.5 * calibration::kPi, 1e-9);
  const render::Frame resting = nextFrame(drilling, tickAt(3.0), plan().command);
  EXPECT_EQ(resting.bur_angle_rad, drilling.bur_angle_rad) << "it keeps its angle";
}

TEST(FrameBuilder, ACuringLampShinesWhileItWorksFromItsTip) {
  haptics::Command lamp = plan().command;
  lamp.tool = haptics::handInstrumentTool(haptics::HandInstrument::curing_lamp);
  haptics::Tick tick = tickAt(0.5);
  EXPECT_FALSE(nextFrame(openingFrame(plan()), tick, lamp).curing) << "the pedal is up";
  tick.filling.works = true;
  const render::Frame frame = nextFrame(openingFrame(plan()), tick, lamp);
  ASSERT_TRUE(frame.curing);
  // Its rod is 3 mm thick to both sides, the hand upright.
  EXPECT_NEAR(glm::distance(frame.curing->tip_P.mm, glm::dvec3(1.0, 2.0, 0.5)), 0.0, 1e-12);
  EXPECT_NEAR(glm::distance(frame.curing->axis_P, glm::dvec3(0.0, 0.0, -1.0)), 0.0, 1e-12);
  EXPECT_FALSE(nextFrame(frame, tick, plan().command).curing) << "another tool";
}

TEST(FrameBuilder, OutlinesTheBurOfTheCommand) {
  haptics::Command other = plan().command;
  other.tool.head = {haptics::ShapeKind::cylinder, 0.8, 4.0};
  const render::Frame frame = nextFrame(openingFrame(plan()), tickAt(0.5), other);
  EXPECT_EQ(frame.bur_radius_mm, 0.8);
  EXPECT_EQ(frame.bur_length_mm, 4.0);
  EXPECT_EQ(frame.bur_form, static_cast<assets::BurForm>(haptics::ShapeKind::cylinder));
}

TEST(FrameBuilder, KeepsTheLastPositionBeforeATick) {
  const render::Frame before = nextFrame(openingFrame(plan()), tickAt(0.5), plan().command);
  const render::Frame frame = nextFrame(before, {}, plan().command);
  EXPECT_FALSE(frame.tool_visible);
  EXPECT_EQ(frame.X_PT.translation_mm, before.X_PT.translation_mm);
}

TEST(FrameBuilder, ShowsThePiecesThatHaveLeftRest) {
  haptics::Tick tick;
  tick.pieces = 2;
  tick.X_PQ[1].translation_mm = {0.0, 0.0, 1e-9};
  tick.X_PQ[2].translation_mm = {0.0, 0.0, 5.0};
  const render::MovedPieces pieces = movedPieces(tick);
  EXPECT_FALSE(pieces[0]) << "in the jaw";
  ASSERT_TRUE(pieces[1]);
  EXPECT_EQ(pieces[1]->translation_mm, glm::dvec3(0.0, 0.0, 1e-9));
  EXPECT_FALSE(pieces[2]) << "there are two";
  EXPECT_FALSE(movedPieces({})[1]);
}

TEST(FrameBuilder, HidesAWithdrawnToolInTheLastFrame) {
  haptics::Tick tick = tickAt(0.5);
  const render::Frame last = nextFrame(openingFrame(plan()), tick, plan().command);
  EXPECT_FALSE(closingFrame(last, tick, false).tool_visible);
  EXPECT_TRUE(closingFrame(last, tick, true).tool_visible) << "a person's hand stays visible";
  tick.depth_mm = 0.2;
  EXPECT_TRUE(closingFrame(last, tick, false).tool_visible) << "still at work";
}

TEST(FrameBuilder, ChangesOnlyTheRequestedLayer) {
  const render::Layers before;
  render::Layers after = layersAfter(before, requestFrom("layer:slices"));
  EXPECT_TRUE(after.slices);
  EXPECT_FALSE(layersAfter(after, requestFrom("layer:slices")).slices) << "toggled again";
  EXPECT_FALSE(layersAfter(before, requestFrom("layer:gum")).gingiva);
  EXPECT_FLOAT_EQ(layersAfter(before, requestFrom("face:30")).face_opacity, 0.3f);
  after = layersAfter(before, requestFrom("undo"));
  EXPECT_EQ(after.face_opacity, before.face_opacity);
  EXPECT_EQ(after.slices, before.slices);
}

TEST(FrameBuilder, SlicesAreScrolledAlongTheirAxisUntilTheBurDrills) {
  render::Frame frame;
  frame.slices_beside_bur_P_mm = scrolledSlices(frame, render::SlicePlane::axial, 3.0);
  frame.slices_beside_bur_P_mm = scrolledSlices(frame, render::SlicePlane::sagittal, -1.0);
  EXPECT_EQ(frame.slices_beside_bur_P_mm, glm::dvec3(-0.5, 0.0, 1.5));
  EXPECT_EQ(scrolledSlices(frame, render::SlicePlane::coronal, 1000.0).y, 15.0);
  haptics::Tick tick;
  tick.dt_s = 0.001;
  EXPECT_EQ(nextFrame(frame, tick, {}).slices_beside_bur_P_mm, frame.slices_beside_bur_P_mm);
  tick.drilling = true;
  EXPECT_EQ(nextFrame(frame, tick, {}).slices_beside_bur_P_mm, glm::dvec3(0.0));
}

}  // namespace
}  // namespace app
