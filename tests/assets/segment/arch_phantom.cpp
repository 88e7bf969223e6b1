#include "tests/assets/segment/arch_phantom.h"

#include <tbb/parallel_for.h>

#include <array>
#include <cmath>

#include "assets/segment/cell_filters.h"

namespace tests {
namespace {

constexpr std::array<double, 9> kWidth_mm = {0.0, 5.0, 5.5, 7.0, 7.0, 7.0, 11.0, 10.5, 10.0};
constexpr std::array<double, 9> kDepth_mm = {0.0, 6.0, 6.5, 7.5, 7.5, 8.0, 10.5, 10.0, 9.5};
constexpr double kAside_mm = 25.0, kBack_mm = 48.0;  ///< half axes of the arch
constexpr double kCrown_mm = 7.0, kRoot_mm = 13.0, kEnamel_mm = 1.7, kAlveolus_mm = 6.5, kBase_mm = -30.0;

glm::dvec2 onArch(double angle) { return {kAside_mm * std::sin(angle), -kBack_mm * std::cos(angle)}; }

struct Tooth {
  int fdi;
  glm::dvec2 centre, along, across;
  double half_width, half_depth, down_mm;
};

/// From the middle to both sides, by their widths.
std::vector<Tooth> rowOfTeeth(const std::set<int>& missing) {
  std::vector<Tooth> row;
  double at_mm = 0.0, angle = 0.0, walked_mm = 0.0;
  for (std::size_t position = 1; position <= 8; ++position) {
    const double target_mm = at_mm + 0.5 * kWidth_mm[position];
    constexpr double kStep = 1e-4;
    while (walked_mm < target_mm) {
      walked_mm += glm::distance(onArch(angle), onArch(angle + kStep));
      angle += kStep;
    }
    at_mm += kWidth_mm[position];
    const glm::dvec2 along = glm::normalize(onArch(angle + kStep) - onArch(angle));
    for (const int quadrant : {30, 40}) {
      const int fdi = quadrant + static_cast<int>(position);
      const double side = quadrant == 30 ? 1.0 : -1.0;
      if (missing.contains(fdi)) continue;
      row.push_back({fdi, onArch(angle) * glm::dvec2(side, 1.0), along * glm::dvec2(side, 1.0),
                     glm::dvec2(along.y, -along.x) * glm::dvec2(side, 1.0), 0.46 * kWidth_mm[position],
                     0.5 * kDepth_mm[position], position == 8 ? 3.0 : 0.0});
    }
  }
  return row;
}

/// Below 1 inside a tooth whose sides are `inset_mm` further in.
double shapeAt(const Tooth& tooth, const glm::dvec3& p, double inset_mm) {
  const glm::dvec2 away = glm::dvec2(p) - tooth.centre;
  const double down_mm = -p.z - tooth.down_mm;
  if (down_mm < inset_mm || down_mm > kCrown_mm + kRoot_mm - inset_mm) return 2.0;
  const double taper = down_mm < kCrown_mm ? 1.0 : 1.0 - 0.6 * (down_mm - kCrown_mm) / kRoot_mm;
  const double u = glm::dot(away, tooth.along) / (taper * tooth.half_width - inset_mm);
  const double v = glm::dot(away, tooth.across) / (taper * tooth.half_depth - inset_mm);
  return u * u + v * v;
}

/// Along the arch up to below the crowns; behind it the rami.
bool isBone(const glm::dvec3& p, double inset_mm) {
  const double crest_mm = -kCrown_mm - 1.5;
  if (p.z < kBase_mm + inset_mm) return false;
  if (p.y > 0.0) {
    const double aside = std::abs(std::abs(p.x) - kAside_mm), top_mm = p.y < 6.0 + inset_mm ? crest_mm : 18.0;
    return aside < 5.5 - inset_mm && p.y < 26.0 - inset_mm && p.z < top_mm - inset_mm;
  }
  const double angle = std::atan2(p.x / kAside_mm, -p.y / kBack_mm);
  const double aside = std::abs(glm::length(glm::dvec2(p)) - glm::length(onArch(angle)));
  return aside < kAlveolus_mm - inset_mm && p.z < crest_mm - inset_mm;
}

double noiseAt(std::uint64_t n) {
  n ^= n >> 33, n *= 0xff51afd7ed558ccdULL, n ^= n >> 33, n *= 0xc4ceb9fe1a85ec53ULL, n ^= n >> 33;
  return (static_cast<double>(n >> 11) * 0x1.0p-53 - 0.5) * 3.4641016;
}

}  // namespace

ArchPhantom archPhantom(const ArchPhantomOptions& options) {
  ArchPhantom phantom;
  const glm::ivec3 size(glm::dvec3(80.0, 96.0, 66.0) / options.spacing_mm);
  const glm::dvec3 middle(0.0, -14.0, -6.0);
  phantom.grid = {size, options.spacing_mm, middle - 0.5 * options.spacing_mm * glm::dvec3(size - 1)};
  const std::vector<Tooth> row = rowOfTeeth(options.missing);
  std::vector<float> hu(phantom.grid.voxelCount());
  phantom.jaw.assign(hu.size(), 0);
  phantom.tooth.assign(hu.size(), 0);
  tbb::parallel_for(0, size.z, [&](int k) {
    assets::forVoxels({0, 0, k}, {size.x, size.y, k + 1}, [&](glm::ivec3 ijk) {
      const std::size_t v = phantom.grid.index(ijk);
      glm::dvec3 p = phantom.grid.centre_P_mm(ijk - options.shift);
      if (options.is_mirrored) p.x = -p.x;
      p.x -= 0.2;  // no layer of voxels lies in the middle
      if (options.is_upside_down) p.z = -p.z - 12.0;
      double value = -1000.0 + (std::abs(p.x) < 38.0 && p.y < 30.0 && p.y > -56.0 && p.z < -2.0 ? 1060.0 : 0.0);
      if (isBone(p, 0.0)) value = isBone(p, 2.0) ? 350.0 : 1250.0, phantom.jaw[v] = 1;
      for (const Tooth& tooth : row) {
        if (shapeAt(tooth, p, 0.0) >= 1.0) continue;
        const bool is_enamel = -p.z - tooth.down_mm < kCrown_mm && shapeAt(tooth, p, kEnamel_mm) >= 1.0;
        value = is_enamel ? 2500.0 : 1650.0;
        phantom.jaw[v] = 1;
        phantom.tooth[v] = static_cast<std::uint8_t>(
            options.is_mirrored ? (tooth.fdi < 40 ? tooth.fdi + 10 : tooth.fdi - 10) : tooth.fdi);
      }
      hu[v] = static_cast<float>(value);
    });
  });
  assets::smoothCells(size, 0.3 / options.spacing_mm, hu);
  phantom.hounsfield.resize(hu.size());
  assets::forVoxels(phantom.grid, [&](glm::ivec3 ijk, std::size_t v) {
    // Noise goes with the jaw, so that a shifted or mirrored jaw is the same.
    glm::ivec3 own = ijk - options.shift;
    if (options.is_mirrored) own.x = size.x - 1 - own.x;
    const double noise = options.noise_hu * noiseAt(assets::indexIn(size, (own + size) % size));
    phantom.hounsfield[v] = static_cast<std::int16_t>(std::lround(static_cast<double>(hu[v]) + noise));
  });
  return phantom;
}

}  // namespace tests
