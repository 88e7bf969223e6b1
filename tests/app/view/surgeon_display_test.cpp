#include "app/view/surgeon_display.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "app/view/brick_upload.h"
#include "app/view/display_windows.h"
#include "haptics/servo/servo.h"
#include "render/display/camera.h"
#include "render/gpu/gpu_error.h"

namespace app {
namespace {

constexpr assets::VolumeGrid kGrid{{32, 32, 32}, 0.25, {-4.0, -4.0, -4.0}};

/// A cube of bone, without window and graphics card.
SurgeonDisplay::Options onTheProcessor() {
  SurgeonDisplay::Options options;
  options.backend = render::Backend::cpu;
  options.headless = true;
  options.needs_window = false;
  return options;
}

render::Frame frameAbove() {
  render::Frame frame;
  frame.rig = render::cameraRig({.eye_P_mm = {0, -40, 60}, .fov_y_rad = 0.25}, {64, 48});
  frame.tool_visible = false;
  return frame;
}

TEST(DisplayWindows, AWindowKeepsItsShapeOnASmallerMonitor) {
  const glm::ivec2 monitor_px = render::monitors().at(0).px;
  DisplayWindows windows({.screen_px = 3 * monitor_px}, [](const std::string&) {});
  const glm::ivec2 px = windows.first().framebufferSize_px();
  EXPECT_TRUE(glm::all(glm::lessThan(px, monitor_px))) << px.x << " x " << px.y;
  EXPECT_NEAR(static_cast<double>(px.x) / px.y, static_cast<double>(monitor_px.x) / monitor_px.y, 0.01);
}

TEST(SurgeonDisplay, ShowsTheSameImageAfterRecreation) {
  std::vector<std::uint8_t> solid(kGrid.voxelCount(), 0);
  for (int k = 8; k < 24; ++k)
    for (int j = 8; j < 24; ++j)
      for (int i = 8; i < 24; ++i) solid[kGrid.index({i, j, k})] = 255;
  int renderers = 0, told_first = 0;
  SurgeonDisplay display(
      onTheProcessor(),
      [&](render::Backend backend) {
        ++renderers;
        return std::make_unique<render::FrameRenderer>(kGrid, solid, std::vector<std::uint8_t>{},
                                                       render::RenderOptions{.backend = backend});
      },
      [](const std::string&) {});
  display.beforeRecreation([&] { told_first = renderers; });
  display.show(frameAbove());
  const std::vector<std::uint8_t> before = display.renderer().readImage().rgba;
  display.recreate();
  EXPECT_EQ(told_first, 1) << "objects sharing the context are destroyed first";
  display.show(frameAbove());
  EXPECT_EQ(renderers, 2);
  EXPECT_EQ(display.renderer().readImage().rgba, before);
  EXPECT_GT(std::count(before.begin(), before.end(), 0xff), 0) << "the control: something is drawn";
}

TEST(SurgeonDisplay, GivesUpAtTheFourthResetOfTheGraphicsCard) {
  int renderers = 0;
  SurgeonDisplay display(
      onTheProcessor(),
      [&](render::Backend) -> std::unique_ptr<render::FrameRenderer> {
        ++renderers;
        throw render::ContextLost("the graphics card was reset");
      },
      [](const std::string&) {});
  EXPECT_THROW(display.show(frameAbove()), render::ContextLost);
  EXPECT_EQ(renderers, 4);
  EXPECT_EQ(display.contextLosses(), 3);
}

TEST(SurgeonDisplay, PassesOtherErrorsOn) {
  int renderers = 0;
  SurgeonDisplay display(
      onTheProcessor(),
      [&](render::Backend) -> std::unique_ptr<render::FrameRenderer> {
        ++renderers;
        throw render::GpuError("out of memory");
      },
      [](const std::string&) {});
  EXPECT_THROW(display.show(frameAbove()), render::GpuError);
  EXPECT_EQ(renderers, 1) << "created once, not again";
  EXPECT_EQ(display.contextLosses(), 0);
}

/// A second reset during recreation: show() still restores bone and cut.
TEST(SurgeonDisplay, ShowsTheCutBoneAfterAResetDuringShow) {
  std::vector<std::uint8_t> solid(kGrid.voxelCount(), 0);
  for (int k = 8; k < 24; ++k)
    for (int j = 8; j < 24; ++j)
      for (int i = 8; i < 24; ++i) solid[kGrid.index({i, j, k})] = 255;
  haptics::Bodies bone(kGrid, solid, {});
  BrickUploader uploader;
  int renderers = 0;
  SurgeonDisplay display(
      onTheProcessor(),
      [&](render::Backend backend) {
        if (++renderers == 2) throw render::ContextLost("the graphics card was reset");
        auto renderer = std::make_unique<render::FrameRenderer>(kGrid, solid, std::vector<std::uint8_t>{},
                                                                render::RenderOptions{.backend = backend});
        uploader.uploadAllAgain(bone, *renderer);
        return renderer;
      },
      [](const std::string&) {});
  display.show(frameAbove());
  const std::vector<std::uint8_t> whole = display.renderer().readImage().rgba;

  haptics::Servo servo(bone);
  haptics::Command command;
  command.tool.head.radius_mm = 1.5;
  command.erosion.time.removal_rate_per_s = 1000.0;
  haptics::HandSample hand;
  hand.drill_pedal = true;
  hand.X_PT.translation_mm = {0.0, 0.0, 6.0};
  for (int spin_up = 0; spin_up < 2000; ++spin_up) servo.step(hand, command, 0.001);
  hand.X_PT.translation_mm = {0.0, 0.0, 2.4};
  ASSERT_GT(servo.step(hand, command, 0.001).removed_mm3, 0.5);
  ASSERT_GT(uploader.upload(bone, {}, display.renderer()), 0u);
  display.show(frameAbove());
  const std::vector<std::uint8_t> cut = display.renderer().readImage().rgba;
  ASSERT_NE(cut, whole);

  display.recreate();
  display.show(frameAbove());
  EXPECT_EQ(display.contextLosses(), 1);
  EXPECT_EQ(renderers, 3);
  EXPECT_EQ(display.backend(), render::Backend::cpu);
  EXPECT_EQ(display.renderer().readImage().rgba, cut);
}

}  // namespace
}  // namespace app
