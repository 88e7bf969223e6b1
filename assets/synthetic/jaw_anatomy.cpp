#include "assets/synthetic/jaw_anatomy.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "assets/load_error.h"
#include "assets/synthetic/implicit_shape.h"

namespace assets {
namespace {

constexpr double kLigament_mm = 0.25;
constexpr double kLigamentAtCrest_mm = 0.5;
constexpr double kFollicle_mm = 0.8;
constexpr double kLaminaDura_mm = 0.45;
constexpr double kSocketWall_mm = 0.85;  ///< minimum bone over a root
constexpr double kMucosa_mm = 2.3;
constexpr double kEndCover_mm = 1.3;  ///< gingiva beyond the ends of the scanned segment
constexpr double kReach_mm = 4.4;     ///< influence of teeth and canal

/// Bone that follows a root outward where the jaw is thin: the juga and the lingual bulge.
double socketWall_mm(double tooth_mm, double over_cervix_mm) {
  return smoothMax(tooth_mm - kLigament_mm - kSocketWall_mm, over_cervix_mm + 1.9, 1.0);
}

/// Cuff of attached gingiva around a neck, high between the teeth, thin at its edge.
double gingivalCuff_mm(const glm::dvec3& q, double tooth_mm) {
  const double proximal = std::abs(q.x) / std::max(std::hypot(q.x, q.y), 0.1);
  const double margin_mm = 0.9 + 1.7 * smoothStep(0.6, 1.0, proximal);
  const double thickness_mm = glm::mix(0.8, 1.6, smoothStep(margin_mm, margin_mm - 3.0, q.z));
  return smoothMax(tooth_mm - thickness_mm, q.z - margin_mm, 0.6);
}

[[noreturn]] void refuseMandibularCanal(double distance_mm) {
  std::ostringstream line;
  line << "synthetic jaw: a canal " << distance_mm << " mm from the third molar does not fit into the bone next to it; "
       << "choose another depth, canal distance or Winter angle";
  throw LoadError(line.str());
}

}  // namespace

JawAnatomy::JawAnatomy(const JawParameters& parameters) : mandible_(arch_, parameters.seed) {
  tbb::parallel_for(4, 9, [](int position) { lowerToothShape(position); });
  for (int position = 4; position <= 7; ++position) teeth_.push_back(eruptedTooth(arch_, position));
  PlacedTooth third = impactedThirdMolar(arch_, teeth_.back(), parameters.winter_angle_deg, parameters.depth_mm);
  teeth_.push_back(std::move(third));
  placeMandibularCanal(parameters.mandibular_canal_distance_mm);
}

void JawAnatomy::placeMandibularCanal(double distance_mm) {
  // The point where the mean course is closest to the tooth.
  std::vector<glm::dvec3> surface_J = thirdMolar().shape.surfacePoints_mm();
  const MandibularCanalPath mean_course(arch_, 0.0, 0.0);
  double closest_mm = 1e9, beside_mm = 0.0;
  for (glm::dvec3& p : surface_J) p = thirdMolar().inJaw(p);
  for (std::size_t n = 0; n < surface_J.size(); n += 16) {
    const double lumen_mm = mean_course.lumen_mm(surface_J[n]);
    if (lumen_mm >= closest_mm) continue;
    closest_mm = lumen_mm;
    beside_mm = arch_.coordinatesOf({surface_J[n].x, surface_J[n].y}).along_mm;
  }
  const auto clearance = [&](const MandibularCanalPath& path) {
    double least_mm = 1e9;
    for (std::size_t n = 0; n < surface_J.size(); n += 4) least_mm = std::min(least_mm, path.lumen_mm(surface_J[n]));
    return least_mm;
  };

  // Lower the canal there to the requested distance, by bisection.
  double high_mm = -14.0, low_mm = 12.0;
  for (int halving = 0; halving < 14; ++halving) {
    const double middle_mm = 0.5 * (high_mm + low_mm);
    (clearance(MandibularCanalPath(arch_, beside_mm, middle_mm)) < distance_mm ? high_mm : low_mm) = middle_mm;
  }
  mandibular_canal_.emplace(arch_, beside_mm, low_mm);

  const double reached_mm = clearance(*mandibular_canal_);
  double cover_mm = 1e9;
  for (const glm::dvec3& p : mandibular_canal_->points_J_mm())
    if (p.y > 30.0 && mandible_.cut_mm(p) < 0.0) cover_mm = std::min(cover_mm, -mandible_.outer_mm(p));
  if (std::abs(reached_mm - distance_mm) > 0.1 || cover_mm < 0.3 * MandibularCanalPath::kRadius_mm)
    refuseMandibularCanal(distance_mm);
}

NearbyStructures JawAnatomy::nearby(const glm::dvec3& centre_J, double radius_mm) const {
  NearbyStructures nearby;
  const double reach_mm = 1.15 * radius_mm + 0.7;
  nearby.any =
      mandible_.outer_mm(centre_J) < reach_mm + kMucosa_mm && mandible_.cut_mm(centre_J) < reach_mm + kEndCover_mm;
  for (std::size_t n = 0; n < teeth_.size(); ++n) {
    const double tooth_mm = teeth_[n].shape.outerLowerBound_mm(teeth_[n].local(centre_J));
    if (tooth_mm > reach_mm + kReach_mm) continue;
    nearby.teeth |= 1u << n;
    nearby.any = true;
  }
  nearby.mandibular_canal = nearby.any && mandibular_canal_->lumen_mm(centre_J) < reach_mm + kReach_mm;
  if (nearby.mandibular_canal) nearby.canal_stretch = mandibular_canal_->stretchNear(centre_J, radius_mm);
  return nearby;
}

TissueDistances JawAnatomy::at(const glm::dvec3& p_J, const NearbyStructures& nearby, ArchLine& line) const {
  TissueDistances d;
  if (!nearby.any) return d;
  const double cut_mm = mandible_.cut_mm(p_J);
  double bone_mm = mandible_.outer_mm(p_J);
  double lining_mm = TissueDistances::kFar_mm;
  double cuff_mm = TissueDistances::kFar_mm;

  for (std::size_t n = 0; n < teeth_.size(); ++n) {
    if ((nearby.teeth >> n & 1u) == 0) continue;
    const PlacedTooth& tooth = teeth_[n];
    const glm::dvec3 q = tooth.local(p_J);
    const double outer_mm = tooth.shape.outer_mm(q);
    if (outer_mm > kReach_mm) continue;
    const double over_cervix_mm = tooth.shape.heightAboveCervix_mm(q);
    const bool third = tooth.position == 8;
    if (outer_mm < 1.0) {
      ToothDistances& nearest = third ? d.third_molar : d.other_tooth;
      if (!third && outer_mm < nearest.outer) d.other_position = tooth.position;
      nearest.outer = std::min(outer_mm, nearest.outer);
      nearest.core = std::min(tooth.shape.core_mm(q, outer_mm), nearest.core);
      nearest.pulp = std::min(std::max(tooth.shape.pulp_mm(q), outer_mm + 0.25), nearest.pulp);
    }
    bone_mm = smoothMin(bone_mm, socketWall_mm(outer_mm, over_cervix_mm), 1.8);
    const double space_mm = third ? glm::mix(kLigament_mm, kFollicle_mm, smoothStep(-2.0, 1.5, over_cervix_mm))
                                  : glm::mix(kLigament_mm, kLigamentAtCrest_mm, smoothStep(-3.8, -2.0, over_cervix_mm));
    lining_mm = std::min(lining_mm, outer_mm - space_mm);
    // The impacted crown lies under mucosa; erupted teeth have a cuff.
    cuff_mm =
        smoothMin(cuff_mm, third ? smoothMax(outer_mm - 1.4, p_J.z + 1.2, 0.8) : gingivalCuff_mm(q, outer_mm), 1.2);
  }

  // A canal near the surface has a thin wall, except at the mental foramen.
  const double lumen_mm =
      nearby.mandibular_canal ? mandibular_canal_->lumen_mm(p_J, nearby.canal_stretch) : TissueDistances::kFar_mm;
  if (p_J.y > 26.0) bone_mm = smoothMin(bone_mm, lumen_mm + 6.0 * smoothStep(32.0, 26.0, p_J.y) - 0.9, 1.5);
  d.bone = std::max(bone_mm, cut_mm);
  d.ligament = std::max(lining_mm, d.bone);

  // Trabecular bone begins under the cortex, whose thickness is computed only near its inner surface.
  const bool in_question = bone_mm > -4.0 && bone_mm < 0.0;
  if (in_question && !line) line = arch_.coordinatesOf({p_J.x, p_J.y});
  const double cortex_mm = in_question ? mandible_.cortex_mm(p_J, *line) : 1.5;
  double spongy_mm = std::max(bone_mm + cortex_mm, -(lining_mm - kLaminaDura_mm));
  spongy_mm = std::max(spongy_mm, MandibularCanalPath::kWall_mm - lumen_mm);
  d.mandibular_canal = std::max(lumen_mm, d.bone);
  d.trabecular = std::max(spongy_mm, cut_mm);

  // Mucosa thins out down the body; it also covers the ends of the segment, so that no bare bone shows there.
  const double covered = smoothStep(-21.0, -13.0, p_J.z);
  d.gingiva = std::max(smoothMin(bone_mm - covered * kMucosa_mm, cuff_mm, 3.4), cut_mm - covered * kEndCover_mm);
  return d;
}

}  // namespace assets
