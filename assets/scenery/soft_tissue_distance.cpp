#include "assets/scenery/soft_tissue_distance.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <limits>

namespace assets {
namespace {

using glm::dvec3;

/// Corners, and the outward pseudo-normals of face, edges (ab, bc, ca) and corners. Zero at an open edge.
struct SignedTriangle {
  dvec3 a, b, c, face;
  std::array<dvec3, 3> edge, corner;
};

struct Nearest {
  double square_mm2 = std::numeric_limits<double>::max();
  bool inside = false;
};

/// Ericson, Real-Time Collision Detection 5.1.5.
Nearest nearestOn(const SignedTriangle& t, const dvec3& p) {
  const auto result = [&](const dvec3& q, const dvec3& normal) {
    const dvec3 away = p - q;
    return Nearest{glm::dot(away, away), glm::dot(away, normal) < 0.0};
  };
  const dvec3 ab = t.b - t.a, ac = t.c - t.a, ap = p - t.a;
  const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
  if (d1 <= 0.0 && d2 <= 0.0) return result(t.a, t.corner[0]);
  const dvec3 bp = p - t.b;
  const double d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
  if (d3 >= 0.0 && d4 <= d3) return result(t.b, t.corner[1]);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return result(t.a + d1 / (d1 - d3) * ab, t.edge[0]);
  const dvec3 cp = p - t.c;
  const double d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
  if (d6 >= 0.0 && d5 <= d6) return result(t.c, t.corner[2]);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return result(t.a + d2 / (d2 - d6) * ac, t.edge[2]);
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0)
    return result(t.b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (t.c - t.b), t.edge[1]);
  const double scale = 1.0 / (va + vb + vc);
  return result(t.a + vb * scale * ab + vc * scale * ac, t.face);
}

/// The edge of a triangle that begins at its corner `side % 3`, side / 3 being the triangle.
struct Side {
  std::uint64_t edge;  ///< both vertices, whatever their order
  std::uint32_t side;
  auto operator<=>(const Side&) const = default;
};

std::uint64_t edgeOf(unsigned a, unsigned b) {
  return static_cast<std::uint64_t>(std::min(a, b)) << 32 | std::max(a, b);
}

std::vector<SignedTriangle> signedTriangles(const SoftTissueSurface& surface) {
  const std::size_t count = surface.triangles.size();
  std::vector<SignedTriangle> triangles(count);
  std::vector<dvec3> corner_sum(surface.position_P_mm.size(), dvec3(0.0));
  std::vector<bool> is_open(surface.position_P_mm.size());
  std::vector<Side> sides(3 * count);
  for (std::size_t n = 0; n < count; ++n) {
    const glm::uvec3 v = surface.triangles[n];
    SignedTriangle& t = triangles[n];
    const std::array<dvec3, 3> p = {surface.position_P_mm[v.x], surface.position_P_mm[v.y], surface.position_P_mm[v.z]};
    t.a = p[0], t.b = p[1], t.c = p[2];
    const dvec3 area = glm::cross(t.b - t.a, t.c - t.a);
    const double twice_mm2 = glm::length(area);
    t.face = twice_mm2 > 0.0 ? area / twice_mm2 : dvec3(0.0);
    for (std::size_t k = 0; k < 3; ++k) {
      const dvec3 to_next = p[(k + 1) % 3] - p[k], to_last = p[(k + 2) % 3] - p[k];
      const double angle = std::atan2(glm::length(glm::cross(to_next, to_last)), glm::dot(to_next, to_last));
      corner_sum[v[static_cast<int>(k)]] += angle * t.face;
      const auto side = static_cast<std::uint32_t>(3 * n + k);
      sides[side] = {edgeOf(v[static_cast<int>(k)], v[static_cast<int>((k + 1) % 3)]), side};
    }
  }
  // The sides of one edge, then the next edge.
  tbb::parallel_sort(sides.begin(), sides.end());
  for (auto first = sides.begin(); first != sides.end();) {
    const auto end = std::find_if(first, sides.end(), [&](const Side& side) { return side.edge != first->edge; });
    dvec3 sum(0.0);
    for (auto side = first; side != end; ++side) sum += triangles[side->side / 3].face;
    if (end - first == 1) {
      sum = dvec3(0.0);
      is_open[first->edge >> 32] = is_open[first->edge & 0xffffffffu] = true;
    }
    for (; first != end; ++first) triangles[first->side / 3].edge[first->side % 3] = sum;
  }
  for (std::size_t n = 0; n < count; ++n)
    for (std::size_t k = 0; k < 3; ++k) {
      const unsigned from = surface.triangles[n][static_cast<int>(k)];
      triangles[n].corner[k] = is_open[from] ? dvec3(0.0) : corner_sum[from];
    }
  return triangles;
}

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max(), kAsked = kNone - 1, kBeyond = kNone - 2;
constexpr double kDeepest_mm = 40.0;

/// The nearest triangle of every voxel within the field's reach of one surface: exact next to the triangles, then
/// handed on from neighbour to neighbour, each voxel taking the best of its neighbours' triangles.
class NearestTriangles {
 public:
  NearestTriangles(const VolumeGrid& grid, const std::vector<SignedTriangle>& triangles, const SoftTissueRegion& region)
      : grid_(grid), triangles_(triangles), owner_(grid.voxelCount(), kNone), best_(grid.voxelCount()) {
    forVoxels(grid_, [&](glm::ivec3 at, std::size_t voxel) {
      if (glm::distance(grid_.centre_P_mm(at), region.centre_P_mm) > region.reach_mm) owner_[voxel] = kBeyond;
    });
    seed();
    // Further inside than outside, so that no depth of a head counts as outside.
    const int outside = static_cast<int>(std::ceil(SoftTissueField::kOutside_mm / grid.spacing_mm));
    const int inside = static_cast<int>(std::ceil(kDeepest_mm / grid.spacing_mm));
    for (int layer = 0; layer < inside && !frontier_.empty(); ++layer) grow(layer, outside);
    askNeighboursAgain();
  }

  std::uint32_t owner(std::size_t voxel) const { return owner_[voxel]; }
  double distance_mm(std::size_t voxel) const {
    const double distance = std::sqrt(best_[voxel].square_mm2);
    return best_[voxel].inside ? -distance : distance;
  }

 private:
  /// Slabs of voxels in parallel, so that every voxel has one writer and the result is the same for any number of
  /// cores.
  void seed() {
    constexpr int kSlab = 8;
    const double near_mm = 1.05 * grid_.spacing_mm;  // more than half a voxel's diagonal
    const int slabs = (grid_.size.z + kSlab - 1) / kSlab;
    std::vector<std::vector<std::uint32_t>> in_slab(static_cast<std::size_t>(slabs));
    const auto box = [&](const SignedTriangle& t) {
      const glm::ivec3 low(glm::ceil(grid_.indexFromPoint(glm::min(t.a, glm::min(t.b, t.c)) - near_mm)));
      const glm::ivec3 high(glm::floor(grid_.indexFromPoint(glm::max(t.a, glm::max(t.b, t.c)) + near_mm)));
      return std::pair(glm::max(low, 0), glm::min(high, grid_.size - 1));
    };
    for (std::size_t n = 0; n < triangles_.size(); ++n) {
      const auto [low, high] = box(triangles_[n]);
      for (int slab = low.z / kSlab; slab <= high.z / kSlab && low.z <= high.z; ++slab)
        in_slab[static_cast<std::size_t>(slab)].push_back(static_cast<std::uint32_t>(n));
    }
    tbb::parallel_for(0, slabs, [&](int slab) {
      for (const std::uint32_t n : in_slab[static_cast<std::size_t>(slab)]) {
        auto [low, high] = box(triangles_[n]);
        low.z = std::max(low.z, slab * kSlab), high.z = std::min(high.z, slab * kSlab + kSlab - 1);
        forVoxels(low, high + 1, [&](glm::ivec3 at) { offer(at, n); });
      }
    });
    forVoxels(grid_, [&](glm::ivec3 at, std::size_t voxel) {
      if (owner_[voxel] < kBeyond) frontier_.push_back(at);
    });
  }

  void offer(glm::ivec3 at, std::uint32_t triangle) {
    const std::size_t voxel = grid_.index(at);
    if (owner_[voxel] == kBeyond) return;
    const Nearest found = nearestOn(triangles_[triangle], grid_.centre_P_mm(at));
    if (!(found.square_mm2 < best_[voxel].square_mm2)) return;
    best_[voxel] = found;
    owner_[voxel] = triangle;
  }

  /// One more layer of voxels around the last one. Beyond the reach only the sign is handed on, beside faces.
  void grow(int number, int outside) {
    const bool inside_only = number >= outside, by_faces = inside_only;
    std::vector<glm::ivec3> layer;
    for (const glm::ivec3& from : frontier_) {
      if (inside_only && !best_[grid_.index(from)].inside) continue;
      forVoxels(glm::max(from - 1, 0), glm::min(from + 2, grid_.size), [&](glm::ivec3 at) {
        const glm::ivec3 step = glm::abs(at - from);
        if (by_faces && step.x + step.y + step.z != 1) return;
        std::uint32_t& owner = owner_[grid_.index(at)];
        if (owner != kNone) return;
        owner = kAsked;
        layer.push_back(at);
      });
    }
    std::vector<std::uint32_t> owners(layer.size(), kNone);
    tbb::parallel_for(std::size_t{0}, layer.size(), [&](std::size_t n) {
      const glm::ivec3 at = layer[n];
      Nearest& best = best_[grid_.index(at)];
      std::array<std::uint32_t, 27> tried{};
      std::size_t tries = 0;
      forVoxels(glm::max(at - 1, 0), glm::min(at + 2, grid_.size), [&](glm::ivec3 beside) {
        const std::uint32_t triangle = owner_[grid_.index(beside)];
        const glm::ivec3 step = glm::abs(beside - at);
        if (by_faces && step.x + step.y + step.z != 1) return;
        if (triangle >= kBeyond || std::find(tried.begin(), tried.begin() + tries, triangle) != tried.begin() + tries)
          return;
        tried[tries++] = triangle;
        if (inside_only) {
          if (best_[grid_.index(beside)].inside) best = {kHandedOn_mm2, true}, owners[n] = triangle;
          return;
        }
        const Nearest found = nearestOn(triangles_[triangle], grid_.centre_P_mm(at));
        if (found.square_mm2 < best.square_mm2) best = found, owners[n] = triangle;
      });
    });
    for (std::size_t n = 0; n < layer.size(); ++n) owner_[grid_.index(layer[n])] = owners[n];
    frontier_ = std::move(layer);
  }

  /// A voxel's nearest triangle may belong to a neighbour that was reached later.
  void askNeighboursAgain() {
    std::vector<std::uint32_t> owners(owner_);
    tbb::parallel_for(0, grid_.size.z, [&](int k) {
      forVoxels(glm::ivec3(0, 0, k), glm::ivec3(grid_.size.x, grid_.size.y, k + 1), [&](glm::ivec3 at) {
        const std::size_t voxel = grid_.index(at);
        Nearest& best = best_[voxel];
        if (owner_[voxel] >= kBeyond || best.square_mm2 >= kHandedOn_mm2) return;
        std::uint32_t last = owner_[voxel];
        forVoxels(glm::max(at - 1, 0), glm::min(at + 2, grid_.size), [&](glm::ivec3 beside) {
          const std::uint32_t triangle = owner_[grid_.index(beside)];
          if (triangle >= kBeyond || triangle == owner_[voxel] || triangle == last) return;
          last = triangle;
          const Nearest found = nearestOn(triangles_[triangle], grid_.centre_P_mm(at));
          if (found.square_mm2 < best.square_mm2) best = found, owners[voxel] = triangle;
        });
      });
    });
    owner_ = std::move(owners);
  }

  static constexpr double kHandedOn_mm2 = 1e6;  ///< of a voxel deep inside: only its sign is known

  const VolumeGrid& grid_;
  const std::vector<SignedTriangle>& triangles_;
  std::vector<std::uint32_t> owner_;
  std::vector<Nearest> best_;
  std::vector<glm::ivec3> frontier_;  ///< the last layer
};

VolumeGrid gridAround(std::span<const SoftTissueSurface> surfaces, double spacing_mm) {
  dvec3 low(std::numeric_limits<double>::max()), high(-low);
  for (const SoftTissueSurface& surface : surfaces)
    for (const dvec3& p : surface.position_P_mm) low = glm::min(low, p), high = glm::max(high, p);
  if (!(low.x <= high.x)) return {};
  const double margin_mm = SoftTissueField::kOutside_mm + spacing_mm;
  return {glm::ivec3(glm::ceil((high - low + 2.0 * margin_mm) / spacing_mm)) + 1, spacing_mm, low - margin_mm};
}

}  // namespace

SoftTissueNearest nearestOf(const SoftTissueSurface& surface, const dvec3& p_P_mm) {
  const std::vector<SignedTriangle> triangles = signedTriangles(surface);
  SoftTissueNearest nearest;
  double best_mm2 = std::numeric_limits<double>::max();
  for (std::size_t n = 0; n < triangles.size(); ++n) {
    const Nearest found = nearestOn(triangles[n], p_P_mm);
    if (!(found.square_mm2 < best_mm2)) continue;
    best_mm2 = found.square_mm2;
    nearest = {found.inside ? -std::sqrt(best_mm2) : std::sqrt(best_mm2), surface.tissue[n]};
  }
  return nearest;
}

SoftTissueField softTissueField(std::span<const SoftTissueSurface> surfaces, const SoftTissueRegion& region,
                                double spacing_mm) {
  SoftTissueField field;
  field.grid = gridAround(surfaces, spacing_mm);
  const std::size_t voxels = field.grid.size.x > 0 ? field.grid.voxelCount() : 0;
  field.distance.assign(voxels, SoftTissueField::stored(SoftTissueField::kOutside_mm));
  field.tissue.assign(voxels, static_cast<std::uint8_t>(SoftTissue::none));
  for (const SoftTissueSurface& surface : surfaces) {
    const std::vector<SignedTriangle> triangles = signedTriangles(surface);
    const NearestTriangles nearest(field.grid, triangles, region);
    tbb::parallel_for(std::size_t{0}, voxels, [&](std::size_t voxel) {
      if (nearest.owner(voxel) >= kBeyond) return;
      const std::int16_t distance = SoftTissueField::stored(nearest.distance_mm(voxel));
      if (distance >= field.distance[voxel]) return;
      field.distance[voxel] = distance;
      field.tissue[voxel] = static_cast<std::uint8_t>(surface.tissue[nearest.owner(voxel)]);
    });
  }
  return field;
}

}  // namespace assets
