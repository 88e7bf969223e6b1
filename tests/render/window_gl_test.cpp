// Needs an X display for all but the refusal: run under xvfb-run where there is none.
#include "render/display/window.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "render/gpu/gpu_error.h"
#include "tests/render/drawn_scene.h"

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

TEST(Window, ShowsAFrameOfTheRenderer) {
  if (!hasDisplay()) GTEST_SKIP() << "no DISPLAY: run under xvfb-run";
  Window::Options options;
  options.size_px = {320, 240};
  options.debugging = true;
  Window window(options);
  const assets::CtVolume ct = testing::ballVolume(testing::smallGrid(), {{{0, 0, 0}, 9.0}});
  FrameRenderer renderer(ct.grid, ct.solid, ct.label);
  const Frame frame = testing::frameFor(cameraRig({.eye_P_mm = {0, -200, 0}, .fov_y_rad = 0.17}, {320, 240}));
  renderer.render(frame);
  renderer.showOnWindow(window.framebufferSize_px());
  window.present();
  EXPECT_GT(renderer.readPicture().rgba[4 * (120 * 320 + 160)], 60);
  EXPECT_NO_THROW(renderer.throwIfError());
  EXPECT_NO_THROW(window.takeEvents());
}

}  // namespace
}  // namespace render
