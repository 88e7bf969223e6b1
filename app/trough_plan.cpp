#include "app/trough_plan.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "assets/solid_sample.h"

namespace app {
namespace {

using assets::CtVolume;
using assets::solidAt;
using assets::Tissue;

constexpr double kHalfLength_mm = 4.0, kStation_mm = 0.5, kSteepest = 0.8, kRoughest_mm = 0.8;
constexpr std::size_t kStations = 17, kFewestStations = 7;
constexpr double kRayStart_mm = 12.0, kRayLength_mm = 20.0, kRayStep_mm = 0.05;
constexpr double kTroughDepth_mm = 4.0, kToothMargin_mm = 0.7;
constexpr double kCrownFromCentroid_mm = 3.5;
constexpr double kNearestBuccal_mm = 5.0, kFarthestBuccal_mm = 9.0, kFarthestMesial_mm = -5.0;

struct Hit {
  glm::dvec3 p_P_mm;
  bool bone;
};

/// First solid point along a ray, and whether it is bone.
std::optional<Hit> firstSolid(const CtVolume& ct, const glm::dvec3& from_P_mm, const glm::dvec3& direction_P) {
  for (double t = 0.0; t < kRayLength_mm; t += kRayStep_mm) {
    const glm::dvec3 p = from_P_mm + t * direction_P;
    if (solidAt(ct, p) < 0.5) continue;
    // Labels are crisp and the surface soft: ask half a millimetre below it.
    const glm::ivec3 below = glm::ivec3(glm::round(ct.grid.indexFromPoint(p + 0.5 * direction_P)));
    const auto label = ct.grid.contains(below) ? Tissue{ct.label[ct.grid.index(below)]} : Tissue::unlabelled;
    return Hit{p, label == Tissue::cortical || label == Tissue::trabecular};
  }
  return std::nullopt;
}

/// Whether a tooth that must not be touched stands within `clearance_mm` of the way the bur takes down from a point.
bool toothBelow(const CtVolume& ct, const glm::dvec3& surface_P_mm, const glm::dvec3& outward, double clearance_mm) {
  const int reach = static_cast<int>(std::ceil(clearance_mm / ct.grid.spacing_mm));
  for (double depth = 0.0; depth <= kTroughDepth_mm; depth += 1.0) {
    const glm::dvec3 at = surface_P_mm - depth * outward;
    const glm::ivec3 middle = glm::ivec3(glm::round(ct.grid.indexFromPoint(at)));
    for (int k = -reach; k <= reach; ++k)
      for (int j = -reach; j <= reach; ++j)
        for (int i = -reach; i <= reach; ++i) {
          const glm::ivec3 ijk = middle + glm::ivec3(i, j, k);
          if (ct.grid.contains(ijk) && Tissue{ct.label[ct.grid.index(ijk)]} == Tissue::other_teeth &&
              glm::distance(ct.grid.centre_P_mm(ijk), at) < clearance_mm)
            return true;
        }
  }
  return false;
}

/// The bone's surface along a line over `middle`, from mesial to distal: the stations that lie on one straight slope,
/// none if it climbs like the ramus.
std::vector<glm::dvec3> straightBone(const CtVolume& ct, const glm::dvec3& middle, const glm::dvec3& distal,
                                     const glm::dvec3& outward, double clearance_mm) {
  std::vector<glm::dvec3> found;
  std::vector<glm::dvec2> way_and_height;
  glm::dvec2 mean{0.0};
  for (std::size_t n = 0; n < kStations; ++n) {
    const double s = kStation_mm * static_cast<double>(n) - kHalfLength_mm;
    const glm::dvec3 from = middle + s * distal + kRayStart_mm * outward;
    if (solidAt(ct, from) >= 0.5) continue;
    const auto hit = firstSolid(ct, from, -outward);
    if (!hit || !hit->bone || toothBelow(ct, hit->p_P_mm, outward, clearance_mm)) continue;
    found.push_back(hit->p_P_mm);
    way_and_height.emplace_back(s, glm::dot(hit->p_P_mm, outward));
    mean += way_and_height.back();
  }
  if (found.size() < kFewestStations) return {};

  // Least-squares line of height over way.
  mean /= static_cast<double>(found.size());
  double covariance = 0.0, variance = 0.0;
  for (const glm::dvec2& p : way_and_height) {
    covariance += (p.x - mean.x) * (p.y - mean.y);
    variance += (p.x - mean.x) * (p.x - mean.x);
  }
  const double slope = covariance / variance;
  if (std::abs(slope) > kSteepest) return {};
  std::vector<glm::dvec3> straight;
  for (std::size_t n = 0; n < found.size(); ++n)
    if (std::abs(way_and_height[n].y - mean.y - slope * (way_and_height[n].x - mean.x)) < kRoughest_mm)
      straight.push_back(found[n]);
  return straight;
}

/// Direction of the dental arch at the third molar, mesial to distal, horizontal.
glm::dvec3 archDirection(const CtVolume& ct, const glm::dvec3& third_molar_P_mm) {
  glm::dvec3 sum{0.0};
  double count = 0.0;
  for (int k = 0; k < ct.grid.size.z; ++k)
    for (int j = 0; j < ct.grid.size.y; ++j)
      for (int i = 0; i < ct.grid.size.x; ++i) {
        if (Tissue{ct.label[ct.grid.index({i, j, k})]} != Tissue::other_teeth) continue;
        const glm::dvec3 p = ct.grid.centre_P_mm({i, j, k});
        if (glm::distance(p, third_molar_P_mm) > 22.0) continue;
        sum += p;
        count += 1.0;
      }
  if (count == 0.0) return {0.0, 1.0, 0.0};
  glm::dvec3 along = third_molar_P_mm - sum / count;
  along.z = 0.0;
  return glm::length(along) > 1.0 ? glm::normalize(along) : glm::dvec3(0.0, 1.0, 0.0);
}

}  // namespace

std::optional<haptics::TroughPlan> planBuccalTrough(const assets::Patient& patient, double bur_radius_mm) {
  if (!patient.site.known) return std::nullopt;
  const glm::dvec3 distal = archDirection(patient.ct, patient.site.third_molar_P_mm), up{0.0, 0.0, 1.0};
  const double lateral_x = patient.site.tooth_fdi == 48 ? -1.0 : 1.0;
  glm::dvec3 buccal = glm::cross(up, distal);
  if (buccal.x * lateral_x < 0.0) buccal = -buccal;
  const glm::dvec3 outward = glm::normalize(0.45 * buccal + up);
  const glm::dvec3 crown = patient.site.third_molar_P_mm + kCrownFromCentroid_mm * patient.site.crown_direction_P;

  // Walk mesially along the crown and outwards from it until the line lies on bone all along and does not climb the
  // ramus.
  std::vector<glm::dvec3> surface;
  for (double shift = 0.0; shift >= kFarthestMesial_mm; shift -= 1.0)
    for (double out = kNearestBuccal_mm; out <= kFarthestBuccal_mm; out += 0.5) {
      const glm::dvec3 middle = crown + shift * distal + out * buccal;
      std::vector<glm::dvec3> found =
          straightBone(patient.ct, middle, distal, outward, bur_radius_mm + kToothMargin_mm);
      if (found.size() > surface.size()) surface = std::move(found);
      if (surface.size() == kStations) break;
    }
  if (surface.size() < kFewestStations) return std::nullopt;

  // The hand sweeps straight: along the line the surface takes, square to it outwards.
  const glm::dvec3 along = glm::normalize(surface.back() - surface.front());
  const glm::dvec3 square = glm::normalize(outward - glm::dot(outward, along) * along);
  haptics::TroughPlan plan;
  plan.site_D = {surface[surface.size() / 2]};
  plan.outward_D = {square};
  plan.buccal_D = {glm::normalize(buccal - glm::dot(buccal, square) * square - glm::dot(buccal, along) * along)};
  plan.bur_radius_mm = bur_radius_mm;
  plan.stroke_mm = 2.0 * kHalfLength_mm;
  return plan;
}

}  // namespace app
