// Rays of one eye and the places where they meet meshes, as structures of arrays that the shading kernels read many at
// a time. Frame P, mm. Plain data; one thread at a time. Nothing here allocates once it has grown to its working size.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace render {

/// Kernels may read this many values beyond `count`.
inline constexpr int kLanePadding = 16;

/// Rays from one place. Neighbours in the picture should be neighbours here: packets of 8 are traced together.
struct RayBatch {
  static constexpr int kMost = 256;
  glm::vec3 origin_P{0.0f};
  int count = 0;
  alignas(64) std::array<float, kMost> x{}, y{}, z{};        ///< unit directions
  alignas(64) std::array<float, kMost> near_mm{}, far_mm{};  ///< between which a mesh can be met
};

/// Places on meshes with what is needed to shade them.
struct MeshPoints {
  int count = 0;
  std::vector<std::int32_t> ray;   ///< which of the batch
  std::vector<float> distance_mm;  ///< from the eye
  std::vector<float> nx, ny, nz;   ///< interpolated normal as the mesh has it, not of unit length
  std::vector<float> r, g, b, a;   ///< material times vertex colour, linear; opacity
  std::vector<float> roughness, metallic;
  std::vector<std::int32_t> finish;     ///< FINISH_…
  std::vector<std::int32_t> is_cut;     ///< 1 where the window in the face cuts
  std::vector<std::int32_t> faces_eye;  ///< 1 where the outside is seen

  void clear() { count = 0; }
  /// Makes every array long enough for `more` further points and the kernels' padding.
  void makeRoom(int more) {
    const auto wanted = static_cast<std::size_t>(count + more + kLanePadding);
    if (ray.size() >= wanted) return;
    const std::size_t size = wanted + wanted / 2;
    for (std::vector<float>* values : {&distance_mm, &nx, &ny, &nz, &r, &g, &b, &a, &roughness, &metallic})
      values->resize(size, 0.0f);
    for (std::vector<std::int32_t>* values : {&ray, &finish, &is_cut, &faces_eye}) values->resize(size, 0);
  }
};

}  // namespace render
