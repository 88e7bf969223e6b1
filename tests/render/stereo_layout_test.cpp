#include "render/display/stereo_layout.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "render/display/anaglyph.h"

namespace render {
namespace {

constexpr glm::ivec2 kScreen{12, 8};

// Counts how often every pixel of either eye is shown over all outputs of a mode, and the black output pixels.
struct Census {
  std::map<std::pair<int, int>, int> left, right;
  int black = 0, cyclopean = 0, both = 0;
};

Census censusOf(StereoLayout layout) {
  Census census;
  const glm::ivec2 size = outputSize(layout.mode, layout.screen_px);
  for (layout.output = 0; layout.output < outputCount(layout.mode); ++layout.output)
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x) {
        const SourcePixel shown = sourcePixelAt(layout, {x, y});
        if (shown.eye == PixelSource::left) ++census.left[{shown.px.x, shown.px.y}];
        if (shown.eye == PixelSource::right) ++census.right[{shown.px.x, shown.px.y}];
        census.black += shown.eye == PixelSource::black;
        census.cyclopean += shown.eye == PixelSource::cyclopean;
        census.both += shown.eye == PixelSource::both;
      }
  return census;
}

TEST(StereoLayout, EveryModeHasOneNameAndTheNameFindsIt) {
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < kDisplayModes.size(); ++i) {
    EXPECT_EQ(static_cast<std::size_t>(kDisplayModes[i].mode), i) << "the table is in the order of the enum";
    EXPECT_EQ(displayModeNamed(kDisplayModes[i].name), kDisplayModes[i].mode);
    EXPECT_EQ(nameOf(kDisplayModes[i].mode), kDisplayModes[i].name);
    names.insert(kDisplayModes[i].name);
  }
  EXPECT_EQ(names.size(), kDisplayModes.size());
  EXPECT_FALSE(displayModeNamed("stereo"));
}

TEST(StereoLayout, SplitModesShowEveryPixelOfBothEyesOnce) {
  for (const DisplayMode mode :
       {DisplayMode::quad_buffer, DisplayMode::two_windows, DisplayMode::side_by_side, DisplayMode::side_by_side_full,
        DisplayMode::top_bottom, DisplayMode::top_bottom_full, DisplayMode::frame_packing}) {
    const Census census = censusOf({.mode = mode, .screen_px = kScreen});
    const glm::ivec2 eye = eyeImageSize(mode, kScreen);
    for (const auto* seen : {&census.left, &census.right}) {
      EXPECT_EQ(seen->size(), static_cast<std::size_t>(eye.x * eye.y)) << nameOf(mode);
      for (const auto& [px, times] : *seen) {
        EXPECT_EQ(times, 1) << nameOf(mode);
        EXPECT_TRUE(px.first >= 0 && px.second >= 0 && px.first < eye.x && px.second < eye.y) << nameOf(mode);
      }
    }
  }
}

TEST(StereoLayout, TheLeftEyeIsLeftAboveOrFirst) {
  const auto eyeAt = [](DisplayMode mode, glm::ivec2 px) {
    return sourcePixelAt({.mode = mode, .screen_px = kScreen}, px);
  };
  EXPECT_EQ(eyeAt(DisplayMode::side_by_side, {5, 3}), (SourcePixel{PixelSource::left, {5, 3}}));
  EXPECT_EQ(eyeAt(DisplayMode::side_by_side, {6, 3}), (SourcePixel{PixelSource::right, {0, 3}}));
  EXPECT_EQ(eyeAt(DisplayMode::side_by_side_full, {11, 3}), (SourcePixel{PixelSource::left, {11, 3}}));
  EXPECT_EQ(eyeAt(DisplayMode::side_by_side_full, {23, 3}), (SourcePixel{PixelSource::right, {11, 3}}));
  EXPECT_EQ(eyeAt(DisplayMode::top_bottom, {7, 3}), (SourcePixel{PixelSource::left, {7, 3}}));
  EXPECT_EQ(eyeAt(DisplayMode::top_bottom, {7, 4}), (SourcePixel{PixelSource::right, {7, 0}}));
  EXPECT_EQ(eyeAt(DisplayMode::top_bottom_full, {7, 15}), (SourcePixel{PixelSource::right, {7, 7}}));
  const StereoLayout second{.mode = DisplayMode::quad_buffer, .screen_px = kScreen, .output = 1};
  EXPECT_EQ(sourcePixelAt(second, {2, 1}), (SourcePixel{PixelSource::right, {2, 1}}));
}

TEST(StereoLayout, AHalvedOddSizeLeavesItsLastLineBlack) {
  const Census census = censusOf({.mode = DisplayMode::side_by_side, .screen_px = {13, 8}});
  EXPECT_EQ(census.black, 8);
  EXPECT_EQ(census.left.size(), 48u);
  EXPECT_EQ(census.right.size(), 48u);
}

// HDMI 1.4a: 1920x2205 with lines 1080 to 1124 blank, 1280x1470 with lines 720 to 749 blank.
TEST(StereoLayout, PackedFramesHaveTheSizesAndGapsOfHdmi) {
  struct Case {
    glm::ivec2 screen, output;
    int gap;
  };
  for (const Case& c : {Case{{1920, 1080}, {1920, 2205}, 45}, Case{{1280, 720}, {1280, 1470}, 30}}) {
    const StereoLayout layout{.mode = DisplayMode::frame_packing, .screen_px = c.screen};
    EXPECT_TRUE(isPackable(c.screen));
    EXPECT_EQ(outputSize(layout.mode, c.screen), c.output);
    for (int y = 0; y < c.output.y; ++y) {
      const SourcePixel expected = y < c.screen.y ? SourcePixel{PixelSource::left, {100, y}}
                                   : y < c.screen.y + c.gap
                                       ? SourcePixel{}
                                       : SourcePixel{PixelSource::right, {100, y - c.screen.y - c.gap}};
      ASSERT_EQ(sourcePixelAt(layout, {100, y}), expected) << y;
    }
  }
  EXPECT_FALSE(isPackable({1920, 1200}));
}

TEST(StereoLayout, InterleavedPixelsKeepTheirPositionsAndAlternate) {
  for (int y = 0; y < kScreen.y; ++y)
    for (int x = 0; x < kScreen.x; ++x) {
      const auto eyeIn = [&](DisplayMode mode) {
        const SourcePixel shown = sourcePixelAt({.mode = mode, .screen_px = kScreen}, {x, y});
        EXPECT_EQ(shown.px, glm::ivec2(x, y));
        return shown.eye;
      };
      EXPECT_EQ(eyeIn(DisplayMode::row_interleaved), y % 2 == 0 ? PixelSource::left : PixelSource::right);
      EXPECT_EQ(eyeIn(DisplayMode::column_interleaved), x % 2 == 0 ? PixelSource::left : PixelSource::right);
      EXPECT_EQ(eyeIn(DisplayMode::checkerboard), (x + y) % 2 == 0 ? PixelSource::left : PixelSource::right);
    }
}

// The panel's polarisers do not move with the window: a position on the panel always belongs to the same eye.
TEST(StereoLayout, ParityFollowsThePanelWhereverTheWindowIs) {
  for (const DisplayMode mode :
       {DisplayMode::row_interleaved, DisplayMode::column_interleaved, DisplayMode::checkerboard})
    for (const glm::ivec2 at : {glm::ivec2(1, 0), glm::ivec2(0, 1), glm::ivec2(7, 3), glm::ivec2(-3, -1)})
      for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 20; ++x) {
          const StereoLayout still{.mode = mode, .screen_px = {20, 20}},
              moved{.mode = mode, .screen_px = {20, 20}, .at_px = at};
          const glm::ivec2 inside = glm::ivec2(x, y) - at;
          if (inside.x < 0 || inside.y < 0 || inside.x >= 20 || inside.y >= 20) continue;
          ASSERT_EQ(sourcePixelAt(moved, inside).eye, sourcePixelAt(still, {x, y}).eye) << nameOf(mode);
        }
}

TEST(StereoLayout, SwappingExchangesTheEyesAndNothingElse) {
  for (const DisplayModeName& one : kDisplayModes) {
    const Census as_is = censusOf({.mode = one.mode, .screen_px = kScreen});
    const Census swapped = censusOf({.mode = one.mode, .screen_px = kScreen, .swapped = true});
    EXPECT_EQ(as_is.left, swapped.right) << one.name;
    EXPECT_EQ(as_is.right, swapped.left) << one.name;
    EXPECT_EQ(as_is.black, swapped.black) << one.name;
  }
}

TEST(StereoLayout, OneEyeOrBothFillTheWholeOutput) {
  EXPECT_EQ(censusOf({.mode = DisplayMode::mono, .screen_px = kScreen}).cyclopean, 96);
  EXPECT_EQ(censusOf({.mode = DisplayMode::anaglyph, .screen_px = kScreen}).both, 96);
  EXPECT_EQ(censusOf({.mode = DisplayMode::anaglyph_red_cyan, .screen_px = kScreen}).both, 96);
}

TEST(Anaglyph, KeepsWhiteAndBlackAndGivesEachEyeItsChannels) {
  const glm::dvec3 white(1.0), black(0.0);
  for (const DisplayMode mode : {DisplayMode::anaglyph, DisplayMode::anaglyph_red_cyan}) {
    // The published rows sum to 1 within their three digits.
    EXPECT_LT(glm::distance(anaglyph(mode, white, white), white), 0.002);
    EXPECT_EQ(anaglyph(mode, black, black), black);
    // White in one eye, black in the other: red is the left eye's, green and blue are the right eye's.
    EXPECT_GT(anaglyph(mode, white, black).r, 0.99);
    EXPECT_LT(anaglyph(mode, white, black).g, 0.01);
    EXPECT_LT(anaglyph(mode, white, black).b, 0.01);
    EXPECT_LT(anaglyph(mode, black, white).r, 0.01);
    EXPECT_GT(anaglyph(mode, black, white).g, 0.99);
    EXPECT_GT(anaglyph(mode, black, white).b, 0.99);
  }
  // With plain channels pure red is dark behind the cyan filter; least squares distributes it over both eyes.
  const glm::dvec3 red(1.0, 0.0, 0.0);
  EXPECT_EQ(anaglyph(DisplayMode::anaglyph_red_cyan, red, red), red);
  EXPECT_GT(anaglyph(DisplayMode::anaglyph, red, red).g, 0.3);
}

}  // namespace
}  // namespace render
