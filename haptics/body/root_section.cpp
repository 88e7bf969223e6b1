#include "haptics/body/root_section.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <utility>

#include "assets/ct_volume.h"
#include "assets/tissue.h"
#include "haptics/body/bridge_break.h"
#include "haptics/body/components.h"

namespace haptics {
namespace {

constexpr double kLeastEnamel = 0.03;  ///< of the volume: less says nothing about where the crown is
constexpr double kMostBeyond = 0.75;   ///< of the volume: a tip is no more than that
constexpr std::array<glm::ivec3, 6> kFaces{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};

/// The largest part of a piece, voxel by voxel.
struct Whole {
  const assets::VolumeGrid& grid;
  std::span<const std::uint8_t> solid, label;
  std::vector<glm::ivec3> voxels;
  double volume_mm3 = 0.0;
  glm::dvec3 axis{0.0};  ///< unit, to the tips
  double low_mm = 0.0, high_mm = 0.0;

  assets::Tissue tissueAt(glm::ivec3 ijk) const {
    return label.empty() ? assets::Tissue::dentine : assets::Tissue{label[grid.index(ijk)]};
  }
};

/// Longest axis of inertia: the eigenvector of the spread with the largest eigenvalue, by repeated multiplication.
glm::dvec3 longestAxis(const glm::dmat3& inertia) {
  const double trace = inertia[0][0] + inertia[1][1] + inertia[2][2];
  const glm::dmat3 spread = glm::dmat3(0.5 * trace) - inertia;
  glm::dvec3 axis = glm::normalize(glm::dvec3(0.3, 0.5, 0.8));
  constexpr int kSteps = 100;
  for (int n = 0; n < kSteps; ++n) {
    const glm::dvec3 next = spread * axis;
    if (!(glm::length(next) > 0.0)) break;
    axis = glm::normalize(next);
  }
  return axis;
}

/// From enamel to dentine; without enough enamel the longest axis, to its thinner end.
glm::dvec3 axisOf(const Whole& whole, const ToothPiece& piece) {
  glm::dvec3 enamel(0.0), rest(0.0);
  double in_enamel = 0.0, in_rest = 0.0;
  for (const glm::ivec3& ijk : whole.voxels) {
    const bool is_enamel = whole.tissueAt(ijk) == assets::Tissue::enamel;
    (is_enamel ? enamel : rest) += glm::dvec3(ijk);
    (is_enamel ? in_enamel : in_rest) += 1.0;
  }
  if (in_enamel > kLeastEnamel * (in_enamel + in_rest) && in_rest > 0.0) {
    const glm::dvec3 way = rest / in_rest - enamel / in_enamel;
    if (glm::length(way) > 0.0) return glm::normalize(way);
  }
  const glm::dvec3 axis = longestAxis(piece.inertia_mm5);
  double skew = 0.0;
  for (const glm::ivec3& ijk : whole.voxels)
    skew += std::pow(glm::dot(whole.grid.centre_P_mm(ijk) - piece.centroid_mm, axis), 3);
  return skew < 0.0 ? -axis : axis;
}

/// Of the voxels just beyond a level: area, axes and farthest edges.
std::optional<RootSection> sectionOf(const Whole& whole, const std::vector<glm::ivec3>& beyond, double level_mm) {
  const double spacing_mm = whole.grid.spacing_mm;
  const glm::dvec3& n = whole.axis;
  const glm::dvec3 u = glm::normalize(glm::cross(n, std::abs(n.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
  const glm::dvec3 v = glm::cross(n, u);
  // A slab a voxel thick and a voxel beyond the level, all of whose voxels are beyond it, each by its volume in there.
  struct InPlane {
    double u_mm, v_mm, weight;
  };
  std::vector<InPlane> places;
  double enamel = 0.0, sum_u = 0.0, sum_v = 0.0, count = 0.0;
  for (const glm::ivec3& ijk : beyond) {
    const glm::dvec3 p = whole.grid.centre_P_mm(ijk);
    const assets::Tissue tissue = whole.tissueAt(ijk);
    const double to_level = (level_mm - glm::dot(p, n)) / spacing_mm;
    if (to_level < -3.0 || tissue == assets::Tissue::pulp) continue;
    const double weight = cubeShareBelow(n, to_level + 2.0) - cubeShareBelow(n, to_level + 1.0);
    if (weight <= 0.0) continue;
    places.push_back({glm::dot(p, u), glm::dot(p, v), weight});
    count += weight;
    sum_u += weight * places.back().u_mm;
    sum_v += weight * places.back().v_mm;
    enamel += tissue == assets::Tissue::enamel ? weight : 0.0;
  }
  if (!(count > 0.0)) return {};
  const double u0 = sum_u / count, v0 = sum_v / count;
  double uu = spacing_mm * spacing_mm / 12.0, vv = uu, uv = 0.0;
  for (const InPlane& p : places) {
    uu += p.weight * (p.u_mm - u0) * (p.u_mm - u0) / count;
    vv += p.weight * (p.v_mm - v0) * (p.v_mm - v0) / count;
    uv += p.weight * (p.u_mm - u0) * (p.v_mm - v0) / count;
  }
  const double middle = 0.5 * (uu + vv), half = std::hypot(0.5 * (uu - vv), uv);
  const double turn_rad = 0.5 * std::atan2(2.0 * uv, uu - vv);

  RootSection one;
  Bridge& section = one.section;
  section.area_mm2 = count * spacing_mm * spacing_mm;
  section.width_mm = std::sqrt(12.0 * (middle + half));
  section.thickness_mm = std::sqrt(12.0 * std::max(middle - half, 1e-12));
  section.normal = n;
  section.width_axis = std::cos(turn_rad) * u + std::sin(turn_rad) * v;
  section.centre_mm = level_mm * n + u0 * u + v0 * v;
  const glm::dvec3 across = section.floorwards();
  for (const InPlane& p : places) {
    const glm::dvec3 off = (p.u_mm - u0) * u + (p.v_mm - v0) * v;
    section.half_width_mm = std::max(section.half_width_mm, std::abs(glm::dot(off, section.width_axis)));
    section.half_thickness_mm = std::max(section.half_thickness_mm, std::abs(glm::dot(off, across)));
  }
  // To the voxel's edge.
  section.half_width_mm += 0.5 * spacing_mm;
  section.half_thickness_mm += 0.5 * spacing_mm;
  one.enamel_share = enamel / count;
  return one;
}

/// What lies beyond, with what is partly solid next to it; of voxels that the level runs through the part beyond it.
SplitPlan partBeyond(const Whole& whole, const std::vector<glm::ivec3>& beyond, double level_mm) {
  const assets::VolumeGrid& grid = whole.grid;
  SolidField lattice;
  lattice.blocks = (grid.size + kBlockEdge - 1) / kBlockEdge;
  std::map<std::size_t, SplitPlan::Block> blocks;
  const auto give = [&](glm::ivec3 ijk) {
    const std::uint8_t solid = whole.solid[grid.index(ijk)];
    if (solid == 0) return;
    const double to_level = (level_mm - glm::dot(grid.centre_P_mm(ijk), whole.axis)) / grid.spacing_mm;
    const double share = 1.0 - cubeShareBelow(whole.axis, to_level);
    const auto given = static_cast<std::uint8_t>(std::lround(solid * share));
    if (given == 0) return;
    const std::size_t at = lattice.offsetOf(ijk), block = at / kBlockVoxels;
    SplitPlan::Block& planned = blocks[block];
    planned.block = static_cast<std::uint32_t>(block);
    planned.given[at % kBlockVoxels] = given;
  };
  for (const glm::ivec3& ijk : beyond) {
    give(ijk);
    for (const glm::ivec3& face : kFaces)
      if (grid.contains(ijk + face)) give(ijk + face);
  }
  SplitPlan plan;
  for (const auto& [number, block] : blocks) plan.blocks.push_back(block);
  return plan;
}

/// Connected voxels beyond a level, in the order of the first of each.
std::vector<std::vector<glm::ivec3>> partsBeyond(const Whole& whole, double level_mm) {
  const assets::VolumeGrid& grid = whole.grid;
  std::vector<char> is_left(grid.voxelCount(), 0);
  for (const glm::ivec3& ijk : whole.voxels)
    is_left[grid.index(ijk)] = glm::dot(grid.centre_P_mm(ijk), whole.axis) > level_mm ? 1 : 0;
  std::vector<std::vector<glm::ivec3>> parts;
  for (const glm::ivec3& first : whole.voxels) {
    if (std::exchange(is_left[grid.index(first)], char{0}) == 0) continue;
    std::vector<glm::ivec3> part{first};
    for (std::size_t n = 0; n < part.size(); ++n)
      for (const glm::ivec3& face : kFaces) {
        const glm::ivec3 at = part[n] + face;
        if (grid.contains(at) && std::exchange(is_left[grid.index(at)], char{0}) != 0) part.push_back(at);
      }
    parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace

RootSections rootSections(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid,
                          std::span<const std::uint8_t> label) {
  assert(solid.size() == grid.voxelCount() && (label.empty() || label.size() == solid.size()));
  RootSections found;
  found.beyond.assign(grid.voxelCount(), 0);
  const Components components(grid, solid);
  if (components.pieces().empty()) return found;
  const ToothPiece& piece = components.pieces()[0];
  Whole whole{grid, solid, label, {}, piece.volume_mm3, {}, 1e9, -1e9};
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t) {
    if (components.pieceAt(ijk) == 0) whole.voxels.push_back(ijk);
  });
  whole.axis = axisOf(whole, piece);
  for (const glm::ivec3& ijk : whole.voxels) {
    const double at_mm = glm::dot(grid.centre_P_mm(ijk), whole.axis);
    whole.low_mm = std::min(whole.low_mm, at_mm);
    whole.high_mm = std::max(whole.high_mm, at_mm);
  }
  for (int level = 1; level <= kRootLevels; ++level) {
    const double level_mm = glm::mix(whole.low_mm, whole.high_mm, static_cast<double>(level) / (kRootLevels + 1));
    for (const std::vector<glm::ivec3>& part : partsBeyond(whole, level_mm)) {
      const double beyond_mm3 = static_cast<double>(part.size()) * grid.voxelVolume_mm3();
      if (beyond_mm3 < kLeastPiece_mm3 || beyond_mm3 > kMostBeyond * whole.volume_mm3) continue;
      auto section = sectionOf(whole, part, level_mm);
      if (!section || found.sections.size() == kMostRootSections) continue;
      const auto bit = static_cast<std::uint16_t>(1U << found.sections.size());
      for (const glm::ivec3& ijk : part) found.beyond[grid.index(ijk)] |= bit;
      section->beyond_mm3 = beyond_mm3;
      section->split = partBeyond(whole, part, level_mm);
      found.sections.push_back(std::move(*section));
    }
  }
  return found;
}

}  // namespace haptics
