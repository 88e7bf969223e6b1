#include "render/cpu/volume_cast.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "render/cpu/volume_cast_kernels.h"

namespace render {
namespace {

void makeRoom(CastJob& job) {
  VolumePoints& to = *static_cast<VolumePoints*>(job.owner);
  to.count = job.points;
  to.makeRoom(kLanePadding);
  job.capacity = static_cast<std::int32_t>(to.ray.size());
  job.ray = to.ray.data();
  job.length = to.length.data();
  job.weight = to.weight.data();
}

CastJob jobOf(const SolidCells& cells, const CastSettings& settings, const RayBatch& rays, const float* limit_mm,
              VolumePoints& to) {
  CastJob job{};
  const FieldLayout& layout = cells.solid().layout();
  job.words = cells.words();
  job.table = cells.table();
  job.solid = cells.solid().at(glm::ivec3(-1));
  job.row = static_cast<std::int32_t>(layout.row);
  job.slice = static_cast<std::int32_t>(layout.slice);
  for (int a = 0; a < 3; ++a) {
    job.bricks[a] = cells.bricks()[a];
    job.size[a] = static_cast<float>(layout.size[a]);
    job.eye[a] = settings.eye_index[a] + static_cast<float>(SolidCells::kEdge);
  }
  job.x = &rays.x[0];
  job.y = &rays.y[0];
  job.z = &rays.z[0];
  job.begin_mm = &rays.begin_mm[0];
  job.limit_mm = limit_mm;
  job.count = rays.count;
  job.voxels_per_mm = 1.0f / settings.spacing_mm;
  job.step = settings.step;
  job.skip = settings.skip_empty_space;
  job.room = makeRoom;
  job.owner = &to;
  job.points = to.count;
  makeRoom(job);
  return job;
}

const CastKernels& kernels(assets::InstructionSet set) {
  assert(assets::available(set));
  static constexpr std::array kKernels{&portable::kCastKernels, &avx2::kCastKernels, &avx512::kCastKernels};
  return *kKernels[static_cast<std::size_t>(set)];
}

}  // namespace

OpacityTable opacityTable(const Transfer& transfer, float step_mm) {
  OpacityTable table;
  table.ramp_start = kRampStart;
  table.ramp_per_solid = 1.0f / (transfer.full - kRampStart);
  table.labels = static_cast<int>(transfer.inner_per_mm.size());
  for (std::size_t label = 0; label < transfer.inner_per_mm.size(); ++label)
    for (int n = 0; n <= OpacityTable::kIntervals; ++n) {
      const double ramp = static_cast<double>(n) / OpacityTable::kIntervals;
      const double a =
          std::clamp(opacityPerMm(transfer.inner_per_mm[label], transfer.wall_per_mm[label], ramp), 0.0, 0.99999);
      table.of_step.push_back(static_cast<float>(1.0 - std::pow(1.0 - a, static_cast<double>(step_mm))));
    }
  return table;
}

void castSurface(const SolidCells& cells, const CastSettings& settings, const RayBatch& rays, const float* limit_mm,
                 VolumePoints& to, assets::InstructionSet set) {
  CastJob job = jobOf(cells, settings, rays, limit_mm, to);
  kernels(set).surface(job);
  to.count = job.points;
}

void castTranslucent(const SolidCells& cells, const CastSettings& settings, const BorderedField<std::uint8_t>& label,
                     const OpacityTable& opacity, const RayBatch& rays, const float* limit_mm, VolumePoints& to,
                     RaySums& sums, assets::InstructionSet set) {
  CastJob job = jobOf(cells, settings, rays, limit_mm, to);
  job.label = label.at(glm::ivec3(-1));
  job.opacity = opacity.of_step.data();
  job.last_label = opacity.labels - 1;
  job.ramp_start = opacity.ramp_start;
  job.ramp_per_solid = opacity.ramp_per_solid;
  job.sum = sums.opacity.data();
  job.reach = sums.reach.data();
  kernels(set).translucent(job);
  to.count = job.points;
}

}  // namespace render
