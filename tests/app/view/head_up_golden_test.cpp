// The text in the picture against stored images: what a surgeon reads, looked at by eye. After an intended change:
//   MOLAR_WRITE_GOLDEN=1 build/release/tests/app/view/app_view_test --gtest_filter="HeadUpGolden*"
#include <gtest/gtest.h>

#include "app/view/head_up_line.h"
#include "render/cpu/cpu_compositor.h"
#include "render/display/camera.h"
#include "tests/app/view/golden_image.h"

namespace app {
namespace {

/// The text's rasteriser differs between versions of FreeType: half a grey value.
void expectGolden(const render::Image& image, const std::string& name) { test::expectGolden(image, name, 0.5); }

HeadUpContent drilling() {
  HeadUpContent content;
  content.bur = "round 3.0 mm, ISO 030";
  content.drive = "39,500 rpm";
  content.turning = true;
  content.irrigating = false;
  content.force_N = 1.3;
  content.force_share = 0.8;
  content.gap_mm = 2.4;
  content.time_s = 754.0;
  content.said = "irrigation off: the bur cuts dry";
  content.warnings = {{"Lower right second molar touched", true}, {"Nerve 1.4 mm", false}};
  return content;
}

/// The panels over the colour of gingiva, as an output of a display mode shows them.
render::Image shown(const HeadUpContent& content, render::DisplayMode mode) {
  constexpr glm::ivec2 kPx{960, 600};
  render::Frame frame;
  frame.rig = render::cameraRig(
      {.eye_P_mm = {0, -300, 0}, .look_at_P_mm = {0, 0, 0}, .up_P = {0, 0, 1}, .fov_y_rad = 0.3}, kPx);
  HeadUpLine line;
  line.update(content, headUpPlace(frame.rig, mode, frame));
  const render::StereoLayout layout{.mode = mode, .screen_px = kPx};
  render::Image image{kPx.x, kPx.y, {}};
  for (int p = 0; p < kPx.x * kPx.y; ++p) image.rgba.insert(image.rgba.end(), {200, 120, 115, 255});
  for (const render::OverlayPanel& panel : line.panels())
    render::blendOver(render::patchOf(panel, layout, render::screenOrientation(frame.rig)), image);
  return image;
}

TEST(HeadUpGolden, LineAndWarnings) { expectGolden(shown(drilling(), render::DisplayMode::mono), "head_up_line.png"); }

TEST(HeadUpGolden, SideBySide) {
  expectGolden(shown(drilling(), render::DisplayMode::side_by_side), "head_up_side_by_side.png");
}

TEST(HeadUpGolden, RowInterleavedIsLegible) {
  expectGolden(shown(drilling(), render::DisplayMode::row_interleaved), "head_up_interleaved.png");
}

TEST(HeadUpGolden, SheetOfKeys) {
  HeadUpContent content;
  content.bur = "fissure 1.6 mm, ISO 016";
  content.drive = "drill off";
  content.keys = {{"Space", "pedal: drill while held"},
                  {"Drag", "move in the screen's plane"},
                  {"Arrows", "tilt the handpiece"},
                  {"T", "change the tool"},
                  {"F1, ?", "show or close these keys"}};
  expectGolden(shown(content, render::DisplayMode::mono), "head_up_keys.png");
}

}  // namespace
}  // namespace app
