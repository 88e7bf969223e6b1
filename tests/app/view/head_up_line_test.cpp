#include "app/view/head_up_line.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "app/text/clock_text.h"
#include "render/display/camera.h"

namespace app {
namespace {

HeadUpContent atWork() {
  HeadUpContent content;
  content.bur = "round-end fissure 1.6 mm, ISO 016";
  content.drive = "40,000 rpm";
  content.turning = true;
  content.force_N = 1.2;
  content.force_share = 0.4;
  content.gap_mm = 3.2;
  content.time_s = 65.4;
  content.said = "snapshot /data/molar/pictures/molar-snapshot-12.png";
  content.warnings = {
      {"Lower right second molar touched", true}, {"Cutting dry: water on with I", false}, {"third", false}};
  return content;
}

/// Frames whose site is in the middle of the picture, as rigs and desktop have it.
render::Frame frameOf(glm::ivec2 px, double rise_mm = 0.0) {
  render::Frame frame;
  frame.rig =
      render::cameraRig({.eye_P_mm = {0, -300, 0}, .look_at_P_mm = {0, 0, 0}, .up_P = {0, 0, 1}, .fov_y_rad = 0.3}, px);
  frame.site_P = {glm::dvec3(0, 0, rise_mm)};
  return frame;
}

bool overlap(const render::OverlayPanel& a, const render::OverlayPanel& b) {
  return a.corner_px.x < b.corner_px.x + b.image.w && b.corner_px.x < a.corner_px.x + a.image.w &&
         a.corner_px.y < b.corner_px.y + b.image.h && b.corner_px.y < a.corner_px.y + a.image.h;
}

HeadUpRing ringOf(std::size_t tools, const glm::dvec2& middle) {
  const std::vector<std::string> names = {"round 3.0 mm, ISO 030",
                                          "round-end fissure 2.1 mm, ISO 021",
                                          "elevator 301",
                                          "extraction forceps",
                                          "curette",
                                          "bone file",
                                          "suction tip",
                                          "scalpel 15",
                                          "periosteal elevator"};
  return {{names.begin(), names.begin() + static_cast<std::ptrdiff_t>(tools)}, 0, tools - 1, middle};
}

// On every screen, wherever the hand is: inside the picture, with letters no smaller than half of the others.
TEST(HeadUpLine, TheRingOfInstrumentsIsInThePicture) {
  for (const glm::ivec2 px : {glm::ivec2(1280, 800), glm::ivec2(640, 400), glm::ivec2(800, 1280)})
    for (const std::size_t tools : {1u, 2u, 9u})
      for (const glm::dvec2& middle :
           {glm::dvec2(0.8, 0.5), glm::dvec2(0.0, 0.0), glm::dvec2(1.6, 1.0), glm::dvec2(9.0, -4.0)}) {
        HeadUpContent content;
        content.line_shown = false;
        content.ring = ringOf(tools, middle);
        HeadUpLine line;
        const render::Frame frame = frameOf(px);
        ASSERT_TRUE(line.update(content, headUpPlace(frame.rig, render::DisplayMode::mono, frame)));
        ASSERT_EQ(line.panels().size(), 1u);
        const render::OverlayPanel& panel = line.panels()[0];
        EXPECT_GE(panel.corner_px.x, 0);
        EXPECT_GE(panel.corner_px.y, 0);
        EXPECT_LE(panel.corner_px.x + panel.image.w, px.x);
        EXPECT_LE(panel.corner_px.y + panel.image.h, px.y);
        if (middle == glm::dvec2(0.8, 0.5) && px == glm::ivec2(1280, 800)) {
          EXPECT_GT(panel.image.h, static_cast<int>(0.3 * px.y)) << tools;
        }
      }
}

TEST(HeadUpLine, TheRingIsDrawnAgainOnlyWhenAnotherInstrumentIsChosen) {
  HeadUpContent content;
  content.line_shown = false;
  content.ring = ringOf(9, {0.8, 0.5});
  HeadUpLine line;
  const render::Frame frame = frameOf({1280, 800});
  const HeadUpPlace place = headUpPlace(frame.rig, render::DisplayMode::mono, frame);
  ASSERT_TRUE(line.update(content, place));
  EXPECT_FALSE(line.update(content, place));
  content.ring.chosen = 3;
  EXPECT_TRUE(line.update(content, place));
  content.ring = {};
  line.update(content, place);
  EXPECT_TRUE(line.panels().empty());
}

// For every screen and every position of the site: inside the picture, apart from each other, away from the site.
TEST(HeadUpLine, IsInThePictureAndNeverOverTheSite) {
  for (const glm::ivec2 px :
       {glm::ivec2(1280, 800), glm::ivec2(640, 400), glm::ivec2(1920, 1080), glm::ivec2(800, 1280)})
    for (const double rise_mm : {-22.0, -8.0, 0.0, 20.0})
      for (const bool slices : {false, true})
        for (const auto mode : {render::DisplayMode::mono, render::DisplayMode::row_interleaved}) {
          render::Frame frame = frameOf(px, rise_mm);
          frame.layers.slices = slices;
          HeadUpLine line;
          ASSERT_TRUE(line.update(atWork(), headUpPlace(frame.rig, mode, frame)));
          ASSERT_EQ(line.panels().size(), px.x < 1000 && (slices || px.x < 700) ? line.panels().size() : 9u)
              << "six cells, two warnings, what was said";
          ASSERT_GE(line.panels().size(), 5u) << "gap and force at least";
          // The camera's picture is 2 * 300 * tan(0.15) mm high.
          const double site_y = px.y * (0.5 - rise_mm / (600.0 * std::tan(0.15)));
          for (std::size_t n = 0; n < line.panels().size(); ++n) {
            const render::OverlayPanel& panel = line.panels()[n];
            EXPECT_GE(panel.corner_px.x, 0);
            EXPECT_GE(panel.corner_px.y, 0);
            EXPECT_LE(panel.corner_px.x + panel.image.w, px.x);
            EXPECT_LE(panel.corner_px.y + panel.image.h, px.y);
            const double above = panel.corner_px.y - site_y, below = site_y - panel.corner_px.y - panel.image.h;
            EXPECT_GT(std::max(above, below), 0.12 * px.y) << "panel " << n << " of " << px.x << " at " << rise_mm;
            if (slices) {
              EXPECT_GE(panel.corner_px.x, static_cast<int>(0.325 * px.y)) << "on the slices";
            }
            for (std::size_t m = 0; m < n; ++m) EXPECT_FALSE(overlap(panel, line.panels()[m])) << n << " and " << m;
          }
        }
}

// For every screen, wherever bur and shaft are: beside both bur and site, inside the picture, on no other panel.
TEST(HeadUpLine, TheRulerStandsBesideBurAndSite) {
  for (const glm::ivec2 px : {glm::ivec2(1280, 800), glm::ivec2(640, 400), glm::ivec2(1920, 1080)})
    for (const double rise_mm : {-15.0, 0.0, 15.0})
      for (const double bur_x_mm : {-12.0, 0.0, 9.0})
        for (const double bur_z_mm : {-14.0, 0.0, 14.0})
          for (const double shaft_rad : {0.7, -0.7})
            for (const auto mode : {render::DisplayMode::mono, render::DisplayMode::side_by_side}) {
              render::Frame frame = frameOf(px, rise_mm);
              frame.X_PT = {glm::angleAxis(shaft_rad, glm::dvec3(0, 1, 0)), {bur_x_mm, 0.0, bur_z_mm + rise_mm}};
              HeadUpContent content = atWork();
              HeadUpLine without, with;
              const HeadUpPlace place = headUpPlace(frame.rig, mode, frame);
              without.update(content, place);
              content.clearances = {{"canal", 0.4, assets::RiskLevel::red},
                                    {"second molar", 0.4, assets::RiskLevel::amber},
                                    {"lingual nerve (modelled)", 1.2, assets::RiskLevel::note},
                                    {"lingual plate", 1.9, assets::RiskLevel::note}};
              ASSERT_TRUE(with.update(content, place));
              ASSERT_EQ(with.panels().size(), without.panels().size() + 1) << "three rows on one panel";
              const auto ruler = std::ranges::find_if(with.panels(), [&](const render::OverlayPanel& panel) {
                return std::ranges::none_of(without.panels(), [&](const render::OverlayPanel& old) {
                  return old.corner_px == panel.corner_px && old.image.w == panel.image.w;
                });
              });
              ASSERT_NE(ruler, with.panels().end());
              EXPECT_GE(ruler->corner_px.x, 0);
              EXPECT_GE(ruler->corner_px.y, 0);
              EXPECT_LE(ruler->corner_px.x + ruler->image.w, px.x);
              EXPECT_LE(ruler->corner_px.y + ruler->image.h, px.y);
              // The camera's picture is 2 * 300 * tan(0.15) mm high.
              const double per_mm = px.y / (600.0 * std::tan(0.15));
              for (const double x_mm : {0.0, bur_x_mm}) {
                const double x_px = 0.5 * px.x + per_mm * x_mm;
                EXPECT_TRUE(ruler->corner_px.x > x_px + 4.0 * per_mm ||
                            ruler->corner_px.x + ruler->image.w < x_px - 4.0 * per_mm)
                    << px.x << " bur at " << bur_x_mm << ", " << bur_z_mm;
              }
              for (const render::OverlayPanel& panel : with.panels()) {
                if (&panel != &*ruler) {
                  EXPECT_FALSE(overlap(panel, *ruler)) << px.x << " rise " << rise_mm << " bur at " << bur_z_mm;
                }
              }
            }
}

TEST(HeadUpLine, DrawsOnlyWhatChanged) {
  const render::Frame frame = frameOf({1280, 800});
  const HeadUpPlace place = headUpPlace(frame.rig, render::DisplayMode::mono, frame);
  HeadUpLine line;
  HeadUpContent content = atWork();
  line.update(content, place);
  EXPECT_FALSE(line.update(content, place));
  content.force_share += 1e-4;  // less than a step of the bar
  content.time_s += 0.4;        // the same second
  EXPECT_FALSE(line.update(content, place));
  const std::vector<render::OverlayPanel> before = line.panels();
  content.time_s += 1.0;
  EXPECT_TRUE(line.update(content, place));
  int changed = 0;
  for (std::size_t n = 0; n < before.size(); ++n) changed += before[n].serial != line.panels()[n].serial;
  EXPECT_EQ(changed, 1);
}

TEST(HeadUpLine, IsSwitchedOffWhileWarningsStay) {
  const render::Frame frame = frameOf({1280, 800});
  const HeadUpPlace place = headUpPlace(frame.rig, render::DisplayMode::mono, frame);
  HeadUpLine line;
  HeadUpContent content = atWork();
  content.line_shown = false;
  line.update(content, place);
  EXPECT_EQ(line.panels().size(), 3u);
  content.warnings.clear();
  content.said.clear();
  EXPECT_TRUE(line.update(content, place));
  EXPECT_TRUE(line.panels().empty());
}

TEST(HeadUpLine, ShowsTheGapBelowTenMillimetres) {
  const render::Frame frame = frameOf({1280, 800});
  const HeadUpPlace place = headUpPlace(frame.rig, render::DisplayMode::mono, frame);
  const auto gap_cell = [&](std::optional<double> gap_mm) {
    HeadUpLine line;
    HeadUpContent content;
    content.gap_mm = gap_mm;
    line.update(content, place);
    return line.panels()[4].image.rgba;
  };
  EXPECT_EQ(gap_cell(10.5), gap_cell({}));
  EXPECT_NE(gap_cell(9.5), gap_cell({}));
  EXPECT_NE(gap_cell(0.0), gap_cell(0.1)) << "contact";
}

TEST(HeadUpLine, AClearanceThatNobodyConfirmedIsGrey) {
  const render::Frame frame = frameOf({1280, 800}, 0.0);
  HeadUpContent content = atWork();
  content.clearances = {{"canal", 0.4, assets::RiskLevel::red}};
  const HeadUpPlace place = headUpPlace(frame.rig, render::DisplayMode::mono, frame);
  HeadUpLine line;
  const auto reddish = [&] {
    int count = 0;
    for (const render::OverlayPanel& panel : line.panels())
      for (std::size_t v = 0; v + 3 < panel.image.rgba.size(); v += 4)
        count += panel.image.rgba[v] > 150 && panel.image.rgba[v + 1] < 110 && panel.image.rgba[v + 3] > 200 ? 1 : 0;
    return count;
  };
  line.update(content, place);
  const int with_band = reddish();
  content.clearances.front().is_confirmed = false;
  ASSERT_TRUE(line.update(content, place));
  const int grey = reddish();
  EXPECT_GT(with_band, grey + 50);
  content.clearances.clear();
  ASSERT_TRUE(line.update(content, place));
  EXPECT_EQ(grey, reddish()) << "the rest is as it was";
}

TEST(HeadUpLine, HasACellForTheRulerWhileThereIsOne) {
  const render::Frame frame = frameOf({1280, 800});
  const HeadUpPlace place = headUpPlace(frame.rig, render::DisplayMode::mono, frame);
  HeadUpContent content = atWork();
  HeadUpLine line;
  line.update(content, place);
  const std::size_t without = line.panels().size();
  content.ruler = "ruler 7.3 mm";
  EXPECT_TRUE(line.update(content, place));
  EXPECT_EQ(line.panels().size(), without + 1);
  for (std::size_t n = 1; n < line.panels().size(); ++n)
    for (std::size_t m = 0; m < n; ++m) EXPECT_FALSE(overlap(line.panels()[n], line.panels()[m])) << n << " " << m;
  content.ruler.clear();
  line.update(content, place);
  EXPECT_EQ(line.panels().size(), without);
}

TEST(HeadUpLine, LettersAreLargerWhereAnEyeGetsFewerLines) {
  const render::Frame frame = frameOf({1280, 800});
  const auto height = [&](render::DisplayMode mode) {
    return headUpTextHeight_px(headUpPlace(frame.rig, mode, frame));
  };
  EXPECT_GT(height(render::DisplayMode::row_interleaved), 1.2 * height(render::DisplayMode::mono));
  EXPECT_GT(height(render::DisplayMode::top_bottom), 1.2 * height(render::DisplayMode::mono));
  EXPECT_DOUBLE_EQ(height(render::DisplayMode::anaglyph), height(render::DisplayMode::mono));
}

TEST(HeadUpLine, TimeIsMinutesAndSeconds) {
  EXPECT_EQ(clockText(0.0), "0:00");
  EXPECT_EQ(clockText(65.9), "1:05");
  EXPECT_EQ(clockText(3600.0), "60:00");
  double sum_s = 0.0;
  for (int n = 0; n < 3000; ++n) sum_s += 1e-3;
  EXPECT_LT(sum_s, 3.0) << "of ticks";
  EXPECT_EQ(clockText(sum_s), "0:03");
  EXPECT_EQ(clockText(std::numeric_limits<double>::quiet_NaN()), "0:00");
}

}  // namespace
}  // namespace app
