#include "app/case/own_face.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "assets/scan/exact_distance.h"
#include "assets/synthetic/surface_mesher.h"
#include "assets/trilinear.h"

namespace app {
namespace {

// Of about a millimetre.
constexpr double kCell_mm = 1.0, kSkin_hu = -300.0;
constexpr double kNarrow_mm = 2.5;  ///< nostrils and ears are closed up to twice that
constexpr double kThick_mm = 3.0, kOpening_mm = 24.0, kSmallest_mm2 = 5000.0;
constexpr std::array<glm::ivec3, 6> kFaces = {{{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};

bool isIn(const assets::VolumeGrid& cells, const glm::ivec3& at) {
  return glm::all(glm::greaterThanEqual(at, glm::ivec3(0))) && glm::all(glm::lessThan(at, cells.size));
}

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

/// Cells where `enters` holds that hang together by faces with one of `from`.
std::vector<std::uint8_t> flooded(const assets::VolumeGrid& cells, std::vector<std::size_t> from,
                                  const std::function<bool(std::size_t)>& enters) {
  std::vector<std::uint8_t> is_in(cells.voxelCount());
  std::erase_if(from, [&](std::size_t n) { return !enters(n); });
  for (const std::size_t n : from) is_in[n] = 1;
  while (!from.empty()) {
    const glm::ivec3 at = assets::elementAt(cells.size, from.back());
    from.pop_back();
    for (const glm::ivec3& step : kFaces) {
      if (!isIn(cells, at + step)) continue;
      const std::size_t next = cells.index(at + step);
      if (is_in[next] != 0 || !enters(next)) continue;
      is_in[next] = 1;
      from.push_back(next);
    }
  }
  return is_in;
}

/// The air around the head, without that in nose, mouth and ears.
std::vector<std::uint8_t> outsideOf(const assets::VolumeGrid& cells, const std::vector<std::uint8_t>& is_flesh) {
  const std::vector<float> from_flesh_mm = assets::exactDistance_mm(cells.size, cells.spacing_mm, is_flesh);
  std::vector<std::size_t> border;
  assets::forVoxels(glm::ivec3(0), cells.size, [&](glm::ivec3 cell) {
    const bool is_border = glm::any(glm::equal(cell, glm::ivec3(0))) || glm::any(glm::equal(cell, cells.size - 1));
    if (is_border) border.push_back(cells.index(cell));
  });
  std::vector<std::uint8_t> is_outside = flooded(
      cells, std::move(border), [&](std::size_t n) { return static_cast<double>(from_flesh_mm[n]) > kNarrow_mm; });
  const std::vector<float> from_outside_mm = assets::exactDistance_mm(cells.size, cells.spacing_mm, is_outside);
  for (std::size_t n = 0; n < is_outside.size(); ++n)
    is_outside[n] =
        is_flesh[n] == 0 && static_cast<double>(from_outside_mm[n]) <= kNarrow_mm + cells.spacing_mm ? 1 : 0;
  return is_outside;
}

/// The head is the largest piece that is not outside: headrests are others.
void keepLargestBody(const assets::VolumeGrid& cells, std::vector<std::uint8_t>& is_outside) {
  std::vector<std::uint8_t> is_seen(is_outside), best;
  std::size_t most = 0;
  for (std::size_t n = 0; n < is_seen.size(); ++n) {
    if (is_seen[n] != 0) continue;
    std::vector<std::uint8_t> piece = flooded(cells, {n}, [&](std::size_t at) { return is_outside[at] == 0; });
    std::size_t count = 0;
    for (std::size_t at = 0; at < piece.size(); ++at) count += piece[at], is_seen[at] |= piece[at];
    if (count > most) most = count, best = std::move(piece);
    if (2 * most > is_seen.size()) break;
  }
  for (std::size_t n = 0; n < best.size(); ++n) is_outside[n] = best[n] == 0 ? 1 : 0;
}

/// Signed distance from the skin, smoothed over a cell or two.
std::vector<float> distanceFromSkin_mm(const assets::VolumeGrid& cells, const std::vector<std::uint8_t>& is_outside) {
  std::vector<std::uint8_t> is_body(is_outside.size());
  for (std::size_t n = 0; n < is_body.size(); ++n) is_body[n] = is_outside[n] == 0 ? 1 : 0;
  std::vector<float> distance_mm = assets::exactDistance_mm(cells.size, cells.spacing_mm, is_body);
  const std::vector<float> inside_mm = assets::exactDistance_mm(cells.size, cells.spacing_mm, is_outside);
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
  std::vector<std::uint8_t> is_outside = outsideOf(cells, fleshOf(ct, edge, cells));
  keepLargestBody(cells, is_outside);
  const std::vector<float> from_skin_mm = distanceFromSkin_mm(cells, is_outside);

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
