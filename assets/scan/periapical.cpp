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

/// In 1/100 of cortical bone: enamel 2.1, dentine 1.4, pulp and other soft tissue 0.3; spongy bone is mostly marrow,
/// caries has lost mineral, makers load fillings.
constexpr int kBone = 100;
constexpr std::array<int, kTissueCount> kAttenuation{kBone, kBone, 50,  140, 210, 140, 30,  30, 30,  30,
                                                     60,    110,   230, 230, 190, 190, 800, 10, 400, 800};

/// Attenuation of the voxels that the beam crosses, planes across it one after the other, with a border of air.
struct Slab {
  std::array<int, 3> axis{};       ///< of the grid: within a plane first and second, and across
  glm::ivec3 low{0}, size{0};      ///< in the order of `axis`
  std::vector<float> attenuation;  ///< as sums need it: a conversion at every sample costs a third of the time
  /// Of each plane: where a sample between four elements may be more than air.
  struct Shadow {
    glm::vec2 low{1.0f}, high{0.0f};
  };
  std::vector<Shadow> shadows;
};

void findShadows(Slab& slab) {
  slab.shadows.resize(static_cast<std::size_t>(std::max(slab.size.z, 0)));
  for (int plane = 0; plane < slab.size.z; ++plane) {
    glm::ivec2 low(slab.size), high(-1);
    for (int b = 0; b < slab.size.y; ++b) {
      const float* const row = slab.attenuation.data() + indexIn(slab.size, {0, b, plane});
      const auto is_any = [](float attenuation) { return attenuation != 0.0f; };
      const auto first = std::find_if(row, row + slab.size.x, is_any) - row;
      if (first == slab.size.x) continue;
      int last = slab.size.x - 1;
      while (row[last] == 0.0f) --last;
      low = {std::min(low.x, static_cast<int>(first)), std::min(low.y, b)};
      high = {std::max(high.x, last), b};
    }
    if (high.y >= 0) slab.shadows[static_cast<std::size_t>(plane)] = {glm::vec2(low - 1), glm::vec2(high + 1)};
  }
}

struct Ray {
  float a, b, a_step, b_step;  ///< in its plane, of the slab's first plane and per plane
  float mm;                    ///< of the way between two planes
  int first, end;              ///< planes before the film
};

/// To each of the rays of a row what they meet in a plane. Those that meet its shadow lie side by side.
void addPlane(const Slab& slab, int plane, const std::vector<Ray>& rays, std::vector<float>& sum) {
  const Slab::Shadow shadow = slab.shadows[static_cast<std::size_t>(plane)];
  const float depth = static_cast<float>(plane);
  const auto meets = [&](const Ray& ray) {
    const float a = ray.a + depth * ray.a_step, b = ray.b + depth * ray.b_step;
    return a >= shadow.low.x && b >= shadow.low.y && a < shadow.high.x && b < shadow.high.y && plane >= ray.first &&
           plane < ray.end;
  };
  std::size_t begin = 0, end = rays.size();
  while (begin < end && !meets(rays[begin])) ++begin;
  while (end > begin && !meets(rays[end - 1])) --end;
  const auto row_step = static_cast<std::size_t>(slab.size.x);
  const float* const voxels = slab.attenuation.data() + indexIn(slab.size, {0, 0, plane});
  for (std::size_t x = begin; x < end; ++x) {
    const Ray& ray = rays[x];
    const float a = ray.a + depth * ray.a_step, b = ray.b + depth * ray.b_step;
    const int i = static_cast<int>(a), j = static_cast<int>(b);
    const float u = a - static_cast<float>(i), w = b - static_cast<float>(j);
    const float* const at = voxels + static_cast<std::size_t>(j) * row_step + static_cast<std::size_t>(i);
    const float near = at[0] * (1.0f - u) + at[1] * u;
    const float far = at[row_step] * (1.0f - u) + at[row_step + 1] * u;
    sum[x] += near * (1.0f - w) + far * w;
  }
}

float attenuationOf(std::uint8_t solid, std::uint8_t label) {
  const std::uint8_t tissue = label < kTissueCount ? label : std::uint8_t{0};
  const int full = kAttenuation[tissue];
  // Tissue fills what lies between hard parts, a filling is where it was laid.
  const bool is_soft = tissue != 0 && !isHard(tissue) && tissue < kScanTissueCount;
  return static_cast<float>(is_soft ? full : (full * solid + 127) / 255);
}

Slab slabOf(const VolumeGrid& grid, std::span<const std::uint8_t> solid, std::span<const std::uint8_t> label,
            const PeriapicalView& view, int across, std::span<const std::uint8_t> share) {
  Slab slab;
  slab.axis = {(across + 1) % 3, (across + 2) % 3, across};
  if (slab.axis[0] > slab.axis[1]) std::swap(slab.axis[0], slab.axis[1]);

  // The box of the four edges of the beam, within the volume and before the film.
  const glm::dvec3 source = grid.indexFromPoint(view.source_P_mm);
  glm::dvec3 low(std::numeric_limits<double>::max()), high(-std::numeric_limits<double>::max());
  for (const glm::dvec2 corner : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1), glm::dvec2(1, 1)}) {
    const glm::dvec2 px = corner * glm::dvec2(view.size_px - 1);
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
  // A ray that grazes the last row may be rounded onto it: one row more is read, and is air.
  slab.attenuation.assign(countIn(slab.size) + static_cast<std::size_t>(slab.size.x) + 1, 0.0f);
  std::array<std::size_t, 3> step{};  // in the slab, along each axis of the grid
  const std::array<std::size_t, 3> steps{1, static_cast<std::size_t>(slab.size.x),
                                         static_cast<std::size_t>(slab.size.x) * static_cast<std::size_t>(slab.size.y)};
  for (std::size_t n = 0; n < 3; ++n) step[static_cast<std::size_t>(slab.axis[n])] = steps[n];
  for (int k = from.z; k < end.z; ++k)
    for (int j = from.y; j < end.y; ++j) {
      const glm::ivec3 ijk(from.x, j, k), at(ijk[slab.axis[0]], ijk[slab.axis[1]], ijk[slab.axis[2]]);
      float* to = slab.attenuation.data() + indexIn(slab.size, at - slab.low);
      const std::size_t first = grid.index(ijk), last = first + static_cast<std::size_t>(end.x - from.x);
      for (std::size_t v = first; v < last; ++v, to += step[0])
        *to = attenuationOf(solid[v], label.empty() ? 0 : label[v]) *
              (share.empty() ? 1.0f : static_cast<float>(share[v]) / 255.0f);
    }
  findShadows(slab);
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
                                std::span<const std::uint8_t> label, const PeriapicalView& view,
                                std::span<const std::uint8_t> share) {
  assert(share.empty() || share.size() == solid.size());
  assert(solid.size() == grid.voxelCount() && (label.empty() || label.size() == solid.size()));
  const auto columns = static_cast<std::size_t>(view.size_px.x), rows = static_cast<std::size_t>(view.size_px.y);
  std::vector<float> bone_mm(columns * rows, 0.0f);
  const glm::dvec3 half_P_mm =
      0.5 * view.pixel_mm *
      (static_cast<double>(columns - 1) * view.right_P + static_cast<double>(rows - 1) * view.down_P);
  const int across = longestAxis(view.corner_P_mm + half_P_mm - view.source_P_mm);
  const Slab slab = slabOf(grid, solid, label, view, across, share);
  if (slab.attenuation.empty()) return bone_mm;

  std::vector<Ray> rays(columns);
  std::vector<float> sum(columns);
  const glm::dvec3 source = grid.indexFromPoint(view.source_P_mm);
  const glm::dvec3 corner = grid.indexFromPoint(view.corner_P_mm);
  const glm::dvec3 right = view.pixel_mm / grid.spacing_mm * view.right_P,
                   down = view.pixel_mm / grid.spacing_mm * view.down_P;
  for (std::size_t y = 0; y < rows; ++y) {
    const glm::dvec3 row_begin = corner + static_cast<double>(y) * down;
    for (std::size_t x = 0; x < columns; ++x) {
      const glm::dvec3 film = row_begin + static_cast<double>(x) * right;
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
    for (int plane = 0; plane < slab.size.z; ++plane) addPlane(slab, plane, rays, sum);
    for (std::size_t x = 0; x < columns; ++x) bone_mm[y * columns + x] = sum[x] * rays[x].mm;
  }
  return bone_mm;
}

}  // namespace assets
