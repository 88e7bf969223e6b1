#include "render/scene_renderer.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <thread>

#include "render/cpu/cpu_compositor.h"
#include "render/cpu/edges.h"
#include "render/cpu/enlarge.h"
#include "render/cpu/eye_image.h"
#include "render/cpu/ray_tracer.h"
#include "render/display/srgb.h"
#include "render/eye_block.h"
#include "render/shaders/shared_constants.glsl"
#include "render/volume/transfer_function.h"
#include "render/volume/volume_fields.h"

namespace render {
namespace {

constexpr int kTile = 16;  // pixels along the edge of a tile
constexpr int kBlock = 4;  // rays are ordered by blocks of 4x4 pixels, so that packets are compact

// Leaves a core to the servo if there are more than two; on two the servo has the higher priority.
int threads() {
  const int cores = static_cast<int>(std::thread::hardware_concurrency());
  return cores > 2 ? cores - 1 : std::max(cores, 1);
}

template <class T>
FieldView<T> viewOf(const BorderedField<T>& field) {
  const FieldLayout& layout = field.layout();
  return {.border = field.at(glm::ivec3(-1)),
          .row = static_cast<std::int32_t>(layout.row),
          .slice = static_cast<std::int32_t>(layout.slice),
          .size = layout.size};
}

// Hits on face and gingiva by tile, kept while the eye does not move.
struct KeptHits {
  std::array<glm::vec4, 4> view{};  ///< of the EyeBlock
  glm::ivec2 px{0};
  std::uint64_t revision = ~std::uint64_t{0};
  std::vector<MeshHits> tiles, veil_tiles;  // `veil_tiles`: only while there is a veil
};

// The image holds linear light after the shoulder, as displayed.
void blendOver(const Inset& inset, EyeImage& image) {
  static const std::array<float, 256> kLight = lightOfBytes();
  const glm::ivec2 end = glm::min(inset.first_px + inset.size_px, image.px);
  for (int y = inset.first_px.y; y < end.y; ++y)
    for (int x = inset.first_px.x; x < end.x; ++x) {
      const int column = (2 * (x - inset.first_px.x) + 1) * inset.image.w / (2 * inset.size_px.x);
      const int row = (2 * (y - inset.first_px.y) + 1) * inset.image.h / (2 * inset.size_px.y);
      const std::uint8_t* const from = &inset.image.rgba[4 * static_cast<std::size_t>(row * inset.image.w + column)];
      const std::size_t at = image.at(x, y);
      image.r[at] = kLight[from[0]], image.g[at] = kLight[from[1]], image.b[at] = kLight[from[2]];
    }
}

// The last drawn state of an eye.
struct RenderedEye {
  EyeImage image, enlarged;
  bool is_enlarged = false;  // since it was drawn
  Enlarger::Edges edges = Enlarger::Edges::smooth;
  // Of two sizes: the picture is drawn small while it moves and whole where it rests.
  std::array<KeptHits, 2> static_hits;
  std::size_t newest_hits = 0;

  KeptHits& hitsOf(glm::ivec2 px) {
    if (static_hits[newest_hits].px != px) newest_hits = 1 - newest_hits;
    return static_hits[newest_hits];
  }
};

class CpuSceneRenderer final : public SceneRenderer {
 public:
  CpuSceneRenderer(const VolumeFields& fields, const RenderOptions& options, ShowImage show)
      : options_(options),
        show_(std::move(show)),
        kernels_(shadeKernels()),
        arena_(threads()),
        fields_(fields),
        cells_(fields_.solid()),
        matter_(fields_.ambient(), BRICK_VOXELS / AMBIENT_CELL_VOXELS, std::uint16_t{1}) {}

  void setModel(Model model, const assets::MeshModel& mesh) override { meshes_.setModel(model, mesh); }
  void setGuides(GuideField guides) override { guides_ = std::move(guides); }
  void setPaint(const SurfacePaint* paint) override { paint_ = paint != nullptr ? *paint : SurfacePaint{}; }
  void setInsets(std::vector<Inset> insets) override { insets_ = std::move(insets); }
  void setPatches(int output, std::span<const OverlayPatch> patches) override {
    patches_[static_cast<std::size_t>(output)].assign(patches.begin(), patches.end());
  }

  void prepare(const Frame& frame, const FieldChanges& changes) override;
  void drawEye(const Frame& frame, Eye eye, glm::ivec2 px) override;
  void compose(const StereoLayout& layout, Eye left, Eye right, int output) override;

  void showOnWindow(const WindowTarget& target, int output) override {
    show_(outputs_[static_cast<std::size_t>(output)], target);
  }
  std::optional<Image> readLate(int output, glm::ivec2) override { return readImage(output); }
  Image readImage(int output) override { return outputs_[static_cast<std::size_t>(output)]; }
  DistanceImage readDistance(const Frame& frame, Eye eye) override;
  void throwIfError() override {}

 private:
  RenderedEye& drawn(Eye eye) { return eyes_[static_cast<std::size_t>(eye)]; }
  TraceScene sceneFor(const Frame& frame, Eye eye);
  TraceScene sceneOf(const Frame& frame, const EyeBlock& eye);
  void draw(const TraceScene& scene, int samples, EyeImage& image, KeptHits* static_hits);
  void drawTile(const TraceScene& scene, int samples, glm::ivec2 first, glm::ivec2 end, RayTracer& tracer,
                EyeImage& image, const StaticHits& kept);
  void drawEdgesAgain(const TraceScene& scene, EyeImage& image);

  RenderOptions options_;
  ShowImage show_;
  const ShadeKernels& kernels_;
  tbb::task_arena arena_;
  const VolumeFields& fields_;
  SolidCells cells_;
  Occupancy matter_;  ///< where ambient occlusion can occur
  OpacityTable opacity_;
  std::optional<GuideField> guides_;
  SurfacePaint paint_;
  MeshScene meshes_;
  std::vector<Inset> insets_;
  std::array<std::vector<OverlayPatch>, kOutputs> patches_;
  tbb::enumerable_thread_specific<std::unique_ptr<RayTracer>> tracers_{[] { return std::make_unique<RayTracer>(); }};
  TraceScene in_glass_;  ///< of the eye that is drawn
  std::array<RenderedEye, kEyes> eyes_;
  Enlarger enlarger_;
  std::array<Image, kOutputs> outputs_;
};

void CpuSceneRenderer::prepare(const Frame& frame, const FieldChanges& changes) {
  const EyeBlock any_eye = eyeBlock(frame, eyeView(frame.rig, Eye::cyclopean));
  arena_.execute([&] {
    // Both views skip the same bricks, since the ramp begins at the surface or above.
    for (const VoxelBox& cells : changes.ambient) matter_.touch(cells);
    matter_.refresh();
    for (const VoxelBox& box : changes.solid) cells_.touch(box);
    cells_.refresh();
    if (changes.solid.empty()) cells_.rebuildIfStale();
    meshes_.place(placementsIn(frame),
                  {glm::vec3(any_eye.window_eye_P), glm::vec3(any_eye.window_site_P), any_eye.window_site_P.w},
                  softBlock(frame.marks));
  });
}

TraceScene CpuSceneRenderer::sceneFor(const Frame& frame, Eye eye) {
  const EyeView view = eyeView(frame.rig, eye);
  TraceScene scene = sceneOf(frame, eyeBlock(frame, view));
  if (const std::optional<EyeBlock> there = reflectedEyeBlock(frame, view)) {
    in_glass_ = sceneOf(frame, *there);
    scene.reflected = &in_glass_;
  }
  return scene;
}

TraceScene CpuSceneRenderer::sceneOf(const Frame& frame, const EyeBlock& eye) {
  const assets::VolumeGrid& grid = fields_.grid();
  TraceScene scene;
  scene.meshes = &meshes_;
  scene.cells = &cells_;
  scene.kernels = &kernels_;
  ShadeScene& shade = scene.shade;
  shade.eye = eye;
  shade.tool = toolBlock(frame);
  shade.soft = softBlock(frame.marks);
  shade.right_axis_P = glm::normalize(glm::vec3(shade.eye.right_edge_P));
  const glm::vec3 window = glm::vec3(shade.eye.window_site_P) - glm::vec3(shade.eye.window_eye_P);
  shade.window_reach_mm = glm::length(window);
  shade.window_axis_P = window / std::max(shade.window_reach_mm, 1e-6f);
  shade.origin_P = glm::vec3(grid.origin_P_mm);
  shade.spacing_mm = static_cast<float>(grid.spacing_mm);
  shade.voxels = grid.size;
  shade.smooth = viewOf(fields_.smooth());
  shade.ambient = viewOf(fields_.ambient());
  shade.appearance = viewOf(fields_.appearance());
  shade.matter_distance = {.border = matter_.emptiness().data(),
                           .row = matter_.bricks().x,
                           .slice = matter_.bricks().x * matter_.bricks().y,
                           .size = matter_.bricks()};
  if (guides_) {
    shade.guides = viewOf(*guides_);
    shade.visible_guides = visibleGuides(frame);
  }
  if (frame.paint != nullptr && paint_.texels.layout().size.x > 0) {
    shade.paint = viewOf(paint_.texels);
    shade.paint_low = paint_.low;
  }
  shade.ambient_occlusion = frame.quality.ambient_occlusion;
  shade.lamp_shadow = frame.quality.lamp_shadow;
  scene.cast = {.eye_index = (glm::vec3(shade.eye.eye_P) - shade.origin_P) / shade.spacing_mm,
                .spacing_mm = shade.spacing_mm,
                .step = static_cast<float>(frame.quality.step_voxels),
                .skip_empty_space = options_.skip_empty_space};
  if (isTranslucent(frame.mode)) {
    opacity_ = opacityTable(transferOf(frame.mode), scene.cast.step * shade.spacing_mm);
    scene.opacity = &opacity_;
    scene.label = &fields_.label();
  }
  return scene;
}

void CpuSceneRenderer::drawEye(const Frame& frame, Eye eye, glm::ivec2 px) {
  RenderedEye& to = drawn(eye);
  to.image.resize(px);
  to.is_enlarged = false;
  to.edges = frame.quality.smooth_enlarged_edges ? Enlarger::Edges::smooth : Enlarger::Edges::even;
  const TraceScene scene = sceneFor(frame, eye);
  to.image.seen_mm.resize(scene.reflected != nullptr ? to.image.distance_mm.size() : 0);
  arena_.execute([&] {
    draw(scene, options_.samples, to.image, options_.samples == 1 ? &to.hitsOf(px) : nullptr);
    if (options_.samples == 1 && frame.quality.antialias == Antialias::edges) drawEdgesAgain(scene, to.image);
  });
  for (const Inset& inset : insets_) blendOver(inset, to.image);
}

void CpuSceneRenderer::draw(const TraceScene& scene, int samples, EyeImage& image, KeptHits* static_hits) {
  const int edge = kTile / samples;
  const glm::ivec2 tiles = (image.px + edge - 1) / edge;
  bool static_hits_valid = false;
  if (static_hits != nullptr) {
    const EyeBlock& eye = scene.shade.eye;
    const std::array view{eye.eye_P, eye.lower_left_P, eye.right_edge_P, eye.up_edge_P};
    static_hits_valid =
        static_hits->revision == meshes_.staticRevision() && static_hits->px == image.px && static_hits->view == view;
    static_hits->view = view;
    static_hits->px = image.px;
    static_hits->revision = meshes_.staticRevision();
    const std::size_t count = static_cast<std::size_t>(tiles.x) * static_cast<std::size_t>(tiles.y);
    static_hits->tiles.resize(count);
    static_hits->veil_tiles.resize(meshes_.hasVeil() ? count : 0);
  }
  tbb::parallel_for(0, tiles.x * tiles.y, [&](int tile) {
    const glm::ivec2 first = edge * glm::ivec2(tile % tiles.x, tile / tiles.x);
    StaticHits kept;
    if (static_hits != nullptr) {
      kept = {.opaque = &static_hits->tiles[static_cast<std::size_t>(tile)], .are_valid = static_hits_valid};
      if (meshes_.hasVeil()) kept.veil = &static_hits->veil_tiles[static_cast<std::size_t>(tile)];
    }
    drawTile(scene, samples, first, glm::min(first + edge, image.px), *tracers_.local(), image, kept);
  });
}

// Pixels in [first, end), each the mean of samples x samples rays on a regular grid.
void CpuSceneRenderer::drawTile(const TraceScene& scene, int samples, glm::ivec2 first, glm::ivec2 end,
                                RayTracer& tracer, EyeImage& image, const StaticHits& kept) {
  const glm::ivec2 rays = samples * (end - first), from = samples * first, all = samples * image.px;
  int n = 0;
  std::array<std::uint16_t, RayTracer::kMaxRays> pixel;
  for (int by = 0; by < rays.y; by += kBlock)
    for (int bx = 0; bx < rays.x; bx += kBlock)
      for (int y = by; y < std::min(by + kBlock, rays.y); ++y)
        for (int x = bx; x < std::min(bx + kBlock, rays.x); ++x, ++n) {
          tracer.uv_x[n] = (static_cast<float>(from.x + x) + 0.5f) / static_cast<float>(all.x);
          tracer.uv_y[n] = (static_cast<float>(all.y - 1 - (from.y + y)) + 0.5f) / static_cast<float>(all.y);
          pixel[static_cast<std::size_t>(n)] = static_cast<std::uint16_t>((y / samples) * kTile + x / samples);
        }
  tracer.trace(scene, n, kept);

  for (int y = first.y; y < end.y; ++y)
    for (std::vector<float>* plane : {&image.r, &image.g, &image.b})
      std::fill_n(&(*plane)[image.at(first.x, y)], end.x - first.x, 0.0f);
  const float share = 1.0f / static_cast<float>(samples * samples);
  for (int i = 0; i < n; ++i) {
    const int p = pixel[static_cast<std::size_t>(i)];
    const std::size_t at = image.at(first.x + p % kTile, first.y + p / kTile);
    image.r[at] += share * tracer.r[i], image.g[at] += share * tracer.g[i], image.b[at] += share * tracer.b[i];
    image.distance_mm[at] = tracer.distance_mm[i];
    if (!image.seen_mm.empty()) image.seen_mm[at] = tracer.seen_mm()[i];
  }
}

// Finds the edges in bands of rows and draws them again in batches.
void CpuSceneRenderer::drawEdgesAgain(const TraceScene& scene, EyeImage& image) {
  constexpr int kSamples = EDGE_SAMPLES * EDGE_SAMPLES;
  constexpr std::size_t kPixels = RayTracer::kMaxRays / kSamples;
  const int bands = (image.px.y + kTile - 1) / kTile;
  tbb::parallel_for(0, bands, [&](int band) {
    std::vector<std::uint32_t> edges;
    findEdges(image, band * kTile, std::min((band + 1) * kTile, image.px.y), edges);
    RayTracer& tracer = *tracers_.local();
    for (std::size_t first = 0; first < edges.size(); first += kPixels) {
      const std::size_t count = std::min(kPixels, edges.size() - first);
      int n = 0;
      for (std::size_t e = first; e < first + count; ++e)
        for (int s = 0; s < kSamples; ++s, ++n) {
          const glm::ivec2 px = edgePixel(edges[e]);
          const float x = static_cast<float>(px.x) + 0.25f + 0.5f * static_cast<float>(s % EDGE_SAMPLES);
          const float y =
              static_cast<float>(image.px.y - 1 - px.y) + 0.25f + 0.5f * static_cast<float>(s / EDGE_SAMPLES);
          tracer.uv_x[n] = x / static_cast<float>(image.px.x);
          tracer.uv_y[n] = y / static_cast<float>(image.px.y);
        }
      tracer.trace(scene, n);
      for (std::size_t e = 0; e < count; ++e) {
        const glm::ivec2 px = edgePixel(edges[first + e]);
        const std::size_t at = image.at(px.x, px.y);
        const auto mean = [&](const float* of) {
          const float* const from = of + kSamples * e;
          return 0.25f * (from[0] + from[1] + from[2] + from[3]);
        };
        image.r[at] = mean(tracer.r), image.g[at] = mean(tracer.g), image.b[at] = mean(tracer.b);
      }
    }
  });
}

void CpuSceneRenderer::compose(const StereoLayout& layout, Eye left, Eye right, int output) {
  Image& to = outputs_[static_cast<std::size_t>(output)];
  const glm::ivec2 full_px = eyeImageSize(layout.mode, layout.screen_px);
  arena_.execute([&] {
    const auto whole = [&](RenderedEye& eye) -> const EyeImage& {
      if (eye.image.px == full_px) return eye.image;
      if (!eye.is_enlarged || eye.enlarged.px != full_px)
        enlarger_.enlarge(eye.image, full_px, eye.enlarged, eye.edges);
      eye.is_enlarged = true;
      return eye.enlarged;
    };
    const EyeImage& of_left = whole(drawn(left));
    render::compose(layout, of_left, left == right ? of_left : whole(drawn(right)), kernels_, to);
  });
  for (const OverlayPatch& patch : patches_[static_cast<std::size_t>(output)]) blendOver(patch, to);
}

DistanceImage CpuSceneRenderer::readDistance(const Frame& frame, Eye eye) {
  const EyeImage* image = &drawn(eye).image;
  EyeImage centred;
  if (options_.samples > 1) {
    // Samples do not lie at the pixel centre, where the distance is wanted: draw once more with one sample.
    centred.resize(image->px);
    const TraceScene scene = sceneFor(frame, eye);
    arena_.execute([&] { draw(scene, 1, centred, nullptr); });
    image = &centred;
  }
  const auto count = static_cast<std::ptrdiff_t>(image->px.x) * image->px.y;
  return {image->px.x, image->px.y, {image->distance_mm.begin(), image->distance_mm.begin() + count}};
}

}  // namespace

std::unique_ptr<SceneRenderer> cpuSceneRenderer(const VolumeFields& fields, const RenderOptions& options,
                                                ShowImage show) {
  return std::make_unique<CpuSceneRenderer>(fields, options, std::move(show));
}

}  // namespace render
