#include "app/procedure/flap/gum_chart.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "assets/trilinear.h"

namespace app {
namespace {

constexpr double kLineBelow_mm = 7.0;   // the bone's surface in the middle of the cut
constexpr double kBeyondCut_mm = 12.0;  // along the arch
constexpr double kReach_mm = 30.0;      // of the rays
constexpr double kTooth_mm = 9.0;       // a crown stands free that far over its gum
constexpr double kOverGum_mm = 0.6;     // nearer, what is solid belongs to the ground
constexpr double kStep_mm = 0.15;       // along a ray through the scan
constexpr double kGumOver_mm = 3.0;     // of gum over which nothing solid is found

/// 0 outside of the scan.
double solidAt(const assets::CtVolume& ct, const glm::dvec3& p_P_mm) {
  const glm::ivec3 base(glm::floor(ct.grid.indexFromPoint(p_P_mm)));
  if (!ct.grid.contains(base) || !ct.grid.contains(base + 1)) return 0.0;
  return assets::trilinearAt(ct.grid, p_P_mm,
                             [&](glm::ivec3 ijk) { return double{1.0} * ct.solid[ct.grid.index(ijk)]; });
}

}  // namespace

GumChart::GumChart(const assets::MeshModel& gum_P, const assets::CtVolume& ct, const assets::PlannedCut& cut) {
  buccal_P_ = glm::normalize(cut.lateral_P);
  up_P_ = glm::normalize(cut.outward_P - glm::dot(cut.outward_P, buccal_P_) * buccal_P_);
  mesial_P_ = glm::cross(buccal_P_, up_P_);
  if (mesial_P_.y > 0.0) mesial_P_ = -mesial_P_;  // anterior is -y
  origin_P_mm_ = cut.surface_P_mm - kLineBelow_mm * up_P_;
  double low_mm = 0.0, high_mm = 0.0;
  for (const auto& stroke : cut.strokes_P_mm)
    for (const glm::dvec3& p : stroke) {
      const double m_mm = glm::dot(p - origin_P_mm_, mesial_P_);
      low_mm = std::min(low_mm, m_mm), high_mm = std::max(high_mm, m_mm);
    }
  low_m_mm_ = low_mm - kBeyondCut_mm;
  columns_ = static_cast<int>((high_mm - low_mm + 2.0 * kBeyondCut_mm) / kColumn_mm) + 1;
  rows_ = static_cast<int>((kHighest_rad - kLowest_rad) / kRow_rad) + 1;
  const std::size_t count = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  gum_mm_.assign(count, 0.0), bone_mm_.assign(count, 0.0), gum_.assign(count, 0);
  takeGum(gum_P);
  takeSolid(ct);
}

/// Where the rays leave the mesh: each column's plane cuts triangles into segments, whose rows are looked for.
void GumChart::takeGum(const assets::MeshModel& gum_P) {
  const auto in_plane = [&](const glm::dvec3& p) {
    const glm::dvec3 off = p - origin_P_mm_;
    return glm::dvec2(glm::dot(off, buccal_P_), glm::dot(off, up_P_));
  };
  const auto take = [&](int column, const glm::dvec2& a, const glm::dvec2& b) {
    const double angle_a = std::atan2(a.x, a.y), angle_b = std::atan2(b.x, b.y);
    if (std::abs(angle_a - angle_b) > 1.0) return;  // round the line
    const int first = static_cast<int>(std::ceil((std::min(angle_a, angle_b) - kLowest_rad) / kRow_rad));
    const int last = static_cast<int>(std::floor((std::max(angle_a, angle_b) - kLowest_rad) / kRow_rad));
    for (int row = std::max(first, 0); row <= std::min(last, rows_ - 1); ++row) {
      const double angle = kLowest_rad + kRow_rad * row;
      const glm::dvec2 ray(std::sin(angle), std::cos(angle)), across(ray.y, -ray.x);
      const double at_a = glm::dot(a, across), at_b = glm::dot(b, across);
      const double part = std::abs(at_a - at_b) > 1e-12 ? at_a / (at_a - at_b) : 0.0;
      const double r_mm = glm::dot(glm::mix(a, b, std::clamp(part, 0.0, 1.0)), ray);
      double& known_mm = gum_mm_[index(column, row)];
      if (r_mm <= kReach_mm) known_mm = std::max(known_mm, r_mm);
    }
  };
  for (const assets::MeshPart& part : gum_P.parts)
    for (std::size_t t = 0; t + 2 < part.triangles.size(); t += 3) {
      std::array<glm::dvec3, 3> p;
      glm::dvec3 m;
      for (int n = 0; n < 3; ++n) {
        p[static_cast<std::size_t>(n)] = glm::dvec3(part.position_mm[part.triangles[t + static_cast<std::size_t>(n)]]);
        m[n] = (glm::dot(p[static_cast<std::size_t>(n)] - origin_P_mm_, mesial_P_) - low_m_mm_) / kColumn_mm;
      }
      const int first = static_cast<int>(std::ceil(std::min({m.x, m.y, m.z})));
      const int last = static_cast<int>(std::floor(std::max({m.x, m.y, m.z})));
      for (int column = std::max(first, 0); column <= std::min(last, columns_ - 1); ++column) {
        std::array<glm::dvec2, 3> cut;
        std::size_t found = 0;
        for (std::size_t n = 0; n < 3; ++n) {
          const std::size_t next = (n + 1) % 3;
          const double here = m[static_cast<int>(n)] - column, there = m[static_cast<int>(next)] - column;
          if ((here < 0.0) == (there < 0.0)) continue;
          cut[found++] = in_plane(glm::mix(p[n], p[next], here / (here - there)));
        }
        if (found == 2) take(column, cut[0], cut[1]);
      }
    }
}

void GumChart::takeSolid(const assets::CtVolume& ct) {
  const auto inwards_mm = [&](const ChartPlace& at, double from_mm) {
    double before = solidAt(ct, point_P_mm(at, from_mm));
    if (before >= assets::kHalfSolid) return from_mm;
    for (double r_mm = from_mm - kStep_mm; r_mm > 0.0; r_mm -= kStep_mm) {
      const double here = solidAt(ct, point_P_mm(at, r_mm));
      if (here >= assets::kHalfSolid)
        return r_mm + kStep_mm * (here - assets::kHalfSolid) / std::max(here - before, 1e-9);
      before = here;
    }
    return 0.0;
  };
  for (int column = 0; column < columns_; ++column)
    for (int row = 0; row < rows_; ++row) {
      const ChartPlace at = node(column, row);
      double& gum = gum_mm_[index(column, row)];
      double& bone = bone_mm_[index(column, row)];
      bool is_gum = gum > 0.0;
      for (double over_mm = kOverGum_mm; is_gum && over_mm < kTooth_mm; over_mm += 2.0 * kStep_mm)
        is_gum = solidAt(ct, point_P_mm(at, gum + over_mm)) < assets::kHalfSolid;
      gum_[index(column, row)] = is_gum ? 1 : 0;
      bone = inwards_mm(at, is_gum ? gum : gum > 0.0 ? gum + kTooth_mm : kReach_mm - kTooth_mm);
      if (bone == 0.0) bone = std::max(0.5, (gum > 0.0 ? gum : kGumOver_mm) - kGumOver_mm);
      if (!is_gum) gum = bone;
    }
}

ChartPlace GumChart::placeOf(const glm::dvec3& p_P_mm) const {
  const glm::dvec3 off = p_P_mm - origin_P_mm_;
  return {glm::dot(off, mesial_P_), std::atan2(glm::dot(off, buccal_P_), glm::dot(off, up_P_))};
}

double GumChart::radiusOf_mm(const glm::dvec3& p_P_mm) const {
  const glm::dvec3 off = p_P_mm - origin_P_mm_;
  return std::hypot(glm::dot(off, buccal_P_), glm::dot(off, up_P_));
}

glm::dvec3 GumChart::outward_P(const ChartPlace& at) const {
  return std::sin(at.angle_rad) * buccal_P_ + std::cos(at.angle_rad) * up_P_;
}

glm::dvec3 GumChart::point_P_mm(const ChartPlace& at, double r_mm) const {
  return origin_P_mm_ + at.m_mm * mesial_P_ + r_mm * outward_P(at);
}

bool GumChart::contains(const ChartPlace& at) const {
  const double m = (at.m_mm - low_m_mm_) / kColumn_mm, row = (at.angle_rad - kLowest_rad) / kRow_rad;
  return m >= 0.0 && row >= 0.0 && m <= columns_ - 1.0 && row <= rows_ - 1.0;
}

bool GumChart::isGum(const ChartPlace& at) const {
  if (!contains(at)) return false;
  return isGum(static_cast<int>(std::lround((at.m_mm - low_m_mm_) / kColumn_mm)),
               static_cast<int>(std::lround((at.angle_rad - kLowest_rad) / kRow_rad)));
}

/// Of the lattice points around a place those that are gum, where there is one: a tooth beside it does not count.
double GumChart::value(const std::vector<double>& of, const ChartPlace& at) const {
  const double m = std::clamp((at.m_mm - low_m_mm_) / kColumn_mm, 0.0, columns_ - 1.001);
  const double r = std::clamp((at.angle_rad - kLowest_rad) / kRow_rad, 0.0, rows_ - 1.001);
  const int column = static_cast<int>(m), row = static_cast<int>(r);
  const double x = m - column, y = r - row;
  double sum = 0.0, weights = 0.0, plain = 0.0;
  for (int corner = 0; corner < 4; ++corner) {
    const std::size_t n = index(column + corner / 2, row + corner % 2);
    const double weight = (corner / 2 ? x : 1.0 - x) * (corner % 2 ? y : 1.0 - y);
    plain += weight * of[n];
    if (gum_[n] != 0) sum += weight * of[n], weights += weight;
  }
  return weights > 1e-9 ? sum / weights : plain;
}

glm::dvec3 GumChart::normal_P(const ChartPlace& at) const {
  constexpr double kAside_mm = 0.6, kAside_rad = 0.06;
  const glm::dvec3 along =
      surface_P_mm({at.m_mm + kAside_mm, at.angle_rad}) - surface_P_mm({at.m_mm - kAside_mm, at.angle_rad});
  const glm::dvec3 across =
      surface_P_mm({at.m_mm, at.angle_rad + kAside_rad}) - surface_P_mm({at.m_mm, at.angle_rad - kAside_rad});
  const glm::dvec3 normal = glm::normalize(glm::cross(along, across));
  return glm::dot(normal, outward_P(at)) < 0.0 ? -normal : normal;
}

double GumChart::depth_mm(const glm::dvec3& p_P_mm) const {
  const ChartPlace at = placeOf(p_P_mm);
  return (gum_mm(at) - radiusOf_mm(p_P_mm)) * glm::dot(normal_P(at), outward_P(at));
}

}  // namespace app
