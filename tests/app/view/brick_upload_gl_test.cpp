#include "app/view/brick_upload.h"

#include <gtest/gtest.h>

#include "app/rehearsal/frame_builder.h"
#include "haptics/servo/servo.h"
#include "render/display/camera.h"
#include "render/frame_renderer.h"
#include "render/gpu/offscreen_context.h"

namespace app {
namespace {

constexpr assets::VolumeGrid kGrid{{48, 48, 32}, 0.25, {-6.0, -6.0, -6.0}};

/// A flat block of bone up to z = 0.
std::vector<std::uint8_t> block() {
  std::vector<std::uint8_t> solid(kGrid.voxelCount(), 0);
  for (int k = 0; k < 24; ++k)
    for (int j = 2; j < 46; ++j)
      for (int i = 2; i < 46; ++i) solid[kGrid.index({i, j, k})] = 255;
  return solid;
}

render::Frame frameAbove() {
  render::Frame frame;
  frame.rig = render::cameraRig({.eye_P_mm = {0, -40, 60}, .fov_y_rad = 0.25}, {96, 72});
  frame.tool_visible = false;
  return frame;
}

TEST(BrickUploader, ShowsTheCutOfOneTickToBothEyesInTheNextFrame) {
  const render::OffscreenContext context;
  const std::vector<std::uint8_t> solid = block();
  haptics::Bodies bone(kGrid, solid, {});
  render::FrameRenderer shown(kGrid, solid, {});
  const render::Frame frame = frameAbove();

  // One tick of a fierce bur.
  haptics::Servo servo(bone);
  haptics::Command command;
  command.tool.head.radius_mm = 1.5;
  command.erosion.time.removal_rate_per_s = 1000.0;
  haptics::HandSample hand;
  hand.drill_pedal = true;
  hand.X_PT.translation_mm = {0.0, 0.0, 4.0};
  for (int spin_up = 0; spin_up < 2000; ++spin_up) servo.step(hand, command, 0.001);
  hand.X_PT.translation_mm = {0.0, 0.0, 0.4};
  const haptics::Tick tick = servo.step(hand, command, 0.001);
  ASSERT_GT(tick.removed_mm3, 0.5);

  // Before: without the hole. After: as a renderer that was given the carved bone from the start.
  std::vector<std::uint8_t> uncut[2];
  constexpr render::Eye kEyes[] = {render::Eye::left, render::Eye::right};
  for (int e = 0; e < 2; ++e) {
    shown.renderEye(frame, kEyes[e]);
    uncut[e] = shown.readEye(kEyes[e]).rgba;
  }
  BrickUploader uploader;
  EXPECT_FALSE(uploader.takeChanged(bone).empty());
  EXPECT_TRUE(uploader.takeChanged(bone).empty()) << "taken, and waiting to be uploaded";
  EXPECT_GT(uploader.upload(bone, {}, shown), 0u);
  EXPECT_EQ(BrickUploader().upload(bone, {}, shown), 0u) << "nothing is uploaded twice";
  render::FrameRenderer fresh(kGrid, bone.solidInGridOrder(), {});
  for (int e = 0; e < 2; ++e) {
    shown.renderEye(frame, kEyes[e]);
    fresh.renderEye(frame, kEyes[e]);
    const auto cut = shown.readEye(kEyes[e]).rgba;
    EXPECT_EQ(cut, fresh.readEye(kEyes[e]).rgba);
    EXPECT_NE(cut, uncut[e]) << "the control: the hole is in sight";
  }

  // After a reset of the graphics card: made from the bone of the start, then all that was ever brought.
  render::FrameRenderer anew(kGrid, solid, {});
  uploader.uploadAllAgain(bone, anew);
  anew.renderEye(frame, render::Eye::left);
  shown.renderEye(frame, render::Eye::left);
  EXPECT_EQ(anew.readEye(render::Eye::left).rgba, shown.readEye(render::Eye::left).rgba);
}

/// A block of bone with a tooth in it that stands out of it.
struct Site {
  std::vector<std::uint8_t> solid = block(), label, is_tooth;
  haptics::Bodies bodies;

  Site() : label(solid.size(), 1), is_tooth(solid.size(), 0), bodies(divided()) {}
  haptics::Bodies divided() {
    assets::forVoxels(glm::ivec3(18, 18, 12), glm::ivec3(30, 30, 28), [&](glm::ivec3 ijk) {
      const std::size_t v = kGrid.index(ijk);
      solid[v] = 255, label[v] = 5, is_tooth[v] = 1;
    });
    return {kGrid, solid, label, is_tooth};
  }
  /// Jaw and pieces at rest as they are, to a renderer of the scan, whose colours stay.
  void bringAll(render::FrameRenderer& to) const {
    const std::vector<std::uint8_t> now = bodies.solidInGridOrder();
    assets::forVoxels(glm::ivec3(0), kGrid.bricks(), [&](glm::ivec3 brick) {
      std::array<std::uint8_t, 512> part{};
      assets::forVoxels(glm::ivec3(0), glm::ivec3(8), [&](glm::ivec3 at) {
        if (kGrid.contains(8 * brick + at)) part[assets::indexIn(glm::ivec3(8), at)] = now[kGrid.index(8 * brick + at)];
      });
      to.updateBrick(brick, part);
    });
  }
  render::Frame frame() const {
    render::Frame frame = frameAbove();
    haptics::Tick tick;
    tick.pieces = static_cast<std::uint8_t>(bodies.bones().size() - 1);
    for (std::size_t n = 0; n < tick.pieces; ++n) tick.X_PQ[n] = bodies.pose(n);
    frame.pieces = movedPieces(tick);
    return frame;
  }
};

TEST(BrickUploader, ATouchedToothLeavesTheJawInTheFrameThatShowsItAsAPieceAndComesBack) {
  const render::OffscreenContext context;
  Site site;
  ASSERT_EQ(site.bodies.pieces(), 1u);
  render::FrameRenderer shown(kGrid, site.solid, site.label);
  BrickUploader uploader;
  const auto picture = [&] {
    const render::Frame frame = site.frame();
    uploader.upload(site.bodies, frame.pieces, shown);
    shown.renderEye(frame, render::Eye::left);
    return shown.readEye(render::Eye::left).rgba;
  };
  const auto at_rest = picture();

  // The jaw with the socket, and the piece above it.
  site.bodies.place(0, {glm::angleAxis(0.2, glm::dvec3(0, 1, 0)), {0.5, 0.0, 1.5}});
  const auto moved = picture();
  render::FrameRenderer fresh(kGrid, site.solid, site.label);
  BrickUploader().uploadEverything(site.bodies, site.frame().pieces, fresh);
  fresh.renderEye(site.frame(), render::Eye::left);
  EXPECT_EQ(moved, fresh.readEye(render::Eye::left).rgba);
  EXPECT_NE(moved, at_rest);
  fresh.renderEye(frameAbove(), render::Eye::left);
  render::FrameRenderer socket(kGrid, site.solid, site.label);
  site.bringAll(socket);
  socket.renderEye(frameAbove(), render::Eye::left);
  EXPECT_EQ(fresh.readEye(render::Eye::left).rgba, socket.readEye(render::Eye::left).rgba) << "nothing of it is left";

  // To a new renderer of the initial bone as well.
  render::FrameRenderer anew(kGrid, site.solid, site.label);
  uploader.uploadAllAgain(site.bodies, anew);
  anew.renderEye(site.frame(), render::Eye::left);
  EXPECT_EQ(anew.readEye(render::Eye::left).rgba, moved);

  site.bodies.place(0, {});
  EXPECT_EQ(picture(), at_rest);
}

TEST(BrickUploader, ACutOfAMovedToothIsOnThePieceAndStillThereWhenItComesBack) {
  const render::OffscreenContext context;
  Site site;
  render::FrameRenderer shown(kGrid, site.solid, site.label);
  BrickUploader uploader;
  const auto picture = [&](render::FrameRenderer& of) {
    of.renderEye(site.frame(), render::Eye::left);
    return of.readEye(render::Eye::left).rgba;
  };
  site.bodies.place(0, {glm::dquat(1, 0, 0, 0), {0.0, 0.0, 2.0}});
  uploader.upload(site.bodies, site.frame().pieces, shown);
  const auto whole = picture(shown);
  haptics::ErosionStep step;
  step.loss.fill(1.0);
  haptics::carveTool(site.bodies, {haptics::ShapeKind::sphere, 1.0, 0.0}, {glm::dquat(1, 0, 0, 0), {-1.0, -1.0, 3.0}},
                     step, 1);
  EXPECT_GT(uploader.upload(site.bodies, site.frame().pieces, shown), 0u);
  EXPECT_NE(picture(shown), whole);

  // Back at rest: as bone that was carved there.
  site.bodies.place(0, {});
  uploader.upload(site.bodies, site.frame().pieces, shown);
  render::FrameRenderer expected(kGrid, site.solid, site.label);
  site.bringAll(expected);
  EXPECT_EQ(picture(shown), picture(expected));
}

TEST(BrickUploader, APieceThatComesOffIsShownOnItsOwn) {
  const render::OffscreenContext context;
  Site site;
  render::FrameRenderer shown(kGrid, site.solid, site.label);
  BrickUploader uploader;
  const auto picture = [&] {
    uploader.upload(site.bodies, site.frame().pieces, shown);
    shown.renderEye(site.frame(), render::Eye::left);
    return shown.readEye(render::Eye::left).rgba;
  };
  const auto nearest_mm = [&] {
    float least = 1e9f;
    for (const float mm : shown.readDistance(render::Eye::left).mm)
      if (mm > 0.0f) least = std::min(least, mm);
    return least;
  };
  const auto whole = picture();
  const float whole_mm = nearest_mm();
  std::array<std::uint8_t, haptics::kBlockVoxels> all{};
  all.fill(255);
  for (std::size_t block = 0; block < site.bodies.bones()[1].blocks() / 2; ++block)
    site.bodies.moveBlock(0, 1, block, all);
  ASSERT_EQ(site.bodies.pieces(), 2u);
  EXPECT_EQ(picture(), whole) << "both at rest";

  site.bodies.place(1, {glm::dquat(1, 0, 0, 0), {-3.0, 0.0, 8.0}});
  const auto apart = picture();
  EXPECT_NE(apart, whole);
  EXPECT_LT(nearest_mm(), whole_mm - 1.0f) << "it is above the rest";
  render::FrameRenderer fresh(kGrid, site.solid, site.label);
  BrickUploader().uploadEverything(site.bodies, site.frame().pieces, fresh);
  fresh.renderEye(site.frame(), render::Eye::left);
  EXPECT_EQ(fresh.readEye(render::Eye::left).rgba, apart);
}

}  // namespace
}  // namespace app
