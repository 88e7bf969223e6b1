// Guides among bone that is carved: solid where they lie open, seen through where bone covers them.
#include <gtest/gtest.h>

#include "render/gpu/offscreen_context.h"
#include "tests/render/drawn_scene.h"

namespace render {
namespace {

using testing::ballVolume;
using testing::frameFor;
using testing::smallGrid;

constexpr std::array kBackends{Backend::gl_fragment, Backend::gl_compute, Backend::cpu};
constexpr double kRadius_mm = 1.0;
const std::vector<glm::dvec3> kCanal_P_mm{{-15, -3, 0}, {-2, -3, 0.5}, {4, -3, -0.5}, {15, -3, 0}};

/// Seen from −y, the canal across the picture.
Frame fromTheFront() {
  Frame frame = frameFor(cameraRig({.eye_P_mm = {0, -250, 0}, .fov_y_rad = 0.08}, {160, 120}));
  frame.layers.mandibular_canal = true;
  return frame;
}

Image seen(FrameRenderer& renderer, const Frame& frame) {
  renderer.renderEye(frame, Eye::cyclopean);
  return renderer.readEye(Eye::cyclopean);
}

/// Bone before the canal is gone within that distance of its middle.
void carve(assets::CtVolume& ct, FrameRenderer& renderer, double within_mm) {
  for (std::size_t v = 0; v < ct.solid.size(); ++v) {
    const glm::ivec3 voxel(static_cast<int>(v) % 64, static_cast<int>(v) / 64 % 64, static_cast<int>(v) / 4096);
    const glm::dvec3 p = ct.grid.centre_P_mm(voxel);
    if (std::abs(p.x) < within_mm && p.y < -1.0) ct.solid[v] = 0;
  }
  for (int n = 0; n < 512; ++n) {
    const glm::ivec3 brick{n % 8, n / 8 % 8, n / 64};
    renderer.updateBrick(brick, std::span<const std::uint8_t, 512>(testing::brickOf(ct, brick)));
  }
}

/// Red minus blue: large for the guide, small for bone.
int orange(const Image& image, int x, int y) {
  const std::uint8_t* const c = &image.rgba[4 * static_cast<std::size_t>(y * image.w + x)];
  return c[0] - c[2];
}

TEST(GuideOverlay, AnOpenedCanalIsAsBrightAndSolidAsWithoutBone) {
  const OffscreenContext context;
  for (const Backend backend : kBackends)
    for (const Antialias antialias : {Antialias::none, Antialias::edges}) {
      assets::CtVolume ct = ballVolume(smallGrid(), {{{0, 0, 0}, 9.0}});
      FrameRenderer renderer(ct.grid, ct.solid, ct.label, {.backend = backend});
      const assets::CtVolume air = ballVolume(smallGrid(), {});
      FrameRenderer bare(air.grid, air.solid, air.label, {.backend = backend});
      for (FrameRenderer* const each : {&renderer, &bare}) each->setGuides({kCanal_P_mm, kRadius_mm, {}});
      Frame frame = fromTheFront();
      frame.quality.antialias = antialias;

      const Image covered = seen(renderer, frame), solid = seen(bare, frame);
      carve(ct, renderer, 5.0);
      const Image opened = seen(renderer, frame);

      // 6 px a mm. The wall without its silhouette, where it is opened for certain and where bone lies before it.
      int dimmest = 255, brightest = 0, differ = 0, wall = 0, dashes = 0, gaps = 0, still_dashes = 0;
      for (int x = 0; x < 160; ++x) {
        const double x_mm = (x + 0.5 - 80.0) / 6.0, z_mm = x_mm < -2.0 ? 0.2 : 0.0;
        int red = 0;  // of the column's brightest pixel
        for (int y = 60 - static_cast<int>(6.0 * z_mm) - 3; y < 60 - static_cast<int>(6.0 * z_mm) + 3; ++y) {
          if (std::abs(x_mm) < 4.0) {
            ++wall;
            red = std::max<int>(red, opened.rgba[4 * static_cast<std::size_t>(y * 160 + x)]);
            for (int c = 0; c < 3; ++c) {
              const auto at = 4 * static_cast<std::size_t>(y * 160 + x) + static_cast<std::size_t>(c);
              if (std::abs(opened.rgba[at] - solid.rgba[at]) > 2) {
                ++differ;
                break;
              }
            }
          }
          if (std::abs(x_mm) > 7.5) continue;
          const int colour = orange(covered, x, y);
          (colour > 60 ? dashes : gaps) += 1;
          if (std::abs(x_mm) > 6.0) still_dashes += std::abs(orange(opened, x, y) - colour) <= 8;
        }
        if (red > 0) dimmest = std::min(dimmest, red), brightest = std::max(brightest, red);
      }
      EXPECT_LT(brightest - dimmest, 6) << "solid along its length";
      EXPECT_GT(wall, 200);
      EXPECT_EQ(differ, 0) << "opened, on back-end " << static_cast<int>(backend);
      EXPECT_GT(dashes, 100) << "covered by bone it shows through";
      EXPECT_GT(gaps, 60) << "and in dashes";
      EXPECT_GT(still_dashes, 90) << "beside the opening it stays dashed";
      EXPECT_NO_THROW(renderer.throwIfError());
    }
}

// Between two touches of a ball: the beads are outside, the line is inside, and so is seen through it.
TEST(GuideOverlay, TheRulerIsBrightInAirAndDimInsideTheBone) {
  const OffscreenContext context;
  const assets::CtVolume ct = ballVolume(smallGrid(), {{{0, 0, 0}, 9.0}});
  for (const Backend backend : kBackends) {
    FrameRenderer renderer(ct.grid, ct.solid, ct.label, {.backend = backend});
    Frame frame = fromTheFront();
    const Image without = seen(renderer, frame);
    // Green beyond red: of no tissue.
    const auto green = [&](const Image& image, const glm::dvec3& p_P_mm) {
      const glm::ivec2 px = testing::pixelOf(frame.rig, eyeView(frame.rig, Eye::cyclopean), p_P_mm);
      const int x = px.x, y = px.y;
      const std::uint8_t* const c = &image.rgba[4 * static_cast<std::size_t>(y * 160 + x)];
      return c[1] - c[0];
    };
    frame.ruler = RulerLine{{{-6.0, 0.0, 5.0}}, calibration::Point<calibration::Patient>{{6.0, 0.0, 5.0}}};
    const Image hidden = seen(renderer, frame);
    frame.ruler = RulerLine{{{-6.0, -9.5, 5.0}}, calibration::Point<calibration::Patient>{{6.0, -9.5, 5.0}}};
    const Image open = seen(renderer, frame);
    for (const double x_mm : {-3.0, 0.1, 4.0}) {
      EXPECT_GT(green(open, {x_mm, -9.5, 5.0}), 100) << x_mm;
      EXPECT_GT(green(hidden, {x_mm, 0.0, 5.0}), 15) << x_mm << " seen through the bone";
      EXPECT_LT(green(hidden, {x_mm, 0.0, 5.0}), green(open, {x_mm, -9.5, 5.0}) - 40) << x_mm << " and dimmer";
      EXPECT_LT(green(open, {x_mm, -9.5, 3.5}), 10) << x_mm << " a thin line";
    }
    frame.ruler = RulerLine{{{-6.0, -9.5, 5.0}}, {}};
    const Image first = seen(renderer, frame);
    EXPECT_GT(green(first, {-6.0, -9.5, 5.0}), 60) << "one bead";
    EXPECT_LT(green(first, {0.1, -9.5, 5.0}), 10);
    frame.ruler.reset();
    EXPECT_EQ(seen(renderer, frame).rgba, without.rgba);
  }
}

}  // namespace
}  // namespace render
