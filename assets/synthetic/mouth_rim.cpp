#include "assets/synthetic/mouth_rim.h"

#include <algorithm>
#include <cmath>

#include "assets/mesh/catmull_rom.h"
#include "assets/synthetic/implicit_shape.h"

namespace assets {
namespace {

struct Knot {
  double x_mm, z_mm;
  double lip_mm;     ///< radius of the lip there
  double inward_mm;  ///< how far the lip's centre lies behind the skin
};

constexpr double kLowerLip_mm = -5.2, kUpperLip_mm = 40.4;  // z on the midline

constexpr double kRounding_mm = 1e-6;  // far more than the rounding of any distance here

// Clockwise seen from the operated side's front: upper lip, retracted corner, lower lip, free corner.
constexpr std::array<Knot, 20> kKnots = {
    {{0, 40.4, 4.6, -0.2},    {4.5, 41.6, 4.9, -0.4},  {10, 41.4, 4.7, -0.2},  {18, 39.6, 4.2, 0.4},
     {28, 36.4, 3.6, 1.2},    {39.5, 31.0, 3.2, 2.0},  {48, 22.5, 3.0, 3.0},   {48.3, 8.5, 3.0, 3.2},
     {40.5, -1.4, 3.6, 2.0},  {26, -4.6, 4.6, 0.4},    {13, -5.4, 5.4, -0.2},  {0, -5.2, 5.6, -0.3},
     {-12, -4.4, 5.3, -0.1},  {-20, -1.2, 4.5, 0.6},   {-25.5, 6.0, 3.7, 1.4}, {-27.5, 15.5, 3.2, 1.8},
     {-25.5, 25.0, 3.5, 1.4}, {-18.5, 34.8, 4.1, 0.6}, {-10, 40.6, 4.7, -0.2}, {-4.5, 41.6, 4.9, -0.4}}};

}  // namespace

MouthRim::MouthRim(const std::function<double(double, double)>& depth_at, double raised_mm) {
  // Catmull-Rom through the knots.
  constexpr std::size_t kPerSpan = kPoints / kKnots.size();
  std::array<double, kPoints> inward_mm{};
  for (std::size_t n = 0; n < kPoints; ++n) {
    const auto knot = [&](std::size_t i) { return kKnots[(n / kPerSpan + kKnots.size() + i - 1) % kKnots.size()]; };
    const double t = static_cast<double>(n % kPerSpan) / kPerSpan;
    const auto value = [&](auto member) {
      return catmullRom(knot(0).*member, knot(1).*member, knot(2).*member, knot(3).*member, t);
    };
    const double z_mm = value(&Knot::z_mm);
    edge_[n] = {value(&Knot::x_mm), z_mm + raised_mm * (z_mm - kLowerLip_mm) / (kUpperLip_mm - kLowerLip_mm)};
    radius_mm_[n] = value(&Knot::lip_mm);
    inward_mm[n] = value(&Knot::inward_mm);
  }
  // The lip lies outside the edge, on the skin.
  for (std::size_t n = 0; n < kPoints; ++n) {
    const glm::dvec2 along = edge_[(n + 1) % kPoints] - edge_[(n + kPoints - 1) % kPoints];
    const glm::dvec2 outward = glm::normalize(glm::dvec2(-along.y, along.x));
    const glm::dvec2 centre = edge_[n] + radius_mm_[n] * outward;
    lip_[n] = {centre.x, depth_at(centre.x, centre.y) + 0.9 + inward_mm[n], centre.y};
  }
  // Smooth the depth along the rim.
  for (int pass = 0; pass < 6; ++pass) {
    const auto before = lip_;
    for (std::size_t n = 0; n < kPoints; ++n) {
      lip_[n].y = 0.5 * before[n].y + 0.25 * (before[(n + 1) % kPoints].y + before[(n + kPoints - 1) % kPoints].y);
    }
  }
  gatherRuns();
}

void MouthRim::gatherRuns() {
  for (std::size_t r = 0; r < kRuns; ++r) {
    Run& run = runs_[r];
    const auto point = [&](std::size_t n) { return (r * kPerRun + n) % kPoints; };
    double widest_mm = 0.0;
    for (std::size_t n = 0; n <= kPerRun; ++n) {
      run.lip_centre += lip_[point(n)] / (kPerRun + 1.0);
      run.edge_centre += edge_[point(n)] / (kPerRun + 1.0);
      run.low_z_mm = std::min(run.low_z_mm, edge_[point(n)].y);
      run.high_z_mm = std::max(run.high_z_mm, edge_[point(n)].y);
      widest_mm = std::max(widest_mm, radius_mm_[point(n)]);
    }
    for (std::size_t n = 0; n <= kPerRun; ++n) {
      run.lip_reach_mm = std::max(run.lip_reach_mm, glm::distance(run.lip_centre, lip_[point(n)]) + widest_mm);
      run.edge_reach_mm = std::max(run.edge_reach_mm, glm::distance(run.edge_centre, edge_[point(n)]));
    }
  }
}

MouthRim::LipPoint MouthRim::nearestInRun(std::size_t run, const glm::dvec3& p, LipPoint best) const {
  for (std::size_t n = run * kPerRun; n < (run + 1) * kPerRun; ++n) {
    const std::size_t next = (n + 1) % kPoints;
    const double t = nearestOnSegment(p, lip_[n], lip_[next]);
    const double d =
        glm::length(p - lip_[n] - t * (lip_[next] - lip_[n])) - glm::mix(radius_mm_[n], radius_mm_[next], t);
    if (d < best.distance_mm) best = {d, (static_cast<double>(n) + t) / static_cast<double>(kPoints)};
  }
  return best;
}

MouthRim::LipPoint MouthRim::lip(const glm::dvec3& p) const {
  // The run that may come nearest gives a bound; then all that may be within it, in order.
  std::array<double, kRuns> least_mm;
  for (std::size_t r = 0; r < kRuns; ++r) least_mm[r] = glm::distance(p, runs_[r].lip_centre) - runs_[r].lip_reach_mm;
  const auto first = static_cast<std::size_t>(std::ranges::min_element(least_mm) - least_mm.begin());
  const double bound_mm = nearestInRun(first, p, {1e9, 0.0}).distance_mm + kRounding_mm;
  LipPoint best{1e9, 0.0};
  for (std::size_t r = 0; r < kRuns; ++r)
    if (least_mm[r] <= bound_mm) best = nearestInRun(r, p, best);
  return best;
}

double MouthRim::squareInRun_mm2(std::size_t run, const glm::dvec2& p) const {
  double square = 1e30;
  for (std::size_t n = run * kPerRun; n < (run + 1) * kPerRun; ++n) {
    const glm::dvec2 &a = edge_[n], &b = edge_[(n + 1) % kPoints];
    const glm::dvec2 offset = p - a - nearestOnSegment(p, a, b) * (b - a);
    square = std::min(square, glm::dot(offset, offset));
  }
  return square;
}

bool MouthRim::crossesOddlyInRun(std::size_t run, const glm::dvec2& p) const {
  if (p.y < runs_[run].low_z_mm || p.y >= runs_[run].high_z_mm) return false;
  bool odd = false;
  for (std::size_t n = run * kPerRun; n < (run + 1) * kPerRun; ++n) {
    const glm::dvec2 a = edge_[n], edge = edge_[(n + 1) % kPoints] - a;
    if ((a.y > p.y) != (edge_[(n + 1) % kPoints].y > p.y) && p.x < a.x + (p.y - a.y) / edge.y * edge.x) odd = !odd;
  }
  return odd;
}

double MouthRim::opening_mm(double x_mm, double z_mm) const {
  const glm::dvec2 p(x_mm, z_mm);
  std::array<double, kRuns> least_mm;
  for (std::size_t r = 0; r < kRuns; ++r) least_mm[r] = glm::distance(p, runs_[r].edge_centre) - runs_[r].edge_reach_mm;
  const auto first = static_cast<std::size_t>(std::ranges::min_element(least_mm) - least_mm.begin());
  double square = squareInRun_mm2(first, p);
  const double bound_mm = std::sqrt(square) + kRounding_mm;
  bool inside = false;
  for (std::size_t r = 0; r < kRuns; ++r) {
    if (r != first && least_mm[r] <= bound_mm) square = std::min(square, squareInRun_mm2(r, p));
    inside = inside != crossesOddlyInRun(r, p);
  }
  return inside ? -std::sqrt(square) : std::sqrt(square);
}

}  // namespace assets
