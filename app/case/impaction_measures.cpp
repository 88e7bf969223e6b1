#include "app/case/impaction_measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/core.h>

#include "app/case/trough_plan.h"
#include "assets/import/tooth_axis.h"
#include "assets/solid_sample.h"
#include "assets/tooth.h"
#include "calibration/geometry/segment.h"
#include "calibration/geometry/units.h"

namespace app {
namespace {

using assets::CtVolume;
using assets::Tissue;

constexpr double kInfinity_mm = std::numeric_limits<double>::infinity();

bool isBone(std::uint8_t label) { return Tissue{label} == Tissue::cortical || Tissue{label} == Tissue::trabecular; }

struct Extent {
  double low = kInfinity_mm, high = -kInfinity_mm;
};

Extent extentAlong(const std::vector<glm::dvec3>& points_P_mm, const glm::dvec3& way) {
  Extent extent;
  for (const glm::dvec3& p : points_P_mm) {
    extent.low = std::min(extent.low, glm::dot(p, way));
    extent.high = std::max(extent.high, glm::dot(p, way));
  }
  return extent;
}

/// In the sagittal plane of the arch, from the vertical, positive: to mesial.
double tip_deg(const glm::dvec3& axis_P, const ArchFrame& frame) {
  return calibration::degreesFromRad(std::atan2(-glm::dot(axis_P, frame.distal_P), axis_P.z));
}

/// Distal coordinate at which bone first reaches the occlusal plane behind a tooth.
std::optional<double> ramusAt_mm(const CtVolume& ct, const ArchFrame& frame, const glm::dvec3& tooth_P_mm,
                                 double behind_mm, double level_mm) {
  constexpr double kBeside_mm = 12.0, kHalfLayer_mm = 0.5;
  double first_mm = kInfinity_mm;
  assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (ct.solid[v] < assets::kHalfSolid || !isBone(ct.label[v])) return;
    const glm::dvec3 p = ct.grid.centre_P_mm(ijk);
    const double along_mm = glm::dot(p, frame.distal_P);
    if (along_mm < behind_mm || along_mm > first_mm || std::abs(glm::dot(p, frame.up_P) - level_mm) > kHalfLayer_mm ||
        std::abs(glm::dot(p - tooth_P_mm, frame.buccal_P)) > kBeside_mm)
      return;
    first_mm = along_mm;
  });
  if (first_mm == kInfinity_mm) return std::nullopt;
  return first_mm;
}

/// Nearest points of the tooth's surface and of the canal's centre line.
struct NearCanal {
  double distance_mm = kInfinity_mm;  ///< to the centre line
  glm::dvec3 tooth_P_mm{0.0}, canal_P_mm{0.0};
};

NearCanal nearCanal(const assets::Patient& patient, const ToothVoxels& tooth) {
  const std::vector<glm::dvec3>& line = patient.mandibular_canal_P_mm;
  NearCanal nearest;
  for (const ToothFace& face : tooth.faces)
    for (std::size_t n = 0; n + 1 < line.size(); ++n) {
      const double mm = calibration::distanceToSegment(face.middle_P_mm, line[n], line[n + 1]);
      if (mm >= nearest.distance_mm) continue;
      const glm::dvec3 way = line[n + 1] - line[n];
      const double share =
          std::clamp(glm::dot(face.middle_P_mm - line[n], way) / std::max(glm::dot(way, way), 1e-12), 0.0, 1.0);
      nearest = {mm, face.middle_P_mm, line[n] + share * way};
    }
  return nearest;
}

/// Whether the tooth lies on both sides of a point along a direction.
bool isBetweenRoots(const CtVolume& ct, int fdi, const glm::dvec3& p_P_mm, const glm::dvec3& way) {
  constexpr double kReach_mm = 6.0;
  const auto meets = [&](double sign) {
    for (double mm = 0.0; mm < kReach_mm; mm += 0.5 * ct.grid.spacing_mm) {
      const glm::ivec3 ijk(glm::round(ct.grid.indexFromPoint(p_P_mm + sign * mm * way)));
      if (ct.grid.contains(ijk) && ct.tooth[ct.grid.index(ijk)] == fdi) return true;
    }
    return false;
  };
  return meets(-1.0) && meets(1.0);
}

CanalPlace canalPlace(const assets::Patient& patient, const NearCanal& near, const ArchFrame& frame) {
  const CtVolume& ct = patient.ct;
  if (isBetweenRoots(ct, patient.site->fdi, near.canal_P_mm, frame.buccal_P) ||
      isBetweenRoots(ct, patient.site->fdi, near.canal_P_mm, frame.distal_P))
    return CanalPlace::between_roots;
  const glm::dvec3 way = near.canal_P_mm - near.tooth_P_mm;
  const double buccal_mm = glm::dot(way, frame.buccal_P);
  if (-glm::dot(way, frame.up_P) >= std::abs(buccal_mm)) return CanalPlace::below;
  return buccal_mm > 0.0 ? CanalPlace::buccal : CanalPlace::lingual;
}

/// Thickness of bone lingual of every face of the roots that looks to the tongue past no other root, below the
/// follicle.
std::vector<double> lingualBone_mm(const CtVolume& ct, int fdi, const ToothVoxels& tooth, const ArchFrame& frame,
                                   const glm::dvec3& axis_P, double cervix_mm) {
  constexpr double kReach_mm = 25.0, kFollicle_mm = 2.5;
  const glm::dvec3 lingual = -frame.buccal_P;
  const double step_mm = 0.5 * ct.grid.spacing_mm;
  std::vector<double> found_mm;
  for (const ToothFace& face : tooth.faces) {
    if (glm::dot(glm::dvec3(face.outward), lingual) < 0.5 ||
        glm::dot(face.middle_P_mm, axis_P) > cervix_mm - kFollicle_mm)
      continue;
    double bone_mm = 0.0;
    bool is_covered = false, is_in_bone = false;
    for (double mm = 0.5 * step_mm; mm < kReach_mm && !is_covered; mm += step_mm) {
      const glm::ivec3 ijk(glm::round(ct.grid.indexFromPoint(face.middle_P_mm + mm * lingual)));
      if (!ct.grid.contains(ijk)) break;
      const std::size_t v = ct.grid.index(ijk);
      is_covered = ct.tooth[v] == fdi;
      is_in_bone = isBone(ct.label[v]) && ct.solid[v] >= assets::kHalfSolid;
      if (is_in_bone) bone_mm += step_mm;
    }
    // A scan that ends within the bone does not show how thick it is.
    if (!is_covered && !is_in_bone) found_mm.push_back(bone_mm);
  }
  return found_mm;
}

double percentile(std::vector<double> values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, at);
  return *at;
}

/// Between surfaces; only what is near counts.
std::optional<double> gap_mm(const ToothVoxels& a, const ToothVoxels& b) {
  for (const double reach_mm : {3.0, 12.0}) {
    const auto near = [&](const ToothVoxels& of, const ToothVoxels& to) {
      glm::dvec3 low(kInfinity_mm), high(-kInfinity_mm);
      for (const ToothFace& face : to.faces) {
        low = glm::min(low, face.middle_P_mm);
        high = glm::max(high, face.middle_P_mm);
      }
      std::vector<glm::dvec3> points;
      for (const ToothFace& face : of.faces)
        if (glm::all(glm::greaterThan(face.middle_P_mm, low - reach_mm)) &&
            glm::all(glm::lessThan(face.middle_P_mm, high + reach_mm)))
          points.push_back(face.middle_P_mm);
      return points;
    };
    const std::vector<glm::dvec3> of_a = near(a, b), of_b = near(b, a);
    double square_mm2 = kInfinity_mm;
    for (const glm::dvec3& p : of_a)
      for (const glm::dvec3& q : of_b) square_mm2 = std::min(square_mm2, glm::dot(p - q, p - q));
    if (square_mm2 <= reach_mm * reach_mm) return std::sqrt(square_mm2);
  }
  return std::nullopt;
}

/// Angle, depth, ramus and gap, against the second molar.
void measureBesideSecond(const assets::Patient& patient, const ToothVoxels& third, const ToothVoxels& second,
                         const glm::dvec3& second_axis_P, const ArchFrame& frame, ImpactionMeasures& out) {
  const double voxel_mm = patient.ct.grid.spacing_mm;
  const glm::dvec3 axis_P = patient.site->axis_P;
  double angle_deg = tip_deg(axis_P, frame) - tip_deg(second_axis_P, frame);
  angle_deg = std::remainder(angle_deg, 360.0);
  out.angle_deg.value = angle_deg;

  const double occlusal_mm = extentAlong(second.all_P_mm, frame.up_P).high;
  out.depth_mm.value = std::max(0.0, occlusal_mm - extentAlong(third.all_P_mm, frame.up_P).high);
  if (const auto line = cervicalLine_P_mm(second, second_axis_P); !line.empty()) {
    double mean_mm = 0.0;
    for (const glm::dvec3& p : line) mean_mm += glm::dot(p, frame.up_P) / static_cast<double>(line.size());
    // The middle of the lowest voxels of enamel lies half a voxel over its end; that of the highest under the cusps.
    out.cervical_line_mm.value = occlusal_mm - mean_mm + voxel_mm;
  } else {
    out.cervical_line_mm.missing = "the second molar's enamel is not labelled";
  }

  const double behind_mm = extentAlong(second.all_P_mm, frame.distal_P).high;
  const auto& crown = third.enamel_P_mm;
  const glm::dvec3 middle = second.all_P_mm[second.all_P_mm.size() / 2];
  const auto ramus_mm = ramusAt_mm(patient.ct, frame, middle, behind_mm, occlusal_mm);
  if (crown.empty()) {
    out.covered_share.missing = "the third molar's enamel is not labelled";
  } else if (!ramus_mm) {
    out.covered_share.missing = "the scan ends before the ramus rises to the occlusal plane";
  } else {
    const Extent width = extentAlong(crown, frame.mesialSideOf(axis_P));
    out.covered_share.value = std::clamp(1.0 - (*ramus_mm - behind_mm) / (width.high - width.low + voxel_mm), 0.0, 1.0);
  }
  out.second_molar_mm.value = gap_mm(third, second);
  if (!out.second_molar_mm.value) out.second_molar_mm.missing = "the second molar is more than 12 mm away";
}

}  // namespace

ArchFrame archFrame(const assets::Patient& patient, const glm::dvec3& up_P) {
  const glm::dvec3 distal = archDirection_P(patient.ct, *patient.site);
  glm::dvec3 buccal = glm::cross(distal, glm::dvec3(0.0, 0.0, 1.0));
  if (glm::dot(buccal, assets::buccalDirection_P(patient.site->fdi)) < 0.0) buccal = -buccal;
  return {distal, buccal, glm::normalize(up_P - glm::dot(up_P, buccal) * buccal)};
}

ImpactionMeasures measureImpaction(const assets::Patient& patient, const ToothVoxels& third) {
  ImpactionMeasures out;
  const CtVolume& ct = patient.ct;
  const assets::OperativeSite& site = *patient.site;
  const int second_fdi = site.fdi - 1;
  const CtVolume second_alone = toothAlone(ct, second_fdi);
  const ToothVoxels second = toothVoxels(second_alone, second_fdi);
  ArchFrame frame = archFrame(patient);
  out.across_deg.value =
      calibration::degreesFromRad(std::asin(std::clamp(glm::dot(site.axis_P, frame.buccal_P), -1.0, 1.0)));

  if (second.all_P_mm.empty()) {
    const std::string why = fmt::format("the second molar ({}) is not numbered in this scan", second_fdi);
    for (Measured* one :
         {&out.angle_deg, &out.depth_mm, &out.cervical_line_mm, &out.covered_share, &out.second_molar_mm})
      one->missing = why;
  } else {
    const glm::dvec3 axis_P = assets::toothAxis_P(second_alone, second_fdi);
    frame = archFrame(patient, axis_P);
    measureBesideSecond(patient, third, second, axis_P, frame, out);
  }

  if (patient.mandibular_canal_P_mm.size() < 2) {
    out.canal_mm.missing = "no mandibular canal is labelled";
  } else {
    const NearCanal near = nearCanal(patient, third);
    out.canal_mm.value = std::max(0.0, near.distance_mm - patient.mandibular_canal_radius_mm);
    out.canal_place = canalPlace(patient, near, frame);
  }

  const auto line = cervicalLine_P_mm(third, site.axis_P);
  double cervix_mm = 0.0;
  for (const glm::dvec3& p : line) cervix_mm += glm::dot(p, site.axis_P) / static_cast<double>(line.size());
  if (line.empty()) cervix_mm = glm::dot(site.centre_P_mm, site.axis_P);
  const std::vector<double> lingual_mm = lingualBone_mm(ct, site.fdi, third, frame, site.axis_P, cervix_mm);
  if (lingual_mm.empty())
    out.lingual_plate_mm.missing = "the scan ends before the lingual side of the jaw";
  else
    out.lingual_plate_mm.value = percentile(lingual_mm, 0.02);
  return out;
}

}  // namespace app
