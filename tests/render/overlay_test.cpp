// Overlay panels as patches of an output: at the same place for both eyes, upright for the viewer of every panel and
// mirror, in every display mode.
#include "render/display/overlay.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "render/display/anaglyph.h"
#include "render/display/eye_projection.h"
#include "render/display/srgb.h"

namespace render {
namespace {

constexpr glm::ivec2 kSmallScreen{22, 14};

OverlayPanel randomPanel(glm::ivec2 corner_px, glm::ivec2 size_px, unsigned seed, bool grey = false) {
  std::mt19937 random(seed);
  OverlayPanel panel{{size_px.x, size_px.y, {}}, corner_px, 1};
  for (int p = 0; p < size_px.x * size_px.y; ++p) {
    const auto alpha = static_cast<unsigned>(random() % 256);
    for (unsigned c = 0, value = 0; c < 3; ++c) {
      if (c == 0 || !grey) value = static_cast<unsigned>(random()) % (alpha + 1);
      panel.image.rgba.push_back(static_cast<std::uint8_t>(value));
    }
    panel.image.rgba.push_back(static_cast<std::uint8_t>(alpha));
  }
  return panel;
}

/// Of the viewer's screen; transparent outside the panel.
std::array<int, 4> panelAt(const OverlayPanel& panel, glm::ivec2 seen_px) {
  const glm::ivec2 at = seen_px - panel.corner_px;
  if (at.x < 0 || at.y < 0 || at.x >= panel.image.w || at.y >= panel.image.h) return {};
  const std::uint8_t* c = &panel.image.rgba[static_cast<std::size_t>(4 * (at.y * panel.image.w + at.x))];
  return {c[0], c[1], c[2], c[3]};
}

/// The viewer's pixel that shows a pixel of the framebuffer image: the inverse of imageBox, pixel by pixel.
glm::ivec2 seenPixel(glm::ivec2 image_px, const ScreenOrientation& orientation) {
  glm::ivec2 at(orientation.flip_x ? kSmallScreen.x - 1 - image_px.x : image_px.x,
                orientation.flip_y ? kSmallScreen.y - 1 - image_px.y : image_px.y);
  return orientation.transposed ? glm::ivec2(at.y, at.x) : at;
}

std::vector<ScreenOrientation> allOrientations() {
  std::vector<ScreenOrientation> all;
  for (int n = 0; n < 8; ++n) all.push_back({(n & 1) != 0, (n & 2) != 0, (n & 4) != 0});
  return all;
}

// Pixel by pixel: the mean of the screen's pixels that an output pixel stands for.
TEST(Overlay, IsThePanelInEveryPixelOfEveryModeAndOrientation) {
  unsigned seed = 1;
  for (const DisplayModeName& known : kDisplayModes)
    for (const ScreenOrientation& orientation : allOrientations())
      for (const glm::ivec2 corner : {glm::ivec2(3, 2), glm::ivec2(-4, -3), glm::ivec2(9, 7)}) {
        if (isInterleaved(known.mode) || known.mode == DisplayMode::anaglyph) continue;  // filtered or mixed: below
        const OverlayPanel panel = randomPanel(corner, {9, 6}, seed++);
        StereoLayout layout{.mode = known.mode, .screen_px = kSmallScreen};
        const glm::ivec2 eye_px = eyeImageSize(known.mode, kSmallScreen), by = kSmallScreen / eye_px;
        const OverlayPatch patch = patchOf(panel, layout, orientation);
        const glm::ivec2 size = outputSize(known.mode, kSmallScreen);
        for (layout.output = 0; layout.output < outputCount(known.mode); ++layout.output)
          for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
              std::array<int, 4> expected{}, got{};
              if (const SourcePixel shown = sourcePixelAt(layout, {x, y}); shown.eye != PixelSource::black)
                for (int j = 0; j < by.y; ++j)
                  for (int i = 0; i < by.x; ++i) {
                    const auto part = panelAt(panel, seenPixel(shown.px * by + glm::ivec2(i, j), orientation));
                    for (std::size_t c = 0; c < 4; ++c) expected[c] += part[c];
                  }
              for (const glm::ivec2& place : patch.corners_px) {
                const glm::ivec2 at = glm::ivec2(x, y) - place;
                if (at.x < 0 || at.y < 0 || at.x >= patch.image.w || at.y >= patch.image.h) continue;
                for (std::size_t c = 0; c < 4; ++c)
                  got[c] += patch.image.rgba[static_cast<std::size_t>(4 * (at.y * patch.image.w + at.x)) + c];
              }
              for (std::size_t c = 0; c < 4; ++c)
                ASSERT_NEAR(got[c], static_cast<double>(expected[c]) / (by.x * by.y), 0.51)
                    << known.name << " at " << x << "," << y << " of channel " << c;
            }
      }
}

// No stroke of a letter may reach one eye alone: the light of every panel row is split evenly on even and odd rows.
TEST(Overlay, GivesBothEyesEveryStrokeOnInterleavedDisplays) {
  for (const DisplayMode mode : {DisplayMode::row_interleaved, DisplayMode::column_interleaved}) {
    const bool rows = mode == DisplayMode::row_interleaved;
    for (const int line : {3, 4}) {
      OverlayPanel panel{{8, 8, std::vector<std::uint8_t>(256, 0)}, {4, 3}, 1};
      for (int n = 0; n < 8; ++n) {
        const int pixel = rows ? line * 8 + n : n * 8 + line;
        std::fill_n(panel.image.rgba.begin() + 4 * pixel, 4, std::uint8_t{200});
      }
      const OverlayPatch patch = patchOf(panel, {.mode = mode, .screen_px = kSmallScreen}, {});
      std::array<int, 2> light{};
      for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
          light[static_cast<std::size_t>((rows ? y : x) & 1)] +=
              patch.image.rgba[static_cast<std::size_t>(4 * (y * 8 + x))];
      EXPECT_EQ(light[0], 8 * 100) << nameOf(mode);
      EXPECT_EQ(light[1], 8 * 100) << nameOf(mode);
    }
  }
}

TEST(Overlay, MixesColoursForAnaglyphsAsTheSceneAndLeavesGreyAlone) {
  const StereoLayout layout{.mode = DisplayMode::anaglyph, .screen_px = kSmallScreen};
  const OverlayPanel grey = randomPanel({2, 1}, {9, 6}, 5, true);
  EXPECT_EQ(patchOf(grey, layout, {}).image.rgba, grey.image.rgba);
  const OverlayPanel red{{1, 1, {255, 0, 0, 255}}, {0, 0}, 1};
  const OverlayPatch mixed = patchOf(red, layout, {});
  const glm::dvec3 light = anaglyph(layout.mode, {1, 0, 0}, {1, 0, 0});
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(mixed.image.rgba[static_cast<std::size_t>(c)], 255.0 * srgbOfLight(light[c]), 0.51);
}

TEST(Overlay, OutsideTheScreenIsNothing) {
  const OverlayPanel panel = randomPanel({40, 2}, {5, 5}, 3);
  const OverlayPatch patch = patchOf(panel, {.screen_px = kSmallScreen}, {});
  EXPECT_TRUE(patch.corners_px.empty());
}

// A pixel of the viewer's screen is where the viewer looks for it: x to the right from eye to eye, y down, whatever the
// panel's mounting and the mirror.
TEST(ScreenOrientation, PutsTheViewersPixelsWhereTheViewerSeesThem) {
  std::mt19937 random(11);
  const auto number = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967295.0);
  };
  for (int n = 0; n < 400; ++n) {
    // A virtual screen before the eyes, its framebuffer turned by quarters, flipped behind a mirror for half of them.
    const glm::dvec3 right = glm::normalize(glm::dvec3(1, number(-0.2, 0.2), number(-0.2, 0.2)));
    const glm::dvec3 down =
        glm::normalize(glm::cross(glm::dvec3(number(-0.2, 0.2), number(-0.3, 0.3), 1), right)) * -1.0;
    const int quarter = n % 4;
    const bool mirrored = n % 8 >= 4;
    glm::dvec3 across = quarter == 0 ? right : quarter == 1 ? down : quarter == 2 ? -right : -down;
    glm::dvec3 up = quarter == 0 ? -down : quarter == 1 ? right : quarter == 2 ? down : -right;
    if (mirrored) across = -across;
    const glm::dvec2 size_mm = quarter % 2 == 0 ? glm::dvec2(440, 280) : glm::dvec2(280, 440);
    const glm::dvec3 centre{number(-20, 20), number(-20, 20), 0};
    calibration::Rig rig;
    rig.screen = calibration::screenAround(centre, size_mm.x * across, size_mm.y * up, {200, 120});
    if (mirrored) {
      // The panel whose reflection that virtual screen is.
      const calibration::Plane<calibration::World> mirror{glm::normalize(glm::dvec3(0.1, 0.7, 0.6)), 40.0};
      for (auto* const corner : {&rig.screen.lower_left, &rig.screen.lower_right, &rig.screen.upper_left})
        *corner = mirror.reflect(*corner);
      rig.mirror = mirror;
    }
    const glm::dvec3 head = centre + glm::dvec3(number(-30, 30), number(-30, 30), 550);
    rig.left_eye = {head - 31.5 * right};
    rig.right_eye = {head + 31.5 * right};

    const ScreenOrientation orientation = screenOrientation(rig);
    const glm::ivec2 seen_size = orientation.viewerSize(rig.screen.px);
    const glm::ivec2 seen{static_cast<int>(random() % 50), static_cast<int>(random() % 50)};
    const PixelBox box = orientation.imageBox({seen, {1, 1}}, rig.screen.px);
    const EyeView view = eyeView(rig, Eye::cyclopean);
    const glm::dvec2 uv = (glm::dvec2(box.corner_px) + 0.5) / glm::dvec2(rig.screen.px);
    const glm::dvec3 at_W = view.lower_left_W.mm + uv.x * view.right_edge_W.xyz + (1.0 - uv.y) * view.up_edge_W.xyz;
    const glm::dvec2 seen_mm = quarter % 2 == 0 ? size_mm : glm::dvec2(size_mm.y, size_mm.x);
    const glm::dvec2 expected = ((glm::dvec2(seen) + 0.5) / glm::dvec2(seen_size) - 0.5) * seen_mm;
    EXPECT_NEAR(glm::dot(at_W - centre, right), expected.x, 1e-9) << "rig " << n;
    EXPECT_NEAR(glm::dot(at_W - centre, down), expected.y, 1e-9) << "rig " << n;
  }
}

TEST(ScreenOrientation, TurnsAPictureIntoTheBoxOfItsPanel) {
  const OverlayPanel panel = randomPanel({2, 1}, {5, 4}, 9);
  for (const ScreenOrientation& orientation : allOrientations()) {
    const Image image = turned(panel.image, orientation);
    const PixelBox box = orientation.imageBox({panel.corner_px, {5, 4}}, kSmallScreen);
    ASSERT_EQ(glm::ivec2(image.w, image.h), box.size_px);
    for (int y = 0; y < image.h; ++y)
      for (int x = 0; x < image.w; ++x) {
        const auto expected = panelAt(panel, seenPixel(box.corner_px + glm::ivec2(x, y), orientation));
        for (std::size_t c = 0; c < 4; ++c)
          ASSERT_EQ(image.rgba[static_cast<std::size_t>(4 * (y * image.w + x)) + c], expected[c]);
      }
  }
}

}  // namespace
}  // namespace render
