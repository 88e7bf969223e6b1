#include "app/view/still_picture.h"

#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <vector>

#include "render/display/camera.h"
#include "render/quality_ladder.h"

namespace app {
namespace {

using std::chrono::milliseconds;
using Step = FrameDrawing;

constexpr assets::VolumeGrid kBlock{{32, 32, 32}, 0.25, {-4.0, -4.0, -4.0}};
constexpr StillPicture::Time kStart{};

render::Frame frameOfBur() {
  render::Frame frame;
  frame.rig = render::cameraRig({.eye_P_mm = {0, -40, 60}, .fov_y_rad = 0.25}, {96, 64});
  frame.X_PT.translation_mm = {0.0, 0.0, 5.0};
  frame.bur_radius_mm = 1.0;
  frame.quality = render::kQualitySteps.back().quality;
  return frame;
}

/// Still since 0 ms, and refined.
StillPicture refinedAt300(const render::Frame& frame) {
  StillPicture still;
  for (int ms = 0; ms <= 300; ms += 20) still.next(frame, false, kStart + milliseconds(ms));
  EXPECT_EQ(still.newest(), Step::refined);
  return still;
}

TEST(StillPicture, RefinesOnceAfterThreeTenthsOfASecondAndKeepsThePicture) {
  StillPicture still;
  const render::Frame frame = frameOfBur();
  for (int ms = 0; ms < 300; ms += 10) EXPECT_EQ(still.next(frame, false, kStart + milliseconds(ms)), Step::live) << ms;
  EXPECT_EQ(still.next(frame, false, kStart + milliseconds(300)), Step::refined);
  for (int ms = 310; ms < 5000; ms += 10)
    EXPECT_EQ(still.next(frame, false, kStart + milliseconds(ms)), Step::kept) << ms;
}

TEST(StillPicture, IsRefinedAgainWhereTheFieldHasChangedAndNothingMoves) {
  render::Frame frame = frameOfBur();
  frame.field.water = 1.0;
  StillPicture still = refinedAt300(frame);
  frame.field.water = 0.95;
  EXPECT_EQ(still.next(frame, false, kStart + milliseconds(320)), Step::kept) << "not seen";
  frame.field.water = 0.85;
  EXPECT_EQ(still.next(frame, false, kStart + milliseconds(340)), Step::refined);
  EXPECT_EQ(still.next(frame, false, kStart + milliseconds(360)), Step::kept);
}

TEST(StillPicture, IsRefinedAgainWhereAMarkOnSoftTissueHasChanged) {
  render::Frame frame = frameOfBur();
  frame.marks.reddened = {{{}, 3.5, 1.0}};
  StillPicture still = refinedAt300(frame);
  frame.marks.reddened[0].share = 0.95;
  EXPECT_EQ(still.next(frame, false, kStart + milliseconds(320)), Step::kept) << "not seen";
  frame.marks.reddened[0].share = 0.8;
  EXPECT_EQ(still.next(frame, false, kStart + milliseconds(340)), Step::refined);
  frame.marks.cuts = {{{}, {}, 1.5}};
  EXPECT_EQ(still.next(frame, false, kStart + milliseconds(360)), Step::refined);
  EXPECT_EQ(still.next(frame, false, kStart + milliseconds(380)), Step::kept);
}

TEST(StillPicture, DropsBackAtOnceWhateverMoves) {
  const render::Frame at_rest = frameOfBur();
  using Change = void (*)(render::Frame&);
  const std::pair<const char*, Change> changes[] = {
      {"bur", [](render::Frame& f) { f.X_PT.translation_mm.x += 0.05; }},
      {"tilt", [](render::Frame& f) { f.X_PT.rotation = glm::angleAxis(0.01, glm::dvec3(1, 0, 0)); }},
      {"turning bur", [](render::Frame& f) { f.bur_angle_rad += 0.1; }},
      {"another bur", [](render::Frame& f) { f.bur_radius_mm = 1.5; }},
      {"bur out of sight", [](render::Frame& f) { f.tool_visible = false; }},
      {"head of the surgeon", [](render::Frame& f) { f.rig.left_eye.mm.x += 1.0; }},
      {"turned view", [](render::Frame& f) { f.rig.X_WP.rotation = glm::angleAxis(0.01, glm::dvec3(0, 1, 0)); }},
      {"loupes", [](render::Frame& f) { f.rig.screen.lower_right.mm *= 1.1; }},
      {"layer", [](render::Frame& f) { f.layers.mandibular_canal = true; }},
      {"face", [](render::Frame& f) { f.layers.face_opacity = 0.5f; }},
      {"scrolled slice", [](render::Frame& f) { f.slices_beside_bur_P_mm.z = 0.5; }},
      {"ruler", [](render::Frame& f) { f.ruler = render::RulerLine{}; }},
      {"mirror", [](render::Frame& f) { f.second_visible = true; }},
      {"curing lamp", [](render::Frame& f) { f.curing = render::CuringSpot{}; }},
      {"tooth",
       [](render::Frame& f) {
         f.pieces[0] = {{1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.05}};
       }},
      {"tooth that turns",
       [](render::Frame& f) {
         f.pieces[1] = {glm::angleAxis(0.01, glm::dvec3(1, 0, 0)), {}};
       }},
  };
  for (const auto& [name, change] : changes) {
    StillPicture still = refinedAt300(at_rest);
    render::Frame moved = at_rest;
    change(moved);
    EXPECT_EQ(still.next(moved, false, kStart + milliseconds(310)), Step::live) << name;
    EXPECT_EQ(still.next(moved, false, kStart + milliseconds(600)), Step::live) << name << ": the time begins anew";
    EXPECT_EQ(still.next(moved, false, kStart + milliseconds(610)), Step::refined) << name;
  }
  StillPicture still = refinedAt300(at_rest);
  EXPECT_EQ(still.next(at_rest, true, kStart + milliseconds(310)), Step::live) << "bone or warning";

  render::Frame out = at_rest;
  out.pieces[0] = {{1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 5.0}};
  StillPicture of_tooth = refinedAt300(out);
  EXPECT_EQ(of_tooth.next(out, false, kStart + milliseconds(320)), Step::kept);
  out.pieces[0]->translation_mm.z = 5.1;
  EXPECT_EQ(of_tooth.next(out, false, kStart + milliseconds(340)), Step::live) << "a piece further out";
}

TEST(StillPicture, TheTrembleOfARestingHandIsNoMotionButASlowDriftIs) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> tremble_mm(-0.008, 0.008);
  StillPicture still;
  int refined = 0, live = 0;
  for (int ms = 0; ms < 3000; ms += 10) {
    render::Frame frame = frameOfBur();
    frame.X_PT.translation_mm += glm::dvec3(tremble_mm(random), tremble_mm(random), tremble_mm(random));
    const Step step = still.next(frame, false, kStart + milliseconds(ms));
    refined += step == Step::refined;
    live += step == Step::live;
  }
  EXPECT_EQ(refined, 1);
  EXPECT_EQ(live, 30);
  render::Frame drifting = frameOfBur();
  int back_to_live = 0;
  for (int ms = 3000; ms < 6000; ms += 10) {
    drifting.X_PT.translation_mm.x += 0.001;
    back_to_live += still.next(drifting, false, kStart + milliseconds(ms)) == Step::live;
  }
  EXPECT_GT(back_to_live, 100) << "never more than the tolerance behind";
}

/// A block of bone on the processor; what `frames` leave on the screen.
struct Screen {
  std::vector<std::uint8_t> solid = std::vector<std::uint8_t>(kBlock.voxelCount(), 0);
  std::unique_ptr<SurgeonDisplay> display;

  Screen() {
    for (int k = 8; k < 24; ++k)
      for (int j = 8; j < 24; ++j)
        for (int i = 8; i < 24; ++i) solid[kBlock.index({i, j, k})] = 255;
    SurgeonDisplay::Options options;
    options.backend = render::Backend::cpu;
    options.headless = true;
    options.needs_window = false;
    display = std::make_unique<SurgeonDisplay>(
        options,
        [this](render::Backend backend) {
          return std::make_unique<render::FrameRenderer>(kBlock, solid, std::vector<std::uint8_t>{},
                                                         render::RenderOptions{.backend = backend});
        },
        [](const std::string&) {});
  }
  std::vector<std::uint8_t> shown() { return display->renderer().readImage().rgba; }
};

std::vector<std::uint8_t> fullQualityOf(render::Frame frame) {
  Screen screen;
  frame.quality = render::kQualitySteps.front().quality;
  screen.display->show(frame);
  return screen.shown();
}

TEST(StillPicture, TheRefinedPictureIsTheOneOfFullQualityBitForBit) {
  Screen screen;
  StillPicture still;
  const render::Frame frame = frameOfBur();
  const std::vector<std::uint8_t> full = fullQualityOf(frame);
  for (int ms = 0; ms < 1000; ms += 50) {
    show(*screen.display, frame, still.next(frame, false, kStart + milliseconds(ms)));
    EXPECT_EQ(screen.shown() == full, ms >= 300) << ms;
  }
  render::Frame moved = frame;
  moved.X_PT.translation_mm.x += 1.0;
  show(*screen.display, moved, still.next(moved, false, kStart + milliseconds(1000)));
  EXPECT_NE(screen.shown(), fullQualityOf(moved));
  Screen live;
  live.display->show(moved);
  EXPECT_EQ(screen.shown(), live.shown()) << "at the live quality at once";
}

TEST(StillPicture, NewTextIsComposedOverTheKeptPicture) {
  render::OverlayPanel panel;
  panel.image = {20, 10, std::vector<std::uint8_t>(800, 200)};
  panel.corner_px = {8, 8};
  panel.serial = 1;
  const render::Frame frame = frameOfBur();
  Screen kept, drawn;
  show(*kept.display, frame, Step::refined);
  const std::vector<std::uint8_t> before = kept.shown();
  kept.display->renderer().setOverlay({panel});
  show(*kept.display, frame, Step::kept);
  drawn.display->renderer().setOverlay({panel});
  show(*drawn.display, frame, Step::refined);
  EXPECT_EQ(kept.shown(), drawn.shown());
  EXPECT_NE(kept.shown(), before);
}

}  // namespace
}  // namespace app
