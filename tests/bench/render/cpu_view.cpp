#include "tests/bench/render/cpu_view.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <thread>

#include "render/cpu/shade_kernels.h"
#include "render/eye_block.h"
#include "tests/bench/render/headlight.h"
#include "tests/bench/render/synthetic_head.h"

namespace bench {
namespace {

constexpr int kTile = 16;

/// Places of a tile's rays: blocks of 8x8 px, in them packets of 4x2.
constexpr std::array<glm::u8vec2, kTile* kTile> kOrder = [] {
  std::array<glm::u8vec2, kTile * kTile> order{};
  for (unsigned n = 0; n < order.size(); ++n) {
    const unsigned block = n / 64, packet = n / 8 % 8, lane = n % 8;
    order[n].x = static_cast<std::uint8_t>(block % 2 * 8 + packet / 4 * 4 + lane % 4);
    order[n].y = static_cast<std::uint8_t>(block / 2 * 8 + packet % 4 * 2 + lane / 4);
  }
  return order;
}();

/// One tissue: the ramp runs from the surface to full opacity.
render::OpacityTable opacityOf(float step) {
  render::OpacityTable table;
  table.labels = 1;
  table.ramp_start = 0.5f;
  table.ramp_per_solid = 2000.0f / static_cast<float>(kOpaqueFrom_HU - kSurface_HU);
  for (int n = 0; n <= render::OpacityTable::kIntervals; ++n) {
    const double hu = std::lerp(kSurface_HU, kOpaqueFrom_HU, static_cast<double>(n) / render::OpacityTable::kIntervals);
    table.of_step.push_back(static_cast<float>(1.0 - std::pow(1.0 - opacityPerVoxel(hu), static_cast<double>(step))));
  }
  return table;
}

tbb::task_arena& arena() {
  static tbb::task_arena threads(std::max(1, static_cast<int>(std::thread::hardware_concurrency()) - 1), 1);
  return threads;
}

}  // namespace

CpuView::CpuView(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid)
    : fields_(grid, solid, {}), cells_(fields_.solid()) {}

void CpuView::prepare() {
  for (const render::VoxelBox& box : fields_.prepare().solid) cells_.touch(box);
  cells_.refresh();
}

void CpuView::draw(const render::Camera& camera, render::Eye eye, render::ViewMode mode, Image& image) const {
  const assets::VolumeGrid& grid = fields_.grid();
  render::Frame frame;
  frame.rig = render::cameraRig(camera, image.px);
  const render::EyeBlock block = render::eyeBlock(frame, render::eyeView(frame.rig, eye));
  const auto pixels = static_cast<std::size_t>(image.px.x) * static_cast<std::size_t>(image.px.y);
  image.r.resize(pixels);
  image.g.resize(pixels);
  image.b.resize(pixels);
  render::CastSettings settings;
  settings.eye_index = glm::vec3(grid.indexFromPoint(glm::dvec3(glm::vec3(block.eye_P))));
  settings.spacing_mm = static_cast<float>(grid.spacing_mm);
  settings.skip_empty_space = skip_empty_space;
  const render::OpacityTable opacity = opacityOf(settings.step);
  const render::ShadeKernels& kernels = render::shadeKernels(set);
  const auto& smooth = fields_.smooth();

  const int across = (image.px.x + kTile - 1) / kTile, down = (image.px.y + kTile - 1) / kTile;
  arena().execute([&] {
    tbb::parallel_for(0, across * down, [&](int tile) {
      thread_local render::RayBatch rays;
      thread_local render::VolumePoints points;
      thread_local render::RaySums sums;
      alignas(64) std::array<float, render::RayBatch::kMaxRays> uv_x, uv_y, limit_mm, r{}, g{}, b{};
      const int left = tile % across * kTile, low = tile / across * kTile;
      for (std::size_t n = 0; n < kOrder.size(); ++n) {
        uv_x[n] = (static_cast<float>(left + kOrder[n].x) + 0.5f) / static_cast<float>(image.px.x);
        uv_y[n] = (static_cast<float>(low + kOrder[n].y) + 0.5f) / static_cast<float>(image.px.y);
      }
      limit_mm.fill(1e9f);
      rays.origin_P = glm::vec3(block.eye_P);
      rays.count = render::RayBatch::kMaxRays;
      kernels.aim(block, uv_x.data(), uv_y.data(), rays);

      points.clear();
      if (mode == render::ViewMode::iso)
        render::castSurface(cells_, settings, rays, limit_mm.data(), points, set);
      else
        render::castTranslucent(cells_, settings, fields_.label(), opacity, rays, limit_mm.data(), points, sums, set);
      HeadlightJob job{};
      job.smooth = smooth.at(glm::ivec3(-1));
      job.appearance = fields_.appearance().at(glm::ivec3(-1));
      job.row = static_cast<std::int32_t>(smooth.layout().row);
      job.slice = static_cast<std::int32_t>(smooth.layout().slice);
      for (int a = 0; a < 3; ++a) job.eye[a] = settings.eye_index[a];
      job.x = &rays.x[0];
      job.y = &rays.y[0];
      job.z = &rays.z[0];
      job.ray = points.ray.data();
      job.length = points.length.data();
      job.weight = points.weight.data();
      job.count = points.count;
      job.r = r.data();
      job.g = g.data();
      job.b = b.data();
      headlight(job, set);

      for (std::size_t n = 0; n < kOrder.size(); ++n) {
        const int x = left + kOrder[n].x, y = low + kOrder[n].y;
        if (x >= image.px.x || y >= image.px.y) continue;
        const auto at =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(image.px.x) + static_cast<std::size_t>(x);
        image.r[at] = r[n];
        image.g[at] = g[n];
        image.b[at] = b[n];
      }
    });
  });
}

}  // namespace bench
