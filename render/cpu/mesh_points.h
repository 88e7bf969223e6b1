// Rays of one eye and the places where they meet meshes, as structures of arrays that the shading kernels read many at
// a time. Frame P, mm. Plain data; one thread at a time. Nothing here allocates once it has grown to its working size.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace render {

/// Kernels may read this many values beyond `count`.
inline constexpr int kLanePadding = 16;

/// Rays from one place. Neighbours in the image should be neighbours here: packets of 8 are traced together.
struct RayBatch {
  static constexpr int kMaxRays = 256;
  glm::vec3 origin_P{0.0f};
  int count = 0;
  alignas(64) float x[kMaxRays] = {}, y[kMaxRays] = {}, z[kMaxRays] = {};  ///< unit directions
  alignas(64) float near_mm[kMaxRays] = {}, far_mm[kMaxRays] = {};         ///< between which a mesh can be met
};

/// The first mesh along every ray of a batch, as it is found: attributes are looked up only where it is seen.
struct MeshHits {
  alignas(64) float distance_mm[RayBatch::kMaxRays + kLanePadding] = {};  ///< 0: none
  float u[RayBatch::kMaxRays] = {}, v[RayBatch::kMaxRays] = {};           ///< barycentric
  unsigned body[RayBatch::kMaxRays] = {}, part[RayBatch::kMaxRays] = {}, triangle[RayBatch::kMaxRays] = {};
  bool faces_eye[RayBatch::kMaxRays] = {};
};

/// Places on meshes with what is needed to shade them. Plain pointers, for the kernels.
struct MeshPoints {
  int count = 0;
  std::int32_t* ray = nullptr;                        ///< which of the batch
  float* distance_mm = nullptr;                       ///< from the eye
  float *nx = nullptr, *ny = nullptr, *nz = nullptr;  ///< interpolated normal as the mesh has it, not of unit length
  float *r = nullptr, *g = nullptr, *b = nullptr, *a = nullptr;  ///< material times vertex colour, linear; opacity
  float *roughness = nullptr, *metallic = nullptr;
  std::int32_t* finish = nullptr;     ///< FINISH_…
  std::int32_t* is_cut = nullptr;     ///< 1 where the window in the face cuts
  std::int32_t* faces_eye = nullptr;  ///< 1 where the outside is seen

  MeshPoints() = default;
  MeshPoints(MeshPoints&&) = default;
  MeshPoints& operator=(MeshPoints&&) = default;

  void clear() { count = 0; }
  /// Makes every array long enough for `more` further points and the kernels' padding.
  void makeRoom(int more);

 private:
  std::vector<float> values_;
  std::vector<std::int32_t> numbers_;
  std::size_t room_ = 0;
};

}  // namespace render
