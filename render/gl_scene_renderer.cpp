#include "render/scene_renderer.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "render/display/patch_pass.h"
#include "render/display/stereo_compositor.h"
#include "render/eye_block.h"
#include "render/gpu/drawing.h"
#include "render/gpu/framebuffer.h"
#include "render/gpu/gpu_error.h"
#include "render/gpu/late_image.h"
#include "render/gpu/window_image.h"
#include "render/scene/edge_pass.h"
#include "render/scene/fragment_lists.h"
#include "render/scene/inset_pass.h"
#include "render/scene/mesh_pass.h"
#include "render/shaders/shared_constants.glsl"
#include "render/soft_block.h"
#include "render/tool_block.h"
#include "render/volume/bone_mesh.h"
#include "render/volume/ray_caster.h"

namespace render {
namespace {

constexpr std::array kSceneTargets{TexelFormat::rgba16f, TexelFormat::r32f};
constexpr std::array kOutputTargets{TexelFormat::rgba8};

// Reverses the order of the rows.
template <class T>
std::vector<T> flipped(std::vector<T> rows, std::size_t row_length) {
  for (auto low = rows.begin(), high = rows.end(); high - low > static_cast<std::ptrdiff_t>(row_length);
       low += static_cast<std::ptrdiff_t>(row_length)) {
    high -= static_cast<std::ptrdiff_t>(row_length);
    std::swap_ranges(low, low + static_cast<std::ptrdiff_t>(row_length), high);
  }
  return rows;
}

struct SceneTarget {
  Framebuffer target, layer;  ///< layer: the ray-cast volume
  FragmentLists clear;
};

class GlSceneRenderer final : public SceneRenderer {
 public:
  GlSceneRenderer(const VolumeFields& fields, const RenderOptions& options)
      : samples_(options.samples),
        fields_(fields),
        volume_(fields),
        caster_(options.backend == Backend::gl_compute ? RayCaster::Stage::compute : RayCaster::Stage::fragment,
                options.skip_empty_space) {}

  void setModel(Model model, const assets::MeshModel& mesh) override {
    models_[static_cast<std::size_t>(model)] = SceneMesh(mesh, model);
  }
  void setGuides(GuideField guides) override { volume_.setGuides(guides); }
  void setPaint(const SurfacePaint* paint) override { volume_.setPaint(paint != nullptr ? *paint : SurfacePaint{}); }
  void setInsets(std::vector<Inset> insets) override {
    insets_.clear();
    for (const Inset& inset : insets)
      insets_.push_back({InsetPass::uploaded(inset.image), inset.first_px, inset.size_px});
  }
  void setPatches(int output, std::span<const OverlayPatch> patches) override {
    PatchPass::update(patches, patches_[static_cast<std::size_t>(output)]);
  }

  void prepare(const Frame& frame, const FieldChanges& changes) override {
    volume_.update(fields_, changes);
    if (frame.mode == ViewMode::mesh && !bone_mesh_) bone_mesh_.emplace();
    if (bone_mesh_) bone_mesh_->markChanged(changes);
    if (frame.mode == ViewMode::mesh) bone_mesh_->prepare(fields_);
  }
  void drawEye(const Frame& frame, Eye eye, glm::ivec2 px) override;
  void compose(const StereoLayout& layout, Eye left, Eye right, int output) override;

  void showOnWindow(const WindowTarget& target, int output) override {
    showImageOnWindow(outputs_[static_cast<std::size_t>(output)].colour(0), target);
  }
  Image readImage(int output) override;
  std::optional<Image> readLate(int output, glm::ivec2 most_px) override {
    return late_.take(outputs_[static_cast<std::size_t>(output)], most_px);
  }
  DistanceImage readDistance(const Frame& frame, Eye eye) override;
  void throwIfError() override { throwIfGlError("drawing a frame"); }

 private:
  SceneTarget& canvasOf(Eye eye) { return canvases_[static_cast<std::size_t>(eye)]; }
  enum class Where { everywhere, edges };
  void drawScene(const Frame& frame, Eye eye, glm::ivec2 size, SceneTarget& canvas, Where where = Where::everywhere);
  /// What is seen in the second hand's mirror, in the pixels that can show it, for the shaders of its glass.
  void drawReflected(const Frame& frame, const EyeView& view, glm::ivec2 size, Where where);
  /// Into a bound and cleared target.
  void drawView(const Frame& frame, const EyeBlock& block, bool mirrored, SceneTarget& canvas);

  int samples_;
  const VolumeFields& fields_;
  VolumeTexture volume_;
  RayCaster caster_;
  std::optional<BoneMesh> bone_mesh_;  ///< from the first frame in ViewMode::mesh
  MeshPass meshes_;
  Program background_{"screen.vert", "background.frag"};
  UniformBlock<EyeBlock> eye_block_;
  UniformBlock<ToolBlock> tool_block_;
  UniformBlock<SoftBlock> soft_block_;
  StereoCompositor compositor_;
  std::array<SceneMesh, kModels> models_;
  EdgePass edges_;
  InsetPass inset_pass_;
  std::vector<InsetPass::GpuInset> insets_;
  PatchPass patch_pass_;
  std::array<std::vector<PatchPass::GpuPatch>, kOutputs> patches_;
  std::array<SceneTarget, kEyes> canvases_;  ///< of the eyes as last drawn
  SceneTarget edge_samples_;
  std::array<SceneTarget, 2> reflected_;  ///< of the eye that is drawn, and of its edges
  std::array<Framebuffer, kOutputs> outputs_;
  LateImage late_;
};

void GlSceneRenderer::drawEye(const Frame& frame, Eye eye, glm::ivec2 px) {
  SceneTarget& canvas = canvasOf(eye);
  const glm::ivec2 size = samples_ * px;
  drawScene(frame, eye, size, canvas);
  if (samples_ == 1 && frame.quality.antialias == Antialias::edges) {
    // Silhouettes again, at 2x2 samples.
    edges_.find(canvas.target);
    drawScene(frame, eye, EDGE_SAMPLES * size, edge_samples_, Where::edges);
    edges_.average(edge_samples_.target, canvas.target);
  }
  inset_pass_.draw(insets_, canvas.target, samples_);
}

void GlSceneRenderer::drawScene(const Frame& frame, Eye eye, glm::ivec2 size, SceneTarget& canvas, Where where) {
  Framebuffer& target = canvas.target;
  target.fit(size, kSceneTargets, true);
  const EyeView view = eyeView(frame.rig, eye);
  tool_block_.set(TOOL_BLOCK, toolBlock(frame));
  soft_block_.set(SOFT_BLOCK, softBlock(frame.marks));
  caster_.bind(fields_, volume_, frame);
  drawReflected(frame, view, size, where);
  target.bind();
  target.clear();
  if (where == Where::edges) edges_.rejectInterior(target);
  drawView(frame, eyeBlock(frame, view), view.mirrored, canvas);
}

void GlSceneRenderer::drawReflected(const Frame& frame, const EyeView& view, glm::ivec2 size, Where where) {
  const std::optional<EyeBlock> there = reflectedEyeBlock(frame, view);
  if (!there) return;
  SceneTarget& canvas = reflected_[where == Where::edges ? 1 : 0];
  Framebuffer& target = canvas.target;
  target.fit(size, kSceneTargets, true);
  target.bind();
  target.block();
  if (const GlassBox box = glassBox(frame, view, size); box.size_px.x > 0) {
    setScissor(box.corner_px, box.size_px);
    target.clear();
    if (where == Where::edges) edges_.rejectInterior(target);
    drawView(frame, *there, !view.mirrored, canvas);
    setScissor({}, {});
  }
  target.colour(COLOUR_TARGET).bind(REFLECTED_LIGHT_UNIT);
  target.colour(DISTANCE_TARGET).bind(REFLECTED_DISTANCE_UNIT);
}

void GlSceneRenderer::drawView(const Frame& frame, const EyeBlock& block, bool mirrored, SceneTarget& canvas) {
  Framebuffer& target = canvas.target;
  eye_block_.set(EYE_BLOCK, block);
  drawScreen(background_, {.depth_write = false, .allow_equal_depth = true, .write_distance = false});

  const Placements placements = placementsIn(frame);
  const auto draw = [&](std::span<const Model> models, MeshPass::Parts parts) {
    for (const Model model : models)
      meshes_.draw(models_[static_cast<std::size_t>(model)], parts, placements[model], mirrored);
  };
  constexpr std::array kOutside{Model::face, Model::instrument, Model::second_instrument};
  constexpr std::array kInside{Model::gingiva, Model::flap,      Model::mandibular_canal, Model::ruler,  Model::arrow,
                               Model::beads,   Model::fragments, pieceModel(0),           pieceModel(1), pieceModel(2),
                               pieceModel(3)};
  static_assert(kMostPieces == 4);
  constexpr std::array kOverlay{Model::mandibular_canal_overlay, Model::ruler_overlay, Model::arrow_overlay,
                                Model::obstacles, Model::ghost};
  bool any_transparent = false;
  for (std::size_t m = 0; m < kModels; ++m)
    any_transparent = any_transparent || MeshPass::hasTransparent(models_[m], placements[m].opacity);
  if (any_transparent) canvas.clear.begin(target.size());

  // Opaque meshes; the overlays before the depth of bone and gingiva is written; the volume; transparent meshes.
  draw(kOutside, MeshPass::Parts::opaque);
  draw(kOverlay, MeshPass::Parts::transparent);
  draw(kInside, MeshPass::Parts::opaque);
  if (frame.mode == ViewMode::mesh)
    bone_mesh_->draw(mirrored);
  else
    caster_.draw(canvas.layer, target);
  if (!any_transparent) return;
  draw(kOutside, MeshPass::Parts::transparent);
  draw(kInside, MeshPass::Parts::transparent);
  canvas.clear.blendOver(target);
}

void GlSceneRenderer::compose(const StereoLayout& layout, Eye left, Eye right, int output) {
  Framebuffer& to = outputs_[static_cast<std::size_t>(output)];
  to.fit(outputSize(layout.mode, layout.screen_px), kOutputTargets, false);
  compositor_.compose(layout, canvasOf(left).target.colour(COLOUR_TARGET), canvasOf(right).target.colour(COLOUR_TARGET),
                      samples_, to);
  patch_pass_.draw(patches_[static_cast<std::size_t>(output)], to);
}

Image GlSceneRenderer::readImage(int output) {
  const Framebuffer& target = outputs_[static_cast<std::size_t>(output)];
  const glm::ivec2 size = target.size();
  return {size.x, size.y, flipped(target.readRgba8(0), 4 * static_cast<std::size_t>(size.x))};
}

DistanceImage GlSceneRenderer::readDistance(const Frame& frame, Eye eye) {
  const Framebuffer* target = &canvasOf(eye).target;
  const glm::ivec2 px = target->size() / samples_;
  SceneTarget centred;
  if (samples_ > 1) {
    // Samples do not lie at the pixel centre, where the distance is wanted: draw once more with one sample.
    drawScene(frame, eye, px, centred);
    target = &centred.target;
  }
  return {px.x, px.y, flipped(target->readFloat(DISTANCE_TARGET), static_cast<std::size_t>(px.x))};
}

}  // namespace

std::unique_ptr<SceneRenderer> glSceneRenderer(const VolumeFields& fields, const RenderOptions& options) {
  return std::make_unique<GlSceneRenderer>(fields, options);
}

}  // namespace render
