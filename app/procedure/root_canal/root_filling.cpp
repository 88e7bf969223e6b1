#include "app/procedure/root_canal/root_filling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/core.h>

namespace app {
namespace {

constexpr double kShortOfForamen_mm = 0.5;              ///< the working length
constexpr double kBetweenSections_mm = 0.1;             ///< between sections
constexpr double kBeyond_mm = 1.5;                      ///< the foramen, looked at
constexpr double kWidest_mm = 3.0, kOpenSide_mm = 0.5;  ///< of a canal; where no wall stands around
constexpr double kPresent_mm2 = 0.005, kOfItsEnd_mm = 0.4;
constexpr double kBesideAxis_mm = 1.2;  ///< of a canal's axis, for its voids

struct Areas {
  double canal_mm2 = 0.0, laid_mm2 = 0.0;
};

/// From the axis out: the canal up to its wall, or to the chamber's floor, and what of it is filled.
Areas areasOf(const CanalSection& section, const FineSolid& laid, const assets::ToothCanals& tooth) {
  const double spacing_mm = laid.grid().spacing_mm, step_mm = 0.5 * spacing_mm;
  const double turn = 2.0 * std::numbers::pi / static_cast<double>(CanalSection::kRays);
  const glm::dvec3& up = tooth.frame.axes_P[2];
  const double under_floor_mm = tooth.chamber.floor_mm - tooth.frame.local(section.centre_P_mm).z;
  Areas areas;
  for (std::size_t ray = 0; ray < CanalSection::kRays; ++ray) {
    const glm::dvec3 way_P = section.wayInP(ray);
    const double rise = glm::dot(way_P, up);
    const double floor_mm = rise > 1e-6 ? std::max(0.0, under_floor_mm / rise) : kWidest_mm;
    double end_mm = section.after_mm[ray];
    // Open to the side: as far as it was a canal.
    if (!std::isfinite(end_mm)) end_mm = std::isfinite(section.before_mm[ray]) ? section.before_mm[ray] : kOpenSide_mm;
    end_mm = std::min({end_mm, floor_mm, kWidest_mm});
    areas.canal_mm2 += 0.5 * end_mm * end_mm * turn;
    // A voxel at the wall is filled as far as it is no wall.
    const double rim_mm = end_mm < floor_mm ? 1.5 * spacing_mm : 0.0;
    const auto steps = static_cast<int>(std::ceil((end_mm + rim_mm) / step_mm));
    for (int n = 0; n < steps; ++n) {
      const double r_mm = (n + 0.5) * step_mm;
      areas.laid_mm2 += laid.at(section.centre_P_mm + r_mm * way_P) * r_mm * step_mm * turn;
    }
  }
  return areas;
}

struct Foramen {
  glm::dvec3 at_P_mm, out_P;
};

Foramen foramenOf(const assets::ToothCanal& canal) {
  constexpr double kTangent_mm = 0.3;
  const glm::dvec3 end = canal.foramen_P_mm();
  return {end, glm::normalize(end - canal.at(canal.length_mm() - kTangent_mm).p_P_mm)};
}

/// In a plane across, around the canal's axis as it goes on beyond the foramen.
double laidBeyond_mm2(const FineSolid& laid, const Foramen& foramen, double beyond_mm) {
  const double step_mm = laid.grid().spacing_mm;
  const glm::dvec3 helper = std::abs(foramen.out_P.x) < 0.7 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
  const glm::dvec3 x = glm::normalize(glm::cross(foramen.out_P, helper)), y = glm::cross(foramen.out_P, x);
  const int half = static_cast<int>(kOpenSide_mm / step_mm);
  double area = 0.0;
  for (int i = -half; i <= half; ++i)
    for (int j = -half; j <= half; ++j)
      area += laid.at(foramen.at_P_mm + beyond_mm * foramen.out_P +
                      step_mm * (static_cast<double>(i) * x + static_cast<double>(j) * y)) *
              step_mm * step_mm;
  return area;
}

/// Of the voxels beyond the plane through the foramen.
double extruded_mm3(const FineSolid& laid, const Foramen& foramen) {
  const assets::VolumeGrid& grid = laid.grid();
  const glm::dvec3 middle = grid.indexFromPoint(foramen.at_P_mm);
  const double reach = kBeyond_mm / grid.spacing_mm;
  const glm::ivec3 low = glm::max(glm::ivec3(glm::floor(middle - reach)), glm::ivec3(0)),
                   end = glm::min(glm::ivec3(glm::ceil(middle + reach)) + 1, grid.size);
  double sum = 0.0;
  assets::forVoxels(low, end, [&](glm::ivec3 ijk) {
    if (glm::dot(grid.centre_P_mm(ijk) - foramen.at_P_mm, foramen.out_P) > 0.0) sum += laid.voxel(ijk) / 255.0;
  });
  return sum * grid.voxelVolume_mm3();
}

double fromAxis_mm(const assets::ToothCanal& canal, const glm::dvec3& p_P_mm) {
  double least_mm = std::numeric_limits<double>::max();
  for (const assets::CanalPlace& place : canal.places)
    least_mm = std::min(least_mm, glm::distance(place.p_P_mm, p_P_mm));
  return least_mm;
}

/// Nearer to this canal than to the tooth's others.
bool isOf(const assets::ToothCanals& tooth, std::size_t canal, const glm::dvec3& p_P_mm) {
  const double own_mm = fromAxis_mm(tooth.canals[canal], p_P_mm);
  for (std::size_t n = 0; n < tooth.canals.size(); ++n)
    if (n != canal && fromAxis_mm(tooth.canals[n], p_P_mm) < own_mm) return false;
  return true;
}

std::vector<EnclosedAir> voidsOf(const FineSolid& now, const FineSolid& laid, const assets::ToothCanals& tooth,
                                 std::size_t canal) {
  const assets::VolumeGrid& grid = laid.grid();
  glm::dvec3 low_P(std::numeric_limits<double>::max()), high_P(-low_P);
  for (const assets::CanalPlace& place : tooth.canals[canal].places)
    low_P = glm::min(low_P, place.p_P_mm - kBesideAxis_mm), high_P = glm::max(high_P, place.p_P_mm + kBesideAxis_mm);
  const glm::ivec3 low = glm::max(glm::ivec3(glm::floor(grid.indexFromPoint(low_P))), glm::ivec3(0)),
                   end = glm::min(glm::ivec3(glm::ceil(grid.indexFromPoint(high_P))) + 1, grid.size);
  if (glm::any(glm::lessThan(end - low, glm::ivec3(3)))) return {};
  const assets::VolumeGrid box{end - low, grid.spacing_mm, grid.centre_P_mm(low)};
  std::vector<std::uint8_t> all(box.voxelCount()), filling(box.voxelCount());
  assets::forVoxels(box, [&](glm::ivec3 ijk, std::size_t v) {
    filling[v] = laid.voxel(low + ijk);
    all[v] = static_cast<std::uint8_t>(std::min(255, now.voxel(low + ijk) + filling[v]));
  });
  std::vector<EnclosedAir> voids = voidsBeside(AirParts(box, all), box, all, filling, 0.0);
  std::erase_if(voids, [&](const EnclosedAir& one) { return !isOf(tooth, canal, one.middle_P_mm); });
  return voids;
}

}  // namespace

const char* lengthWord(const RootFilling& filling) {
  return filling.end_mm < -kRightLength_mm ? "short" : filling.end_mm > kRightLength_mm ? "long" : "right";
}

std::string fillingWords(const RootFilling& filling) {
  constexpr double kTold_mm3 = 0.005;
  const std::string length = lengthWord(filling);
  std::string words = fmt::format("filled to {:+.1f} mm{}, {:.0f} %", filling.end_mm,
                                  length == "right" ? "" : ", " + length, 100.0 * filling.share());
  words += filling.voids.empty()
               ? std::string(", no void")
               : fmt::format(", {} void{}", filling.voids.size(), filling.voids.size() == 1 ? "" : "s");
  if (filling.extruded_mm3 >= kTold_mm3) words += fmt::format(", {:.2f} mm³ beyond the foramen", filling.extruded_mm3);
  return words;
}

std::optional<RootFilling> rootFilling(CanalSections& sections, const FineSolid& now, const FineSolid& laid,
                                       const assets::ToothCanals& tooth, std::size_t canal) {
  const assets::ToothCanal& of = tooth.canals[canal];
  const Foramen foramen = foramenOf(of);
  RootFilling filling;

  // Section by section from beyond the foramen to the orifice.
  std::optional<double> first_mm;
  double before_mm3 = 0.0, end_mm = 0.0, last_mm2 = 0.0;
  bool is_end_known = false;
  const int beyond = static_cast<int>(std::lround(kBeyond_mm / kBetweenSections_mm)),
            steps = static_cast<int>(std::floor(of.length_mm() / kBetweenSections_mm - 1e-9));
  for (int n = -beyond; n <= steps; ++n) {
    const double at_mm = n * kBetweenSections_mm;
    Areas areas;
    if (n <= 0)
      areas.laid_mm2 = laidBeyond_mm2(laid, foramen, -at_mm);
    else
      areas = areasOf(sections.at(at_mm), laid, tooth);
    if (at_mm > kShortOfForamen_mm - 0.5 * kBetweenSections_mm) {
      const double share = std::abs(at_mm - kShortOfForamen_mm) < 0.5 * kBetweenSections_mm ? 0.5 : 1.0;
      filling.canal_mm3 += share * kBetweenSections_mm * areas.canal_mm2;
      filling.filled_mm3 += share * kBetweenSections_mm * areas.laid_mm2;
    }
    // Where it ends: as far as what lies before a place that it fills would reach.
    if (!is_end_known) before_mm3 += 0.5 * kBetweenSections_mm * (last_mm2 + areas.laid_mm2);
    last_mm2 = areas.laid_mm2;
    if (!first_mm && areas.laid_mm2 > kPresent_mm2) first_mm = at_mm;
    if (first_mm && !is_end_known && at_mm >= *first_mm + kOfItsEnd_mm - 1e-9 && areas.laid_mm2 > 0.0) {
      end_mm = at_mm - before_mm3 / areas.laid_mm2;
      is_end_known = true;
    }
  }
  if (!is_end_known) return {};
  filling.end_mm = kShortOfForamen_mm - end_mm;
  filling.extruded_mm3 = extruded_mm3(laid, foramen);
  filling.voids = voidsOf(now, laid, tooth, canal);
  if (!filling.voids.empty()) filling.largest_void_mm3 = filling.voids.front().volume_mm3;
  std::erase_if(filling.voids, [](const EnclosedAir& one) { return one.volume_mm3 < kLeastVoid_mm3; });
  return filling;
}

}  // namespace app
