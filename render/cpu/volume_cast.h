// Where the rays of a batch meet the volume, on the CPU: the surface (castSurface) or all that shows of it when it is
// translucent (castTranslucent). The twin of shaders/ray_cast.glsl: samples at t = k · step from the entry, six
// bisections. Empty space is passed in three ways that never pass a sample that would count: a beam around up to 64
// rays at once, then every ray by itself, by the distances of SolidCells. Tests compare with `skip_empty_space` off,
// bit for bit. Compiled for each instruction set (volume_cast_body.h); the machine's best is chosen. Lengths in voxels.
// Any thread, many at once; no allocation once the output has grown. About 0.1 us per ray.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "assets/instruction_set.h"
#include "render/cpu/mesh_points.h"
#include "render/cpu/solid_cells.h"

namespace render {

/// Places on the rays of a batch, to be shaded. castSurface: at most one per ray, in the order of the rays.
/// castTranslucent: of each ray from front to back, rays in no order; the light of a ray is the sum of weight · light
/// of its places.
struct VolumePoints {
  int count = 0;
  std::vector<std::int32_t> ray;  ///< which of the batch
  std::vector<float> length;      ///< from the eye, voxels
  std::vector<float> weight;      ///< 1 for a surface

  void clear() { count = 0; }
  /// Makes every array long enough for `more` further points and the kernels' padding.
  void makeRoom(int more) {
    const auto wanted = static_cast<std::size_t>(count + more + kLanePadding);
    if (ray.size() >= wanted) return;
    ray.resize(wanted + wanted / 2);
    length.resize(ray.size());
    weight.resize(ray.size());
  }
};

/// Of each ray of a batch.
struct RaySums {
  alignas(64) std::array<float, RayBatch::kMaxRays> opacity{};  ///< the weights' sum
  alignas(64) std::array<float, RayBatch::kMaxRays> reach{};    ///< voxels to where it passes one half; negative: never
};

/// The opacity of one step for every tissue and share of the ramp, as castTranslucent reads it.
struct OpacityTable {
  static constexpr int kIntervals = 256;
  int labels = 0;
  float ramp_start = 0.5f;  ///< solid fraction, at least one half
  float ramp_per_solid = 1.0f;
  std::vector<float> of_step;  ///< kIntervals + 1 for every label
};

/// alpha = 1 - (1 - a)^step of a = ramp(solid) · `per_mm` of the label; within 1e-4 by 256 intervals for a below 0.95.
OpacityTable opacityTable(float ramp_start, float ramp_full, std::span<const float> per_mm, float step_mm);

struct CastSettings {
  glm::vec3 eye_index{0.0f};  ///< the eye as a continuous voxel index
  float spacing_mm = 1.0f;
  float step = 0.5f;  ///< voxels
  bool skip_empty_space = true;
};

/// `limit_mm`: where each ray ends at the latest; as long as the count rounded up to kLanePadding.
void castSurface(const SolidCells& cells, const CastSettings& settings, const RayBatch& rays, const float* limit_mm,
                 VolumePoints& to, assets::InstructionSet set = assets::chosenInstructionSet());

/// Rays end where their opacity reaches 0.98. `label`: of the same grid.
void castTranslucent(const SolidCells& cells, const CastSettings& settings, const BorderedField<std::uint8_t>& label,
                     const OpacityTable& opacity, const RayBatch& rays, const float* limit_mm, VolumePoints& to,
                     RaySums& sums, assets::InstructionSet set = assets::chosenInstructionSet());

}  // namespace render
