#include "assets/import/modelled_gum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "assets/scan/exact_distance.h"
#include "assets/segment/cell_masks.h"
#include "assets/tissue.h"
#include "assets/tooth.h"

namespace assets {
namespace {

constexpr double kAir_hu = -300.0, kSoft_hu = 400.0;
constexpr double kOnCrown_mm = 1.0, kAttached_mm = 10.0, kBesideTooth_mm = 5.0, kBehindTeeth_mm = 4.0;
constexpr double kBuried_mm = 3.0;  ///< a crown that lies so deep has not come through
constexpr double kLeastSoftShare = 0.3;

/// A tooth as gum stands to it.
struct Neck {
  glm::dvec2 at_P_mm{0.0};
  double neck_z_mm = 0.0, top_z_mm = 0.0;
  bool is_buried = false;
};

struct Necks {
  std::vector<Neck> teeth;
  std::array<std::uint8_t, 256> is_buried{};
};

Necks necksOf(const VolumeGrid& grid, const std::vector<std::uint8_t>& jaw_label,
              const std::vector<std::uint8_t>& tooth) {
  struct Of {
    double count = 0.0, low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
    glm::dvec2 sum{0.0};
  };
  std::array<Of, 256> all{};
  forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (tooth[v] == 0 || Tissue{jaw_label[v]} != Tissue::enamel) return;
    Of& of = all[tooth[v]];
    const glm::dvec3 p = grid.centre_P_mm(ijk);
    of.count += 1.0, of.sum += glm::dvec2(p);
    of.low = std::min(of.low, p.z), of.high = std::max(of.high, p.z);
  });
  Necks necks;
  std::vector<double> tops;
  for (std::size_t fdi = 31; fdi < 49; ++fdi)
    if (all[fdi].count > 0.0 && positionOf(static_cast<int>(fdi)) != 8) tops.push_back(all[fdi].high);
  if (tops.empty()) return necks;
  for (std::size_t fdi = 31; fdi < 49; ++fdi) {
    const Of& of = all[fdi];
    if (of.count == 0.0) continue;
    Neck neck{of.sum / of.count, of.low, of.high, false};
    // Against the nearest other tooth that is no third molar.
    double nearest_mm = 1e9, beside_mm = 0.0;
    for (std::size_t other = 31; other < 49; ++other) {
      if (other == fdi || all[other].count == 0.0 || positionOf(static_cast<int>(other)) == 8) continue;
      const double away_mm = glm::distance(neck.at_P_mm, all[other].sum / all[other].count);
      if (away_mm < nearest_mm) nearest_mm = away_mm, beside_mm = all[other].high;
    }
    neck.is_buried =
        positionOf(static_cast<int>(fdi)) == 8 && nearest_mm < 1e8 && neck.top_z_mm < beside_mm - kBuried_mm;
    necks.is_buried[fdi] = neck.is_buried ? 1 : 0;
    necks.teeth.push_back(neck);
  }
  return necks;
}

}  // namespace

std::vector<std::size_t> modelledGum(const VolumeGrid& grid, const std::vector<std::int16_t>& hounsfield,
                                     const std::vector<std::uint8_t>& jaw_label,
                                     const std::vector<std::uint8_t>& tooth) {
  const Necks necks = necksOf(grid, jaw_label, tooth);
  if (necks.teeth.empty()) return {};
  double lowest = std::numeric_limits<double>::max(), highest = std::numeric_limits<double>::lowest();
  for (const Neck& neck : necks.teeth) {
    if (neck.is_buried) continue;
    lowest = std::min(lowest, neck.neck_z_mm - kAttached_mm);
    highest = std::max(highest, neck.top_z_mm + kBehindTeeth_mm);
  }
  if (lowest > highest) return {};
  const auto layer = [&](double z_mm) {
    return static_cast<int>(std::floor((z_mm - grid.origin_P_mm.z) / grid.spacing_mm));
  };
  CellBox box{{0, 0, std::clamp(layer(lowest) - 8, 0, grid.size.z)},
              {grid.size.x, grid.size.y, std::clamp(layer(highest) + 8, 0, grid.size.z)}};
  if (box.isEmpty()) return {};
  const glm::ivec3 size = box.size();
  // What gum lies on.
  CellMask carries(countIn(size), 0);
  forCells(size, [&](glm::ivec3 ijk, std::size_t n) {
    const std::size_t v = grid.index(box.low + ijk);
    const Tissue tissue{jaw_label[v]};
    const bool is_bone =
        tissue == Tissue::cortical || tissue == Tissue::trabecular || tissue == Tissue::mandibular_canal;
    if (is_bone || (tooth[v] != 0 && necks.is_buried[tooth[v]] != 0)) carries[n] = 1;
  });
  const CellBox around = boxOfCells(size, carries).grown(static_cast<int>(4.0 / grid.spacing_mm), size);
  if (around.isEmpty()) return {};
  const CellMask near = croppedTo(around, size, carries);
  const std::vector<float> off_mm = exactDistance_mm(around.size(), grid.spacing_mm, near);

  std::vector<std::size_t> soft, empty;
  forCells(around.size(), [&](glm::ivec3 ijk, std::size_t n) {
    const double away_mm = static_cast<double>(off_mm[n]);
    if (!(away_mm > 0.0) || away_mm > kGumThickness_mm) return;
    const glm::ivec3 at = box.low + around.low + ijk;
    const std::size_t v = grid.index(at);
    if (jaw_label[v] != 0 || static_cast<double>(hounsfield[v]) > kSoft_hu) return;
    const glm::dvec3 p = grid.centre_P_mm(at);
    // Up to the neck beside a tooth that has come through; behind the last one up to the bite.
    const Neck* nearest = nullptr;
    double nearest_mm = 1e9;
    for (const Neck& neck : necks.teeth)
      if (const double mm = glm::distance(neck.at_P_mm, glm::dvec2(p)); !neck.is_buried && mm < nearest_mm)
        nearest = &neck, nearest_mm = mm;
    if (nearest == nullptr) return;
    const double top_mm =
        nearest_mm < kBesideTooth_mm ? nearest->neck_z_mm + kOnCrown_mm : nearest->top_z_mm + kBehindTeeth_mm;
    if (p.z > top_mm || p.z < nearest->neck_z_mm - kAttached_mm) return;
    (static_cast<double>(hounsfield[v]) > kAir_hu ? soft : empty).push_back(v);
  });
  if (static_cast<double>(soft.size()) < kLeastSoftShare * static_cast<double>(soft.size() + empty.size()))
    soft.insert(soft.end(), empty.begin(), empty.end());
  return soft;
}

}  // namespace assets
