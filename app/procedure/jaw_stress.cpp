#include "app/procedure/jaw_stress.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/case/arch_curve.h"
#include "assets/tissue.h"

namespace app {
namespace {

constexpr double kBeside_mm = 22.0, kBelow_mm = 36.0, kAbove_mm = 6.0, kStep_mm = 0.5;
constexpr double kTrabecular = 0.1;
constexpr double kPresses_N = 5.0;
constexpr double kAgain_s = 0.2, kMoved_mm = 1.0;

double shareOfCortical(std::uint8_t label) {
  const assets::Tissue tissue{label};
  return tissue == assets::Tissue::cortical ? 1.0 : tissue == assets::Tissue::trabecular ? kTrabecular : 0.0;
}

}  // namespace

double sectionModulus_mm3(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid,
                          std::span<const std::uint8_t> label, const glm::dvec3& at_P_mm, const glm::dvec2& along) {
  const glm::dvec2 unit = glm::normalize(along);
  const glm::dvec3 beside(-unit.y, unit.x, 0.0);
  struct Point {
    glm::dvec2 at_mm;  ///< beside, up
    double weight;
  };
  std::vector<Point> points;
  double area = 0.0;
  glm::dvec2 centre(0.0);
  for (double side_mm = -kBeside_mm; side_mm <= kBeside_mm; side_mm += kStep_mm)
    for (double up_mm = -kBelow_mm; up_mm <= kAbove_mm; up_mm += kStep_mm) {
      const glm::dvec3 index = grid.indexFromPoint(at_P_mm + side_mm * beside + glm::dvec3(0.0, 0.0, up_mm));
      const glm::ivec3 ijk(glm::round(index));
      if (!grid.contains(ijk)) continue;
      const std::size_t v = grid.index(ijk);
      const double weight = shareOfCortical(label[v]) * solid[v] / 255.0 * kStep_mm * kStep_mm;
      if (weight <= 0.0) continue;
      points.push_back({{side_mm, up_mm}, weight});
      area += weight;
      centre += weight * points.back().at_mm;
    }
  if (area <= 0.0) return 0.0;
  centre /= area;

  // Bending about either principal axis: second moment by the farthest fibre.
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (const Point& point : points) {
    const glm::dvec2 d = point.at_mm - centre;
    xx += point.weight * d.x * d.x, xy += point.weight * d.x * d.y, yy += point.weight * d.y * d.y;
  }
  const double turn = 0.5 * std::atan2(2.0 * xy, xx - yy);
  double least_mm3 = std::numeric_limits<double>::infinity();
  for (const glm::dvec2& across :
       {glm::dvec2(std::cos(turn), std::sin(turn)), glm::dvec2(-std::sin(turn), std::cos(turn))}) {
    double second_mm4 = 0.0, farthest_mm = 0.0;
    for (const Point& point : points) {
      const double d_mm = glm::dot(point.at_mm - centre, across);
      second_mm4 += point.weight * d_mm * d_mm;
      farthest_mm = std::max(farthest_mm, std::abs(d_mm));
    }
    least_mm3 = std::min(least_mm3, second_mm4 / (farthest_mm + 0.5 * kStep_mm));
  }
  return least_mm3;
}

JawStress::JawStress(const assets::Patient& patient) : patient_(patient), arch_P_mm_(archCurve_P_mm(patient)) {}

std::optional<JawStress::Plane> JawStress::due(const haptics::Tick& newest) {
  const haptics::Levering& lever = newest.lever;
  if (lever.on_bone_N < kPresses_N || arch_P_mm_.size() < 2) return {};
  const bool is_known = measured_s_ >= 0.0 && newest.t_s >= measured_s_ && newest.t_s < measured_s_ + 5.0 &&
                        glm::distance(lever.fulcrum_P_mm, measured_P_mm_) < kMoved_mm;
  if (is_known || (measured_s_ >= 0.0 && newest.t_s >= measured_s_ && newest.t_s < measured_s_ + kAgain_s)) return {};
  measured_s_ = newest.t_s;
  measured_P_mm_ = lever.fulcrum_P_mm;

  const glm::dvec2 at(lever.fulcrum_P_mm);
  const auto nearest =
      std::ranges::min_element(arch_P_mm_, {}, [&](const glm::dvec2& point) { return glm::distance(point, at); });
  const std::size_t n = static_cast<std::size_t>(nearest - arch_P_mm_.begin());
  const glm::dvec2 along = arch_P_mm_[std::min(n + 1, arch_P_mm_.size() - 1)] - arch_P_mm_[n == 0 ? 0 : n - 1];
  if (!(glm::length(along) > 0.0)) return {};
  return Plane{lever.fulcrum_P_mm, along};
}

void JawStress::measure(const Plane& plane, std::span<const std::uint8_t> solid) {
  modulus_mm3_ = sectionModulus_mm3(patient_.ct.grid, solid, patient_.ct.label, plane.at_P_mm, plane.along);
}

void JawStress::update(const haptics::Tick& newest) {
  now_N_per_mm2_.reset();
  if (newest.lever.on_bone_N < kPresses_N || modulus_mm3_ <= 0.0) return;
  now_N_per_mm2_ = newest.lever.on_bone_N * kLever_mm / modulus_mm3_;
  most_N_per_mm2_ = std::max(most_N_per_mm2_, *now_N_per_mm2_);
}

}  // namespace app
