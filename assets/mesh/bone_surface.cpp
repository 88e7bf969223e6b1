#include "assets/mesh/bone_surface.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cassert>

#include "assets/vertex_normals.h"

namespace assets {
namespace {

constexpr std::size_t kBricksATask = 16;  // minimum worth another core

template <class Work>
void forEachIndex(std::size_t count, const Work& work) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kBricksATask), [&](const auto& range) {
    for (std::size_t n = range.begin(); n != range.end(); ++n) work(n);
  });
}

}  // namespace

std::size_t BoneSurface::brickIndex(glm::ivec3 brick) const {
  const glm::ivec3 bricks = grid_.bricks();
  assert(glm::all(glm::greaterThanEqual(brick, glm::ivec3(0))) && glm::all(glm::lessThan(brick, bricks)));
  return indexIn(bricks, brick);
}

glm::ivec3 BoneSurface::brickOf(std::size_t index) const {
  const glm::ivec3 bricks = grid_.bricks();
  const auto n = static_cast<int>(index);
  return {n % bricks.x, n / bricks.x % bricks.y, n / bricks.x / bricks.y};
}

BoneSurface::BoneSurface(const SolidVoxels& solid) : grid_(solid.grid) {
  patches_.resize(countIn(grid_.bricks()));
  forEachIndex(patches_.size(), [&](std::size_t n) { patches_[n] = surfacePatch(solid, brickOf(n)); });
}

std::vector<glm::ivec3> BoneSurface::update(const SolidVoxels& solid, std::span<const glm::ivec3> changed) {
  assert(solid.grid == grid_);
  // A voxel is a corner of the cells that begin at it or one before along each axis.
  std::vector<std::size_t> touched;
  for (const glm::ivec3& brick : changed)
    for (int corner = 0; corner < 8; ++corner) {
      const glm::ivec3 before = brick - cornerOffset(corner);
      if (glm::all(glm::greaterThanEqual(before, glm::ivec3(0)))) touched.push_back(brickIndex(before));
    }
  std::ranges::sort(touched);
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());

  std::vector<char> had_triangles(touched.size());
  forEachIndex(touched.size(), [&](std::size_t n) {
    SurfacePatch& patch = patches_[touched[n]];
    had_triangles[n] = !patch.empty();
    patch = surfacePatch(solid, brickOf(touched[n]));
  });

  std::vector<glm::ivec3> rebuilt;
  for (std::size_t n = 0; n < touched.size(); ++n)
    if (had_triangles[n] || !patches_[touched[n]].empty()) rebuilt.push_back(brickOf(touched[n]));
  return rebuilt;
}

MeshPart BoneSurface::mergedMesh(std::string name) const {
  MeshPart part;
  part.name = std::move(name);

  // Each crossed lattice edge is one vertex, numbered in lattice order.
  std::vector<std::uint64_t> edges;
  for (const SurfacePatch& patch : patches_)
    edges.insert(edges.end(), patch.lattice_edge.begin(), patch.lattice_edge.end());
  tbb::parallel_sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());

  part.position_mm.resize(edges.size());
  for (const SurfacePatch& patch : patches_) {
    std::vector<std::uint32_t> number(patch.lattice_edge.size());
    for (std::size_t v = 0; v < number.size(); ++v) {
      number[v] = static_cast<std::uint32_t>(std::ranges::lower_bound(edges, patch.lattice_edge[v]) - edges.begin());
      part.position_mm[number[v]] = patch.position_P_mm[v];
    }
    for (const std::uint32_t v : patch.triangles) part.triangles.push_back(number[v]);
  }
  part.normal = vertexNormals(part.position_mm, part.triangles);
  return part;
}

}  // namespace assets
