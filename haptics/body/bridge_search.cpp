#include "haptics/body/bridge_search.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>
#include <utility>

#include "assets/ct_volume.h"

namespace haptics {
namespace {

constexpr std::array<glm::ivec3, 6> kNeighbours{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};

glm::ivec3 unitAlong(int axis) { return {axis == 0 ? 1 : 0, axis == 1 ? 1 : 0, axis == 2 ? 1 : 0}; }

/// A face of a cut: the voxel before it along the axis, and whether that one is on the first side.
struct WeighedFace {
  glm::ivec3 before{0};
  int axis = 0;
  bool forward = true;

  auto key() const { return std::tuple(before.z, before.y, before.x, axis, forward); }
  bool operator==(const WeighedFace& other) const { return key() == other.key(); }
  bool operator<(const WeighedFace& other) const { return key() < other.key(); }
};

/// Any unit vector across `n`.
glm::dvec3 across(const glm::dvec3& n) {
  const glm::dvec3 other = std::abs(n.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  return glm::normalize(glm::cross(n, other));
}

}  // namespace

BridgeSearch::BridgeSearch(const Components& components, std::size_t piece, CutRegion region, double cell_mm)
    : components_(components),
      piece_(piece),
      region_(std::move(region)),
      cell_(std::max(1, static_cast<int>(std::lround(cell_mm / components.grid().spacing_mm)))) {
  assert(components.grid().contains(box().first) && components.grid().contains(box().last));
  assert(region_.zone.empty() || region_.zone.size() == assets::countIn(box().last - box().first + 1));
  cells_ = cellOf(box().last) + 1;
  divideOutside();
  if (parts_.size() < 2) return;
  fillRegion();
  separate();
}

/// The voxels of the brick at `corner` that lie in the region.
BrickMask BridgeSearch::regionIn(glm::ivec3 corner) const {
  BrickMask mask{};
  assets::forVoxels(
      glm::max(corner, box().first), glm::min(corner + assets::kBrickVoxels, box().last + 1), [&](glm::ivec3 ijk) {
        const glm::ivec3 within = ijk - corner;
        if (isInRegion(ijk))
          mask[static_cast<std::size_t>(within.z)] |= 1ull << (within.y * assets::kBrickVoxels + within.x);
      });
  return mask;
}

/// The piece without the region, in its connected components.
void BridgeSearch::divideOutside() {
  outside_.resize(assets::countIn(components_.bricks()));
  forBricks(components_.bricks(), [&](std::size_t brick, glm::ivec3 corner) {
    const auto parts = components_.partsIn(brick);
    if (parts.empty()) return;
    const BrickMask inside = regionIn(corner);
    BrickMask left{};
    for (std::size_t n = 0; n < parts.size(); ++n) {
      if (components_.pieceOf(brick, n) != piece_) continue;
      if (isEmpty(inside)) {
        outside_[brick].push_back(parts[n]);
        continue;
      }
      for (std::size_t k = 0; k < left.size(); ++k) left[k] |= parts[n].mask[k] & ~inside[k];
    }
    if (!isEmpty(inside)) findParts(left, corner, outside_[brick]);
  });
  outside_join_.unite(components_.bricks(), outside_);

  std::vector<VoxelMoments> of_root(outside_join_.count());
  for (std::size_t brick = 0; brick < outside_.size(); ++brick)
    for (std::size_t n = 0; n < outside_[brick].size(); ++n)
      of_root[outside_join_.rootOf(brick, n)] += outside_[brick][n].moments;
  std::vector<std::size_t> roots;
  const double voxel_mm3 = components_.grid().voxelVolume_mm3();
  for (std::size_t root = 0; root < of_root.size(); ++root)
    if (static_cast<double>(of_root[root].count) * voxel_mm3 >= kLeastPart_mm3) roots.push_back(root);
  std::ranges::stable_sort(roots, [&](std::size_t a, std::size_t b) { return of_root[a].count > of_root[b].count; });
  if (roots.size() > kMaxParts) roots.resize(kMaxParts);
  part_of_root_.assign(of_root.size(), roots.size());
  for (const std::size_t root : roots) {
    part_of_root_[root] = parts_.size();
    const ToothPiece mass = massOf(of_root[root], components_.grid());
    parts_.push_back({mass.volume_mm3, mass.centroid_mm});
  }
}

void BridgeSearch::fillRegion() {
  mine_.assign(assets::countIn(box().last - box().first + 1), false);
  assets::forVoxels(box().first / assets::kBrickVoxels, box().last / assets::kBrickVoxels + 1, [&](glm::ivec3 at) {
    const std::size_t brick = assets::indexIn(components_.bricks(), at);
    const glm::ivec3 corner = at * assets::kBrickVoxels;
    const auto parts = components_.partsIn(brick);
    for (std::size_t n = 0; n < parts.size(); ++n) {
      if (components_.pieceOf(brick, n) != piece_) continue;
      assets::forVoxels(glm::max(corner, box().first), glm::min(corner + assets::kBrickVoxels, box().last + 1),
                        [&](glm::ivec3 ijk) {
                          if (holds(parts[n].mask, ijk - corner) && isInRegion(ijk)) mine_[local(ijk)] = true;
                        });
    }
  });
}

template <class Visit>
void BridgeSearch::forLinkedFaces(const Visit& visit) const {
  const glm::ivec3 size = box().last - box().first + 1;
  const std::array<std::size_t, 3> step{1, static_cast<std::size_t>(size.x),
                                        static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y)};
  std::size_t at = 0;
  assets::forVoxels(glm::ivec3(0), size, [&](glm::ivec3 ijk) {
    const std::size_t here = at++;
    if (!mine_[here]) return;
    for (int axis = 0; axis < 3; ++axis)
      if ((ijk[axis] + 1) % cell_ == 0 && ijk[axis] + 1 < size[axis] &&
          mine_[here + step[static_cast<std::size_t>(axis)]])
        visit(box().first + ijk, box().first + ijk + unitAlong(axis), axis);
  });
}

void BridgeSearch::linkCells(GridMinCut& graph) const {
  std::vector<std::array<std::uint16_t, 3>> faces(assets::countIn(cells_));
  forLinkedFaces([&](glm::ivec3 before, glm::ivec3, int axis) {
    ++faces[assets::indexIn(cells_, cellOf(before))][static_cast<std::size_t>(axis)];
  });
  std::size_t n = 0;
  assets::forVoxels(glm::ivec3(0), cells_, [&](glm::ivec3 cell) {
    const auto& of_cell = faces[n++];
    for (int axis = 0; axis < 3; ++axis)
      if (const std::uint16_t count = of_cell[static_cast<std::size_t>(axis)]; count > 0) graph.link(cell, axis, count);
  });
}

std::size_t BridgeSearch::outsidePart(glm::ivec3 ijk) const {
  if (!components_.grid().contains(ijk)) return parts_.size();
  const std::size_t brick = components_.brickOf(ijk);
  for (std::size_t n = 0; n < outside_[brick].size(); ++n)
    if (holds(outside_[brick][n].mask, ijk & (assets::kBrickVoxels - 1)))
      return part_of_root_[outside_join_.rootOf(brick, n)];
  return parts_.size();
}

std::vector<std::vector<glm::ivec3>> BridgeSearch::terminals() const {
  std::vector<std::vector<glm::ivec3>> found(parts_.size());
  std::vector<bool> taken(assets::countIn(cells_), false);
  assets::forVoxels(box().first, box().last + 1, [&](glm::ivec3 ijk) {
    if (!isMine(ijk)) return;
    for (const glm::ivec3 way : kNeighbours) {
      if (isInRegion(ijk + way)) continue;
      const glm::ivec3 cell = cellOf(ijk);
      const std::size_t part = outsidePart(ijk + way);
      // A coarse cell that meets two parts belongs to the first.
      if (part == parts_.size() || taken[assets::indexIn(cells_, cell)]) continue;
      taken[assets::indexIn(cells_, cell)] = true;
      found[part].push_back(cell);
    }
  });
  return found;
}

std::vector<BridgeSearch::Group> BridgeSearch::groups() const {
  if (region_.normal != glm::dvec3(0.0)) {
    Group beyond(parts_.size());
    std::array<double, 2> mm3{};
    for (std::size_t part = 0; part < parts_.size(); ++part) {
      beyond[part] = glm::dot(parts_[part].centroid_mm - region_.centre_mm, region_.normal) > 0.0;
      mm3[beyond[part] ? 1 : 0] += parts_[part].volume_mm3;
    }
    // The smaller side comes off.
    if (mm3[1] > mm3[0]) beyond.flip();
    if (mm3[0] > 0.0 && mm3[1] > 0.0) return {beyond};
  }
  std::vector<Group> single;
  for (std::size_t part = 1; part < parts_.size(); ++part) {
    single.emplace_back(parts_.size(), false);
    single.back()[part] = true;
  }
  return single;
}

void BridgeSearch::separate() {
  GridMinCut graph(cells_);
  linkCells(graph);
  const std::vector<std::vector<glm::ivec3>> ends = terminals();
  for (const Group& group : groups()) {
    std::array<std::vector<glm::ivec3>, 2> cells;
    for (std::size_t part = 0; part < parts_.size(); ++part) {
      auto& of_side = cells[group[part] ? 0 : 1];
      of_side.insert(of_side.end(), ends[part].begin(), ends[part].end());
    }
    if (cells[0].empty() || cells[1].empty()) continue;
    graph.cut(cells[0], cells[1]);
    Side side = sideOf(graph);
    if (side.faces.empty()) continue;
    Bridge bridge = measured(side);
    const auto largest = static_cast<std::size_t>(std::ranges::find(group, true) - group.begin());
    bridge.between = {largest, partBeyond(side, group)};
    bridges_.push_back(bridge);
  }
}

BridgeSearch::Side BridgeSearch::sideOf(const GridMinCut& graph) const {
  Side side;
  side.cell.reserve(assets::countIn(cells_));
  assets::forVoxels(glm::ivec3(0), cells_, [&](glm::ivec3 cell) { side.cell.push_back(graph.isOnSourceSide(cell)); });
  forLinkedFaces([&](glm::ivec3 before, glm::ivec3 after, int) {
    const bool first = isFirst(side, before);
    if (first == isFirst(side, after)) return;
    side.faces.push_back(first ? CutFace{before, after} : CutFace{after, before});
  });
  return side;
}

Bridge BridgeSearch::measured(const Side& side) const {
  // Faces of the cut, and partly solid ones along their rim, each once.
  std::vector<WeighedFace> faces;
  for (const CutFace& face : side.faces) {
    const glm::ivec3 way = face.second - face.first;
    const int axis = way.x != 0 ? 0 : way.y != 0 ? 1 : 2;
    const WeighedFace solid{glm::min(face.first, face.second), axis, way[axis] > 0};
    faces.push_back(solid);
    for (const glm::ivec3 aside : kNeighbours) {
      if (aside[axis] != 0) continue;
      const glm::ivec3 before = solid.before + aside, after = before + unitAlong(axis);
      const bool both_solid = std::min(components_.solidAt(before), components_.solidAt(after)) >= assets::kHalfSolid;
      if (!both_solid) faces.push_back({before, axis, solid.forward});
    }
  }
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());

  const assets::VolumeGrid& grid = components_.grid();
  const double s = grid.spacing_mm;
  const auto weight_mm2 = [&](const WeighedFace& face) {
    return std::min(components_.solidAt(face.before), components_.solidAt(face.before + unitAlong(face.axis))) * s * s /
           255.0;
  };
  const auto centre_mm = [&](const WeighedFace& face) {
    return grid.centre_P_mm(face.before) + 0.5 * s * glm::dvec3(unitAlong(face.axis));
  };
  Bridge bridge;
  glm::dvec3 area_mm2(0.0), first_moment(0.0);
  double all_mm2 = 0.0;
  for (const WeighedFace& face : faces) {
    const double w = weight_mm2(face);
    area_mm2[face.axis] += face.forward ? w : -w;
    first_moment += w * centre_mm(face);
    all_mm2 += w;
  }
  bridge.area_mm2 = glm::length(area_mm2);
  bridge.centre_mm = first_moment / all_mm2;
  bridge.normal = bridge.area_mm2 > 1e-9 ? area_mm2 / bridge.area_mm2 : glm::dvec3(0, 0, 1);

  // Second moments in the plane, of squares seen along the normal.
  const glm::dvec3 u = across(bridge.normal), v = glm::cross(bridge.normal, u);
  double uu = 0.0, vv = 0.0, uv = 0.0;
  for (const WeighedFace& face : faces) {
    const double w = weight_mm2(face) / all_mm2;
    const glm::dvec3 from_centre = centre_mm(face) - bridge.centre_mm;
    const double along_u = glm::dot(from_centre, u), along_v = glm::dot(from_centre, v);
    const double n_u = u[face.axis], n_v = v[face.axis], square = s * s / 12.0;
    uu += w * (along_u * along_u + square * (1.0 - n_u * n_u));
    vv += w * (along_v * along_v + square * (1.0 - n_v * n_v));
    uv += w * (along_u * along_v - square * n_u * n_v);
  }
  const double mean = 0.5 * (uu + vv), swing = std::hypot(0.5 * (uu - vv), uv);
  const double angle = 0.5 * std::atan2(2.0 * uv, uu - vv);
  bridge.width_mm = std::sqrt(12.0 * (mean + swing));
  bridge.thickness_mm = std::sqrt(12.0 * std::max(mean - swing, 0.0));
  bridge.width_axis = std::cos(angle) * u + std::sin(angle) * v;
  if (glm::dot(region_.centre_mm - bridge.centre_mm, bridge.floorwards()) < 0.0) bridge.width_axis *= -1.0;

  // The farthest edges of what is at least half solid.
  for (const WeighedFace& face : faces) {
    if (weight_mm2(face) < 0.5 * s * s) continue;
    const glm::dvec3 from_centre = centre_mm(face) - bridge.centre_mm;
    const auto reach_mm = [&](const glm::dvec3& along) {
      const glm::dvec3 n = glm::abs(along);
      return std::abs(glm::dot(from_centre, along)) + 0.5 * s * (n.x + n.y + n.z - n[face.axis]);
    };
    bridge.half_width_mm = std::max(bridge.half_width_mm, reach_mm(bridge.width_axis));
    bridge.half_thickness_mm = std::max(bridge.half_thickness_mm, reach_mm(bridge.floorwards()));
  }
  return bridge;
}

/// The part that is reached first from the far side of the cut, voxel by voxel.
std::size_t BridgeSearch::partBeyond(const Side& side, const Group& group) const {
  const auto largest = static_cast<std::size_t>(std::ranges::find(group, false) - group.begin());
  if (parts_.size() == 2) return largest;
  std::vector<bool> seen(mine_.size(), false);
  std::vector<glm::ivec3> queue;
  const auto visit = [&](glm::ivec3 ijk) {
    if (!isMine(ijk) || seen[local(ijk)] || isFirst(side, ijk)) return;
    seen[local(ijk)] = true;
    queue.push_back(ijk);
  };
  for (const CutFace& face : side.faces) visit(face.second);
  for (std::size_t head = 0; head < queue.size(); ++head) {
    const glm::ivec3 ijk = queue[head];
    for (const glm::ivec3 way : kNeighbours) {
      const std::size_t beyond = isInRegion(ijk + way) ? parts_.size() : outsidePart(ijk + way);
      if (beyond != parts_.size() && !group[beyond]) return beyond;
      visit(ijk + way);
    }
  }
  return largest;
}

}  // namespace haptics
