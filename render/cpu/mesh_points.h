// Rays of one eye, and their hits on meshes as structures of arrays for the shading kernels. Frame P, mm. Plain data;
// one thread at a time. Allocates only until the working size is reached.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace render {

/// Kernels may read this many values beyond `count`.
inline constexpr int kLanePadding = 16;

/// Rays from one origin. Packets of 8 are traced together, so neighbours in the image should be neighbours here.
struct RayBatch {
  static constexpr int kMaxRays = 256;
  glm::vec3 origin_P{0.0f};
  int count = 0;
  alignas(64) float x[kMaxRays] = {}, y[kMaxRays] = {}, z[kMaxRays] = {};  ///< unit directions
  alignas(64) float near_mm[kMaxRays] = {}, far_mm[kMaxRays] = {};         ///< range in which a mesh can be hit
  alignas(64) float begin_mm[kMaxRays] = {};                               ///< where it begins: 0, or at a glass
};

/// The first mesh along every ray; attributes are looked up later, only where the hit is visible.
struct MeshHits {
  alignas(64) float distance_mm[RayBatch::kMaxRays + kLanePadding] = {};  ///< 0: none
  float u[RayBatch::kMaxRays] = {}, v[RayBatch::kMaxRays] = {};           ///< barycentric
  unsigned body[RayBatch::kMaxRays] = {}, part[RayBatch::kMaxRays] = {}, triangle[RayBatch::kMaxRays] = {};
  bool faces_eye[RayBatch::kMaxRays] = {};
};

/// Hits on meshes with the inputs of shading. Plain pointers, for the kernels.
struct MeshPoints {
  int count = 0;
  std::int32_t* ray = nullptr;                                   ///< index in the batch
  float* distance_mm = nullptr;                                  ///< from the eye
  float *nx = nullptr, *ny = nullptr, *nz = nullptr;             ///< interpolated, not normalised
  float *r = nullptr, *g = nullptr, *b = nullptr, *a = nullptr;  ///< material times vertex colour, linear; opacity
  float *roughness = nullptr, *metallic = nullptr;
  float *qx = nullptr, *qy = nullptr, *qz = nullptr;  ///< of a piece of tooth alone: the point in Q
  float *mx = nullptr, *my = nullptr, *mz = nullptr;  ///< likewise, the normal
  std::int32_t* finish = nullptr;                     ///< FINISH_…
  std::int32_t* is_cut = nullptr;                     ///< 1: cut by the face window
  std::int32_t* faces_eye = nullptr;                  ///< 1: front face

  MeshPoints() = default;
  MeshPoints(MeshPoints&&) = default;
  MeshPoints& operator=(MeshPoints&&) = default;

  void clear() { count = 0; }
  /// Reserves `more` further points and the kernels' padding.
  void makeRoom(int more);

 private:
  std::vector<float> values_;
  std::vector<std::int32_t> integers_;
  std::size_t room_ = 0;
};

}  // namespace render
