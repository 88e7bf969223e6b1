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

// Fills leaves of the level set, eighth by eighth; what is farther from the surface than the band at its middle, given
// the steepest slope, is not evaluated voxel by voxel.
class LeafFiller {
 public:
  LeafFiller(const Distance& distance_mm, double voxel_mm)
      : distance_mm_(distance_mm), voxel_mm_(voxel_mm), band_mm_(kBandVoxels * voxel_mm) {}

  // None far from the surface.
  std::unique_ptr<Leaf> leafAt(const openvdb::Coord& origin) const {
    if (std::abs(inMiddle_mm(origin, kLeafVoxels)) > reach_mm(kLeafVoxels)) return nullptr;
    auto leaf = std::make_unique<Leaf>(origin, static_cast<float>(band_mm_));
    return fillEighths(*leaf, origin, kLeafVoxels / 2) ? std::move(leaf) : nullptr;
  }

 private:
  double inMiddle_mm(const openvdb::Coord& origin, int edge) const {
    return distance_mm_(voxel_mm_ * (glm::dvec3(origin.x(), origin.y(), origin.z()) + 0.5 * (edge - 1.0)));
  }
  double reach_mm(int edge) const { return kSteepest * 0.5 * std::sqrt(3.0) * (edge - 1.0) * voxel_mm_ + band_mm_; }

  // Whether any voxel is in the band.
  bool fillEighths(Leaf& leaf, const openvdb::Coord& origin, int edge) const {
    bool any = false;
    for (int n = 0; n < 8; ++n)
      if (fill(leaf, origin.offsetBy(n & 1 ? edge : 0, n & 2 ? edge : 0, n & 4 ? edge : 0), edge)) any = true;
    return any;
  }

  bool fill(Leaf& leaf, const openvdb::Coord& origin, int edge) const {
    const double d = inMiddle_mm(origin, edge);
    if (edge > 1 && std::abs(d) <= reach_mm(edge)) return fillEighths(leaf, origin, edge / 2);
    const bool in_band = edge == 1 && std::abs(d) < band_mm_;
    for (openvdb::Index n = 0; n < static_cast<openvdb::Index>(edge * edge * edge); ++n) {
      const auto along = static_cast<openvdb::Index>(edge);
      const openvdb::Index voxel = Leaf::coordToOffset(origin.offsetBy(
          static_cast<int>(n % along), static_cast<int>(n / along % along), static_cast<int>(n / (along * along))));
      leaf.setValueOnly(voxel, static_cast<float>(std::clamp(d, -band_mm_, band_mm_)));
      leaf.setActiveState(voxel, in_band);
    }
    return in_band;
  }

  const Distance& distance_mm_;
  double voxel_mm_, band_mm_;
};

openvdb::FloatGrid::Ptr levelSet(const Distance& distance_mm, const BoundingBox& box, double voxel_mm,
                                 const ReportProgress& report) {
  // Leaves are made in parallel and added in order.
  const glm::ivec3 low(glm::floor(box.low_mm / (voxel_mm * kLeafVoxels)));
  const glm::ivec3 count = glm::ivec3(glm::ceil(box.high_mm / (voxel_mm * kLeafVoxels))) - low;
  std::vector<std::unique_ptr<Leaf>> leaves(static_cast<std::size_t>(count.x * count.y * count.z));
  std::atomic<std::size_t> done{0};
  const LeafFiller filler(distance_mm, voxel_mm);
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    const int i = static_cast<int>(n);
    const openvdb::Coord origin((low.x + i % count.x) * kLeafVoxels, (low.y + i / count.x % count.y) * kLeafVoxels,
                                (low.z + i / (count.x * count.y)) * kLeafVoxels);
    leaves[n] = filler.leafAt(origin);
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
