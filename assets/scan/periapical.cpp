#include "assets/scan/periapical.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "assets/tooth.h"

namespace assets {
namespace {

constexpr double kTube_mm = 300.0;  ///< from the film
constexpr double kFilm_mm = 12.0;   ///< behind the middle of the tooth, on the tongue's side
constexpr glm::dvec2 kFilmSize_mm{41.0, 31.0};
constexpr int kFirstPremolar = 4;
/// A tooth that leans more is taken with an upright film.
constexpr double kMostLean_rad = 0.6;

/// In 1/100 of cortical bone: enamel 2.1, dentine 1.4, pulp and other soft tissue 0.3; spongy bone is mostly marrow.
constexpr int kBone = 100;
constexpr std::array<int, kTissueCount> kAttenuation{kBone, kBone, 50, 140, 210, 140, 30, 30, 30, 30};

/// Attenuation of the voxels that the beam crosses, planes across it one after the other, with a border of air.
struct Slab {
  std::array<int, 3> axis{};   ///< of the grid: within a plane first and second, and across
  glm::ivec3 low{0}, size{0};  ///< in the order of `axis`
  std::vector<std::uint8_t> attenuation;
};

Slab slabOf(const VolumeGrid& grid, std::span<const std::uint8_t> solid, std::span<const std::uint8_t> label,
            const PeriapicalView& view, int across) {
  Slab slab;
  slab.axis = {(across + 1) % 3, (across + 2) % 3, across};
  if (slab.axis[0] > slab.axis[1]) std::swap(slab.axis[0], slab.axis[1]);

  // The box of the four edges of the beam, within the volume and before the film.
  const glm::dvec3 source = grid.indexFromPoint(view.source_P_mm);
  glm::dvec3 low(std::numeric_limits<double>::max()), high(-std::numeric_limits<double>::max());
  for (const glm::dvec2 share : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1), glm::dvec2(1, 1)}) {
    const glm::dvec2 px = share * glm::dvec2(view.size_px - 1);
    const glm::dvec3 film =
        grid.indexFromPoint(view.corner_P_mm + view.pixel_mm * (px.x * view.right_P + px.y * view.down_P));
    const double depth = film[across] - source[across];
    const double first = -source[across] / depth, last = (grid.size[across] - 1 - source[across]) / depth;
    for (const double t : {std::clamp(std::min(first, last), 0.0, 1.0), std::clamp(std::max(first, last), 0.0, 1.0)}) {
      const glm::dvec3 at = source + t * (film - source);
      low = glm::min(low, at);
      high = glm::max(high, at);
    }
  }
  const glm::ivec3 from = glm::max(glm::ivec3(glm::floor(low)), glm::ivec3(0));
  const glm::ivec3 end = glm::min(glm::ivec3(glm::ceil(high)) + 1, grid.size);
  if (glm::any(glm::greaterThanEqual(from, end))) return slab;
  for (int n = 0; n < 3; ++n) {
    const int axis = slab.axis[static_cast<std::size_t>(n)], border = n < 2 ? 1 : 0;
    slab.low[n] = from[axis] - border;
    slab.size[n] = end[axis] - from[axis] + 2 * border;
  }
  slab.attenuation.assign(countIn(slab.size), 0);
  forVoxels(from, end, [&](glm::ivec3 ijk) {
    const std::size_t v = grid.index(ijk);
    const std::uint8_t tissue = label.empty() || label[v] >= kTissueCount ? std::uint8_t{0} : label[v];
    const bool soft = tissue != 0 && !isHard(tissue);
    const int full = kAttenuation[tissue];
    const glm::ivec3 at(ijk[slab.axis[0]], ijk[slab.axis[1]], ijk[slab.axis[2]]);
    slab.attenuation[indexIn(slab.size, at - slab.low)] =
        static_cast<std::uint8_t>(soft ? full : (full * solid[v] + 127) / 255);
  });
  return slab;
}

int longestAxis(const glm::dvec3& v) {
  const glm::dvec3 a = glm::abs(v);
  return a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
}

}  // namespace

std::optional<PeriapicalView> periapicalViewOf(const CtVolume& ct, int fdi, double shift_deg) {
  if (ct.tooth.empty()) return std::nullopt;
  const VoxelSum all = voxelSum(ct.grid, [&](std::size_t v) { return ct.tooth[v] == fdi; });
  if (all.count == 0.0) return std::nullopt;
  const VoxelSum crown =
      voxelSum(ct.grid, [&](std::size_t v) { return ct.tooth[v] == fdi && Tissue{ct.label[v]} == Tissue::enamel; });
  const glm::dvec3 middle_P_mm = ct.grid.origin_P_mm + ct.grid.spacing_mm * all.sum / all.count;

  // Along the tooth: from its middle to that of its enamel.
  glm::dvec3 up_P = occlusalDirection_P(fdi);
  if (crown.count > 0.0) {
    const glm::dvec3 to_crown = crown.sum / crown.count - all.sum / all.count;
    if (const double away = glm::length(to_crown);
        away > 0.0 && glm::dot(to_crown / away, up_P) > std::cos(kMostLean_rad))
      up_P = to_crown / away;
  }
  const glm::dvec3 cheek_P = buccalDirection_P(fdi);
  const glm::dvec3 out_P = glm::normalize(cheek_P - glm::dot(cheek_P, up_P) * up_P);

  PeriapicalView view;
  view.right_P = glm::cross(-out_P, occlusalDirection_P(fdi).z > 0.0 ? up_P : -up_P);
  view.down_P = glm::cross(-out_P, view.right_P);
  view.mesial_is_right = isRight(fdi);
  const glm::dvec3 mesial_P = view.mesial_is_right ? view.right_P : -view.right_P;
  const double shift = glm::radians(shift_deg);
  const glm::dvec3 to_tube_P = std::cos(shift) * out_P + std::sin(shift) * mesial_P;
  view.source_P_mm = middle_P_mm + (kTube_mm - kFilm_mm) * to_tube_P;
  // Molars and premolars on a lying film, the others on an upright one; it is centred on the tooth's shadow.
  const glm::dvec2 size_mm =
      positionOf(fdi) >= kFirstPremolar ? kFilmSize_mm : glm::dvec2(kFilmSize_mm.y, kFilmSize_mm.x);
  view.size_px = glm::ivec2(glm::round(size_mm / view.pixel_mm));
  const glm::dvec3 shadow_P_mm = middle_P_mm - kFilm_mm / std::cos(shift) * to_tube_P;
  const glm::dvec2 half_mm = 0.5 * view.pixel_mm * glm::dvec2(view.size_px - 1);
  view.corner_P_mm = shadow_P_mm - half_mm.x * view.right_P - half_mm.y * view.down_P;
  return view;
}

std::vector<float> radiographOf(const VolumeGrid& grid, std::span<const std::uint8_t> solid,
                                std::span<const std::uint8_t> label, const PeriapicalView& view) {
  assert(solid.size() == grid.voxelCount() && (label.empty() || label.size() == solid.size()));
  const auto columns = static_cast<std::size_t>(view.size_px.x), rows = static_cast<std::size_t>(view.size_px.y);
  std::vector<float> bone_mm(columns * rows, 0.0f);
  const glm::dvec3 half_P_mm =
      0.5 * view.pixel_mm *
      (static_cast<double>(columns - 1) * view.right_P + static_cast<double>(rows - 1) * view.down_P);
  const int across = longestAxis(view.corner_P_mm + half_P_mm - view.source_P_mm);
  const Slab slab = slabOf(grid, solid, label, view, across);
  if (slab.attenuation.empty()) return bone_mm;

  struct Ray {
    float a, b, a_step, b_step;  ///< in its plane, of the slab's first plane and per plane
    float mm;                    ///< of the way between two planes
    int first, end;              ///< planes before the film
  };
  std::vector<Ray> rays(columns);
  std::vector<float> sum(columns);
  const glm::dvec3 source = grid.indexFromPoint(view.source_P_mm);
  const std::size_t row_step = static_cast<std::size_t>(slab.size.x),
                    plane_step = row_step * static_cast<std::size_t>(slab.size.y);
  for (std::size_t y = 0; y < rows; ++y) {
    for (std::size_t x = 0; x < columns; ++x) {
      const glm::dvec3 film =
          grid.indexFromPoint(view.corner_P_mm + view.pixel_mm * (static_cast<double>(x) * view.right_P +
                                                                  static_cast<double>(y) * view.down_P));
      const glm::dvec3 way = (film - source) / (film[across] - source[across]);
      const glm::dvec3 at = source + (slab.low.z - source[across]) * way;
      // Planes lie between the tube and the film.
      const double end_a = source[across] - slab.low.z, end_b = film[across] - slab.low.z;
      rays[x] = {static_cast<float>(at[slab.axis[0]] - slab.low.x),
                 static_cast<float>(at[slab.axis[1]] - slab.low.y),
                 static_cast<float>(way[slab.axis[0]]),
                 static_cast<float>(way[slab.axis[1]]),
                 static_cast<float>(glm::length(way) * grid.spacing_mm / kBone),
                 std::max(0, static_cast<int>(std::ceil(std::min(end_a, end_b)))),
                 std::min(slab.size.z, static_cast<int>(std::floor(std::max(end_a, end_b))) + 1)};
    }
    std::ranges::fill(sum, 0.0f);
    for (int plane = 0; plane < slab.size.z; ++plane) {
      const std::uint8_t* voxels = slab.attenuation.data() + static_cast<std::size_t>(plane) * plane_step;
      for (std::size_t x = 0; x < columns; ++x) {
        const Ray& ray = rays[x];
        const float a = ray.a + static_cast<float>(plane) * ray.a_step,
                    b = ray.b + static_cast<float>(plane) * ray.b_step;
        const bool inside = a >= 0.0f && b >= 0.0f && a < static_cast<float>(slab.size.x - 1) &&
                            b < static_cast<float>(slab.size.y - 1) && plane >= ray.first && plane < ray.end;
        if (!inside) continue;
        const int i = static_cast<int>(a), j = static_cast<int>(b);
        const float u = a - static_cast<float>(i), w = b - static_cast<float>(j);
        const std::uint8_t* at = voxels + static_cast<std::size_t>(j) * row_step + static_cast<std::size_t>(i);
        const float near = static_cast<float>(at[0]) * (1.0f - u) + static_cast<float>(at[1]) * u;
        const float far = static_cast<float>(at[row_step]) * (1.0f - u) + static_cast<float>(at[row_step + 1]) * u;
        sum[x] += near * (1.0f - w) + far * w;
      }
    }
    for (std::size_t x = 0; x < columns; ++x) bone_mm[y * columns + x] = sum[x] * rays[x].mm;
  }
  return bone_mm;
}

}  // namespace assets
