#include "app/view/surgeon_display.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "render/display/camera.h"

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

TEST(SurgeonDisplay, ComesBackWithTheSamePictureAfterEverythingWasLost) {
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
  display.beforeMakingAnew([&] { told_first = renderers; });
  display.show(frameAbove());
  const std::vector<std::uint8_t> before = display.renderer().readPicture().rgba;
  display.makeAnew();
  EXPECT_EQ(renderers, 2);
  EXPECT_EQ(told_first, 1) << "what shares with the windows goes before them";
  display.show(frameAbove());
  EXPECT_EQ(display.renderer().readPicture().rgba, before);
  EXPECT_GT(std::count(before.begin(), before.end(), 0xff), 0) << "the control: something is drawn";
}

}  // namespace
}  // namespace app
