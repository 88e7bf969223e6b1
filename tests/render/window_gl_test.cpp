// Needs an X display except for the refusal: use xvfb-run where there is none.
#include "render/display/window.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <vector>

#include "render/gpu/frame_fence.h"
#include "render/gpu/gpu_error.h"
#include "render/gpu/window_image.h"
#include "tests/render/drawn_scene.h"
#include "tests/render/window_pixels.h"

namespace render {
namespace {

bool hasDisplay() { return std::getenv("DISPLAY") != nullptr; }

TEST(Window, RefusesInOneLineWithoutADisplay) {
  const char* display = std::getenv("DISPLAY");
  const std::string kept = display != nullptr ? display : "";
  unsetenv("DISPLAY");
  try {
    const Window window(Window::Options{});
    FAIL() << "a window without a display";
  } catch (const GpuError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("--headless"), std::string::npos);
  }
  if (!kept.empty()) setenv("DISPLAY", kept.c_str(), 1);
}

/// A page of the processor first, as while a patient is prepared: what is shown after a swap must reach the window too.
TEST(Window, ShowsEveryFrameOfTheRenderer) {
  if (!hasDisplay()) GTEST_SKIP() << "no DISPLAY: run under xvfb-run";
  const glm::ivec2 px(320, 240);
  Window window({.size_px = px});
  WindowUpload upload;
  upload.show({px.x, px.y, std::vector<std::uint8_t>(4 * static_cast<std::size_t>(px.x * px.y), 200)}, {.size_px = px});
  window.present();
  const assets::CtVolume ct = testing::ballVolume(testing::smallGrid(), {{{0, 0, 0}, 9.0}});
  FrameRenderer renderer(ct.grid, ct.solid, ct.label);
  for (const double from_mm : {-200.0, -240.0, -280.0}) {
    renderer.render(testing::frameFor(cameraRig({.eye_P_mm = {0, from_mm, 0}, .fov_y_rad = 0.17}, px)));
    renderer.showOnWindow({.size_px = px});
    EXPECT_EQ(testing::windowPixels(px), renderer.readImage().rgba) << from_mm;
    window.present();
  }
  EXPECT_GT(renderer.readImage().rgba[4 * (120 * 320 + 160)], 60);
  EXPECT_NO_THROW(renderer.throwIfError());
  EXPECT_NO_THROW(window.takeEvents());
}

TEST(Window, ASecondWindowShowsWhatTheFirstDrew) {
  if (!hasDisplay()) GTEST_SKIP() << "no DISPLAY: run under xvfb-run";
  Window first({.size_px = {160, 120}});
  const assets::CtVolume ct = testing::ballVolume(testing::smallGrid(), {{{0, 0, 0}, 9.0}});
  FrameRenderer renderer(ct.grid, ct.solid, ct.label);
  Frame frame = testing::frameFor(cameraRig({.eye_P_mm = {0, -200, 0}, .fov_y_rad = 0.17}, {160, 120}));
  frame.display = DisplayMode::two_windows;
  renderer.render(frame);
  renderer.composeForBystander();
  FrameFence drawn;
  drawn.mark();
  Window second({.size_px = {160, 120}, .wait_for_refresh = false, .focused = false, .share_with = &first});
  drawn.waitOnGpu();
  renderer.showOnWindow({.size_px = {160, 120}}, 1);
  // The window shows the right eye's output.
  EXPECT_EQ(testing::windowPixels({160, 120}), renderer.readImage(1).rgba);
  EXPECT_NE(renderer.readImage(0).rgba, renderer.readImage(1).rgba);
  renderer.showBystander({.size_px = {160, 120}});
  EXPECT_EQ(testing::windowPixels({160, 120}), renderer.readEye(Eye::left).rgba);
  second.present();
  first.makeCurrent();
  EXPECT_NO_THROW(renderer.throwIfError());
}

TEST(Window, QuadBufferedStereoIsRefusedInOneLineWhereTheDriverHasNone) {
  if (!hasDisplay()) GTEST_SKIP() << "no DISPLAY: run under xvfb-run";
  try {
    const Window window({.size_px = {160, 120}, .quad_buffer = true});
    GTEST_SKIP() << "this driver has it";
  } catch (const GpuError& error) {
    EXPECT_NE(std::string(error.what()).find("quad-buffered"), std::string::npos);
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
  // A window without stereo still opens.
  EXPECT_NO_THROW(Window({.size_px = {160, 120}}));
}

TEST(Window, KnowsItsPositionOnThePanelAndRefusesAMissingMonitor) {
  if (!hasDisplay()) GTEST_SKIP() << "no DISPLAY: run under xvfb-run";
  ASSERT_GE(monitors().size(), 1u);
  EXPECT_GT(monitors()[0].px.x, 0);
  EXPECT_GT(monitors()[0].refresh_Hz, 0.0);
  const Window window({.size_px = {160, 120}, .monitor = 0});
  EXPECT_GE(window.positionOnPanel_px().x, 0);
  EXPECT_GT(window.refresh_Hz(), 0.0);
  EXPECT_THROW(Window({.size_px = {160, 120}, .monitor = 9, .share_with = &window}), GpuError);
}

}  // namespace
}  // namespace render
