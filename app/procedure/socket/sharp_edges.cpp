#include "app/procedure/socket/sharp_edges.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "assets/ct_volume.h"
#include "assets/tissue.h"

namespace app {
namespace {

using assets::VolumeGrid;

constexpr double kNearOpening_mm = 1.0;  ///< farther from what was opened an edge is the patient's own
constexpr double kAround_mm = 2.0;       ///< in which bone that stands higher makes an edge lie deep
constexpr double kColumn_mm = 0.5;

struct Box {
  glm::ivec3 low{0}, end{0};
  bool isEmpty() const { return glm::any(glm::lessThanEqual(end, low)); }
  glm::ivec3 size() const { return end - low; }
  bool contains(glm::ivec3 ijk) const {
    return glm::all(glm::greaterThanEqual(ijk, low)) && glm::all(glm::lessThan(ijk, end));
  }
};

int voxels(double mm, const VolumeGrid& grid) { return static_cast<int>(std::ceil(mm / grid.spacing_mm)); }

/// Of all that was opened, with room around it.
Box boxAround(const BoneNow& bone) {
  glm::ivec3 low(std::numeric_limits<int>::max()), high(-1);
  assets::forVoxels(bone.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (bone.opened[v] == 0) return;
    low = glm::min(low, ijk);
    high = glm::max(high, ijk);
  });
  if (high.x < 0) return {};
  const int room = voxels(kNearOpening_mm + kAround_mm + kMedian_mm, bone.grid) + 2;
  return {glm::max(low - room, glm::ivec3(0)), glm::min(high + room + 1, bone.grid.size)};
}

/// The mean of the solid fraction over a ball; beyond the grid it goes on as at its edge.
std::vector<float> ballMean(const BoneNow& bone, const Box& box) {
  struct Tap {
    glm::ivec3 off;
    float weight;
  };
  std::vector<Tap> taps;
  float sum = 0.0F;
  const int reach = voxels(kMedian_mm, bone.grid);
  assets::forVoxels(glm::ivec3(-reach), glm::ivec3(reach + 1), [&](glm::ivec3 off) {
    const double inside = kMedian_mm / bone.grid.spacing_mm - glm::length(glm::dvec3(off)) + 0.5;
    const auto weight = static_cast<float>(std::clamp(inside, 0.0, 1.0));
    if (weight > 0.0F) taps.push_back({off, weight}), sum += weight;
  });
  std::vector<float> mean(assets::countIn(box.size()));
  std::size_t at = 0;
  assets::forVoxels(box.low, box.end, [&](glm::ivec3 ijk) {
    float total = 0.0F;
    for (const Tap& tap : taps) {
      const glm::ivec3 there = glm::clamp(ijk + tap.off, glm::ivec3(0), bone.grid.size - 1);
      total += tap.weight * static_cast<float>(bone.solid[bone.grid.index(there)]);
    }
    mean[at++] = total / (255.0F * sum);
  });
  return mean;
}

/// The larger principal curvature of the level set through a voxel, 1/mm, positive where solid bulges.
double curvature_per_mm(const Box& box, const std::vector<float>& mean, glm::ivec3 ijk, double spacing_mm) {
  const auto f = [&](int i, int j, int k) {
    return static_cast<double>(mean[assets::indexIn(box.size(), ijk + glm::ivec3(i, j, k) - box.low)]);
  };
  const double h = spacing_mm, here = f(0, 0, 0);
  const glm::dvec3 slope =
      glm::dvec3(f(1, 0, 0) - f(-1, 0, 0), f(0, 1, 0) - f(0, -1, 0), f(0, 0, 1) - f(0, 0, -1)) / (2.0 * h);
  const double steepness = glm::length(slope);
  constexpr double kFlat_per_mm = 0.2;  // no surface there
  if (steepness < kFlat_per_mm) return 0.0;
  const double xy = (f(1, 1, 0) - f(1, -1, 0) - f(-1, 1, 0) + f(-1, -1, 0)) / (4.0 * h * h);
  const double xz = (f(1, 0, 1) - f(1, 0, -1) - f(-1, 0, 1) + f(-1, 0, -1)) / (4.0 * h * h);
  const double yz = (f(0, 1, 1) - f(0, 1, -1) - f(0, -1, 1) + f(0, -1, -1)) / (4.0 * h * h);
  const glm::dmat3 bend((f(1, 0, 0) + f(-1, 0, 0) - 2.0 * here) / (h * h), xy, xz, xy,
                        (f(0, 1, 0) + f(0, -1, 0) - 2.0 * here) / (h * h), yz, xz, yz,
                        (f(0, 0, 1) + f(0, 0, -1) - 2.0 * here) / (h * h));
  const glm::dvec3 n = slope / steepness;
  const glm::dmat3 along = glm::dmat3(1.0) - glm::outerProduct(n, n);
  const glm::dmat3 shape = -1.0 / steepness * (along * bend * along);
  double trace = 0.0, squares = 0.0;
  for (int c = 0; c < 3; ++c) {
    trace += shape[c][c];
    squares += glm::dot(shape[c], shape[c]);
  }
  return 0.5 * trace + std::sqrt(std::max(0.0, 0.5 * squares - 0.25 * trace * trace));
}

/// The height of the bone around each place, square to `up_P`.
class Crest {
 public:
  Crest(const BoneNow& bone, const Box& box, const glm::dvec3& up_P) : up_P_(up_P) {
    const glm::dvec3 beside = std::abs(up_P.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    first_P_ = glm::normalize(beside - glm::dot(beside, up_P) * up_P);
    second_P_ = glm::cross(up_P, first_P_);
    assets::forVoxels(box.low, box.end, [&](glm::ivec3 ijk) {
      const std::size_t v = bone.grid.index(ijk);
      if (bone.solid[v] < assets::kHalfSolid || (!bone.label.empty() && assets::isTooth(bone.label[v]))) return;
      const glm::dvec3 p = bone.grid.centre_P_mm(ijk);
      auto [at, is_new] = height_mm_.try_emplace(columnOf(p), -std::numeric_limits<double>::infinity());
      at->second = std::max(at->second, glm::dot(p, up_P));
    });
  }
  bool isNear(const glm::dvec3& p_P_mm) const {
    const double height_mm = glm::dot(p_P_mm, up_P_);
    const auto [i, j] = columnOf(p_P_mm);
    constexpr int kReach = static_cast<int>(kAround_mm / kColumn_mm);
    for (int a = -kReach; a <= kReach; ++a)
      for (int b = -kReach; b <= kReach; ++b) {
        if (a * a + b * b > kReach * kReach) continue;
        const auto found = height_mm_.find({i + a, j + b});
        if (found != height_mm_.end() && found->second > height_mm + kCrest_mm) return false;
      }
    return true;
  }

 private:
  std::pair<int, int> columnOf(const glm::dvec3& p_P_mm) const {
    return {static_cast<int>(std::floor(glm::dot(p_P_mm, first_P_) / kColumn_mm)),
            static_cast<int>(std::floor(glm::dot(p_P_mm, second_P_) / kColumn_mm))};
  }
  glm::dvec3 up_P_, first_P_{0.0}, second_P_{0.0};
  std::map<std::pair<int, int>, double> height_mm_;
};

bool isNearOpening(const BoneNow& bone, glm::ivec3 ijk) {
  const int reach = voxels(kNearOpening_mm, bone.grid);
  const double most = kNearOpening_mm / bone.grid.spacing_mm;
  bool found = false;
  assets::forVoxels(glm::max(ijk - reach, glm::ivec3(0)), glm::min(ijk + reach + 1, bone.grid.size),
                    [&](glm::ivec3 at) {
                      const glm::dvec3 off(at - ijk);
                      found = found || (bone.opened[bone.grid.index(at)] != 0 && glm::dot(off, off) <= most * most);
                    });
  return found;
}

struct SharpVoxel {
  glm::ivec3 ijk;
  double curvature_per_mm;
};

/// Voxels that touch, corners included.
std::vector<std::vector<SharpVoxel>> connected(const Box& box, const std::vector<SharpVoxel>& sharp) {
  std::vector<int> at(assets::countIn(box.size()), -1);
  const auto place = [&](glm::ivec3 ijk) { return assets::indexIn(box.size(), ijk - box.low); };
  for (std::size_t n = 0; n < sharp.size(); ++n) at[place(sharp[n].ijk)] = static_cast<int>(n);
  std::vector<std::vector<SharpVoxel>> groups;
  for (const SharpVoxel& first : sharp) {
    if (at[place(first.ijk)] < 0) continue;
    at[place(first.ijk)] = -1;
    std::vector<SharpVoxel> group{first};
    for (std::size_t n = 0; n < group.size(); ++n) {
      const glm::ivec3 middle = group[n].ijk;
      assets::forVoxels(middle - 1, middle + 2, [&](glm::ivec3 beside) {
        if (!box.contains(beside)) return;
        if (const int next = std::exchange(at[place(beside)], -1); next >= 0)
          group.push_back(sharp[static_cast<std::size_t>(next)]);
      });
    }
    groups.push_back(std::move(group));
  }
  return groups;
}

/// Of the shortest lines that join all points (Prim 1957).
double treeLength_mm(const std::vector<glm::dvec3>& points_mm) {
  std::vector<double> nearest_mm(points_mm.size(), std::numeric_limits<double>::infinity());
  std::vector<char> is_joined(points_mm.size(), 0);
  double sum_mm = 0.0;
  std::size_t last = 0;
  for (std::size_t joined = 1; joined < points_mm.size(); ++joined) {
    is_joined[last] = 1;
    std::size_t next = 0;
    double least_mm = std::numeric_limits<double>::infinity();
    for (std::size_t n = 0; n < points_mm.size(); ++n) {
      if (is_joined[n] != 0) continue;
      nearest_mm[n] = std::min(nearest_mm[n], glm::distance(points_mm[last], points_mm[n]));
      if (nearest_mm[n] < least_mm) least_mm = nearest_mm[n], next = n;
    }
    sum_mm += least_mm;
    last = next;
  }
  return sum_mm;
}

SharpEdge edgeOf(const VolumeGrid& grid, std::vector<SharpVoxel> group) {
  SharpEdge edge;
  // The sharpest stand for those beside them, so that the points run along the ridge.
  std::ranges::stable_sort(group, std::greater{}, &SharpVoxel::curvature_per_mm);
  glm::dvec3 sum(0.0);
  for (const SharpVoxel& voxel : group) {
    const glm::dvec3 p = grid.centre_P_mm(voxel.ijk);
    sum += p;
    if (std::ranges::all_of(edge.points_P_mm, [&](const glm::dvec3& q) { return glm::distance(p, q) >= kEdgeStep_mm; }))
      edge.points_P_mm.push_back(p);
  }
  edge.radius_mm = 1.0 / group.front().curvature_per_mm;
  const glm::dvec3 centroid = sum / static_cast<double>(group.size());
  edge.middle_P_mm =
      *std::ranges::min_element(edge.points_P_mm, {}, [&](const glm::dvec3& p) { return glm::distance(p, centroid); });
  edge.length_mm = treeLength_mm(edge.points_P_mm);
  return edge;
}

}  // namespace

std::vector<SharpEdge> sharpEdges(const BoneNow& bone, const glm::dvec3& up_P) {
  assert(bone.solid.size() == bone.grid.voxelCount() && bone.opened.size() == bone.solid.size());
  const Box box = boxAround(bone);
  if (box.isEmpty()) return {};
  const std::vector<float> mean = ballMean(bone, box);
  const Crest crest(bone, box, up_P);
  const auto at = [&](glm::ivec3 ijk) { return mean[assets::indexIn(box.size(), ijk - box.low)]; };
  constexpr std::array<glm::ivec3, 6> kFaces{glm::ivec3{1, 0, 0}, {-1, 0, 0}, {0, 1, 0},
                                             {0, -1, 0},          {0, 0, 1},  {0, 0, -1}};
  std::vector<SharpVoxel> sharp;
  assets::forVoxels(box.low + 1, box.end - 1, [&](glm::ivec3 ijk) {
    if (at(ijk) < 0.5F || std::ranges::none_of(kFaces, [&](glm::ivec3 way) { return at(ijk + way) < 0.5F; })) return;
    if (!bone.label.empty() && assets::isTooth(bone.label[bone.grid.index(ijk)])) return;
    const double curvature = curvature_per_mm(box, mean, ijk, bone.grid.spacing_mm);
    if (curvature * kSharp_mm <= 1.0 || !isNearOpening(bone, ijk) || !crest.isNear(bone.grid.centre_P_mm(ijk))) return;
    sharp.push_back({ijk, curvature});
  });
  std::vector<SharpEdge> edges;
  for (std::vector<SharpVoxel>& group : connected(box, sharp))
    if (SharpEdge edge = edgeOf(bone.grid, std::move(group)); edge.length_mm >= kLeastEdge_mm)
      edges.push_back(std::move(edge));
  std::ranges::stable_sort(edges, std::greater{}, &SharpEdge::length_mm);
  return edges;
}

}  // namespace app
