// Casts the rays of a batch into the volume on the CPU: the surface (castSurface) or all translucent matter
// (castTranslucent). Twin of shaders/ray_cast.glsl: samples at t = k · step from the entry, six bisections.
// Empty space is skipped by beams of up to 64 rays, then by single rays, with the distances of SolidCells; never past a
// sample that would count, so the result equals `skip_empty_space` off bit for bit. Compiled per instruction set; the
// best available is chosen. Lengths in voxels. Any thread; allocates only while the output grows. About 0.1 us per ray.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "assets/instruction_set.h"
#include "render/cpu/mesh_points.h"
#include "render/cpu/solid_cells.h"
#include "render/volume/transfer_function.h"

namespace render {

/// Points on the rays of a batch, to be shaded. castSurface: at most one per ray, in the order of the rays.
/// castTranslucent: front to back for each ray, rays in no order; the light of a ray is the sum of weight · light.
struct VolumePoints {
  int count = 0;
  std::vector<std::int32_t> ray;  ///< index in the batch
  std::vector<float> length;      ///< from the eye, voxels
  std::vector<float> weight;      ///< 1 for a surface

  void clear() { count = 0; }
  /// Reserves `more` further points and the kernels' padding.
  void makeRoom(int more) {
    const auto wanted = static_cast<std::size_t>(count + more + kLanePadding);
    if (ray.size() >= wanted) return;
    ray.resize(wanted + wanted / 2);
    length.resize(ray.size());
    weight.resize(ray.size());
  }
};

/// Per ray of a batch.
struct RaySums {
  alignas(64) std::array<float, RayBatch::kMaxRays> opacity{};  ///< sum of the weights
  alignas(64) std::array<float, RayBatch::kMaxRays> reach{};  ///< voxels to where it exceeds one half; negative: never
};

/// The opacity of one step for every tissue and ramp value.
struct OpacityTable {
  static constexpr int kIntervals = 256;
  int labels = 0;
  float ramp_start = 0.5f;  ///< solid fraction, at least one half
  float ramp_per_solid = 1.0f;
  std::vector<float> of_step;  ///< kIntervals + 1 for every label
};

/// alpha = 1 - (1 - a)^step of a = opacityPerMm(label, ramp(solid)); error below 1e-4 for a below 0.95.
OpacityTable opacityTable(const Transfer& transfer, float step_mm);

struct CastSettings {
  glm::vec3 eye_index{0.0f};  ///< the eye as a continuous voxel index
  float spacing_mm = 1.0f;
  float step = 0.5f;  ///< voxels
  bool skip_empty_space = true;
};

/// `limit_mm`: largest distance per ray; as long as the count rounded up to kLanePadding.
void castSurface(const SolidCells& cells, const CastSettings& settings, const RayBatch& rays, const float* limit_mm,
                 VolumePoints& to, assets::InstructionSet set = assets::chosenInstructionSet());

/// Rays end where their opacity reaches 0.98. `label`: on the same grid.
void castTranslucent(const SolidCells& cells, const CastSettings& settings, const BorderedField<std::uint8_t>& label,
                     const OpacityTable& opacity, const RayBatch& rays, const float* limit_mm, VolumePoints& to,
                     RaySums& sums, assets::InstructionSet set = assets::chosenInstructionSet());

}  // namespace render
