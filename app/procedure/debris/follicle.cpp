#include "app/procedure/debris/follicle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>

#include "app/case/operated_crown.h"

namespace app {
namespace {

using assets::Tissue;

constexpr double kFromEnamel_mm = 2.0, kBeside_mm = 3.0, kOffRoot_mm = 0.5, kCell_mm = 2.0, kCellStep_mm = 0.25;
constexpr double kLeastBlob_mm3 = 1.0;
constexpr double kFollicleStep_s = 0.01;

struct AroundCrown {
  std::vector<glm::dvec3> follicle_P_mm, enamel_P_mm;  ///< middles of voxels
};

/// A flood from the enamel through what is labelled ligament.
AroundCrown aroundCrown(const assets::Patient& patient) {
  const assets::CtVolume& ct = patient.ct;
  const assets::VolumeGrid& grid = ct.grid;
  struct Reached {
    glm::ivec3 ijk, enamel;
  };
  std::vector<Reached> front;
  std::vector<std::uint8_t> seen(grid.voxelCount(), 0);
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (Tissue{ct.label[v]} != Tissue::enamel || !isOfTooth(ct, v, patient.site->fdi)) return;
    front.push_back({ijk, ijk});
  });
  const double most = kFromEnamel_mm / grid.spacing_mm;
  const int near = static_cast<int>(std::ceil(kOffRoot_mm / grid.spacing_mm));
  const auto is_at_root = [&](glm::ivec3 ijk) {
    bool found = false;
    assets::forVoxels(glm::max(ijk - near, glm::ivec3(0)), glm::min(ijk + near + 1, grid.size), [&](glm::ivec3 at) {
      const std::size_t v = grid.index(at);
      found = found || (Tissue{ct.label[v]} == Tissue::dentine && isOfTooth(ct, v, patient.site->fdi) &&
                        glm::length(glm::dvec3(at - ijk)) * grid.spacing_mm <= kOffRoot_mm);
    });
    return found;
  };
  AroundCrown found;
  for (const Reached& one : front) found.enamel_P_mm.push_back(grid.centre_P_mm(one.ijk));
  for (std::size_t n = 0; n < front.size(); ++n) {
    const Reached from = front[n];
    for (int axis = 0; axis < 3; ++axis)
      for (const int step : {-1, 1}) {
        glm::ivec3 at = from.ijk;
        at[axis] += step;
        if (!grid.contains(at)) continue;
        const std::size_t v = grid.index(at);
        if (Tissue{ct.label[v]} != Tissue::ligament || glm::length(glm::dvec3(at - from.enamel)) > most ||
            std::exchange(seen[v], std::uint8_t{1}) != 0)
          continue;
        front.push_back({at, from.enamel});
        if (!is_at_root(at)) found.follicle_P_mm.push_back(grid.centre_P_mm(at));
      }
  }
  return found;
}

struct Cell {
  double count = 0.0;
  glm::dvec3 sum_mm{0.0};
};

std::vector<FollicleBlob> gathered(const std::vector<glm::dvec3>& voxels_P_mm, double voxel_mm3, double cell_mm) {
  std::map<std::tuple<int, int, int>, Cell> cells;
  for (const glm::dvec3& p : voxels_P_mm) {
    const glm::ivec3 at(glm::floor(p / cell_mm));
    Cell& cell = cells[{at.x, at.y, at.z}];
    cell.count += 1.0;
    cell.sum_mm += p;
  }
  std::vector<FollicleBlob> blobs;
  std::vector<Cell> small;
  for (const auto& [at, cell] : cells) {
    if (cell.count * voxel_mm3 < kLeastBlob_mm3)
      small.push_back(cell);
    else
      blobs.push_back({.at_P_mm = cell.sum_mm / cell.count, .volume_mm3 = cell.count * voxel_mm3});
  }
  // What is too little for a blob of its own belongs to the nearest.
  for (const Cell& cell : small) {
    if (blobs.empty()) break;
    const glm::dvec3 middle = cell.sum_mm / cell.count;
    std::ranges::min_element(blobs, {}, [&](const FollicleBlob& blob) {
      return glm::distance(blob.at_P_mm, middle);
    })->volume_mm3 += cell.count * voxel_mm3;
  }
  for (FollicleBlob& blob : blobs) blob.radius_mm = std::cbrt(0.75 * blob.volume_mm3 / std::numbers::pi);
  return blobs;
}

}  // namespace

std::vector<FollicleBlob> follicleOf(const assets::Patient& patient) {
  if (!patient.site || patient.ct.label.empty()) return {};
  const AroundCrown around = aroundCrown(patient);
  double cell_mm = kCell_mm;
  std::vector<FollicleBlob> blobs;
  do {
    blobs = gathered(around.follicle_P_mm, patient.ct.grid.voxelVolume_mm3(), cell_mm);
    cell_mm += kCellStep_mm;
  } while (blobs.size() > kMostBlobs);
  for (FollicleBlob& blob : blobs) {
    // Away from the enamel beside it.
    glm::dvec3 outward(0.0);
    for (const glm::dvec3& p : around.enamel_P_mm)
      if (glm::distance(p, blob.at_P_mm) < kBeside_mm) outward += blob.at_P_mm - p;
    if (glm::length(outward) > 0.0) blob.outward_P = glm::normalize(outward);
  }
  return blobs;
}

void Follicle::scrape(const haptics::Tick& tick, double tip_radius_mm) {
  const double force_N = glm::length(tick.law_force_P_N.xyz);
  if (force_N < kScrape_N || tick.depth_mm <= 0.0) return last_P_mm_.reset();
  const glm::dvec3 here = tick.proxy_P.mm, normal = tick.law_force_P_N.xyz / force_N;
  const std::optional<glm::dvec3> before = std::exchange(last_P_mm_, here);
  if (!before) return;
  const glm::dvec3 moved = here - *before;
  const double way_mm = glm::length(moved - glm::dot(moved, normal) * normal);
  for (FollicleBlob& blob : blobs_) {
    if (blob.state != FollicleBlob::State::stuck || glm::distance(blob.at_P_mm, here) > tip_radius_mm + kScrapeReach_mm)
      continue;
    blob.stuck -= way_mm / kScraped_mm;
    if (blob.stuck <= 0.0) blob.stuck = 0.0, blob.state = FollicleBlob::State::loose;
  }
}

void Follicle::follow(const haptics::Tick& tick, const haptics::Tool& tool, const std::optional<SuctionTip>& tip) {
  if (tool.hand_instrument == haptics::HandInstrument::curette)
    scrape(tick, tool.head.radius_mm);
  else
    last_P_mm_.reset();
  step_s_ += tick.dt_s;
  if (step_s_ < kFollicleStep_s) return;
  step_s_ -= kFollicleStep_s;
  for (FollicleBlob& blob : blobs_) {
    if (blob.state == FollicleBlob::State::taken) continue;
    if (tick.drilling && glm::distance(blob.at_P_mm, tick.proxy_P.mm) < tool.head.radius_mm) {
      blob.state = FollicleBlob::State::taken;
      continue;
    }
    if (blob.state != FollicleBlob::State::loose) continue;
    const bool gripped = tool.grips && tick.hand.drill_pedal && tick.gripped == 0 &&
                         glm::distance(blob.at_P_mm, tick.proxy_P.mm) < kForcepsReach_mm;
    const auto is_free = [](const glm::dvec3&) { return true; };
    if (gripped || (tip && drawTowards(*tip, blob.radius_mm, kFollicleStep_s, is_free, blob.at_P_mm)))
      blob.state = FollicleBlob::State::taken;
  }
}

void Follicle::letLoose(const IsBare& is_bare) {
  for (FollicleBlob& blob : blobs_)
    if (blob.state == FollicleBlob::State::stuck && is_bare(blob.at_P_mm, blob.radius_mm + kHolds_mm))
      blob.stuck = 0.0, blob.state = FollicleBlob::State::loose;
}

std::optional<double> Follicle::left() const {
  double all_mm3 = 0.0, left_mm3 = 0.0;
  for (const FollicleBlob& blob : blobs_) {
    all_mm3 += blob.volume_mm3;
    if (blob.state != FollicleBlob::State::taken) left_mm3 += blob.volume_mm3;
  }
  return all_mm3 > 0.0 ? std::optional(left_mm3 / all_mm3) : std::nullopt;
}

}  // namespace app
