#include "render/gl_scene_renderer.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "render/display/stereo_compositor.h"
#include "render/eye_block.h"
#include "render/gpu/drawing.h"
#include "render/gpu/framebuffer.h"
#include "render/gpu/gl_debug_log.h"
#include "render/gpu/gpu_error.h"
#include "render/gpu/window_picture.h"
#include "render/scene/mesh_pass.h"
#include "render/shaders/shared_numbers.glsl"
#include "render/volume/ray_caster.h"

namespace render {
namespace {

constexpr std::array kSceneTargets{TexelFormat::rgba16f, TexelFormat::r32f};
constexpr std::array kOutputTargets{TexelFormat::rgba8};

// Rows from bottom first to top first.
template <class T>
std::vector<T> flipped(std::vector<T> rows, std::size_t row_length) {
  for (auto low = rows.begin(), high = rows.end(); high - low > static_cast<std::ptrdiff_t>(row_length);
       low += static_cast<std::ptrdiff_t>(row_length)) {
    high -= static_cast<std::ptrdiff_t>(row_length);
    std::swap_ranges(low, low + static_cast<std::ptrdiff_t>(row_length), high);
  }
  return rows;
}

Picture pictureOf(const Framebuffer& target) {
  const glm::ivec2 size = target.size();
  return {size.x, size.y, flipped(target.readRgba8(0), 4 * static_cast<std::size_t>(size.x))};
}

std::optional<SceneMesh> onGpu(const assets::MeshModel& model, Finish finish) {
  if (model.parts.empty()) return std::nullopt;
  return SceneMesh(model, finish);
}

// An eye as last drawn.
struct EyePicture {
  Framebuffer target;
  glm::ivec2 px{0};
  Frame frame;
  bool drawn = false;
};

class GlSceneRenderer final : public SceneRenderer {
 public:
  GlSceneRenderer(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid,
                  std::span<const std::uint8_t> label, const RenderOptions& options)
      : samples_(options.samples),
        fields_(grid, solid, label),
        volume_(fields_),
        caster_(options.skip_empty_space ? RayCaster::EmptySpace::skip : RayCaster::EmptySpace::march) {}

  void setFace(const assets::MeshModel& face_P) override { face_ = onGpu(face_P, Finish::skin); }
  void setGum(const assets::MeshModel& gum_P) override { gum_ = onGpu(gum_P, Finish::gum); }
  void setInstrument(const assets::MeshModel& instrument_T) override {
    instrument_ = onGpu(instrument_T, Finish::instrument);
  }
  void updateBrick(glm::ivec3 brick, std::span<const std::uint8_t, Occupancy::kBrickValues> solid) override {
    fields_.updateBrick(brick, solid);
  }

  void prepare(const Frame&) override { volume_.update(fields_, fields_.prepare()); }
  void drawEye(const Frame& frame, Eye eye, glm::ivec2 px) override;
  void compose(const Frame& frame) override;

  void composeForBystander() override;
  void showOnWindow(const WindowPlace& place, int output) override {
    showPictureOnWindow(outputs_[static_cast<std::size_t>(output)].colour(0), place);
  }
  Picture readPicture(int output) override { return pictureOf(outputs_[static_cast<std::size_t>(output)]); }
  Picture readEye(Eye eye) override;
  DistancePicture readDistance(Eye eye) override;
  void throwIfError() override { log_.throwIfError("drawing a frame"); }

 private:
  EyePicture& picture(Eye eye) { return pictures_[static_cast<std::size_t>(eye)]; }
  void drawScene(const Frame& frame, Eye eye, Framebuffer& target);

  int samples_;
  GlDebugLog log_{false};
  VolumeFields fields_;
  VolumeTexture volume_;
  RayCaster caster_;
  MeshPass meshes_;
  Program background_{"screen.vert", "background.frag"};
  UniformBlock<EyeBlock> eye_block_;
  StereoCompositor compositor_;
  std::optional<SceneMesh> face_, gum_, instrument_;
  std::array<EyePicture, 3> pictures_;
  Eye composed_from_ = Eye::cyclopean;
  std::array<Framebuffer, 3> outputs_;
};

void GlSceneRenderer::drawEye(const Frame& frame, Eye eye, glm::ivec2 px) {
  EyePicture& to = picture(eye);
  const glm::ivec2 size = samples_ * px;
  if (to.target.size() != size) to.target = Framebuffer(size, kSceneTargets, true);
  to.px = px;
  to.frame = frame;
  to.drawn = true;
  drawScene(frame, eye, to.target);
}

void GlSceneRenderer::drawScene(const Frame& frame, Eye eye, Framebuffer& target) {
  const EyeView view = eyeView(frame.rig, eye);
  eye_block_.set(EYE_BLOCK, eyeBlock(frame, view));
  caster_.bind(fields_, volume_);
  target.bind();
  target.clear();

  apply({.depth_test = false, .depth_write = false});
  background_.use();
  drawScreen();

  // Opaque meshes, then the volume between them, then what lets it shine through.
  const MeshPass::Placement in_P{.view_is_mirrored = view.mirrored};
  const MeshPass::Placement at_tool{
      .P_from_mesh = frame.X_PT.matrix(), .bur_angle_rad = frame.bur_angle_rad, .view_is_mirrored = view.mirrored};
  const auto draw_meshes = [&](MeshPass::Parts parts) {
    if (face_) meshes_.draw(*face_, parts, in_P);
    if (instrument_ && frame.tool_visible) meshes_.draw(*instrument_, parts, at_tool);
    if (gum_) meshes_.draw(*gum_, parts, in_P);
  };
  draw_meshes(MeshPass::Parts::opaque);
  caster_.draw(target.colour(DISTANCE_TARGET));
  draw_meshes(MeshPass::Parts::transparent);
}

void GlSceneRenderer::compose(const Frame& frame) {
  StereoLayout layout{.mode = frame.display,
                      .screen_px = frame.rig.screen.px,
                      .at_px = frame.output_at_px,
                      .swapped = frame.eyes_swapped};
  const glm::ivec2 size = outputSize(frame.display, frame.rig.screen.px);
  const bool mono = frame.display == DisplayMode::mono;
  composed_from_ = mono ? Eye::cyclopean : Eye::left;
  const Texture& left = picture(mono ? Eye::cyclopean : Eye::left).target.colour(COLOUR_TARGET);
  const Texture& right = picture(mono ? Eye::cyclopean : Eye::right).target.colour(COLOUR_TARGET);
  for (layout.output = 0; layout.output < outputCount(frame.display); ++layout.output) {
    Framebuffer& output = outputs_[static_cast<std::size_t>(layout.output)];
    if (output.size() != size) output = Framebuffer(size, kOutputTargets, false);
    compositor_.compose(layout, left, right, samples_, output);
  }
}

void GlSceneRenderer::composeForBystander() {
  const EyePicture& seen = picture(composed_from_);
  const glm::ivec2 size = seen.frame.rig.screen.px;
  Framebuffer& output = outputs_[kBystanderOutput];
  if (output.size() != size) output = Framebuffer(size, kOutputTargets, false);
  const Texture& light = seen.target.colour(COLOUR_TARGET);
  compositor_.compose({.screen_px = size}, light, light, samples_, output);
}

Picture GlSceneRenderer::readEye(Eye eye) {
  assert(picture(eye).drawn);
  const Framebuffer resolved(picture(eye).px, kOutputTargets, false);
  const Texture& light = picture(eye).target.colour(COLOUR_TARGET);
  compositor_.compose({.screen_px = picture(eye).px}, light, light, samples_, resolved);
  return pictureOf(resolved);
}

DistancePicture GlSceneRenderer::readDistance(Eye eye) {
  const EyePicture& shown = picture(eye);
  assert(shown.drawn);
  const auto read = [&](const Framebuffer& target) -> DistancePicture {
    return {shown.px.x, shown.px.y, flipped(target.readFloat(DISTANCE_TARGET), static_cast<std::size_t>(shown.px.x))};
  };
  if (samples_ == 1) return read(shown.target);

  // Samples lie beside the pixel's centre, where the distance is asked for: draw it there.
  Framebuffer centred(shown.px, kSceneTargets, true);
  drawScene(shown.frame, eye, centred);
  return read(centred);
}

}  // namespace

std::unique_ptr<SceneRenderer> glSceneRenderer(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid,
                                               std::span<const std::uint8_t> label, const RenderOptions& options) {
  return std::make_unique<GlSceneRenderer>(grid, solid, label, options);
}

}  // namespace render
