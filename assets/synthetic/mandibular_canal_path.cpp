#include "assets/synthetic/mandibular_canal_path.h"

#include <algorithm>
#include <cmath>

#include "assets/mesh/catmull_rom.h"
#include "assets/synthetic/implicit_shape.h"

namespace assets {
namespace {

struct CourseKnot {
  double posterior_mm, buccal_mm, height_mm;
};

// From posterior to the mental foramen between the premolars; the last two pass outward through the buccal cortex.
constexpr CourseKnot kCourse[] = {{76.0, 4.6, -3.0},  {69.0, 4.3, -10.0}, {63.0, 4.5, -16.5}, {57.0, 4.3, -21.6},
                                  {51.0, 3.8, -24.4}, {44.0, 3.2, -25.8}, {36.0, 2.9, -26.8}, {28.0, 2.7, -26.9},
                                  {21.0, 3.2, -26.0}, {18.2, 4.3, -24.3}, {19.4, 7.2, -22.9}};
constexpr int kCanalPointsPerSpan = 16;
constexpr double kDropWidth_mm = 13.0;

}  // namespace

MandibularCanalPath::MandibularCanalPath(const DentalArch& arch, double third_molar_along_mm, double drop_mm) {
  std::vector<glm::dvec3> knots;
  for (const CourseKnot& knot : kCourse) {
    const double along_mm = arch.arcLengthAtPosterior(knot.posterior_mm);
    const ArchStation station = arch.stationAt(along_mm);
    const double turn = (along_mm - third_molar_along_mm) / kDropWidth_mm;
    knots.emplace_back(station.centre_mm + knot.buccal_mm * station.buccal,
                       knot.height_mm - drop_mm * std::exp(-turn * turn));
  }
  for (std::size_t n = 0; n + 1 < knots.size(); ++n)
    for (int step = 0; step < kCanalPointsPerSpan; ++step) {
      const double t = static_cast<double>(step) / kCanalPointsPerSpan;
      points_J_mm_.push_back(catmullRomAt(knots, n, t));
    }
  points_J_mm_.push_back(knots.back());
}

double MandibularCanalPath::square_mm2(const glm::dvec3& p_J, std::size_t segment) const {
  const glm::dvec3 &a = points_J_mm_[segment], &b = points_J_mm_[segment + 1];
  const glm::dvec3 offset = p_J - a - nearestOnSegment(p_J, a, b) * (b - a);
  return glm::dot(offset, offset);
}

MandibularCanalPath::Stretch MandibularCanalPath::stretchNear(const glm::dvec3& centre_J, double radius_mm) const {
  std::vector<double> away_mm(points_J_mm_.size() - 1);
  for (std::size_t n = 0; n < away_mm.size(); ++n) away_mm[n] = std::sqrt(square_mm2(centre_J, n));
  // From the centre to a point of the ball each distance changes by the radius at most.
  const double within_mm = *std::ranges::min_element(away_mm) + 2.0 * radius_mm + 1e-6;
  Stretch stretch{away_mm.size(), 0};
  for (std::size_t n = 0; n < away_mm.size(); ++n)
    if (away_mm[n] <= within_mm) stretch = {std::min(stretch.first, n), n + 1};
  return stretch;
}

double MandibularCanalPath::lumen_mm(const glm::dvec3& p_J, const Stretch& stretch) const {
  double squared = 1e30;
  for (std::size_t n = stretch.first; n < stretch.end; ++n) squared = std::min(squared, square_mm2(p_J, n));
  return std::sqrt(squared) - kRadius_mm;
}

}  // namespace assets
