#include "app/view/brick_upload.h"

#include <gtest/gtest.h>

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
  EXPECT_GT(uploader.upload(bone, shown), 0u);
  EXPECT_EQ(BrickUploader().upload(bone, shown), 0u) << "nothing is uploaded twice";
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

}  // namespace
}  // namespace app
