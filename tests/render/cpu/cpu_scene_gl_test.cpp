// The CPU back-end against the shaders that specify it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstdio>

#include "assets/instrument/handpiece.h"
#include "assets/tooth.h"
#include "render/display/stereo_layout.h"
#include "render/gpu/offscreen_context.h"
#include "render/volume/surface_paint.h"
#include "tests/render/drawn_scene.h"
#include "tests/render/twin_scene.h"

namespace render {
namespace {

using namespace render::testing;

constexpr glm::ivec2 kPx{160, 120};

class CpuScene : public ::testing::Test {
 protected:
  OffscreenContext context_;
  assets::CtVolume ct_ = ballVolume(smallGrid(), {{{-4, 0, 0}, 8.0}, {{8, 3, 2}, 4.0}});
  std::unique_ptr<FrameRenderer> gl_, cpu_;

  void open(RenderOptions options = {}) {
    gl_ = std::make_unique<FrameRenderer>(ct_.grid, ct_.solid, ct_.label, options);
    options.backend = Backend::cpu;
    cpu_ = std::make_unique<FrameRenderer>(ct_.grid, ct_.solid, ct_.label, options);
  }
  template <class Change>
  void both(Change change) {
    change(*gl_);
    change(*cpu_);
  }
  Frame frame() const { return frameFor(cameraRig({.eye_P_mm = {20, -110, 45}}, kPx)); }
};

TEST_F(CpuScene, DrawsToothAndBoneAsTheShaderDoes) {
  for (std::size_t v = 0; v < ct_.label.size(); ++v) ct_.label[v] = static_cast<std::uint8_t>((v / 37) % 6);
  open();
  const Difference d = between(*gl_, *cpu_, frame(), Eye::cyclopean);
  EXPECT_LE(d.worst, 2);
  EXPECT_LE(d.worst_mm, 0.01);
  EXPECT_LE(d.other_mm, 4);
}

TEST_F(CpuScene, DrawsMeshesAndTheirIntersectionWithTheVolumeAsTheShadersDo) {
  open();
  both([](FrameRenderer& r) {
    r.setFace({{ballMesh({-8, -6, 6}, 8.0f, {0.8f, 0.6f, 0.5f, 1.0f})}});
    r.setGingiva({{ballMesh({6, -6, -4}, 5.0f, {0.7f, 0.3f, 0.3f, 1.0f})}});
    r.setInstrument(assets::surgicalHandpiece({}));
  });
  Frame f = frame();
  f.tool_visible = true;
  f.X_PT = {glm::angleAxis(1.0, glm::dvec3(1, 0, 0)), {4, -10, 6}};
  f.bur_angle_rad = 0.3;
  const Difference d = between(*gl_, *cpu_, f, Eye::cyclopean);
  EXPECT_LE(d.worst, 2);
  EXPECT_LE(d.worst_mm, 0.01);
  EXPECT_LE(d.other_mm, 60);
}

TEST_F(CpuScene, DrawsTeethOfTheFaceAsTheShadersDoAndAsTeethOfTheScan) {
  // A crown as voxels, then the same crown as triangles: one arch has one colour and gloss.
  const Ball crown{{0, 0, 0}, 9.0};
  assets::MeshPart teeth = ballMesh({0, 0, 0}, 9.0f, glm::vec4(assets::kEnamelAlbedo, 1.0f), 48);
  ct_ = ballVolume(smallGrid(), {crown});
  std::ranges::fill(ct_.label, static_cast<std::uint8_t>(assets::Tissue::other_teeth));
  open();
  cpu_->renderEye(frame(), Eye::cyclopean);
  const Image scanned = cpu_->readEye(Eye::cyclopean);
  std::ranges::fill(ct_.solid, std::uint8_t{0});
  open();
  const auto differenceAs = [&](const std::string& name) {
    teeth.name = name;
    both([&](FrameRenderer& r) { r.setFace({{teeth}}); });
    EXPECT_LE(between(*gl_, *cpu_, frame(), Eye::cyclopean).worst, 2) << name;
    const Image drawn = cpu_->readEye(Eye::cyclopean);
    double sum = 0.0;
    for (std::size_t c = 0; c < drawn.rgba.size(); ++c) sum += std::abs(drawn.rgba[c] - scanned.rgba[c]);
    return sum / static_cast<double>(drawn.rgba.size());
  };
  const double as_tooth = differenceAs("LowerTeeth"), as_skin = differenceAs("Face");
  EXPECT_LT(as_tooth, 1.0);
  EXPECT_GT(as_skin, 2.0 * as_tooth);
}

TEST_F(CpuScene, CutsTheWindowAndShowsInsidesAsTheShadersDo) {
  open();
  both([](FrameRenderer& r) { r.setFace({{ballMesh({0, 0, 0}, 26.0f, {0.8f, 0.6f, 0.5f, 1.0f})}}); });
  Frame f = frame();
  f.face_window_mm = 9.0;
  const Difference d = between(*gl_, *cpu_, f, Eye::left);
  EXPECT_LE(d.worst, 2);
  EXPECT_LE(d.other_mm, 40);
}

TEST_F(CpuScene, DrawsTranslucentBoneAsTheShaderDoes) {
  for (std::size_t v = 0; v < ct_.label.size(); ++v) ct_.label[v] = static_cast<std::uint8_t>((v / 37) % 6);
  open();
  both([](FrameRenderer& r) { r.setFace({{ballMesh({-4, 8, 6}, 8.0f, {0.8f, 0.6f, 0.5f, 1.0f})}}); });
  for (const ViewMode mode : {ViewMode::dvr, ViewMode::clear}) {
    Frame f = frame();
    f.mode = mode;
    const Difference d = between(*gl_, *cpu_, f, Eye::cyclopean);
    EXPECT_LE(d.worst, 2);
  }
}

TEST_F(CpuScene, MagnifiesAPlaceInACornerAsTheShadersDo) {
  for (std::size_t v = 0; v < ct_.label.size(); ++v) ct_.label[v] = static_cast<std::uint8_t>((v / 37) % 6);
  open();
  both([](FrameRenderer& r) {
    r.setFace({{ballMesh({-4, -30, 6}, 8.0f, {0.8f, 0.6f, 0.5f, 1.0f})}});
    r.setInstrument(assets::surgicalHandpiece({}));
  });
  Frame f = frame();
  cpu_->renderEye(f, Eye::cyclopean);
  const Image plain = cpu_->readEye(Eye::cyclopean);
  f.magnified = Magnified{{{-2.0, -7.0, 3.0}}, {0.0, 0.0, 1.0}, 4.0};
  const Difference d = between(*gl_, *cpu_, f, Eye::cyclopean);
  EXPECT_LE(d.beyond, 6) << "at the rims";
  const Image shown = cpu_->readEye(Eye::cyclopean);
  // At the right, a third of the height; nothing else has changed.
  int left = shown.w, right = 0, top = shown.h, bottom = 0;
  for (int y = 0; y < shown.h; ++y)
    for (int x = 0; x < shown.w; ++x) {
      const std::size_t at = 4 * static_cast<std::size_t>(y * shown.w + x);
      if (std::equal(&shown.rgba[at], &shown.rgba[at] + 4, &plain.rgba[at])) continue;
      left = std::min(left, x), right = std::max(right, x), top = std::min(top, y), bottom = std::max(bottom, y);
    }
  EXPECT_GT(left, shown.w / 2);
  EXPECT_NEAR(bottom - top + 1, 0.32 * shown.h, 2.0);
  EXPECT_NEAR(right - left + 1, bottom - top + 1, 1.0) << "square";
}

TEST_F(CpuScene, DrawsWaterBloodDustAndSprayAsTheShadersDo) {
  for (std::size_t v = 0; v < ct_.label.size(); ++v) ct_.label[v] = static_cast<std::uint8_t>((v / 37) % 6);
  open();
  const Frame dry = frame();
  cpu_->renderEye(dry, Eye::cyclopean);
  const Image before = cpu_->readEye(Eye::cyclopean);
  const SurgicalField all{{{-4.0, -6.0, 4.0}}, 5.0, 0.8, 0.6, 0.5, 0.7};
  std::vector<SurgicalField> fields{all};
  for (const auto share : {&SurgicalField::water, &SurgicalField::blood, &SurgicalField::dust, &SurgicalField::spray}) {
    SurgicalField one{all.centre_P, all.reach_mm};
    one.*share = 1.0;
    fields.push_back(one);
  }
  fields.push_back({{}, 0.0, 0.35, 0.15});
  for (const SurgicalField& field : fields) {
    Frame f = dry;
    f.field = field;
    EXPECT_LE(between(*gl_, *cpu_, f, Eye::cyclopean).worst, 2);
    EXPECT_GT(pixelsThatDiffer(before, cpu_->readEye(Eye::cyclopean), 4), 200u) << "seen";
  }
}

TEST_F(CpuScene, OmitsOcclusionAndShadowAsTheShadersDo) {
  open();
  both([](FrameRenderer& r) { r.setGingiva({{ballMesh({6, -6, -4}, 5.0f, {0.7f, 0.3f, 0.3f, 1.0f})}}); });
  Frame f = frame();
  f.quality.ambient_occlusion = false;
  EXPECT_LE(between(*gl_, *cpu_, f, Eye::cyclopean).worst, 2);
  f.quality.lamp_shadow = false;
  f.quality.step_voxels = 1.0;
  EXPECT_LE(between(*gl_, *cpu_, f, Eye::cyclopean).worst, 2);
}

TEST_F(CpuScene, DrawsTheSamePixelsAgainAtEdges) {
  open();
  both([](FrameRenderer& r) { r.setFace({{ballMesh({-8, -6, 6}, 8.0f, {0.8f, 0.6f, 0.5f, 1.0f})}}); });
  Frame f = frame();
  both([&](FrameRenderer& r) { r.renderEye(f, Eye::cyclopean); });
  const Image plain = cpu_->readEye(Eye::cyclopean);
  f.quality.antialias = Antialias::edges;
  const Difference d = between(*gl_, *cpu_, f, Eye::cyclopean);
  EXPECT_LE(d.beyond, 4) << "a sample on a silhouette may hit here and miss there";
  const std::size_t smoothed = pixelsThatDiffer(plain, cpu_->readEye(Eye::cyclopean));
  EXPECT_GT(smoothed, 200u);
  EXPECT_LT(smoothed, plain.rgba.size() / 4 / 10);
}

TEST_F(CpuScene, ShowsGuidesAsTheShadersDo) {
  open();
  Guides guides;
  guides.mandibular_canal_P_mm = {{-16, -6, -3}, {-4, -7, -1}, {4, -5, 0}, {16, -6, 2}};
  guides.cut.emplace().bur_radius_mm = 2.0;
  guides.cut->strokes_P_mm = {{{-7, -7, 6}, {-1, -7, 6}}, {{-1, -7, 4}, {-7, -7, 4}}, {{-7, -7, 2}, {-1, -7, 2}}};
  both([&](FrameRenderer& r) {
    r.setGuides(guides);
    r.setFace({{ballMesh({-12, -9, 0}, 4.0f, {0.8f, 0.6f, 0.5f, 1.0f})}});
    r.setGingiva({{ballMesh({6, -6, -4}, 5.0f, {0.7f, 0.3f, 0.3f, 1.0f})}});
    r.setInstrument(assets::surgicalHandpiece({}));
  });
  Frame f = frame();
  f.layers.clearance = f.layers.planned_cut = true;
  EXPECT_LE(between(*gl_, *cpu_, f, Eye::cyclopean).beyond, 2);
  f.mode = ViewMode::dvr;
  EXPECT_LE(between(*gl_, *cpu_, f, Eye::cyclopean).worst, 2);
  f.mode = ViewMode::iso;
  f.layers.mandibular_canal = true;
  f.layers.ghost_tool = f.tool_visible = true;
  f.X_PT = {glm::angleAxis(1.0, glm::dvec3(1, 0, 0)), {4, -10, 6}};
  f.X_PT_at_hand = {glm::angleAxis(1.1, glm::dvec3(1, 0, 0)), {2, -4, 5}};
  EXPECT_LE(between(*gl_, *cpu_, f, Eye::cyclopean).beyond, 6) << "at the rims of the tube and the ghost";
}

/// Over the front of the larger ball, in cells of colours and covers of their own.
SurfacePaint cellsOfPaint(const assets::VolumeGrid& grid) {
  SurfacePaint paint;
  const glm::ivec3 size{21, 17, 30};
  paint.low = glm::ivec3(glm::round(grid.indexFromPoint({-9, -9, -7})));
  paint.texels = PaintTexels(size);
  forEachIn({glm::ivec3(0), size}, [&](glm::ivec3 ijk) {
    const glm::ivec3 cell = ijk / 3;
    const int n = cell.x * 7 + cell.y * 3 + cell.z * 5;
    *paint.texels.at(ijk) =
        paintTexel(glm::vec3(n % 3, n % 4, n % 5) / glm::vec3(2, 3, 4), static_cast<float>(n % 6) / 5.0f);
  });
  paint.title = "off the ideal";
  paint.rows = {{glm::vec3(0.7f, 0.1f, 0.0f), "0.5 mm too high"}, {{}, "made"}};
  return paint;
}

TEST_F(CpuScene, ShowsPaintAndItsLegendAsTheShadersDo) {
  open();
  const Frame bare = frame();
  const SurfacePaint paint = cellsOfPaint(ct_.grid);
  Frame f = bare;
  f.paint = &paint;
  f.paint_serial = 1;
  EXPECT_LE(between(*gl_, *cpu_, f, Eye::cyclopean).worst, 2);
  const Image painted = cpu_->readEye(Eye::cyclopean);
  cpu_->renderEye(bare, Eye::cyclopean);
  const Image without = cpu_->readEye(Eye::cyclopean);
  int changed = 0;
  for (std::size_t at = 0; at < painted.rgba.size(); at += 4)
    changed += std::abs(painted.rgba[at] - without.rgba[at]) > 20 ? 1 : 0;
  EXPECT_GT(changed, 600) << "of the ball and of the legend";
  EXPECT_LT(changed, 8000) << "the box alone";
  // Taken away it is gone, as a frame that borrows nothing says.
  gl_->renderEye(bare, Eye::cyclopean);
  Frame none = bare;
  none.paint_serial = 2;
  EXPECT_LE(between(*gl_, *cpu_, none, Eye::cyclopean).worst, 2);
  EXPECT_EQ(cpu_->readEye(Eye::cyclopean).rgba, without.rgba);
}

TEST_F(CpuScene, ShowsAnArrowAsTheShadersDo) {
  open();
  Frame f = frame();
  f.arrow = GuideArrow{{{-4, -14, 12}}, {{-4, -2, 2}}};
  EXPECT_LE(between(*gl_, *cpu_, f, Eye::cyclopean).beyond, 6) << "at its rims";
}

// Every head over the bone, with gum beside it, from 0.1 to 9 mm away.
std::vector<Frame> hoveringTools(Frame frame) {
  std::vector<Frame> frames;
  frame.rig = cameraRig({.eye_P_mm = {20, -110, 45}, .look_at_P_mm = {-3, -8, 0}, .fov_y_rad = 0.14}, kPx);
  frame.tool_visible = true;
  for (const auto& [form, gap_mm] :
       {std::pair{assets::BurForm::round, 0.1}, std::pair{assets::BurForm::capsule, 1.0},
        std::pair{assets::BurForm::cylinder, 4.0}, std::pair{assets::BurForm::cone, 9.0}}) {
    const bool round = form == assets::BurForm::round;
    frame.bur_form = form;
    frame.bur_radius_mm = 1.5;
    frame.bur_length_mm = round ? 0.0 : 4.0;
    frame.X_PT = {glm::angleAxis(1.2, glm::normalize(glm::dvec3(1.0, 0.2, 0.0))), {-4, -9.5 - gap_mm, 0}};
    frame.gap = BoneGap{gap_mm, {{-4.0, -8.0, 0.0}}};
    frames.push_back(frame);
  }
  return frames;
}

TEST_F(CpuScene, ShadesThePatientUnderTheInstrumentAndDrawsTheRingAsTheShadersDo) {
  for (const Backend backend : {Backend::gl_fragment, Backend::gl_compute}) {
    open({.backend = backend});
    both([](FrameRenderer& r) { r.setGingiva({{ballMesh({6, -6, -4}, 5.0f, {0.7f, 0.3f, 0.3f, 1.0f})}}); });
    for (const Frame& tool : hoveringTools(frame()))
      for (const ViewMode mode : {ViewMode::iso, ViewMode::dvr}) {
        Frame f = tool;
        f.mode = mode;
        const Difference d = between(*gl_, *cpu_, f, Eye::cyclopean);
        EXPECT_LE(d.worst, 2) << "gap " << f.gap->mm;
        const Image shaded = cpu_->readEye(Eye::cyclopean);
        f.quality.tool_shadow = false;
        cpu_->renderEye(f, Eye::cyclopean);
        const Image unshaded = cpu_->readEye(Eye::cyclopean);
        f.layers.gap_ring = false;
        cpu_->renderEye(f, Eye::cyclopean);
        // Farther away the lamp's shade misses the ball; translucent matter has no contact shade.
        if (f.gap->mm < 2.0 && mode == ViewMode::iso) {
          EXPECT_GT(pixelsThatDiffer(shaded, unshaded, 8), 50u);
        }
        if (f.gap->mm > 0.5) {
          EXPECT_GT(pixelsThatDiffer(unshaded, cpu_->readEye(Eye::cyclopean), 16), 50u) << "a ring that is seen";
        }
      }
  }
}

TEST_F(CpuScene, TrianglesAreShadedUnderTheInstrumentAsTheRayCastSurface) {
  open();
  for (Frame f : hoveringTools(frame())) {
    gl_->renderEye(f, Eye::cyclopean);
    const Image cast = gl_->readEye(Eye::cyclopean);
    f.mode = ViewMode::mesh;
    gl_->renderEye(f, Eye::cyclopean);
    EXPECT_LT(pixelsThatDiffer(cast, gl_->readEye(Eye::cyclopean), 12), cast.rgba.size() / 4 / 100);
  }
}

TEST_F(CpuScene, ToolShadeOnlyDarkensAndEndsWithTheTool) {
  open();
  for (Frame f : hoveringTools(frame())) {
    f.layers.gap_ring = false;
    cpu_->renderEye(f, Eye::cyclopean);
    const Image shaded = cpu_->readEye(Eye::cyclopean);
    f.quality.tool_shadow = false;
    cpu_->renderEye(f, Eye::cyclopean);
    const Image lit = cpu_->readEye(Eye::cyclopean);
    for (std::size_t c = 0; c < lit.rgba.size(); ++c) ASSERT_LE(shaded.rgba[c], lit.rgba[c]);
    f.quality.tool_shadow = true;
    f.tool_visible = false;
    cpu_->renderEye(f, Eye::cyclopean);
    EXPECT_EQ(pixelsThatDiffer(cpu_->readEye(Eye::cyclopean), lit), 0u) << "no instrument, no shade";
  }
}

TEST_F(CpuScene, CachesStaticHitsOfAnUnmovedEyeUntilStaticMeshesChange) {
  open();
  const auto dress = [](FrameRenderer& r) {
    r.setFace({{ballMesh({-8, -6, 6}, 8.0f, {0.8f, 0.6f, 0.5f, 1.0f})}});
    r.setGingiva({{ballMesh({6, -6, -4}, 5.0f, {0.7f, 0.3f, 0.3f, 1.0f})}});
    r.setInstrument(assets::surgicalHandpiece({}));
  };
  dress(*cpu_);
  Frame f = frame();
  f.tool_visible = true;
  // Each change against a new renderer.
  const auto expectFresh = [&](const char* what) {
    cpu_->renderEye(f, Eye::left);
    FrameRenderer fresh(ct_.grid, ct_.solid, ct_.label, {.backend = Backend::cpu});
    dress(fresh);
    fresh.renderEye(f, Eye::left);
    EXPECT_EQ(pixelsThatDiffer(cpu_->readEye(Eye::left), fresh.readEye(Eye::left)), 0u) << what;
  };
  expectFresh("first");
  expectFresh("again");
  f.X_PT = {glm::angleAxis(1.0, glm::dvec3(1, 0, 0)), {4, -10, 6}};
  expectFresh("tool moved");
  f.face_window_mm = 9.0;
  expectFresh("window opened");
  f.site_P = {{-6, 0, 2}};
  expectFresh("window moved");
  f.layers.gingiva = false;
  expectFresh("gum away");
  f.layers.face_opacity = 0.5f;
  expectFresh("face faded");
  f.layers.face_opacity = 1.0f;
  expectFresh("face back");
  f.rig.left_eye.mm.x += 3.0;
  expectFresh("eye moved");
  f.rig.screen.px = {120, 90};
  expectFresh("smaller");
}

TEST_F(CpuScene, DrawsTheSameBitsWithAnyNumberOfThreads) {
  Image one;
  for (const std::size_t threads : {1u, 2u}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    FrameRenderer renderer(ct_.grid, ct_.solid, ct_.label, {.backend = Backend::cpu});
    renderer.setFace({{ballMesh({-8, -6, 6}, 8.0f, {0.8f, 0.6f, 0.5f, 0.5f})}});
    Frame f = frame();
    f.quality.antialias = Antialias::edges;
    renderer.renderEye(f, Eye::left);
    const Image image = renderer.readEye(Eye::left);
    if (threads == 1) one = image;
    EXPECT_EQ(pixelsThatDiffer(one, image), 0u) << threads;
  }
}

// Two spheres, one of triangles and one in the volume, intersect in a known circle.
TEST_F(CpuScene, MeshAndVolumeIntersectOnTheAnalyticCircle) {
  const Ball bone{{-4, 0, 0}, 8.0}, mesh{{2, -4, 3}, 7.0};
  ct_ = ballVolume(smallGrid(glm::ivec3(96), 0.35), {bone});
  open();
  cpu_->setGingiva({{ballMesh(glm::vec3(mesh.centre_P_mm), 7.0f, {0.1f, 0.9f, 0.1f, 1.0f}, 200)}});
  const Frame f = frame();
  cpu_->renderEye(f, Eye::cyclopean);
  const Image image = cpu_->readEye(Eye::cyclopean);
  const EyeView view = eyeView(f.rig, Eye::cyclopean);
  const glm::dvec3 eye = eye_P_mm(f.rig, view);
  // The nearer one: 1 mesh, 2 bone, 0 neither; the image must agree where a pixel and its eight neighbours are equal.
  const auto expected = [&](int x, int y) {
    const glm::dvec3 d = rayDirection_P(f.rig, view, x, y);
    const auto m = distanceToBall_mm(eye, d, mesh), b = distanceToBall_mm(eye, d, bone);
    return !m && !b ? 0 : m && (!b || *m < *b) ? 1 : 2;
  };
  int checked = 0, kinds[3] = {};
  for (int y = 1; y + 1 < kPx.y; ++y)
    for (int x = 1; x + 1 < kPx.x; ++x) {
      const int kind = expected(x, y);
      bool inner = true;
      for (int n = 0; n < 9; ++n) inner = inner && expected(x + n % 3 - 1, y + n / 3 - 1) == kind;
      if (!inner) continue;
      const std::size_t p = 4 * static_cast<std::size_t>(y * kPx.x + x);
      const bool green = image.rgba[p + 1] > image.rgba[p] + 30;
      EXPECT_EQ(green, kind == 1) << x << ", " << y;
      ++checked;
      ++kinds[kind];
    }
  EXPECT_GT(checked, 15000);
  EXPECT_GT(kinds[1], 300);
  EXPECT_GT(kinds[2], 150);
}

TEST_F(CpuScene, BlendsTranslucentGingivaOverBoneAsTheShadersDo) {
  // A closed ball around bone and a faded face through it, with a ball inside that it hides: up to three layers per
  // ray.
  open();
  both([](FrameRenderer& r) {
    r.setGingiva({{ballMesh({-4, 0, 0}, 9.0f, {0.7f, 0.3f, 0.3f, 0.5f})}});
    r.setFace(
        {{ballMesh({2, -4, 2}, 7.0f, {0.8f, 0.6f, 0.5f, 1.0f}), ballMesh({2, -4, 2}, 5.0f, {0.2f, 0.9f, 0.9f, 1.0f})}});
  });
  Frame f = frame();
  f.layers.face_opacity = 0.4f;
  const Difference d = between(*gl_, *cpu_, f, Eye::right);
  EXPECT_LE(d.beyond, 4) << "at the layers' rims, whose distance is not written";
}

TEST_F(CpuScene, DrawsAMirroredRigAsTheShadersDo) {
  open();
  both([](FrameRenderer& r) { r.setFace({{ballMesh({-8, -6, 6}, 8.0f, {0.8f, 0.6f, 0.5f, 1.0f})}}); });
  Random random(11);
  for (int n = 0; n < 3; ++n) {
    calibration::Rig rig = randomRig(random, true, kPx);
    const Difference d = between(*gl_, *cpu_, frameFor(rig), Eye::left);
    EXPECT_LE(d.worst, 2);
    EXPECT_LE(d.worst_mm, 0.01);
    EXPECT_LE(d.other_mm, 40);
  }
}

TEST_F(CpuScene, AveragesSamplesAsTheOutputPassDoes) {
  open({.samples = 3});
  between(*gl_, *cpu_, frame(), Eye::cyclopean);
  gl_->renderEye(frame(), Eye::cyclopean);
  cpu_->renderEye(frame(), Eye::cyclopean);
  EXPECT_LE(pixelsThatDiffer(gl_->readEye(Eye::cyclopean), cpu_->readEye(Eye::cyclopean), 2), 12u);
}

TEST_F(CpuScene, ComposesEveryDisplayAsTheOutputPassDoes) {
  open();
  for (const DisplayMode mode : {DisplayMode::mono, DisplayMode::side_by_side, DisplayMode::top_bottom_full,
                                 DisplayMode::frame_packing, DisplayMode::row_interleaved, DisplayMode::checkerboard,
                                 DisplayMode::anaglyph, DisplayMode::anaglyph_red_cyan, DisplayMode::two_windows}) {
    Frame f = frame();
    f.display = mode;
    f.eyes_swapped = mode == DisplayMode::checkerboard;
    both([&](FrameRenderer& r) { r.render(f); });
    for (int output = 0; output < outputCount(mode); ++output) {
      const Image a = gl_->readImage(output), b = cpu_->readImage(output);
      ASSERT_EQ(a.w, b.w);
      ASSERT_EQ(a.h, b.h);
      EXPECT_LE(pixelsThatDiffer(a, b, 2), 12u) << static_cast<int>(mode);
    }
  }
}

TEST_F(CpuScene, ShowsACarvedBrickInTheNextFrame) {
  open();
  cpu_->renderEye(frame(), Eye::cyclopean);
  const Image before = cpu_->readEye(Eye::cyclopean);
  // A bite out of the middle of the nearer ball.
  assets::CtVolume carved = ct_;
  const glm::ivec3 brick(3, 2, 4);
  for (int k = 0; k < 8; ++k)
    for (int j = 0; j < 8; ++j)
      for (int i = 0; i < 8; ++i) carved.solid[ct_.grid.index(8 * brick + glm::ivec3(i, j, k))] = 0;
  const std::vector<std::uint8_t> values = brickOf(carved, brick);
  both([&](FrameRenderer& r) { r.updateBrick(brick, std::span<const std::uint8_t, 512>(values.data(), 512)); });
  EXPECT_LE(between(*gl_, *cpu_, frame(), Eye::cyclopean).worst, 2);
  EXPECT_GT(pixelsThatDiffer(before, cpu_->readEye(Eye::cyclopean), 8), 20u);
}

}  // namespace
}  // namespace render
