#include "app/procedure/root_stress.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <fmt/core.h>

#include "assets/tissue.h"
#include "calibration/geometry/units.h"
#include "haptics/body/bridge_strength.h"
#include "haptics/body/principal_axes.h"

namespace app {
namespace {

constexpr double kRaster_mm = 0.25;  ///< of a section
constexpr double kHolds_mm = 0.8;    ///< from root to bone, ligament and voxels between them
constexpr double kWithin_mm = 16.0;  ///< of the axis
constexpr double kAgain_s = 0.5;
constexpr double kLeastPart_mm2 = 0.3;

double shareOfDentine(std::uint8_t label) {
  const assets::Tissue tissue{label};
  if (tissue == assets::Tissue::dentine || tissue == assets::Tissue::other_teeth) return 1.0;
  return tissue == assets::Tissue::enamel ? haptics::DentineLimits::kEnamelFactor : 0.0;
}

/// Solid dentine and enamel on a plane across the axis.
class SectionRaster {
 public:
  SectionRaster(const HeldPiece& piece, const glm::dvec3& middle_Q_mm, const glm::dvec3& e1, const glm::dvec3& e2)
      : middle_Q_mm_(middle_Q_mm), e1_(e1), e2_(e2), weight_(static_cast<std::size_t>(kSide) * kSide, 0.0) {
    for (int j = 0; j < kSide; ++j)
      for (int i = 0; i < kSide; ++i) {
        const glm::ivec3 ijk(glm::round(piece.grid.indexFromPoint(at_Q_mm(place(i, j)))));
        if (!piece.grid.contains(ijk)) continue;
        const std::size_t v = piece.grid.index(ijk);
        weight_[index(i, j)] = shareOfDentine(piece.label[v]) * piece.solid[v] / 255.0;
        has_enamel_ = has_enamel_ || (assets::Tissue{piece.label[v]} == assets::Tissue::enamel &&
                                      piece.solid[v] >= assets::kHalfSolid);
      }
  }

  std::optional<RootSection> section() {
    RootSection section;
    glm::dvec2 centre(0.0);
    double xx = 0.0, xy = 0.0, yy = 0.0;
    std::vector<Part> parts;
    for (int j = 0; j < kSide; ++j)
      for (int i = 0; i < kSide; ++i)
        if (weight_[index(i, j)] > 0.0) parts.push_back(takePart(i, j));
    std::erase_if(parts, [](const Part& part) { return part.area_mm2 < kLeastPart_mm2; });
    if (parts.empty()) return {};
    for (const Part& part : parts) {
      section.area_mm2 += part.area_mm2;
      centre += part.area_mm2 * part.centre_mm;
      xx += part.xx_mm4, xy += part.xy_mm4, yy += part.yy_mm4;
    }
    section.centre_Q_mm = at_Q_mm(centre / section.area_mm2);
    // Bending about u moves fibres along v.
    const double turn = 0.5 * std::atan2(2.0 * xy, xx - yy);
    const glm::dvec2 u(std::cos(turn), std::sin(turn)), v(-u.y, u.x);
    section.u_Q = u.x * e1_ + u.y * e2_;
    section.v_Q = v.x * e1_ + v.y * e2_;
    const auto along = [&](const glm::dvec2& d) { return d.x * d.x * xx + 2.0 * d.x * d.y * xy + d.y * d.y * yy; };
    section.second_u_mm4 = along(v);
    section.second_v_mm4 = along(u);
    std::array<double, RootSection::kFibres> farthest_mm{};
    for (const Part& part : parts)
      for (const glm::dvec2& p : part.places_mm) {
        const glm::dvec2 d = p - part.centre_mm, r(glm::dot(d, u), glm::dot(d, v));
        for (std::size_t n = 0; n < RootSection::kFibres; ++n) {
          const double side_rad = 2.0 * calibration::kPi * static_cast<double>(n) / RootSection::kFibres;
          const glm::dvec2 side(std::cos(side_rad), std::sin(side_rad));
          const double along_mm = glm::dot(r, side) + 0.5 * kRaster_mm;
          if (along_mm > farthest_mm[n]) farthest_mm[n] = along_mm, section.fibres_mm[n] = r + 0.5 * kRaster_mm * side;
        }
      }
    section.is_crown = has_enamel_;
    return section;
  }

 private:
  static constexpr int kHalf = static_cast<int>(kWithin_mm / kRaster_mm), kSide = 2 * kHalf + 1;

  struct Part {
    double area_mm2 = 0.0, xx_mm4 = 0.0, xy_mm4 = 0.0, yy_mm4 = 0.0;
    glm::dvec2 centre_mm{0.0};
    std::vector<glm::dvec2> places_mm;
  };

  static std::size_t index(int i, int j) { return static_cast<std::size_t>(j) * kSide + static_cast<std::size_t>(i); }
  static glm::dvec2 place(int i, int j) { return kRaster_mm * glm::dvec2(i - kHalf, j - kHalf); }
  glm::dvec3 at_Q_mm(const glm::dvec2& p) const { return middle_Q_mm_ + p.x * e1_ + p.y * e2_; }

  /// What hangs together with a place, which is taken off the raster.
  Part takePart(int first_i, int first_j) {
    Part part;
    std::vector<glm::ivec2> open{{first_i, first_j}};
    std::vector<double> weights;
    const auto enter = [&](int i, int j) {
      weights.push_back(std::exchange(weight_[index(i, j)], 0.0));
      part.places_mm.push_back(place(i, j));
    };
    enter(first_i, first_j);
    while (!open.empty()) {
      const glm::ivec2 at = open.back();
      open.pop_back();
      for (const glm::ivec2& beside : {glm::ivec2(1, 0), glm::ivec2(-1, 0), glm::ivec2(0, 1), glm::ivec2(0, -1)}) {
        const glm::ivec2 next = at + beside;
        if (std::min(next.x, next.y) < 0 || std::max(next.x, next.y) >= kSide || weight_[index(next.x, next.y)] <= 0.0)
          continue;
        enter(next.x, next.y);
        open.push_back(next);
      }
    }
    constexpr double kCell_mm2 = kRaster_mm * kRaster_mm;
    for (std::size_t n = 0; n < weights.size(); ++n) {
      part.area_mm2 += weights[n] * kCell_mm2;
      part.centre_mm += weights[n] * kCell_mm2 * part.places_mm[n];
    }
    part.centre_mm /= part.area_mm2;
    for (std::size_t n = 0; n < weights.size(); ++n) {
      const glm::dvec2 d = part.places_mm[n] - part.centre_mm;
      const double cell = weights[n] * kCell_mm2;
      part.xx_mm4 += cell * d.x * d.x, part.xy_mm4 += cell * d.x * d.y, part.yy_mm4 += cell * d.y * d.y;
    }
    return part;
  }

  glm::dvec3 middle_Q_mm_, e1_, e2_;
  std::vector<double> weight_;
  bool has_enamel_ = false;
};

/// How far along the axis each place of the surface lies that bone holds.
std::vector<double> heldAlong_mm(const HeldPiece& piece, const glm::dvec3& middle_Q_mm, const glm::dvec3& axis) {
  const assets::VolumeGrid& grid = piece.grid;
  const int reach = std::max(1, static_cast<int>(std::lround(kHolds_mm / grid.spacing_mm)));
  std::vector<double> along_mm;
  assets::forVoxels(glm::ivec3(1), grid.size - 1, [&](glm::ivec3 ijk) {
    const std::size_t v = grid.index(ijk);
    if (piece.solid[v] < assets::kHalfSolid || assets::Tissue{piece.label[v]} == assets::Tissue::enamel) return;
    const glm::dvec3 q = grid.centre_P_mm(ijk);
    for (const glm::ivec3& side : {glm::ivec3(1, 0, 0), glm::ivec3(-1, 0, 0), glm::ivec3(0, 1, 0), glm::ivec3(0, -1, 0),
                                   glm::ivec3(0, 0, 1), glm::ivec3(0, 0, -1)}) {
      if (piece.solid[grid.index(ijk + side)] >= assets::kHalfSolid) continue;
      const glm::dvec3 outward = piece.X_PQ.rotation * glm::dvec3(side);
      const glm::dvec3 p = piece.X_PQ.rotation * q + piece.X_PQ.translation_mm;
      for (int n = 1; n <= reach; ++n) {
        const glm::ivec3 beside(glm::round(grid.indexFromPoint(p + n * grid.spacing_mm * outward)));
        if (!grid.contains(beside) || piece.jaw[grid.index(beside)] < assets::kHalfSolid) continue;
        along_mm.push_back(glm::dot(q - middle_Q_mm, axis));
        return;
      }
    }
  });
  std::ranges::sort(along_mm);
  return along_mm;
}

}  // namespace

std::vector<RootSection> rootSections(const HeldPiece& piece, const glm::dvec3& grip_Q_mm) {
  // Its axis, towards the end that is not gripped.
  glm::dvec3 sum(0.0);
  std::size_t count = 0;
  const auto for_solid = [&](const auto& visit) {
    assets::forVoxels(piece.grid, [&](glm::ivec3 ijk, std::size_t v) {
      if (piece.solid[v] >= assets::kHalfSolid) visit(piece.grid.centre_P_mm(ijk));
    });
  };
  for_solid([&](const glm::dvec3& q) { sum += q, ++count; });
  if (count == 0) return {};
  const glm::dvec3 middle = sum / static_cast<double>(count);
  glm::dmat3 spread(0.0);
  for_solid([&](const glm::dvec3& q) { spread += glm::outerProduct(q - middle, q - middle); });
  glm::dmat3 axes = haptics::principalAxes(spread);
  const auto spread_along = [&](int n) { return glm::dot(axes[n], spread * axes[n]); };
  for (const int n : {1, 2})
    if (spread_along(n) > spread_along(0)) std::swap(axes[0], axes[n]);
  if (glm::dot(grip_Q_mm - middle, axes[0]) > 0.0) axes[0] = -axes[0];

  double first_mm = std::numeric_limits<double>::infinity(), last_mm = -first_mm;
  for_solid([&](const glm::dvec3& q) {
    const double along_mm = glm::dot(q - middle, axes[0]);
    first_mm = std::min(first_mm, along_mm), last_mm = std::max(last_mm, along_mm);
  });
  first_mm = std::max(first_mm, glm::dot(grip_Q_mm - middle, axes[0]));
  const std::vector<double> held_mm = heldAlong_mm(piece, middle, axes[0]);
  std::vector<RootSection> sections;
  if (held_mm.empty()) return sections;
  for (std::size_t n = 0; n < kRootSections; ++n) {
    const double along_mm = glm::mix(first_mm, last_mm, (static_cast<double>(n) + 0.5) / kRootSections);
    auto section = SectionRaster(piece, middle + along_mm * axes[0], axes[1], axes[2]).section();
    if (!section) continue;
    const auto beyond = held_mm.end() - std::ranges::lower_bound(held_mm, along_mm);
    section->held = static_cast<double>(beyond) / static_cast<double>(held_mm.size());
    sections.push_back(*section);
  }
  return sections;
}

double stressAt_N_per_mm2(const RootSection& section, const glm::dvec3& force_Q_N, const glm::dvec3& torque_Q_Nmm,
                          const glm::dvec3& at_Q_mm) {
  const glm::dvec3 moment = torque_Q_Nmm + glm::cross(at_Q_mm - section.centre_Q_mm, force_Q_N);
  const glm::dvec3 normal = glm::cross(section.u_Q, section.v_Q);
  // A pull at the grip, which lies on one side of the section, stretches it.
  const glm::dvec3 to_grip = glm::dot(at_Q_mm - section.centre_Q_mm, normal) < 0.0 ? -normal : normal;
  const double about_u = glm::dot(moment, section.u_Q) / section.second_u_mm4,
               about_v = glm::dot(moment, section.v_Q) / section.second_v_mm4;
  double bent = 0.0;
  for (const glm::dvec2& r : section.fibres_mm) bent = std::max(bent, about_u * r.y - about_v * r.x);
  return section.held * (glm::dot(force_Q_N, to_grip) / section.area_mm2 + bent);
}

bool RootStress::isDue(const haptics::Tick& newest) const {
  if (newest.gripped == 0) return false;
  return newest.gripped != piece_ || newest.t_s < surveyed_s_ || newest.t_s >= surveyed_s_ + kAgain_s;
}

void RootStress::survey(const haptics::Tick& newest, const haptics::Bodies& bodies) {
  if (newest.gripped != piece_) is_broken_ = false;
  piece_ = newest.gripped;
  surveyed_s_ = newest.t_s;
  const haptics::CarvedBone& bone = bodies.bones()[newest.gripped];
  HeldPiece piece{bone.grid(),
                  bone.copyBox(glm::ivec3(0), bone.grid().size),
                  {},
                  bodies.jaw().copyBox(bodies.firstBrick(), bone.grid().size),
                  newest.X_PQ[newest.gripped - 1U]};
  piece.label.assign(piece.solid.size(), 0);
  const assets::CtVolume& ct = patient_.ct;
  const glm::ivec3 first = bodies.firstBrick() * assets::kBrickVoxels;
  assets::forVoxels(piece.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (ct.grid.contains(ijk + first)) piece.label[v] = ct.label[ct.grid.index(ijk + first)];
  });
  sections_ = rootSections(piece, (piece.X_PQ.inverse() * newest.proxy_P).mm);
}

void RootStress::update(const haptics::Tick& newest) {
  now_N_per_mm2_.reset();
  if (newest.gripped == 0) piece_ = 0;
  if (newest.gripped == 0 || sections_.empty()) return;
  const haptics::PiecePose& X_PQ = newest.X_PQ[newest.gripped - 1U];
  const glm::dquat R_QP = glm::conjugate(X_PQ.rotation);
  const glm::dvec3 at_Q_mm = R_QP * (newest.proxy_P.mm - X_PQ.translation_mm);
  double most = 0.0;
  for (const RootSection& section : sections_) {
    const double stress =
        stressAt_N_per_mm2(section, R_QP * newest.grip_force_P_N.xyz, R_QP * newest.grip_torque_P_Nmm.xyz, at_Q_mm);
    if (stress > most) most = stress, is_crown_ = section.is_crown;
  }
  now_N_per_mm2_ = most;
  most_N_per_mm2_ = std::max(most_N_per_mm2_, most);
  if (most < kBreaks_N_per_mm2 || is_broken_) return;
  is_broken_ = true;
  news_ = fmt::format("the {} would break here, {:.0f} MPa (model)", is_crown_ ? "crown" : "root", most);
}

void RootStress::follow(const haptics::Tick& newest, const haptics::Bodies& bodies) {
  if (isDue(newest)) survey(newest, bodies);
  update(newest);
}

std::optional<std::string> RootStress::news() { return std::exchange(news_, std::nullopt); }

}  // namespace app
