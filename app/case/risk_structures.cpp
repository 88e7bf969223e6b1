#include "app/case/risk_structures.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "app/case/impaction_measures.h"
#include "assets/scan/label_distance.h"
#include "assets/tooth.h"
#include "calibration/geometry/segment.h"

namespace app {
namespace {

using assets::CtVolume;
using assets::kRiskStructures;
using assets::RiskStructure;
using assets::Tissue;
using Voxels = std::vector<std::uint8_t>;

constexpr double kAlong_mm = 20.0;                               ///< of the lingual surface, either way from the tooth
constexpr double kToCheek_mm = 15.0, kToTongue_mm = 22.0;        ///< of the bone looked at, from the tooth's middle
constexpr double kAbove_mm = 15.0, kBelow_mm = 30.0;             ///< of the same
constexpr double kBeyond_mm = 12.0;                              ///< the surface's other side
constexpr double kNerveAlong_mm = 12.0, kNerveStation_mm = 0.5;  ///< of the lingual nerve
constexpr double kOffPlate_mm = 2.06, kOffPlateSd_mm = 1.10, kUnderCrest_mm = 3.01, kUnderCrestSd_mm = 0.42;
constexpr double kDeviations = 2.0;
constexpr double kAtTooth_mm = 4.0, kCrestRises_mm = 2.0;

bool isOfBone(std::uint8_t label) { return Tissue{label} == Tissue::cortical || Tissue{label} == Tissue::trabecular; }

bool anyIn(const Voxels& voxels) {
  return std::ranges::any_of(voxels, [](std::uint8_t v) { return v != 0; });
}

Voxels canalVoxels(const assets::Patient& patient) {
  const CtVolume& ct = patient.ct;
  Voxels canal(ct.label.size());
  std::ranges::transform(ct.label, canal.begin(), [](std::uint8_t label) {
    return static_cast<std::uint8_t>(Tissue{label} == Tissue::mandibular_canal ? 1 : 0);
  });
  const std::vector<glm::dvec3>& line = patient.mandibular_canal_P_mm;
  if (line.size() < 2 || anyIn(canal)) return canal;
  const double radius_mm = patient.mandibular_canal_radius_mm;
  for (std::size_t n = 1; n < line.size(); ++n) {
    const glm::dvec3 low = glm::min(line[n - 1], line[n]) - radius_mm,
                     high = glm::max(line[n - 1], line[n]) + radius_mm;
    const glm::ivec3 first = glm::max(glm::ivec3(glm::floor(ct.grid.indexFromPoint(low))), 0);
    const glm::ivec3 end = glm::min(glm::ivec3(glm::ceil(ct.grid.indexFromPoint(high))) + 1, ct.grid.size);
    assets::forVoxels(first, end, [&](glm::ivec3 ijk) {
      if (calibration::distanceToSegment(ct.grid.centre_P_mm(ijk), line[n - 1], line[n]) <= radius_mm)
        canal[ct.grid.index(ijk)] = 1;
    });
  }
  return canal;
}

/// Directions at a lower third molar; none: the case has no such site.
struct LingualSite {
  glm::dvec3 centre_P_mm{0.0}, distal_P{0.0}, lingual_P{0.0};

  double along_mm(const glm::dvec3& p_P_mm) const { return glm::dot(p_P_mm - centre_P_mm, distal_P); }
};
std::optional<LingualSite> lingualSite(const assets::Patient& patient) {
  if (!patient.site || !assets::isThirdMolar(patient.site->fdi) || assets::isUpper(patient.site->fdi)) return {};
  const ArchFrame frame = archFrame(patient);
  return LingualSite{patient.site->centre_P_mm, frame.distal_P, -frame.buccal_P};
}

/// A voxel of bone with nothing hard between it and the tongue.
struct OuterVoxel {
  glm::ivec3 ijk;
  double along_mm, height_mm, lingual_mm;
};

/// Where a line from a voxel towards the tongue comes through, half a voxel a step; visit(voxel) until it is false.
template <class Visit>
void towardsTongue(const assets::VolumeGrid& grid, glm::ivec3 from, const glm::dvec3& lingual_P, const Visit& visit) {
  const int steps = static_cast<int>(2.0 * kBeyond_mm / grid.spacing_mm);
  for (int n = 1; n <= steps; ++n) {
    const glm::ivec3 at(glm::round(glm::dvec3(from) + 0.5 * n * lingual_P));
    if (at != from && (!grid.contains(at) || !visit(grid.index(at)))) return;
  }
}

std::vector<OuterVoxel> lingualSurface(const CtVolume& ct, const LingualSite& site) {
  std::vector<OuterVoxel> surface;
  const double reach_mm = std::hypot(kAlong_mm, std::max(kToCheek_mm, kToTongue_mm)) + 1.0;
  const glm::dvec3 low_mm = site.centre_P_mm - glm::dvec3(reach_mm, reach_mm, kBelow_mm),
                   high_mm = site.centre_P_mm + glm::dvec3(reach_mm, reach_mm, kAbove_mm);
  const glm::ivec3 first = glm::max(glm::ivec3(glm::floor(ct.grid.indexFromPoint(low_mm))), 0);
  const glm::ivec3 end = glm::min(glm::ivec3(glm::ceil(ct.grid.indexFromPoint(high_mm))) + 1, ct.grid.size);
  assets::forVoxels(first, end, [&](glm::ivec3 ijk) {
    if (!isOfBone(ct.label[ct.grid.index(ijk)])) return;
    const glm::dvec3 p = ct.grid.centre_P_mm(ijk);
    const double lingual_mm = glm::dot(p - site.centre_P_mm, site.lingual_P), along_mm = site.along_mm(p);
    if (std::abs(along_mm) > kAlong_mm || lingual_mm < -kToCheek_mm || lingual_mm > kToTongue_mm) return;
    bool is_outer = true;
    towardsTongue(ct.grid, ijk, site.lingual_P, [&](std::size_t v) { return is_outer = !assets::isHard(ct.label[v]); });
    if (is_outer) surface.push_back({ijk, along_mm, p.z, lingual_mm});
  });
  return surface;
}

/// Whether the bone around a voxel faces the tongue, not the mouth above or the floor below: by the middle of what is
/// hard within a millimetre.
bool facesTongue(const CtVolume& ct, glm::ivec3 ijk, const glm::dvec3& lingual_P) {
  constexpr double kAround_mm = 1.0, kFacing = 0.6;
  const int reach = std::max(2, static_cast<int>(std::lround(kAround_mm / ct.grid.spacing_mm)));
  glm::dvec3 inward(0.0);
  assets::forVoxels(-glm::ivec3(reach), glm::ivec3(reach + 1), [&](glm::ivec3 way) {
    const glm::ivec3 at = ijk + way;
    if (way.x * way.x + way.y * way.y + way.z * way.z <= reach * reach && ct.grid.contains(at) &&
        assets::isHard(ct.label[ct.grid.index(at)]))
      inward += glm::dvec3(way);
  });
  const double length = glm::length(inward);
  return length > 0.0 && glm::dot(inward, lingual_P) <= -kFacing * length;
}

/// Single voxels that oblique lines have missed.
void fillBetween(const assets::VolumeGrid& grid, Voxels& voxels, const std::vector<std::uint8_t>& label) {
  const Voxels before = voxels;
  assets::forVoxels(glm::ivec3(1), grid.size - 1, [&](glm::ivec3 ijk) {
    const std::size_t v = grid.index(ijk);
    if (before[v] != 0 || assets::isHard(label[v])) return;
    for (const glm::ivec3 way : {glm::ivec3(1, 0, 0), glm::ivec3(0, 1, 0), glm::ivec3(0, 0, 1)})
      if (before[grid.index(ijk + way)] != 0 && before[grid.index(ijk - way)] != 0) voxels[v] = 1;
  });
}

Voxels lingualVoxels(const CtVolume& ct, const LingualSite& site) {
  Voxels beyond(ct.label.size(), 0);
  for (const OuterVoxel& outer : lingualSurface(ct, site))
    if (facesTongue(ct, outer.ijk, site.lingual_P))
      towardsTongue(ct.grid, outer.ijk, site.lingual_P, [&](std::size_t v) {
        beyond[v] = 1;
        return true;
      });
  fillBetween(ct.grid, beyond, ct.label);
  return beyond;
}

/// In stations along the arch the crest is the top of the surface; the plate is the surface where the nerve runs.
Voxels nerveVoxels(const CtVolume& ct, const LingualSite& site) {
  struct Station {
    double crest_mm = -1e9;
    std::map<int, double> plate_mm;  ///< by height in voxels: towards the tongue
  };
  std::map<int, Station> stations;
  const auto station_of = [](double along_mm) { return static_cast<int>(std::floor(along_mm / kNerveStation_mm)); };
  const auto level_of = [&](double height_mm) { return static_cast<int>(std::floor(height_mm / ct.grid.spacing_mm)); };
  for (const OuterVoxel& outer : lingualSurface(ct, site)) {
    if (std::abs(outer.along_mm) > kNerveAlong_mm) continue;
    Station& station = stations[station_of(outer.along_mm)];
    station.crest_mm = std::max(station.crest_mm, outer.height_mm);
    double& plate = station.plate_mm.try_emplace(level_of(outer.height_mm), outer.lingual_mm).first->second;
    plate = std::max(plate, outer.lingual_mm);
  }
  Voxels band(ct.label.size(), 0);
  // The ramus behind is no crest.
  std::vector<double> crests_mm;
  for (const auto& [at, station] : stations)
    if (std::abs(at * kNerveStation_mm) <= kAtTooth_mm) crests_mm.push_back(station.crest_mm);
  if (crests_mm.empty()) return band;
  const auto middle = crests_mm.begin() + static_cast<std::ptrdiff_t>(crests_mm.size() / 2);
  std::ranges::nth_element(crests_mm, middle);
  for (auto& [at, station] : stations) station.crest_mm = std::min(station.crest_mm, *middle + kCrestRises_mm);
  const double reach_mm = kNerveAlong_mm + kToTongue_mm + 8.0;
  const glm::ivec3 first = glm::max(glm::ivec3(glm::floor(ct.grid.indexFromPoint(site.centre_P_mm - reach_mm))), 0);
  const glm::ivec3 end =
      glm::min(glm::ivec3(glm::ceil(ct.grid.indexFromPoint(site.centre_P_mm + reach_mm))) + 1, ct.grid.size);
  assets::forVoxels(first, end, [&](glm::ivec3 ijk) {
    const std::size_t v = ct.grid.index(ijk);
    if (assets::isHard(ct.label[v])) return;
    const glm::dvec3 p = ct.grid.centre_P_mm(ijk);
    const auto station = stations.find(station_of(site.along_mm(p)));
    if (station == stations.end()) return;
    const auto plate = station->second.plate_mm.find(level_of(station->second.crest_mm - kUnderCrest_mm));
    if (plate == station->second.plate_mm.end()) return;
    const double off_mm = glm::dot(p - site.centre_P_mm, site.lingual_P) - plate->second;
    const double under_mm = station->second.crest_mm - p.z;
    const glm::dvec2 deviations((off_mm - kOffPlate_mm) / kOffPlateSd_mm,
                                (under_mm - kUnderCrest_mm) / kUnderCrestSd_mm);
    if (glm::length(deviations) <= kDeviations) band[v] = 1;
  });
  return band;
}

}  // namespace

std::vector<std::uint8_t> voxelsOf(RiskStructure structure, const assets::Patient& patient) {
  const CtVolume& ct = patient.ct;
  if (structure == RiskStructure::canal) return canalVoxels(patient);
  const std::optional<LingualSite> site = lingualSite(patient);
  if (!site) return {};
  switch (structure) {
    case RiskStructure::lingual:
      return lingualVoxels(ct, *site);
    case RiskStructure::second_molar:
      return assets::voxelsOfTooth(ct, patient.site->fdi - 1);
    default:
      return nerveVoxels(ct, *site);
  }
}

assets::RiskStructures riskStructures(const assets::Patient& patient) {
  assets::RiskStructures structures;
  for (std::size_t n = 0; n < kRiskStructures; ++n) {
    const Voxels voxels = voxelsOf(static_cast<RiskStructure>(n), patient);
    if (!voxels.empty())
      structures.distance[n] = assets::structureDistance(patient.ct.grid, voxels, patient.focus_P_mm());
  }
  return structures;
}

}  // namespace app
