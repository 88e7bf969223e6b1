#include "assets/synthetic/dental_arch.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "assets/mesh/catmull_rom.h"

namespace assets {
namespace {

constexpr glm::dvec2 kArchForm_mm[] = {{-5.4, 0.9},  {0.0, 0.0},   {5.4, 0.9},   {10.6, 4.4},  {14.7, 9.5},
                                       {17.7, 16.0}, {20.2, 23.0}, {22.8, 32.0}, {25.3, 41.5}, {28.2, 52.0},
                                       {31.4, 63.0}, {34.2, 73.0}, {36.8, 83.0}};
constexpr int kPointsPerSpan = 12;

}  // namespace

DentalArch::DentalArch() {
  for (std::size_t span = 1; span + 2 < std::size(kArchForm_mm); ++span)
    for (int step = 0; step < kPointsPerSpan; ++step) {
      const double t = static_cast<double>(step) / kPointsPerSpan;
      points_mm_.push_back(catmullRomAt(kArchForm_mm, span, t));
    }
  along_mm_.push_back(0.0);
  for (std::size_t n = 1; n < points_mm_.size(); ++n)
    along_mm_.push_back(along_mm_.back() + glm::distance(points_mm_[n - 1], points_mm_[n]));
}

ArchStation DentalArch::stationAt(double along_mm) const {
  const auto above = std::upper_bound(along_mm_.begin(), along_mm_.end(), along_mm);
  const auto last = static_cast<std::ptrdiff_t>(points_mm_.size()) - 2;
  const auto n = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above - along_mm_.begin() - 1, 0, last));
  const auto tangent_at = [&](std::size_t k) {
    const std::size_t before = k == 0 ? 0 : k - 1, after = std::min(k + 1, points_mm_.size() - 1);
    return glm::normalize(points_mm_[after] - points_mm_[before]);
  };
  const double t = (along_mm - along_mm_[n]) / (along_mm_[n + 1] - along_mm_[n]);
  ArchStation station;
  station.centre_mm = glm::mix(points_mm_[n], points_mm_[n + 1], t);
  station.distal = glm::normalize(glm::mix(tangent_at(n), tangent_at(n + 1), std::clamp(t, 0.0, 1.0)));
  station.buccal = {station.distal.y, -station.distal.x};
  return station;
}

ArchCoordinates DentalArch::coordinatesOf(const glm::dvec2& point_mm) const {
  // Nearest point of the polyline, its ends extended.
  double best = 1e30;
  ArchCoordinates coordinates;
  for (std::size_t n = 0; n + 1 < points_mm_.size(); ++n) {
    const glm::dvec2 edge = points_mm_[n + 1] - points_mm_[n];
    const double lowest = n == 0 ? -1e9 : 0.0, highest = n + 2 == points_mm_.size() ? 1e9 : 1.0;
    const double t = std::clamp(glm::dot(point_mm - points_mm_[n], edge) / glm::dot(edge, edge), lowest, highest);
    const glm::dvec2 offset = point_mm - (points_mm_[n] + t * edge);
    const double squared = glm::dot(offset, offset);
    if (squared >= best) continue;
    best = squared;
    const double side = edge.y * offset.x - edge.x * offset.y;
    coordinates = {along_mm_[n] + t * glm::length(edge), std::copysign(std::sqrt(squared), side)};
  }
  return coordinates;
}

double DentalArch::arcLengthAtPosterior(double y_mm) const {
  const auto above = std::lower_bound(points_mm_.begin(), points_mm_.end(), y_mm,
                                      [](const glm::dvec2& p, double y) { return p.y < y; });
  const auto n = static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(above - points_mm_.begin(), 1, static_cast<std::ptrdiff_t>(points_mm_.size()) - 1));
  const double t = (y_mm - points_mm_[n - 1].y) / (points_mm_[n].y - points_mm_[n - 1].y);
  return along_mm_[n - 1] + t * (along_mm_[n] - along_mm_[n - 1]);
}

}  // namespace assets
