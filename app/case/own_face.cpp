#include "app/case/own_face.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "assets/scan/exact_distance.h"
#include "assets/segment/cell_masks.h"
#include "assets/synthetic/surface_mesher.h"
#include "assets/trilinear.h"

namespace app {
namespace {

// Of about a millimetre.
constexpr double kCell_mm = 1.0, kSkin_hu = -300.0;
constexpr double kNarrow_mm = 2.5;  ///< nostrils and ears are closed up to twice that
constexpr double kThick_mm = 3.0, kOpening_mm = 24.0, kSmallest_mm2 = 5000.0;

std::vector<std::uint8_t> fleshOf(const assets::CtVolume& ct, int edge, const assets::VolumeGrid& cells) {
  std::vector<std::uint8_t> is_flesh(cells.voxelCount());
  assets::forVoxels(glm::ivec3(0), cells.size, [&](glm::ivec3 cell) {
    const glm::ivec3 low = cell * edge, end = glm::min(low + edge, ct.grid.size);
    double sum = 0.0;
    assets::forVoxels(low, end, [&](glm::ivec3 ijk) { sum += ct.hounsfield[ct.grid.index(ijk)]; });
    const glm::dvec3 voxels(end - low);
    is_flesh[cells.index(cell)] = sum > kSkin_hu * voxels.x * voxels.y * voxels.z ? 1 : 0;
  });
  return is_flesh;
}

/// The air around the head, without that in nose, mouth and ears.
assets::CellMask outsideOf(const assets::VolumeGrid& cells, const std::vector<std::uint8_t>& is_flesh) {
  const std::vector<float> from_flesh_mm = assets::exactDistance_mm(cells.size, cells.spacing_mm, is_flesh);
  assets::CellMask is_wide(from_flesh_mm.size());
  std::ranges::transform(from_flesh_mm, is_wide.begin(), [](float mm) -> std::uint8_t { return mm > kNarrow_mm; });
  const assets::CellPieces pieces = assets::piecesOfCells(cells.size, is_wide);
  std::vector<std::uint8_t> is_around(pieces.cells.size(), 0);
  assets::forCells(cells.size, [&](glm::ivec3 cell, std::size_t n) {
    const bool is_border = glm::any(glm::equal(cell, glm::ivec3(0))) || glm::any(glm::equal(cell, cells.size - 1));
    if (is_border && pieces.of[n] != 0) is_around[static_cast<std::size_t>(pieces.of[n])] = 1;
  });
  assets::CellMask is_outside(is_wide.size());
  std::ranges::transform(pieces.of, is_outside.begin(),
                         [&](std::int32_t number) { return is_around[static_cast<std::size_t>(number)]; });
  const std::vector<float> from_outside_mm = assets::exactDistance_mm(cells.size, cells.spacing_mm, is_outside);
  for (std::size_t n = 0; n < is_outside.size(); ++n)
    is_outside[n] =
        is_flesh[n] == 0 && static_cast<double>(from_outside_mm[n]) <= kNarrow_mm + cells.spacing_mm ? 1 : 0;
  return is_outside;
}

assets::CellMask without(const assets::CellMask& cells) {
  assets::CellMask others(cells.size());
  std::ranges::transform(cells, others.begin(), [](std::uint8_t in) -> std::uint8_t { return in == 0 ? 1 : 0; });
  return others;
}

/// Signed distance from the skin, smoothed over a cell or two.
std::vector<float> distanceFromSkin_mm(const assets::VolumeGrid& cells, const assets::CellMask& is_body) {
  std::vector<float> distance_mm = assets::exactDistance_mm(cells.size, cells.spacing_mm, is_body);
  const std::vector<float> inside_mm = assets::exactDistance_mm(cells.size, cells.spacing_mm, without(is_body));
  constexpr float kFar_mm = 20.0f;
  for (std::size_t n = 0; n < distance_mm.size(); ++n)
    distance_mm[n] = std::clamp(std::max(distance_mm[n], 0.0f) - std::max(inside_mm[n], 0.0f), -kFar_mm, kFar_mm);
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round)
    for (int axis = 0; axis < 3; ++axis) {
      glm::ivec3 step(0);
      step[axis] = 1;
      const std::vector<float> before = distance_mm;
      assets::forVoxels(glm::ivec3(0), cells.size, [&](glm::ivec3 at) {
        const auto value = [&](const glm::ivec3& cell) {
          return before[cells.index(glm::clamp(cell, glm::ivec3(0), cells.size - 1))];
        };
        distance_mm[cells.index(at)] = 0.25f * (value(at - step) + 2.0f * value(at) + value(at + step));
      });
    }
  return distance_mm;
}

double area_mm2(const assets::MeshPart& part) {
  double area = 0.0;
  for (std::size_t t = 0; t + 2 < part.triangles.size(); t += 3) {
    const glm::vec3 &a = part.position_mm[part.triangles[t]], &b = part.position_mm[part.triangles[t + 1]],
                    &c = part.position_mm[part.triangles[t + 2]];
    area += 0.5 * static_cast<double>(glm::length(glm::cross(b - a, c - a)));
  }
  return area;
}

}  // namespace

assets::MeshModel ownFace(const assets::CtVolume& ct, const glm::dvec3& site_P_mm, const glm::dvec3& to_eye_P) {
  const int edge = std::max(1, static_cast<int>(std::lround(kCell_mm / ct.grid.spacing_mm)));
  assets::VolumeGrid cells;
  cells.size = (ct.grid.size + (edge - 1)) / edge;
  cells.spacing_mm = edge * ct.grid.spacing_mm;
  cells.origin_P_mm = ct.grid.origin_P_mm + 0.5 * (edge - 1) * ct.grid.spacing_mm;
  if (glm::any(glm::lessThan(cells.size, glm::ivec3(8)))) return {};
  // Headrests are other pieces than the head.
  const assets::CellMask is_body =
      assets::largestPiece(cells.size, without(outsideOf(cells, fleshOf(ct, edge, cells))));
  const std::vector<float> from_skin_mm = distanceFromSkin_mm(cells, is_body);

  // A shell, without what stands between the site and the eye.
  constexpr double kFarthest_mm = 200.0;
  const auto distance_mm = [&](const glm::dvec3& p_P_mm) {
    const double skin_mm = assets::trilinearAt(cells, p_P_mm, [&](const glm::ivec3& cell) {
      return static_cast<double>(from_skin_mm[cells.index(glm::clamp(cell, glm::ivec3(0), cells.size - 1))]);
    });
    const double along_mm = std::clamp(glm::dot(p_P_mm - site_P_mm, to_eye_P), 0.0, kFarthest_mm);
    const double aside_mm = glm::distance(p_P_mm, site_P_mm + along_mm * to_eye_P);
    return std::max({skin_mm, -(skin_mm + kThick_mm), kOpening_mm - aside_mm});
  };
  const glm::dvec3 margin(2.0 * cells.spacing_mm);
  const glm::dvec3 end_P_mm = cells.origin_P_mm + cells.spacing_mm * glm::dvec3(cells.size - 1);
  constexpr double kAdaptivity = 0.4;
  assets::MeshPart skin =
      assets::meshOf(distance_mm, {cells.origin_P_mm + margin, end_P_mm - margin}, kCell_mm, kAdaptivity);
  if (area_mm2(skin) < 2.0 * kSmallest_mm2) return {};
  skin.name = "Face";
  skin.material.base_colour = {0.62f, 0.37f, 0.28f, 1.0f};
  return {{std::move(skin)}};
}

}  // namespace app
