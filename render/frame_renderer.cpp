#include "render/frame_renderer.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "render/display/stereo_compositor.h"
#include "render/eye_block.h"
#include "render/gpu/drawing.h"
#include "render/gpu/framebuffer.h"
#include "render/gpu/gl_debug_log.h"
#include "render/gpu/gpu_error.h"
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

}  // namespace

struct FrameRenderer::Passes {
  Passes(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid, std::span<const std::uint8_t> label,
         RenderOptions chosen)
      : options(chosen),
        volume(grid, solid, label),
        caster(chosen.skip_empty_space ? RayCaster::EmptySpace::skip : RayCaster::EmptySpace::march) {}

  EyePicture& picture(Eye eye) { return pictures[static_cast<std::size_t>(eye)]; }
  void drawEye(const Frame& frame, Eye eye, glm::ivec2 px);
  void drawScene(const Frame& frame, Eye eye, Framebuffer& target);

  RenderOptions options;
  GlDebugLog log{false};
  VolumeTexture volume;
  RayCaster caster;
  MeshPass meshes;
  Program background{"screen.vert", "background.frag"};
  UniformBlock<EyeBlock> eye_block;
  StereoCompositor compositor;
  std::optional<SceneMesh> face, gum, instrument;
  std::array<EyePicture, 3> pictures;
  Framebuffer output;
};

void FrameRenderer::Passes::drawEye(const Frame& frame, Eye eye, glm::ivec2 px) {
  EyePicture& to = picture(eye);
  const glm::ivec2 size = options.samples * px;
  if (to.target.size() != size) to.target = Framebuffer(size, kSceneTargets, true);
  to.px = px;
  to.frame = frame;
  to.drawn = true;
  drawScene(frame, eye, to.target);
}

void FrameRenderer::Passes::drawScene(const Frame& frame, Eye eye, Framebuffer& target) {
  const EyeView view = eyeView(frame.rig, eye);
  eye_block.set(EYE_BLOCK, eyeBlock(frame, view));
  caster.bind(volume);
  target.bind();
  target.clear();

  apply({.depth_test = false, .depth_write = false});
  background.use();
  drawScreen();

  // Opaque meshes, then the volume between them, then what lets it shine through.
  const MeshPass::Placement in_P{.view_is_mirrored = view.mirrored};
  const MeshPass::Placement at_tool{
      .P_from_mesh = frame.X_PT.matrix(), .bur_angle_rad = frame.bur_angle_rad, .view_is_mirrored = view.mirrored};
  const auto draw_meshes = [&](MeshPass::Parts parts) {
    if (face) meshes.draw(*face, parts, in_P);
    if (instrument && frame.tool_visible) meshes.draw(*instrument, parts, at_tool);
    if (gum) meshes.draw(*gum, parts, in_P);
  };
  draw_meshes(MeshPass::Parts::opaque);
  caster.draw(volume, target.colour(DISTANCE_TARGET));
  draw_meshes(MeshPass::Parts::transparent);
}

FrameRenderer::FrameRenderer(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid,
                             std::span<const std::uint8_t> label, RenderOptions options) {
  if (options.samples < 1 || options.samples > 8)
    throw GpuError("samples " + std::to_string(options.samples) + ", renderer options: choose 1 to 8");
  passes_ = std::make_unique<Passes>(grid, solid, label, options);
}

FrameRenderer::~FrameRenderer() = default;

void FrameRenderer::setFace(const assets::MeshModel& face_P) { passes_->face = onGpu(face_P, Finish::skin); }
void FrameRenderer::setGum(const assets::MeshModel& gum_P) { passes_->gum = onGpu(gum_P, Finish::gum); }
void FrameRenderer::setInstrument(const assets::MeshModel& instrument_T) {
  passes_->instrument = onGpu(instrument_T, Finish::instrument);
}

void FrameRenderer::updateBrick(glm::ivec3 brick, std::span<const std::uint8_t, Occupancy::kBrickValues> solid) {
  passes_->volume.updateBrick(brick, solid);
}

void FrameRenderer::render(const Frame& frame) {
  Passes& p = *passes_;
  const glm::ivec2 output_px = frame.rig.screen.px;
  const glm::ivec2 eye_px = eyePictureSize(frame.display, output_px);
  if (p.output.size() != output_px) p.output = Framebuffer(output_px, kOutputTargets, false);
  p.volume.prepare();
  if (frame.display == DisplayMode::mono) {
    p.drawEye(frame, Eye::cyclopean, eye_px);
    const Texture& only = p.picture(Eye::cyclopean).target.colour(COLOUR_TARGET);
    p.compositor.compose(frame.display, only, only, p.options.samples, p.output);
    return;
  }
  p.drawEye(frame, Eye::left, eye_px);
  p.drawEye(frame, Eye::right, eye_px);
  p.compositor.compose(frame.display, p.picture(Eye::left).target.colour(COLOUR_TARGET),
                       p.picture(Eye::right).target.colour(COLOUR_TARGET), p.options.samples, p.output);
}

void FrameRenderer::renderEye(const Frame& frame, Eye eye) {
  passes_->volume.prepare();
  passes_->drawEye(frame, eye, frame.rig.screen.px);
}

void FrameRenderer::showOnWindow(glm::ivec2 window_px) const { passes_->output.showOnWindow(window_px); }

Picture FrameRenderer::readPicture() const { return pictureOf(passes_->output); }

Picture FrameRenderer::readEye(Eye eye) {
  Passes& p = *passes_;
  assert(p.picture(eye).drawn);
  const Framebuffer resolved(p.picture(eye).px, kOutputTargets, false);
  const Texture& light = p.picture(eye).target.colour(COLOUR_TARGET);
  p.compositor.compose(DisplayMode::mono, light, light, p.options.samples, resolved);
  return pictureOf(resolved);
}

DistancePicture FrameRenderer::readDistance(Eye eye) {
  Passes& p = *passes_;
  const EyePicture& shown = p.picture(eye);
  assert(shown.drawn);
  const auto read = [&](const Framebuffer& target) -> DistancePicture {
    return {shown.px.x, shown.px.y, flipped(target.readFloat(DISTANCE_TARGET), static_cast<std::size_t>(shown.px.x))};
  };
  if (p.options.samples == 1) return read(shown.target);

  // Samples lie beside the pixel's centre, where the distance is asked for: draw it there.
  Framebuffer centred(shown.px, kSceneTargets, true);
  p.drawScene(shown.frame, eye, centred);
  return read(centred);
}

void FrameRenderer::throwIfError() { passes_->log.throwIfError("drawing a frame"); }

glm::dmat4 clipFromPatient(const calibration::Rig& rig, const EyeView& view) {
  return view.clip_from_W * rig.X_WP.matrix();
}

}  // namespace render
