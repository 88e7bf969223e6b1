#include "assets/synthetic/surface_mesher.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/SignedFloodFill.h>
#include <openvdb/tools/VolumeToMesh.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>

namespace assets {
namespace {

using Leaf = openvdb::FloatTree::LeafNodeType;
constexpr int kLeafVoxels = static_cast<int>(Leaf::DIM);
constexpr double kBandVoxels = 3.0;
constexpr double kSteepest = 1.3;

// One leaf of the level set, or none far from the surface.
std::unique_ptr<Leaf> leafAt(const Distance& distance_mm, const openvdb::Coord& origin, double voxel_mm) {
  const double band_mm = kBandVoxels * voxel_mm;
  const auto point = [&](const openvdb::Coord& c) { return voxel_mm * glm::dvec3(c.x(), c.y(), c.z()); };
  const glm::dvec3 centre = point(origin) + glm::dvec3(voxel_mm * 0.5 * (kLeafVoxels - 1));
  const double reach_mm = kSteepest * 0.5 * std::sqrt(3.0) * kLeafVoxels * voxel_mm + band_mm;
  if (std::abs(distance_mm(centre)) > reach_mm) return nullptr;

  auto leaf = std::make_unique<Leaf>(origin, static_cast<float>(band_mm));
  bool any = false;
  for (openvdb::Index n = 0; n < Leaf::SIZE; ++n) {
    const double d = distance_mm(point(leaf->offsetToGlobalCoord(n)));
    leaf->setValueOnly(n, static_cast<float>(std::clamp(d, -band_mm, band_mm)));
    leaf->setActiveState(n, std::abs(d) < band_mm);
    any = any || std::abs(d) < band_mm;
  }
  return any ? std::move(leaf) : nullptr;
}

openvdb::FloatGrid::Ptr levelSet(const Distance& distance_mm, const BoundingBox& box, double voxel_mm,
                                 const ReportProgress& report) {
  // Leaves are made in parallel and added in order.
  const glm::ivec3 low(glm::floor(box.low_mm / (voxel_mm * kLeafVoxels)));
  const glm::ivec3 count = glm::ivec3(glm::ceil(box.high_mm / (voxel_mm * kLeafVoxels))) - low;
  std::vector<std::unique_ptr<Leaf>> leaves(static_cast<std::size_t>(count.x * count.y * count.z));
  std::atomic<std::size_t> done{0};
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    const int i = static_cast<int>(n);
    const openvdb::Coord origin((low.x + i % count.x) * kLeafVoxels, (low.y + i / count.x % count.y) * kLeafVoxels,
                                (low.z + i / (count.x * count.y)) * kLeafVoxels);
    leaves[n] = leafAt(distance_mm, origin, voxel_mm);
    if (report) report(static_cast<double>(++done) / static_cast<double>(leaves.size()));
  });
  auto grid = openvdb::createLevelSet<openvdb::FloatGrid>(voxel_mm, static_cast<float>(kBandVoxels));
  for (auto& leaf : leaves) {
    if (leaf) grid->tree().addLeaf(leaf.release());
  }
  openvdb::tools::signedFloodFill(grid->tree());
  return grid;
}

// Moves vertices onto the zero surface and takes the gradient there as normal.
void projectVertices(const Distance& distance_mm, double voxel_mm, MeshPart& part) {
  const double h = 0.25 * voxel_mm;
  part.normal.resize(part.position_mm.size());
  tbb::parallel_for(std::size_t{0}, part.position_mm.size(), [&](std::size_t n) {
    glm::dvec3 p = part.position_mm[n];
    // Gradient from the corners of a tetrahedron; their mean is the distance in the middle.
    static constexpr glm::dvec3 kCorners[] = {{1, -1, -1}, {-1, -1, 1}, {-1, 1, -1}, {1, 1, 1}};
    glm::dvec3 gradient(0.0);
    double mean_mm = 0.0;
    for (const glm::dvec3& corner : kCorners) {
      const double d = distance_mm(p + h * corner);
      gradient += d * corner / (4.0 * h);
      mean_mm += 0.25 * d;
    }
    const double slope = glm::length(gradient);
    const glm::dvec3 n_unit = slope > 1e-9 ? gradient / slope : glm::dvec3(0, 0, 1);
    p -= std::clamp(mean_mm / std::max(slope, 0.3), -0.5 * voxel_mm, 0.5 * voxel_mm) * n_unit;
    part.position_mm[n] = glm::vec3(p);
    part.normal[n] = glm::vec3(n_unit);
  });
}

}  // namespace

MeshPart meshOf(const Distance& distance_mm, const BoundingBox& box, double voxel_mm, double adaptivity,
                const ReportProgress& report) {
  const openvdb::FloatGrid::Ptr grid = levelSet(distance_mm, box, voxel_mm, report);
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec3I> triangles;
  std::vector<openvdb::Vec4I> quads;
  openvdb::tools::volumeToMesh(*grid, points, triangles, quads, 0.0, adaptivity);

  // OpenVDB winds clockwise; reverse each triangle.
  MeshPart part;
  for (const auto& p : points) part.position_mm.emplace_back(p.x(), p.y(), p.z());
  for (const auto& t : triangles) part.triangles.insert(part.triangles.end(), {t[0], t[2], t[1]});
  for (const auto& q : quads) part.triangles.insert(part.triangles.end(), {q[0], q[2], q[1], q[0], q[3], q[2]});
  projectVertices(distance_mm, voxel_mm, part);
  return part;
}

}  // namespace assets
