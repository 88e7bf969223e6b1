#include "app/case/trough_plan.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "app/case/gutter_plan.h"
#include "assets/solid_sample.h"
#include "assets/synthetic/face.h"
#include "assets/tooth.h"

namespace app {
namespace {

using assets::CtVolume;
using assets::isRight;
using assets::solidAt;
using assets::Tissue;

constexpr double kHalfLength_mm = 4.0, kStation_mm = 0.5, kMaxSlope = 0.8, kMaxRoughness_mm = 0.8;
constexpr std::size_t kStations = 17, kMinStations = 7;
constexpr double kRayStart_mm = 12.0, kRayLength_mm = 20.0, kRayStep_mm = 0.05;
constexpr double kTroughDepth_mm = 4.0, kToothMargin_mm = 0.7;
constexpr double kNeighbourhood_mm = 22.0;
constexpr double kNextTo_mm = 14.0, kMinElongation = 2.0;
constexpr double kSearch_mm = 40.0, kSearchStep_mm = 4.0;

struct Hit {
  glm::dvec3 p_P_mm;
  bool bone;
};

/// First solid point along a ray.
std::optional<Hit> firstSolid(const CtVolume& ct, const glm::dvec3& from_P_mm, const glm::dvec3& direction_P,
                              double length_mm) {
  for (double t = 0.0; t < length_mm; t += kRayStep_mm) {
    const glm::dvec3 p = from_P_mm + t * direction_P;
    if (solidAt(ct, p) < 0.5) continue;
    // The surface is soft and labels are not: sample the label half a millimetre below.
    const glm::ivec3 below = glm::ivec3(glm::round(ct.grid.indexFromPoint(p + 0.5 * direction_P)));
    const auto label = ct.grid.contains(below) ? Tissue{ct.label[ct.grid.index(below)]} : Tissue::unlabelled;
    return Hit{p, label == Tissue::cortical || label == Tissue::trabecular};
  }
  return std::nullopt;
}

/// Whether another tooth lies within `clearance_mm` of the bur's path down from a point.
bool toothBelow(const CtVolume& ct, int site_fdi, const glm::dvec3& surface_P_mm, const glm::dvec3& outward,
                double clearance_mm) {
  const int reach = static_cast<int>(std::ceil(clearance_mm / ct.grid.spacing_mm));
  for (double depth = 0.0; depth <= kTroughDepth_mm; depth += 1.0) {
    const glm::dvec3 at = surface_P_mm - depth * outward;
    const glm::ivec3 middle = glm::ivec3(glm::round(ct.grid.indexFromPoint(at)));
    for (int k = -reach; k <= reach; ++k)
      for (int j = -reach; j <= reach; ++j)
        for (int i = -reach; i <= reach; ++i) {
          const glm::ivec3 ijk = middle + glm::ivec3(i, j, k);
          if (ct.grid.contains(ijk) && isOtherTooth(ct, ct.grid.index(ijk), site_fdi) &&
              glm::distance(ct.grid.centre_P_mm(ijk), at) < clearance_mm)
            return true;
        }
  }
  return false;
}

/// The bone's surface along a line over `middle`, from mesial to distal: the stations on one straight slope; none on a
/// slope as steep as the ramus.
std::vector<glm::dvec3> straightBone(const CtVolume& ct, int site_fdi, const glm::dvec3& middle,
                                     const glm::dvec3& distal, const glm::dvec3& outward, double clearance_mm) {
  std::vector<glm::dvec3> found;
  std::vector<glm::dvec2> way_and_height;
  glm::dvec2 mean{0.0};
  for (std::size_t n = 0; n < kStations; ++n) {
    const double s = kStation_mm * static_cast<double>(n) - kHalfLength_mm;
    const glm::dvec3 from = middle + s * distal + kRayStart_mm * outward;
    if (solidAt(ct, from) >= 0.5) continue;
    const auto hit = firstSolid(ct, from, -outward, kRayLength_mm);
    if (!hit || !hit->bone || toothBelow(ct, site_fdi, hit->p_P_mm, outward, clearance_mm)) continue;
    found.push_back(hit->p_P_mm);
    way_and_height.emplace_back(s, glm::dot(hit->p_P_mm, outward));
    mean += way_and_height.back();
  }
  if (found.size() < kMinStations) return {};

  // Least-squares line of height over way.
  mean /= static_cast<double>(found.size());
  double covariance = 0.0, variance = 0.0;
  for (const glm::dvec2& p : way_and_height) {
    covariance += (p.x - mean.x) * (p.y - mean.y);
    variance += (p.x - mean.x) * (p.x - mean.x);
  }
  const double slope = covariance / variance;
  if (std::abs(slope) > kMaxSlope) return {};
  std::vector<glm::dvec3> straight;
  for (std::size_t n = 0; n < found.size(); ++n)
    if (std::abs(way_and_height[n].y - mean.y - slope * (way_and_height[n].x - mean.x)) < kMaxRoughness_mm)
      straight.push_back(found[n]);
  return straight;
}

/// First and last index of the voxels within `radius_mm` of a point.
std::pair<glm::ivec3, glm::ivec3> indexBox(const assets::VolumeGrid& grid, const glm::dvec3& point_P_mm,
                                           double radius_mm) {
  const glm::ivec3 first(glm::floor(grid.indexFromPoint(point_P_mm - radius_mm)));
  const glm::ivec3 last(glm::ceil(grid.indexFromPoint(point_P_mm + radius_mm)));
  return {glm::max(first, glm::ivec3(0)), glm::min(last, grid.size - 1)};
}

/// A straight cut along stations on bone, from the first to the last.
assets::PlannedCut cutAlong(const std::vector<glm::dvec3>& surface, const glm::dvec3& outward, const glm::dvec3& aside,
                            double bur_radius_mm) {
  const glm::dvec3 along = glm::normalize(surface.back() - surface.front());
  const glm::dvec3 square = glm::normalize(outward - glm::dot(outward, along) * along);
  assets::StraightCut cut;
  cut.middle_P_mm = surface[surface.size() / 2];
  cut.outward_P = square;
  cut.lateral_P = glm::normalize(aside - glm::dot(aside, square) * square - glm::dot(aside, along) * along);
  cut.bur_radius_mm = bur_radius_mm;
  cut.length_mm = 2.0 * kHalfLength_mm;
  return assets::plannedAlong(cut);
}

/// A practice cut.
std::optional<assets::PlannedCut> planOnNearestBone(const assets::Patient& patient, double bur_radius_mm) {
  const int fdi = patient.operatedTooth();
  const glm::dvec3 outward = assets::surgeonEyeDirection(fdi);
  const glm::dvec3 side = glm::normalize(glm::cross(outward, assets::occlusalDirection_P(fdi)));
  const glm::dvec3 across = glm::cross(side, outward);

  // The first solid on the surgeon's line of sight is reachable; nearest lines first.
  const int steps = static_cast<int>(kSearch_mm / kSearchStep_mm);
  std::vector<glm::ivec2> offsets;
  for (int u = -steps; u <= steps; ++u)
    for (int v = -steps; v <= steps; ++v) offsets.emplace_back(u, v);
  std::ranges::stable_sort(offsets, {}, [](const glm::ivec2& p) { return p.x * p.x + p.y * p.y; });
  std::vector<glm::dvec3> best;
  for (const glm::ivec2& offset : offsets) {
    const glm::dvec3 seen =
        patient.focus_P_mm() + kSearchStep_mm * (double(offset.x) * side + double(offset.y) * across);
    const auto hit = firstSolid(patient.ct, seen + kSearch_mm * outward, -outward, 2.0 * kSearch_mm);
    if (!hit || !hit->bone) continue;
    std::vector<glm::dvec3> found =
        straightBone(patient.ct, 0, hit->p_P_mm, side, outward, bur_radius_mm + kToothMargin_mm);
    if (found.size() > best.size()) best = std::move(found);
    if (best.size() == kStations) break;
  }
  if (best.size() < kMinStations) return std::nullopt;
  return cutAlong(best, outward, across, bur_radius_mm);
}

}  // namespace

bool isOtherTooth(const CtVolume& ct, std::size_t v, int site_fdi) {
  const int fdi = ct.tooth.empty() ? 0 : ct.tooth[v];
  return fdi != 0 ? fdi != site_fdi : Tissue{ct.label[v]} == Tissue::other_teeth;
}

glm::dvec3 archDirection_P(const CtVolume& ct, const assets::OperativeSite& site) {
  // Distal is perpendicular to buccal: lateral at the incisors, posterior at the molars.
  const glm::dvec3 buccal = assets::buccalDirection_P(site.fdi);
  const glm::dvec3 usual(isRight(site.fdi) ? glm::dvec2(buccal.y, -buccal.x) : glm::dvec2(-buccal.y, buccal.x), 0.0);
  glm::dvec3 sum{0.0};
  glm::dmat2 spread(0.0);
  double count = 0.0;
  const bool ends_row = assets::positionOf(site.fdi) == 8;
  const double reach_mm = ends_row ? kNeighbourhood_mm : kNextTo_mm;
  const auto [first, last] = indexBox(ct.grid, site.centre_P_mm, reach_mm);
  for (int k = first.z; k <= last.z; ++k)
    for (int j = first.y; j <= last.y; ++j)
      for (int i = first.x; i <= last.x; ++i) {
        const glm::dvec3 p = ct.grid.centre_P_mm({i, j, k});
        if (!isOtherTooth(ct, ct.grid.index({i, j, k}), site.fdi) || glm::distance(p, site.centre_P_mm) > reach_mm)
          continue;
        sum += p;
        const glm::dvec2 offset(p - site.centre_P_mm);
        spread += glm::outerProduct(offset, offset);
        count += 1.0;
      }
  if (count == 0.0) return usual;
  if (ends_row) {
    glm::dvec3 along = site.centre_P_mm - sum / count;
    along.z = 0.0;
    return glm::length(along) > 1.0 ? glm::normalize(along) : usual;
  }
  // Eigenvalues of the spread: middle ± half.
  const double middle = 0.5 * (spread[0][0] + spread[1][1]);
  const double half = glm::length(glm::dvec2(0.5 * (spread[0][0] - spread[1][1]), spread[0][1]));
  if (middle + half < kMinElongation * (middle - half)) return usual;
  const double angle = 0.5 * std::atan2(2.0 * spread[0][1], spread[0][0] - spread[1][1]);
  const glm::dvec3 row(std::cos(angle), std::sin(angle), 0.0);
  return glm::dot(row, usual) < 0.0 ? -row : row;
}

std::optional<CutPlan> plannedCut(const assets::Patient& patient, double bur_radius_mm) {
  if (const auto trough = planGutter(patient, bur_radius_mm)) return CutPlan{*trough, CutKind::gutter};
  const auto practice = planOnNearestBone(patient, bur_radius_mm);
  return practice ? std::optional(CutPlan{*practice, CutKind::nearest_bone}) : std::nullopt;
}

}  // namespace app
