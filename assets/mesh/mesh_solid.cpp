#include "assets/mesh/mesh_solid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <tuple>

#include "assets/load_error.h"

namespace assets {
namespace {

constexpr int kRays = 3;                           ///< along each edge of a voxel
constexpr std::uint64_t kMostTests = 400'000'000;  ///< of a ray with a face: seconds

/// Numbers of the corners, the same for one place.
std::vector<std::array<std::uint32_t, 3>> numbered(std::span<const StlTriangle> mesh) {
  using Place = std::tuple<double, double, double>;
  std::vector<std::pair<Place, std::size_t>> corners;
  corners.reserve(3 * mesh.size());
  for (std::size_t t = 0; t < mesh.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c) {
      const glm::dvec3 p = mesh[t][c] + 0.0;  // one zero
      corners.emplace_back(Place(p.x, p.y, p.z), 3 * t + c);
    }
  std::ranges::sort(corners);
  std::vector<std::array<std::uint32_t, 3>> faces(mesh.size());
  std::uint32_t number = 0;
  for (std::size_t n = 0; n < corners.size(); ++n) {
    if (n > 0 && corners[n].first != corners[n - 1].first) ++number;
    faces[corners[n].second / 3][corners[n].second % 3] = number;
  }
  return faces;
}

/// On which side of the line from a to b a ray passes: the same answer for b to a, turned round.
bool isLeft(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec2& ray) {
  const bool is_turned = std::tie(b.y, b.z) < std::tie(a.y, a.z);
  const glm::dvec3 &from = is_turned ? b : a, &to = is_turned ? a : b;
  const double side = (to.y - from.y) * (ray.y - from.z) - (to.z - from.z) * (ray.x - from.y);
  return (side >= 0.0) != is_turned;
}

struct Crossing {
  std::uint32_t row;
  float x;  ///< index of the grid
  int way;
  bool operator<(const Crossing& other) const { return std::tie(row, x) < std::tie(other.row, other.x); }
};

/// Where rays meet the mesh.
std::vector<Crossing> crossingsOf(std::span<const StlTriangle> mesh, const VolumeGrid& grid) {
  std::vector<Crossing> crossings;
  const glm::ivec2 rays = kRays * glm::ivec2(grid.size.y, grid.size.z);
  // Rays lie evenly in their voxels: ray n at (n + 1/2) / kRays - 1/2.
  const auto first = [](double low, int most) {
    return static_cast<int>(std::clamp(std::ceil((low + 0.5) * kRays - 0.5), 0.0, static_cast<double>(most)));
  };
  std::uint64_t tests = 0;
  const auto place = [](int ray) { return (ray + 0.5) / kRays - 0.5; };
  for (const StlTriangle& triangle : mesh) {
    StlTriangle at;
    for (std::size_t c = 0; c < 3; ++c) at[c] = grid.indexFromPoint(triangle[c]);
    const auto [low_y, high_y] = std::minmax({at[0].y, at[1].y, at[2].y});
    const auto [low_z, high_z] = std::minmax({at[0].z, at[1].z, at[2].z});
    const glm::dvec3 normal = glm::cross(at[1] - at[0], at[2] - at[0]);
    if (normal.x == 0.0) continue;
    const int from_k = first(low_z, rays.y), from_j = first(low_y, rays.x);
    tests += static_cast<std::uint64_t>(std::max(0, first(high_z, rays.y) - from_k)) *
             static_cast<std::uint64_t>(std::max(0, first(high_y, rays.x) - from_j));
    if (tests > kMostTests) throw LoadError("its faces are too large and too many to be filled");
    for (int k = from_k; k < rays.y && place(k) <= high_z; ++k)
      for (int j = from_j; j < rays.x && place(j) <= high_y; ++j) {
        const glm::dvec2 ray(place(j), place(k));
        const bool left = isLeft(at[0], at[1], ray);
        if (isLeft(at[1], at[2], ray) != left || isLeft(at[2], at[0], ray) != left) continue;
        const double x = at[0].x - (normal.y * (ray.x - at[0].y) + normal.z * (ray.y - at[0].z)) / normal.x;
        crossings.push_back({static_cast<std::uint32_t>(k * rays.x + j),
                             static_cast<float>(std::clamp(x, -1.0, static_cast<double>(grid.size.x))), left ? 1 : -1});
      }
  }
  std::ranges::sort(crossings, std::less<>{});
  return crossings;
}

}  // namespace

std::size_t openEdges(std::span<const StlTriangle> mesh) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  edges.reserve(3 * mesh.size());
  for (const auto& face : numbered(mesh)) {
    if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) continue;
    for (std::size_t c = 0; c < 3; ++c) edges.emplace_back(face[c], face[(c + 1) % 3]);
  }
  std::ranges::sort(edges);
  std::size_t open = 0;
  for (std::size_t n = 0; n < edges.size();) {
    std::size_t end = n;
    while (end < edges.size() && edges[end] == edges[n]) ++end;
    const std::pair back(edges[n].second, edges[n].first);
    const auto [low, high] = std::ranges::equal_range(edges, back);
    const auto forth = static_cast<std::ptrdiff_t>(end - n);
    if (high - low < forth) open += static_cast<std::size_t>(forth - (high - low));
    n = end;
  }
  return open;
}

std::vector<std::uint8_t> solidOfMesh(std::span<const StlTriangle> mesh, const VolumeGrid& grid) {
  const std::vector<Crossing> crossings = crossingsOf(mesh, grid);
  std::vector<float> share(grid.voxelCount());
  const auto rays = static_cast<std::uint32_t>(kRays * grid.size.y);
  const auto fill = [&](std::uint32_t row, double from, double to) {
    const int j = static_cast<int>(row % rays) / kRays, k = static_cast<int>(row / rays) / kRays;
    float* const voxels = &share[grid.index({0, j, k})];
    // Voxel i reaches from i - 1/2 to i + 1/2.
    const double low = std::clamp(from + 0.5, 0.0, static_cast<double>(grid.size.x));
    const double high = std::clamp(to + 0.5, 0.0, static_cast<double>(grid.size.x));
    for (int i = static_cast<int>(low); i < grid.size.x && i < high; ++i)
      voxels[i] += static_cast<float>(std::min(high, i + 1.0) - std::max(low, static_cast<double>(i)));
  };
  for (std::size_t n = 0; n < crossings.size();) {
    const std::uint32_t row = crossings[n].row;
    int inside = 0;
    for (; n < crossings.size() && crossings[n].row == row; ++n) {
      inside += crossings[n].way;
      const bool goes_on = n + 1 < crossings.size() && crossings[n + 1].row == row;
      if (inside != 0 && goes_on)
        fill(row, static_cast<double>(crossings[n].x), static_cast<double>(crossings[n + 1].x));
    }
  }
  std::vector<std::uint8_t> solid(share.size());
  std::ranges::transform(share, solid.begin(), [](float sum) {
    return static_cast<std::uint8_t>(255.0f * std::min(1.0f, sum / (kRays * kRays)) + 0.5f);
  });
  return solid;
}

}  // namespace assets
