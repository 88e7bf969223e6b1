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
#include "render/scene/clear_lists.h"
#include "render/scene/edge_pass.h"
#include "render/scene/guide_opacity.h"
#include "render/scene/inset_pass.h"
#include "render/scene/mandibular_canal_tube.h"
#include "render/scene/mesh_pass.h"
#include "render/shaders/shared_numbers.glsl"
#include "render/volume/bone_mesh.h"
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

// What a scene is drawn into.
struct Canvas {
  void fit(glm::ivec2 size) {
    if (target.size() != size) target = Framebuffer(size, kSceneTargets, true);
  }

  Framebuffer target;
  VolumeLayer layer;
  ClearLists clear;
};

// An eye as last drawn.
struct EyePicture {
  Canvas canvas;
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
        caster_(options.backend == Backend::gl_compute ? RayCaster::Stage::compute : RayCaster::Stage::fragment,
                options.skip_empty_space) {}

  void setFace(const assets::MeshModel& face_P) override { face_ = onGpu(face_P, Finish::skin); }
  void setGum(const assets::MeshModel& gum_P) override { gum_ = onGpu(gum_P, Finish::gum); }
  void setInstrument(const assets::MeshModel& instrument_T) override {
    instrument_ = onGpu(instrument_T, Finish::instrument);
  }
  void setSecondInstrument(const assets::MeshModel& instrument_O) override {
    second_instrument_ = onGpu(instrument_O, Finish::instrument);
  }
  void setGuides(const Guides& guides) override {
    mandibular_canal_ =
        onGpu(mandibularCanalTube(guides.mandibular_canal_P_mm, guides.mandibular_canal_radius_mm), Finish::guide);
    const GuideField field(fields_.grid(), guides);
    guides_ = Texture::volume(field.size(), TexelFormat::rg16);
    guides_.upload({0, 0, 0}, field.size(), std::as_bytes(field.values()));
  }
  void updateBrick(glm::ivec3 brick, std::span<const std::uint8_t, Occupancy::kBrickValues> solid) override {
    fields_.updateBrick(brick, solid);
  }

  void setInsets(std::vector<Inset> insets) override {
    insets_.clear();
    for (const Inset& inset : insets)
      insets_.push_back({InsetPass::onGpu(inset.picture), inset.first_px, inset.size_px});
  }
  const VolumeFields& fields() const override { return fields_; }

  void prepare(const Frame& frame) override {
    const FieldChanges& changes = fields_.prepare();
    volume_.update(fields_, changes);
    if (frame.mode == ViewMode::mesh && !bone_mesh_) bone_mesh_.emplace();
    if (bone_mesh_) bone_mesh_->note(changes);
    if (frame.mode == ViewMode::mesh) bone_mesh_->prepare(fields_);
  }
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
  enum class Where { everywhere, edges };
  struct Placed {
    const SceneMesh* mesh;
    MeshPass::Placement placement;
  };
  struct PlacedMeshes {
    std::vector<Placed> outside;  ///< face and instruments
    std::vector<Placed> inside;   ///< gum and the open canal
    std::vector<Placed> through;  ///< guides that are seen through bone and gum, behind nothing outside
    bool anyTransparent() const;
  };
  PlacedMeshes meshesOf(const Frame& frame, bool mirrored) const;
  void drawScene(const Frame& frame, Eye eye, Canvas& canvas, Where where = Where::everywhere);

  int samples_;
  GlDebugLog log_{false};
  VolumeFields fields_;
  VolumeTexture volume_;
  TransferFunction transfer_;
  RayCaster caster_;
  std::optional<BoneMesh> bone_mesh_;  ///< from the first frame that shows it
  MeshPass meshes_;
  Program background_{"screen.vert", "background.frag"};
  UniformBlock<EyeBlock> eye_block_;
  StereoCompositor compositor_;
  std::optional<SceneMesh> face_, gum_, instrument_, second_instrument_, mandibular_canal_;
  Texture guides_;
  EdgePass edges_;
  InsetPass inset_pass_;
  std::vector<InsetPass::Placed> insets_;
  std::array<EyePicture, 3> pictures_;
  Canvas edge_samples_;
  Eye composed_from_ = Eye::cyclopean;
  std::array<Framebuffer, 3> outputs_;
};

void GlSceneRenderer::drawEye(const Frame& frame, Eye eye, glm::ivec2 px) {
  EyePicture& to = picture(eye);
  const glm::ivec2 size = samples_ * px;
  to.canvas.fit(size);
  to.px = px;
  to.frame = frame;
  to.drawn = true;
  drawScene(frame, eye, to.canvas);
  if (samples_ == 1 && frame.quality.antialias == Antialias::edges) {
    // Silhouettes once more, finer.
    edges_.find(to.canvas.target);
    edge_samples_.fit(EDGE_SAMPLES * size);
    drawScene(frame, eye, edge_samples_, Where::edges);
    edges_.average(edge_samples_.target, to.canvas.target);
  }
  inset_pass_.draw(insets_, to.canvas.target, samples_);
}

void GlSceneRenderer::drawScene(const Frame& frame, Eye eye, Canvas& canvas, Where where) {
  Framebuffer& target = canvas.target;
  const EyeView view = eyeView(frame.rig, eye);
  eye_block_.set(EYE_BLOCK, eyeBlock(frame, view));
  caster_.bind(fields_, volume_, frame, transfer_, guides_.name() != 0);
  if (guides_.name() != 0) guides_.bind(GUIDE_UNIT);
  target.bind();
  target.clear();
  if (where == Where::edges) edges_.bar(target);

  apply({.depth_write = false, .at_same_depth = true, .write_distance = false});
  background_.use();
  drawScreen();

  const PlacedMeshes meshes = meshesOf(frame, view.mirrored);
  const auto draw = [this](const std::vector<Placed>& placed, MeshPass::Parts parts) {
    for (const Placed& p : placed) meshes_.draw(*p.mesh, parts, p.placement);
  };
  const bool any_transparent = meshes.anyTransparent();
  if (any_transparent) canvas.clear.begin(target.size());

  // Opaque meshes, and before the depth of bone and gum is known, what is seen through these; the volume between the
  // meshes; then what lets it shine through.
  draw(meshes.outside, MeshPass::Parts::opaque);
  draw(meshes.through, MeshPass::Parts::transparent);
  draw(meshes.inside, MeshPass::Parts::opaque);
  if (frame.mode == ViewMode::mesh)
    bone_mesh_->draw(view.mirrored);
  else
    caster_.draw(canvas.layer, target);
  if (!any_transparent) return;
  draw(meshes.outside, MeshPass::Parts::transparent);
  draw(meshes.inside, MeshPass::Parts::transparent);
  canvas.clear.layOver(target);
}

bool GlSceneRenderer::PlacedMeshes::anyTransparent() const {
  return std::ranges::any_of(std::array{&outside, &inside, &through}, [](const std::vector<Placed>* placed) {
    return std::ranges::any_of(*placed,
                               [](const Placed& p) { return MeshPass::hasTransparent(*p.mesh, p.placement.opacity); });
  });
}

GlSceneRenderer::PlacedMeshes GlSceneRenderer::meshesOf(const Frame& frame, bool mirrored) const {
  PlacedMeshes meshes;
  const Layers& layers = frame.layers;
  if (face_) meshes.outside.push_back({&*face_, {.view_is_mirrored = mirrored, .opacity = layers.face_opacity}});
  if (instrument_ && frame.tool_visible)
    meshes.outside.push_back(
        {&*instrument_,
         {.P_from_mesh = frame.X_PT.matrix(), .bur_angle_rad = frame.bur_angle_rad, .view_is_mirrored = mirrored}});
  if (second_instrument_ && frame.second_visible)
    meshes.outside.push_back(
        {&*second_instrument_, {.P_from_mesh = frame.X_PO.matrix(), .view_is_mirrored = mirrored}});
  if (gum_ && layers.gum) meshes.inside.push_back({&*gum_, {.view_is_mirrored = mirrored}});

  // Guides: the canal where it is open, and faintly where it is not; the hand where the bone holds the tool.
  if (mandibular_canal_ && layers.mandibular_canal) {
    meshes.inside.push_back({&*mandibular_canal_, {.view_is_mirrored = mirrored}});
    meshes.through.push_back({&*mandibular_canal_, {.view_is_mirrored = mirrored, .opacity = kMandibularCanalThrough}});
  }
  const float ghost = ghostOpacity(frame);
  if (instrument_ && ghost > 0.0f)
    meshes.through.push_back({&*instrument_,
                              {.P_from_mesh = frame.X_PT_at_hand.matrix(),
                               .bur_angle_rad = frame.bur_angle_rad,
                               .view_is_mirrored = mirrored,
                               .opacity = ghost}});
  return meshes;
}

void GlSceneRenderer::compose(const Frame& frame) {
  StereoLayout layout{.mode = frame.display,
                      .screen_px = frame.rig.screen.px,
                      .at_px = frame.output_at_px,
                      .swapped = frame.eyes_swapped};
  const glm::ivec2 size = outputSize(frame.display, frame.rig.screen.px);
  const bool mono = frame.display == DisplayMode::mono;
  composed_from_ = mono ? Eye::cyclopean : Eye::left;
  const Texture& left = picture(mono ? Eye::cyclopean : Eye::left).canvas.target.colour(COLOUR_TARGET);
  const Texture& right = picture(mono ? Eye::cyclopean : Eye::right).canvas.target.colour(COLOUR_TARGET);
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
  const Texture& light = seen.canvas.target.colour(COLOUR_TARGET);
  compositor_.compose({.screen_px = size}, light, light, samples_, output);
}

Picture GlSceneRenderer::readEye(Eye eye) {
  assert(picture(eye).drawn);
  const Framebuffer resolved(picture(eye).px, kOutputTargets, false);
  const Texture& light = picture(eye).canvas.target.colour(COLOUR_TARGET);
  compositor_.compose({.screen_px = picture(eye).px}, light, light, samples_, resolved);
  return pictureOf(resolved);
}

DistancePicture GlSceneRenderer::readDistance(Eye eye) {
  const EyePicture& shown = picture(eye);
  assert(shown.drawn);
  const auto read = [&](const Framebuffer& target) -> DistancePicture {
    return {shown.px.x, shown.px.y, flipped(target.readFloat(DISTANCE_TARGET), static_cast<std::size_t>(shown.px.x))};
  };
  if (samples_ == 1) return read(shown.canvas.target);

  // Samples lie beside the pixel's centre, where the distance is asked for: draw it there.
  Canvas centred;
  centred.fit(shown.px);
  drawScene(shown.frame, eye, centred);
  return read(centred.target);
}

}  // namespace

std::unique_ptr<SceneRenderer> glSceneRenderer(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid,
                                               std::span<const std::uint8_t> label, const RenderOptions& options) {
  return std::make_unique<GlSceneRenderer>(grid, solid, label, options);
}

}  // namespace render
