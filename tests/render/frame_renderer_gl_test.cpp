// Whole frames: both eyes of every rig, meshes among bone, display modes, reading back.
#include <gtest/gtest.h>

#include "render/display/stereo_layout.h"
#include "render/gpu/gpu_error.h"
#include "render/gpu/offscreen_context.h"
#include "tests/render/drawn_scene.h"

namespace render {
namespace {

using calibration::Rig;
using testing::Ball;
using testing::ballVolume;
using testing::distanceToBall_mm;
using testing::eye_P_mm;
using testing::frameFor;
using testing::pixelOf;
using testing::pixelsThatDiffer;
using testing::Random;
using testing::randomRig;
using testing::rayDirection_P;
using testing::smallGrid;
using testing::throughMirror;

assets::MeshModel sphereMesh(const Ball& ball, glm::vec4 colour, const char* name = "ball") {
  constexpr int kRows = 96, kColumns = 192;
  assets::MeshPart part;
  part.name = name;
  part.material = {.base_colour = colour, .roughness = 1.0f};
  for (int r = 0; r <= kRows; ++r)
    for (int c = 0; c <= kColumns; ++c) {
      const double polar = M_PI * r / kRows, turn = 2.0 * M_PI * c / kColumns;
      const glm::dvec3 n{std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar)};
      part.normal.push_back(n);
      part.position_mm.push_back(ball.centre_P_mm + ball.radius_mm * n);
    }
  for (std::uint32_t r = 0; r < kRows; ++r)
    for (std::uint32_t c = 0; c < kColumns; ++c) {
      const std::uint32_t a = r * (kColumns + 1) + c, b = a + kColumns + 1;
      for (const std::uint32_t index : {a, b, a + 1, a + 1, b, b + 1}) part.triangles.push_back(index);
    }
  return {{part}};
}

assets::CtVolume noBone() { return ballVolume(smallGrid(glm::ivec3(8), 1.0), {}); }

const std::uint8_t* pixelAt(const Image& image, int x, int y) {
  return &image.rgba[4 * static_cast<std::size_t>(y * image.w + x)];
}

TEST(FrameRenderer, ThreeBallsProjectAsPredictedInBothEyesOfAnyRig) {
  const OffscreenContext context;
  const std::vector<Ball> balls{{{-21, 3, -9}, 4.5}, {{20, -6, -12}, 3.5}, {{1, 4, 21}, 4.0}};
  const assets::CtVolume ct = ballVolume(smallGrid(glm::ivec3(110), 0.5), balls);
  FrameRenderer renderer(ct.grid, ct.solid, ct.label);
  Random random(31);
  int compared = 0;
  for (int n = 0; n < 6; ++n) {
    const Rig rig = randomRig(random, n % 2 == 1);
    for (const Eye eye : {Eye::left, Eye::right}) {
      const EyeView view = eyeView(rig, eye);
      renderer.renderEye(frameFor(rig), eye);
      const DistanceImage seen = renderer.readDistance(eye);

      // Centroid of the pixels that hit each ball; hidden balls are skipped.
      std::array<glm::dvec2, 3> sum{};
      std::array<int, 3> count{}, expected{};
      for (int y = 0; y < seen.h; ++y)
        for (int x = 0; x < seen.w; ++x) {
          const glm::dvec3 from = eye_P_mm(rig, view), along = rayDirection_P(rig, view, x, y);
          const double mm = seen.mm[static_cast<std::size_t>(y * seen.w + x)];
          for (std::size_t b = 0; b < 3; ++b) {
            if (distanceToBall_mm(from, along, balls[b])) ++expected[b];
            const double off_mm = glm::length(from + mm * along - balls[b].centre_P_mm) - balls[b].radius_mm;
            if (mm > 0.0 && std::abs(off_mm) < 0.3) {
              sum[b] += glm::dvec2(x + 0.5, y + 0.5);
              ++count[b];
            }
          }
        }
      for (std::size_t b = 0; b < 3; ++b) {
        if (count[b] < expected[b] - expected[b] / 50 || expected[b] < 50) continue;
        ++compared;
        const glm::dvec2 at = sum[b] / static_cast<double>(count[b]);
        EXPECT_LT(glm::length(at - pixelOf(rig, view, balls[b].centre_P_mm)), 0.3) << "rig " << n << " ball " << b;
      }
    }
  }
  EXPECT_GE(compared, 24);
  EXPECT_NO_THROW(renderer.throwIfError());
}

TEST(FrameRenderer, AMirroredRigShowsTheFlippedImage) {
  const OffscreenContext context;
  const assets::CtVolume ct = ballVolume(smallGrid(), {{{-5, 2, 3}, 5.0}, {{6, -3, -4}, 3.0}});
  FrameRenderer renderer(ct.grid, ct.solid, ct.label);
  renderer.setGingiva(sphereMesh({{3, -4, 6}, 4.0}, {0.3f, 0.5f, 0.8f, 1.0f}));
  Rig plain = cameraRig({.eye_P_mm = {80, -250, 60}, .fov_y_rad = 0.17}, {160, 120});

  // The same virtual screen by a mirror, with a panel whose rows run the other way round.
  Rig mirrored = plain;
  const calibration::Plane<calibration::World> mirror{glm::normalize(glm::dvec3(0.1, 1.0, 1.0)), 40.0};
  const glm::dvec3 upper_right = plain.screen.upper_left.mm + plain.screen.lower_right.mm - plain.screen.lower_left.mm;
  mirrored.mirror = mirror;
  mirrored.screen.lower_left = mirror.reflect(plain.screen.lower_right);
  mirrored.screen.lower_right = mirror.reflect(plain.screen.lower_left);
  mirrored.screen.upper_left = mirror.reflect({upper_right});
  for (const Eye eye : {Eye::left, Eye::right}) {
    renderer.renderEye(frameFor(plain), eye);
    Image turned = renderer.readEye(eye);
    renderer.renderEye(frameFor(mirrored), eye);
    const Image seen = renderer.readEye(eye);
    EXPECT_GT(pixelsThatDiffer(seen, turned, 8), 1000u) << "control: it must be turned";
    void* const first = turned.rgba.data();
    auto* const pixels = static_cast<std::uint32_t*>(first);
    for (int y = 0; y < turned.h; ++y) std::reverse(pixels + y * turned.w, pixels + (y + 1) * turned.w);
    EXPECT_LT(pixelsThatDiffer(seen, turned, 2), 40u) << "edges may fall either way";
  }
}

TEST(FrameRenderer, DistanceReprojectsIntoTheOtherEye) {
  const OffscreenContext context;
  const assets::CtVolume ct = ballVolume(smallGrid(), {{{-5, 2, 3}, 7.0}, {{6, -3, -4}, 5.0}});
  FrameRenderer renderer(ct.grid, ct.solid, ct.label);
  Random random(32);
  for (const bool with_mirror : {false, true}) {
    Rig rig = randomRig(random, with_mirror);
    const EyeView left = eyeView(rig, Eye::left), right = eyeView(rig, Eye::right);
    renderer.renderEye(frameFor(rig), Eye::left);
    renderer.renderEye(frameFor(rig), Eye::right);
    const DistanceImage from_left = renderer.readDistance(Eye::left), from_right = renderer.readDistance(Eye::right);
    std::vector<double> error_mm;
    for (int y = 0; y < from_left.h; ++y)
      for (int x = 0; x < from_left.w; ++x) {
        const double mm = from_left.mm[static_cast<std::size_t>(y * from_left.w + x)];
        if (mm == 0.0) continue;
        const glm::dvec3 p = eye_P_mm(rig, left) + mm * rayDirection_P(rig, left, x, y);
        const glm::ivec2 there(glm::floor(pixelOf(rig, right, p)));
        if (there.x < 0 || there.y < 0 || there.x >= from_right.w || there.y >= from_right.h) continue;
        const double other = from_right.mm[static_cast<std::size_t>(there.y * from_right.w + there.x)];
        if (other > 0.0) error_mm.push_back(std::abs(other - glm::length(p - eye_P_mm(rig, right))));
      }
    ASSERT_GT(error_mm.size(), 100u);
    std::ranges::nth_element(error_mm, error_mm.begin() + static_cast<std::ptrdiff_t>(error_mm.size() / 2));
    EXPECT_LT(error_mm[error_mm.size() / 2], 0.3);
  }
}

TEST(FrameRenderer, MeshAndBoneIntersectOnTheExpectedCircle) {
  const OffscreenContext context;
  const Ball bone{{-3, 0, 0}, 8.0}, metal{{4, -2, 2}, 7.0};
  const assets::CtVolume ct = ballVolume(smallGrid(), {bone});
  FrameRenderer renderer(ct.grid, ct.solid, ct.label);
  renderer.setGingiva(sphereMesh(metal, {0.02f, 0.05f, 0.9f, 1.0f}));
  Random random(33);
  for (const bool with_mirror : {false, true}) {
    Rig rig = randomRig(random, with_mirror);
    const EyeView view = eyeView(rig, Eye::right);
    renderer.renderEye(frameFor(rig), Eye::right);
    const Image seen = renderer.readEye(Eye::right);
    const DistanceImage distance = renderer.readDistance(Eye::right);
    const glm::dvec3 from = eye_P_mm(rig, view);

    // 0: nothing, 1: bone, 2: metal, by geometry alone.
    const auto winner = [&](int x, int y) {
      const auto b = distanceToBall_mm(from, rayDirection_P(rig, view, x, y), bone);
      const auto m = distanceToBall_mm(from, rayDirection_P(rig, view, x, y), metal);
      return !b && !m ? 0 : !m || (b && *b < *m) ? 1 : 2;
    };
    int wrong = 0, sure = 0;
    for (int y = 1; y + 1 < seen.h; ++y)
      for (int x = 1; x + 1 < seen.w; ++x) {
        const int expected = winner(x, y);
        bool beside_an_edge = false;
        for (int n = 0; n < 9; ++n) beside_an_edge |= winner(x + n % 3 - 1, y + n / 3 - 1) != expected;
        if (beside_an_edge) continue;
        const std::uint8_t* c = pixelAt(seen, x, y);
        const bool nothing = distance.mm[static_cast<std::size_t>(y * seen.w + x)] == 0.0f;
        const int got = nothing ? 0 : c[2] > c[0] ? 2 : 1;
        wrong += got != expected ? 1 : 0;
        sure += expected != 0 ? 1 : 0;
      }
    EXPECT_EQ(wrong, 0);
    EXPECT_GT(sure, 150);
  }
}

// Drawn images, direct and through a mirror; the output pass is tested in stereo_compositor_gl_test.cpp.
TEST(FrameRenderer, EveryDisplayModePutsTheRightEyeInTheRightPixel) {
  const OffscreenContext context;
  const assets::CtVolume ct = ballVolume(smallGrid(), {{{-5, 2, 3}, 6.0}, {{6, -12, -4}, 4.0}});
  FrameRenderer renderer(ct.grid, ct.solid, ct.label);
  Frame frame = frameFor(cameraRig({.eye_P_mm = {60, -250, 60}, .fov_y_rad = 0.17}, {80, 60}));
  for (const bool mirrored : {false, true}) {
    if (mirrored) frame.rig = throughMirror(frame.rig);
    for (const DisplayModeName& one : kDisplayModes) {
      frame.display = one.mode;
      if (isAnaglyph(one.mode)) continue;
      renderer.render(frame);
      StereoLayout layout{.mode = one.mode, .screen_px = frame.rig.screen.px};
      const bool mono = one.mode == DisplayMode::mono;
      const Image left = renderer.readEye(mono ? Eye::cyclopean : Eye::left),
                  right = renderer.readEye(mono ? Eye::cyclopean : Eye::right);
      EXPECT_EQ(mono, pixelsThatDiffer(left, right, 4) <= 50u) << "control: the eyes must differ";
      int wrong = 0;
      for (layout.output = 0; layout.output < outputCount(one.mode); ++layout.output) {
        const Image all = renderer.readImage(layout.output);
        ASSERT_EQ(glm::ivec2(all.w, all.h), outputSize(one.mode, layout.screen_px));
        for (int y = 0; y < all.h; ++y)
          for (int x = 0; x < all.w; ++x) {
            const SourcePixel shown = sourcePixelAt(layout, {x, y});
            const std::array<std::uint8_t, 3> black{};
            const std::uint8_t* expected =
                shown.eye == PixelSource::black
                    ? black.data()
                    : pixelAt(shown.eye == PixelSource::right ? right : left, shown.px.x, shown.px.y);
            for (int c = 0; c < 3; ++c) wrong += pixelAt(all, x, y)[c] != expected[c];
          }
      }
      EXPECT_EQ(wrong, 0) << one.name << (mirrored ? ", mirrored" : "");
    }
  }
}

TEST(FrameRenderer, TheMirrorShowsTheSameImageFlipped) {
  const OffscreenContext context;
  const assets::CtVolume ct = ballVolume(smallGrid(), {{{-5, 2, 3}, 6.0}, {{6, -12, -4}, 4.0}});
  FrameRenderer renderer(ct.grid, ct.solid, ct.label);
  Frame frame = frameFor(cameraRig({.eye_P_mm = {60, -250, 60}, .fov_y_rad = 0.17}, {80, 60}));
  for (const Eye eye : {Eye::left, Eye::right}) {
    renderer.renderEye(frame, eye);
    const Image straight = renderer.readEye(eye);
    Frame mirrored = frame;
    mirrored.rig = throughMirror(frame.rig);
    renderer.renderEye(mirrored, eye);
    const Image reflected = renderer.readEye(eye);
    int wrong = 0;
    for (int y = 0; y < straight.h; ++y)
      for (int x = 0; x < straight.w; ++x)
        for (int c = 0; c < 3; ++c)
          wrong += std::abs(pixelAt(straight, x, y)[c] - pixelAt(reflected, straight.w - 1 - x, y)[c]) > 1;
    // Rays differ by rounding only, which may move silhouettes by a pixel.
    EXPECT_LE(wrong, 6);
    EXPECT_NE(straight.rgba, reflected.rgba) << "control: the picture is not symmetric";
  }
}

TEST(FrameRenderer, TheFaceIsCutAroundTheLineToTheSiteOnlyInFrontOfIt) {
  const OffscreenContext context;
  const assets::CtVolume ct = noBone();
  FrameRenderer renderer(ct.grid, ct.solid, ct.label);
  const Ball head{{0, 0, 0}, 12.0};
  renderer.setFace(sphereMesh(head, {0.8f, 0.6f, 0.5f, 1.0f}));
  Frame frame = frameFor(cameraRig({.eye_P_mm = {0, -250, 0}, .fov_y_rad = 0.17}, {160, 120}));
  const auto centreDistance = [&] {
    renderer.renderEye(frame, Eye::cyclopean);
    return renderer.readDistance(Eye::cyclopean).mm[static_cast<std::size_t>(60 * 160 + 80)];
  };
  EXPECT_NEAR(centreDistance(), 238.0, 0.1);
  frame.face_window_mm = 5.0;
  EXPECT_NEAR(centreDistance(), 262.0, 0.1) << "through the hole, the far wall behind the site";
  frame.site_P.mm = {0, -30, 0};
  EXPECT_NEAR(centreDistance(), 238.0, 0.1) << "a site before the face opens nothing";
}

TEST(FrameRenderer, TheInstrumentIsDrawnAtTheToolPoseAndCanBeHidden) {
  const OffscreenContext context;
  const assets::CtVolume ct = noBone();
  FrameRenderer renderer(ct.grid, ct.solid, ct.label);
  renderer.setInstrument(sphereMesh({{0, 0, 0}, 3.0}, {0.7f, 0.7f, 0.7f, 1.0f}, "Bur"));
  Frame frame = frameFor(cameraRig({.eye_P_mm = {0, -250, 0}, .fov_y_rad = 0.17}, {160, 120}));
  frame.tool_visible = true;
  frame.X_PT.translation_mm = {8, 0, 5};
  frame.bur_angle_rad = 1.0;
  renderer.renderEye(frame, Eye::left);
  const glm::dvec2 at = pixelOf(frame.rig, eyeView(frame.rig, Eye::left), {8, 0, 5});
  const auto distanceAt = [&](const glm::dvec2& px) {
    const auto row = static_cast<std::size_t>(px.y), column = static_cast<std::size_t>(px.x);
    return renderer.readDistance(Eye::left).mm[row * 160 + column];
  };
  EXPECT_GT(distanceAt(at), 200.0f);
  frame.tool_visible = false;
  renderer.renderEye(frame, Eye::left);
  EXPECT_EQ(distanceAt(at), 0.0f);
}

TEST(FrameRenderer, TransparentPartsShowTheBoneAndKeepItsDistance) {
  const OffscreenContext context;
  const Ball bone{{0, 0, 0}, 5.0};
  const assets::CtVolume ct = ballVolume(smallGrid(), {bone});
  FrameRenderer renderer(ct.grid, ct.solid, ct.label);
  Frame frame = frameFor(cameraRig({.eye_P_mm = {0, -250, 0}, .fov_y_rad = 0.17}, {160, 120}));
  renderer.renderEye(frame, Eye::left);
  const Image bare = renderer.readEye(Eye::left);
  const DistanceImage bare_distance = renderer.readDistance(Eye::left);
  renderer.setGingiva(sphereMesh({{0, 0, 0}, 9.0}, {0.6f, 0.2f, 0.2f, 0.4f}));
  renderer.renderEye(frame, Eye::left);
  EXPECT_GT(pixelsThatDiffer(renderer.readEye(Eye::left), bare, 8), 1000u);
  EXPECT_EQ(renderer.readDistance(Eye::left).mm, bare_distance.mm);
}

// Two transparent balls behind each other: the nearer one contributes more, in either order of models.
TEST(FrameRenderer, TransparentPartsAreOrderedByDistanceInEveryPixel) {
  const OffscreenContext context;
  const assets::CtVolume ct = noBone();
  FrameRenderer renderer(ct.grid, ct.solid, ct.label);
  const auto seenWith = [&](double red_y_mm, double blue_y_mm, bool red_first) {
    assets::MeshModel red = sphereMesh({{0, red_y_mm, 0}, 4.0}, {0.8f, 0.05f, 0.05f, 0.6f}),
                      blue = sphereMesh({{0, blue_y_mm, 0}, 4.0}, {0.05f, 0.05f, 0.8f, 0.6f});
    if (!red_first) std::swap(red, blue);
    red.parts.push_back(blue.parts[0]);
    renderer.setGingiva(red);
    renderer.renderEye(frameFor(cameraRig({.eye_P_mm = {0, -250, 0}, .fov_y_rad = 0.17}, {80, 60})), Eye::left);
    return renderer.readEye(Eye::left);
  };
  const Image red_near = seenWith(-10, 10, true);
  EXPECT_EQ(pixelsThatDiffer(red_near, seenWith(-10, 10, false)), 0u);
  const std::uint8_t* c = pixelAt(red_near, 40, 30);
  EXPECT_GT(c[0], c[2] + 40);
  const Image blue_near = seenWith(10, -10, true);
  c = pixelAt(blue_near, 40, 30);
  EXPECT_GT(c[2], c[0] + 40);
  // Intersecting balls: each is in front on its own side.
  EXPECT_EQ(pixelsThatDiffer(seenWith(-1, 1, true), seenWith(-1, 1, false)), 0u);
  EXPECT_EQ(pixelsThatDiffer(seenWith(-1, 1, true), seenWith(-1, 1, true)), 0u);
  EXPECT_NO_THROW(renderer.throwIfError());
}

TEST(FrameRenderer, TheFaceFadesAndTheGingivaCanBeHidden) {
  const OffscreenContext context;
  const assets::CtVolume ct = ballVolume(smallGrid(), {{{0, 0, 0}, 5.0}});
  FrameRenderer renderer(ct.grid, ct.solid, ct.label);
  Frame frame = frameFor(cameraRig({.eye_P_mm = {0, -250, 0}, .fov_y_rad = 0.17}, {80, 60}));
  const auto seen = [&] {
    renderer.renderEye(frame, Eye::left);
    return renderer.readEye(Eye::left);
  };
  const Image bare = seen();
  renderer.setFace(sphereMesh({{0, 0, 0}, 10.0}, {0.8f, 0.6f, 0.5f, 1.0f}));
  const Image whole = seen();
  frame.layers.face_opacity = 0.3f;
  const Image faded = seen();
  frame.layers.face_opacity = 0.0f;
  EXPECT_EQ(seen().rgba, bare.rgba);
  EXPECT_GT(pixelsThatDiffer(faded, bare, 8), 300u);
  EXPECT_GT(pixelsThatDiffer(faded, whole, 8), 300u);
  renderer.setGingiva(sphereMesh({{0, 0, 0}, 7.0}, {0.6f, 0.2f, 0.2f, 1.0f}));
  EXPECT_GT(pixelsThatDiffer(seen(), bare, 8), 200u);
  frame.layers.gingiva = false;
  EXPECT_EQ(seen().rgba, bare.rgba);
}

TEST(FrameRenderer, AFadedFaceHidesItsOwnInside) {
  const OffscreenContext context;
  const assets::CtVolume ct = ballVolume(smallGrid(), {{{0, 0, 0}, 5.0}});
  FrameRenderer renderer(ct.grid, ct.solid, ct.label);
  Frame frame = frameFor(cameraRig({.eye_P_mm = {0, -250, 0}, .fov_y_rad = 0.17}, {80, 60}));
  frame.layers.face_opacity = 0.5f;
  const auto seenWith = [&](std::vector<assets::MeshPart> parts) {
    renderer.setFace({std::move(parts)});
    renderer.renderEye(frame, Eye::left);
    return renderer.readEye(Eye::left);
  };
  const assets::MeshPart skin = sphereMesh({{0, 0, 0}, 10.0}, {0.8f, 0.6f, 0.5f, 1.0f}).parts[0],
                         tongue = sphereMesh({{0, -7, 0}, 2.0}, {0.1f, 0.2f, 0.9f, 1.0f}).parts[0],
                         glass = sphereMesh({{0, -7, 0}, 2.0}, {0.1f, 0.2f, 0.9f, 0.9f}).parts[0];
  const Image alone = seenWith({skin});
  EXPECT_EQ(pixelsThatDiffer(seenWith({tongue, skin}), alone), 0u);
  EXPECT_GT(pixelsThatDiffer(seenWith({glass, skin}), alone, 8), 10u) << "transparent parts stay layers";
  EXPECT_GT(pixelsThatDiffer(seenWith({tongue}), alone, 8), 50u);
}

TEST(FrameRenderer, TransparentPartsBehindTheBoneStayHidden) {
  const OffscreenContext context;
  const assets::CtVolume ct = ballVolume(smallGrid(), {{{0, 0, 0}, 9.0}});
  FrameRenderer renderer(ct.grid, ct.solid, ct.label);
  const Frame frame = frameFor(cameraRig({.eye_P_mm = {0, -250, 0}, .fov_y_rad = 0.17}, {160, 120}));
  const auto seenWith = [&](double y_mm) {
    renderer.setGingiva(sphereMesh({{0, y_mm, 0}, 2.0}, {0.1f, 0.2f, 0.9f, 0.5f}));
    renderer.renderEye(frame, Eye::cyclopean);
    return renderer.readEye(Eye::cyclopean);
  };
  // At the same pixel: a millimetre in front of the surface, a millimetre behind it, far behind it.
  const Image before = seenWith(-12.0), just_behind = seenWith(-6.0), behind = seenWith(40.0);
  EXPECT_GT(pixelsThatDiffer(before, behind, 16), 100u);
  EXPECT_LT(pixelsThatDiffer(just_behind, behind, 16), 10u);
}

// Guides colour the bone near them and nothing else, and nothing when disabled.
TEST(FrameRenderer, GuidesAreDrawnAtTheirPositionsOnlyWhenEnabled) {
  const OffscreenContext context;
  const assets::CtVolume ct = ballVolume(smallGrid(), {{{0, 0, 0}, 9.0}});
  for (const Backend backend : {Backend::gl_fragment, Backend::gl_compute, Backend::cpu}) {
    FrameRenderer renderer(ct.grid, ct.solid, ct.label, {.backend = backend});
    Frame frame = frameFor(cameraRig({.eye_P_mm = {0, -250, 0}, .fov_y_rad = 0.17}, {160, 120}));
    const auto seen = [&] {
      renderer.renderEye(frame, Eye::cyclopean);
      return renderer.readEye(Eye::cyclopean);
    };
    const Image bare = seen();
    assets::PlannedCut cut;
    cut.bur_radius_mm = 2.0;
    cut.strokes_P_mm = {{{-1, -9, 5}, {1, -9, 5}}, {{-1, -10, 5}, {1, -10, 5}}};
    renderer.setGuides({{{-15, -6, 0}, {15, -6, 0}}, 1.0, cut});
    EXPECT_EQ(seen().rgba, bare.rgba);
    for (bool Layers::*layer : {&Layers::mandibular_canal, &Layers::clearance, &Layers::planned_cut}) {
      frame.layers.*layer = true;
      EXPECT_GT(pixelsThatDiffer(seen(), bare, 16), 30u);
      frame.layers.*layer = false;
    }

    // Bone farther than 3 mm from the canal's wall keeps its colour.
    frame.layers.clearance = true;
    const Image banded = seen();
    const DistanceImage distance = renderer.readDistance(Eye::cyclopean);
    const EyeView view = eyeView(frame.rig, Eye::cyclopean);
    int kept = 0, coloured = 0;
    for (int y = 0; y < 120; ++y)
      for (int x = 0; x < 160; ++x) {
        const double mm = distance.mm[static_cast<std::size_t>(y * 160 + x)];
        if (mm == 0.0) continue;
        const glm::dvec3 p = eye_P_mm(frame.rig, view) + mm * rayDirection_P(frame.rig, view, x, y);
        const double wall_mm = glm::length(glm::dvec2(p.y + 6.0, p.z)) - 1.0;
        const bool same = std::equal(pixelAt(bare, x, y), pixelAt(bare, x, y) + 3, pixelAt(banded, x, y));
        if (wall_mm > 3.3) {
          EXPECT_TRUE(same) << x << " " << y;
          ++kept;
        } else if (wall_mm < 2.9) {
          coloured += same ? 0 : 1;
        }
      }
    EXPECT_GT(kept, 500);
    EXPECT_GT(coloured, 500);
    EXPECT_NO_THROW(renderer.throwIfError());

    // Translucent matter shows the plan and no bands.
    frame.mode = ViewMode::dvr;
    const Image through_bands = seen();
    frame.layers.clearance = false;
    const Image through = seen();
    EXPECT_EQ(through_bands.rgba, through.rgba);
    frame.layers.planned_cut = true;
    EXPECT_GT(pixelsThatDiffer(seen(), through, 2), 30u);
  }
}

// The canal is visible through bone and gingiva, but not through face and instrument.
TEST(FrameRenderer, TheCanalIsHiddenOnlyByFaceAndInstrument) {
  const OffscreenContext context;
  const assets::CtVolume ct = ballVolume(smallGrid(), {{{0, 0, 0}, 9.0}});
  const glm::vec4 grey(0.5f, 0.5f, 0.5f, 1.0f);
  const assets::MeshModel gingiva = sphereMesh({{0, -20, 0}, 4.0}, grey), cover = sphereMesh({{0, -19, 0}, 4.0}, grey),
                          none;
  for (const Backend backend : {Backend::gl_fragment, Backend::gl_compute, Backend::cpu}) {
    FrameRenderer renderer(ct.grid, ct.solid, ct.label, {.backend = backend});
    renderer.setGuides({{{-15, 0, 0}, {15, 0, 0}}, 1.0, {}});
    Frame frame = frameFor(cameraRig({.eye_P_mm = {0, -250, 0}, .fov_y_rad = 0.17}, {160, 120}));
    frame.X_PT = frame.X_PT_at_hand = {};
    frame.tool_visible = true;
    // Central pixels, all covered, that the canal changes.
    const auto shining = [&] {
      std::array<Image, 2> images;
      for (const bool canal : {false, true}) {
        frame.layers.mandibular_canal = canal;
        renderer.renderEye(frame, Eye::cyclopean);
        images[canal] = renderer.readEye(Eye::cyclopean);
      }
      int changed = 0;
      for (int y = 50; y < 70; ++y)
        for (int x = 70; x < 90; ++x)
          changed += std::abs(pixelAt(images[0], x, y)[2] - pixelAt(images[1], x, y)[2]) > 8 ? 1 : 0;
      return changed;
    };
    EXPECT_GT(shining(), 50) << "bone";
    renderer.setGingiva(gingiva);
    EXPECT_GT(shining(), 50) << "gum";
    renderer.setFace(cover);
    EXPECT_EQ(shining(), 0) << "face";
    renderer.setFace(none);
    EXPECT_GT(shining(), 50) << "gum again";
    renderer.setInstrument(cover);
    EXPECT_EQ(shining(), 0) << "instrument";
    frame.tool_visible = false;
    EXPECT_GT(shining(), 50) << "instrument away";
  }
}

// The hand is inside the bone, the drawn tool held on its surface.
TEST(FrameRenderer, TheGhostShowsTheHandThroughTheBone) {
  const OffscreenContext context;
  const assets::CtVolume ct = ballVolume(smallGrid(), {{{0, 0, 0}, 9.0}});
  FrameRenderer renderer(ct.grid, ct.solid, ct.label);
  renderer.setInstrument(sphereMesh({{0, 0, 0}, 2.0}, {0.7f, 0.7f, 0.7f, 1.0f}, "Bur"));
  Frame frame = frameFor(cameraRig({.eye_P_mm = {0, -250, 0}, .fov_y_rad = 0.17}, {160, 120}));
  frame.tool_visible = true;
  frame.X_PT.translation_mm = {0, -11, 8};
  frame.X_PT_at_hand.translation_mm = {0, -5, -3};
  const auto seen = [&] {
    renderer.renderEye(frame, Eye::cyclopean);
    return renderer.readEye(Eye::cyclopean);
  };
  const Image without = seen();
  frame.layers.ghost_tool = true;
  EXPECT_GT(pixelsThatDiffer(seen(), without, 8), 30u);
  frame.X_PT_at_hand = frame.X_PT;
  EXPECT_EQ(seen().rgba, without.rgba) << "a free hand has no ghost";
}

// Silhouettes are smoothed; pixels without a step in distance keep every bit.
TEST(FrameRenderer, AntialiasingChangesSilhouettesOnly) {
  const OffscreenContext context;
  const assets::CtVolume ct = ballVolume(smallGrid(), {{{-4, 0, 0}, 7.0}});
  for (const Backend backend : {Backend::gl_fragment, Backend::gl_compute}) {
    FrameRenderer renderer(ct.grid, ct.solid, ct.label, {.backend = backend}),
        everywhere(ct.grid, ct.solid, ct.label, {.backend = backend, .samples = 2});
    for (FrameRenderer* r : {&renderer, &everywhere})
      r->setGingiva(sphereMesh({{7, 3, 3}, 5.0}, {0.2f, 0.4f, 0.8f, 1.0f}));
    Frame frame = frameFor(cameraRig({.eye_P_mm = {0, -250, 0}, .fov_y_rad = 0.17}, {160, 120}));
    renderer.renderEye(frame, Eye::left);
    const Image plain = renderer.readEye(Eye::left);
    const DistanceImage distance = renderer.readDistance(Eye::left);
    everywhere.renderEye(frame, Eye::left);
    const Image supersampled = everywhere.readEye(Eye::left);
    frame.quality.antialias = Antialias::edges;
    renderer.renderEye(frame, Eye::left);
    const Image smooth = renderer.readEye(Eye::left);
    EXPECT_EQ(renderer.readDistance(Eye::left).mm, distance.mm);
    EXPECT_NO_THROW(renderer.throwIfError());

    const auto mm = [&](int x, int y) { return distance.mm[static_cast<std::size_t>(y * 160 + x)]; };
    int edges = 0, far_from_supersampled = 0, changed_elsewhere = 0;
    for (int y = 1; y < 119; ++y)
      for (int x = 1; x < 159; ++x) {
        const std::uint8_t *before = pixelAt(plain, x, y), *after = pixelAt(smooth, x, y),
                           *wanted = pixelAt(supersampled, x, y);
        const bool hits = mm(x, y) > 0.0f;
        const bool silhouette = (mm(x - 1, y) > 0.0f) != hits || (mm(x + 1, y) > 0.0f) != hits ||
                                (mm(x, y - 1) > 0.0f) != hits || (mm(x, y + 1) > 0.0f) != hits;
        edges += silhouette ? 1 : 0;
        bool near_silhouette = false;
        for (int n = 0; n < 25; ++n) {
          const int i = std::clamp(x + n % 5 - 2, 0, 159), j = std::clamp(y + n / 5 - 2, 0, 119);
          near_silhouette |= std::abs(mm(i, j) - mm(x, y)) > 1.0f;
        }
        for (int c = 0; c < 3; ++c) {
          if (silhouette) far_from_supersampled += std::abs(after[c] - wanted[c]) > 1 ? 1 : 0;
          if (!near_silhouette) changed_elsewhere += after[c] != before[c] ? 1 : 0;
        }
      }
    EXPECT_GT(edges, 300);
    EXPECT_EQ(far_from_supersampled, 0);
    EXPECT_EQ(changed_elsewhere, 0);
    EXPECT_GT(pixelsThatDiffer(smooth, plain, 8), 100u);
  }
}

TEST(FrameRenderer, SupersamplingSmoothsEdgesButMovesNoDistance) {
  const OffscreenContext context;
  const assets::CtVolume ct = ballVolume(smallGrid(), {{{0, 0, 0}, 8.0}});
  FrameRenderer plain(ct.grid, ct.solid, ct.label), smooth(ct.grid, ct.solid, ct.label, {.samples = 2});
  const Frame frame = frameFor(cameraRig({.eye_P_mm = {0, -250, 0}, .fov_y_rad = 0.17}, {160, 120}));
  plain.renderEye(frame, Eye::left);
  smooth.renderEye(frame, Eye::left);
  EXPECT_EQ(smooth.readEye(Eye::left).w, 160);
  EXPECT_GT(pixelsThatDiffer(smooth.readEye(Eye::left), plain.readEye(Eye::left), 16), 50u);
  EXPECT_LT(pixelsThatDiffer(smooth.readEye(Eye::left), plain.readEye(Eye::left), 40), 1500u);
  EXPECT_EQ(smooth.readDistance(Eye::left).mm, plain.readDistance(Eye::left).mm);
  EXPECT_THROW(FrameRenderer(ct.grid, ct.solid, ct.label, {.samples = 0}), GpuError);
}

}  // namespace
}  // namespace render
