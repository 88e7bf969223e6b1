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

// Clockwise seen from the operated side's front: upper lip, retracted corner, lower lip, free corner.
constexpr std::array<Knot, 20> kKnots = {
    {{0, 40.4, 4.6, -0.2},    {4.5, 41.6, 4.9, -0.4},  {10, 41.4, 4.7, -0.2},  {18, 39.6, 4.2, 0.4},
     {28, 36.4, 3.6, 1.2},    {39.5, 31.0, 3.2, 2.0},  {48, 22.5, 3.0, 3.0},   {48.3, 8.5, 3.0, 3.2},
     {40.5, -1.4, 3.6, 2.0},  {26, -4.6, 4.6, 0.4},    {13, -5.4, 5.4, -0.2},  {0, -5.2, 5.6, -0.3},
     {-12, -4.4, 5.3, -0.1},  {-20, -1.2, 4.5, 0.6},   {-25.5, 6.0, 3.7, 1.4}, {-27.5, 15.5, 3.2, 1.8},
     {-25.5, 25.0, 3.5, 1.4}, {-18.5, 34.8, 4.1, 0.6}, {-10, 40.6, 4.7, -0.2}, {-4.5, 41.6, 4.9, -0.4}}};

}  // namespace

MouthRim::MouthRim(const std::function<double(double, double)>& depth_at) {
  // Catmull-Rom through the knots.
  constexpr std::size_t kPerSpan = kPoints / kKnots.size();
  std::array<double, kPoints> inward_mm{};
  for (std::size_t n = 0; n < kPoints; ++n) {
    const auto knot = [&](std::size_t i) { return kKnots[(n / kPerSpan + kKnots.size() + i - 1) % kKnots.size()]; };
    const double t = static_cast<double>(n % kPerSpan) / kPerSpan;
    const auto value = [&](auto member) {
      return catmullRom(knot(0).*member, knot(1).*member, knot(2).*member, knot(3).*member, t);
    };
    edge_[n] = {value(&Knot::x_mm), value(&Knot::z_mm)};
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
}

MouthRim::LipPoint MouthRim::lip(const glm::dvec3& p) const {
  LipPoint best{1e9, 0.0};
  for (std::size_t n = 0; n < kPoints; ++n) {
    const std::size_t next = (n + 1) % kPoints;
    const double t = nearestOnSegment(p, lip_[n], lip_[next]);
    const double d =
        glm::length(p - lip_[n] - t * (lip_[next] - lip_[n])) - glm::mix(radius_mm_[n], radius_mm_[next], t);
    if (d < best.distance_mm) best = {d, (static_cast<double>(n) + t) / static_cast<double>(kPoints)};
  }
  return best;
}

double MouthRim::opening_mm(double x_mm, double z_mm) const { return polygonDistance_mm(edge_, {x_mm, z_mm}); }

}  // namespace assets
