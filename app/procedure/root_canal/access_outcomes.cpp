#include "app/procedure/root_canal/access_outcomes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "assets/tissue.h"

namespace app {
namespace {

constexpr double kSolid = 0.5;
constexpr double kColumn_mm = 0.06;
constexpr double kAboveRoof_mm = 1.0, kOutlineHeight_mm = 0.5, kIdealAround_mm = 0.5;
constexpr double kBesideOrifice_mm = 0.5, kBelowFloor_mm = 4.0;
constexpr double kShaftRadius_mm = 0.285, kFileDepth_mm = 3.0, kFileAbove_mm = 14.0;

/// Middles of columns along the tooth's axis around its chamber.
template <class Visit>
void forColumns(const assets::ToothCanals& tooth, double around_mm, const Visit& visit) {
  glm::dvec2 low(std::numeric_limits<double>::max()), high(-std::numeric_limits<double>::max());
  for (const glm::dvec2& p : tooth.chamber.outline_mm) low = glm::min(low, p), high = glm::max(high, p);
  low -= tooth.chamber.round_mm + around_mm;
  high += tooth.chamber.round_mm + around_mm;
  for (double y = low.y + 0.5 * kColumn_mm; y < high.y; y += kColumn_mm)
    for (double x = low.x + 0.5 * kColumn_mm; x < high.x; x += kColumn_mm) visit(glm::dvec2(x, y));
}

/// Of a voxel; where its middle lies just outside of the tooth, of the one beside.
std::uint8_t toothPartAt(const ToothBlocks& before, glm::ivec3 ijk) {
  const std::uint8_t label = before.label(ijk);
  if (assets::isHard(label) || assets::isToothPart(label)) return label;
  for (int axis = 0; axis < 3; ++axis)
    for (const int way : {-1, 1}) {
      glm::ivec3 beside = ijk;
      beside[axis] += way;
      if (assets::isToothPart(before.label(beside))) return before.label(beside);
    }
  return label;
}

/// Tooth all around in its plane: where it is air, it was cut, now or before the session.
bool isWithinTooth(const ToothBlocks& before, glm::ivec3 ijk) {
  constexpr int kAround = 4;
  for (const auto& [x, y] : {std::pair(0, 0), {kAround, 0}, {-kAround, 0}, {0, kAround}, {0, -kAround}})
    if (!assets::isToothPart(before.label(ijk + glm::ivec3(x, y, 0)))) return false;
  return true;
}

/// The middle of the nearest place of all canals, and how far that is beyond its wall.
double besideCanals_mm(const assets::ToothCanals& tooth, const glm::dvec3& p_P) {
  double least_mm = std::numeric_limits<double>::max();
  for (const assets::ToothCanal& canal : tooth.canals)
    for (const assets::CanalPlace& place : canal.places)
      least_mm = std::min(least_mm, glm::distance(p_P, place.p_P_mm) - place.wide_mm);
  return least_mm;
}

/// Along the canal where a straight file begins, upwards.
glm::dvec3 shaftAxis_P(const assets::ToothCanal& canal) {
  constexpr double kTangent_mm = 0.2;
  return glm::normalize(canal.at(kFileDepth_mm - kTangent_mm).p_P_mm - canal.at(kFileDepth_mm + kTangent_mm).p_P_mm);
}

}  // namespace

RoofOutcome roofOutcome(const FineSolid& after, const assets::ToothCanals& tooth) {
  const double step_mm = after.grid().spacing_mm, top_mm = tooth.frame.local(tooth.canals[0].reference_P_mm).z + 1.0;
  const double middle_mm = 0.5 * (tooth.chamber.roof_mm + tooth.chamber.floor_mm);
  double all = 0.0, closed = 0.0, solid = 0.0;
  forColumns(tooth, 0.0, [&](const glm::dvec2& at) {
    if (assets::outlineDistance_mm(tooth.chamber.outline_mm, at) > tooth.chamber.round_mm) return;
    all += 1.0;
    bool is_open = true;
    double over = 0.0;
    for (double z = middle_mm; z < top_mm; z += step_mm) {
      if (!is_open && z >= tooth.chamber.roof_mm + kAboveRoof_mm) break;
      const double w = after.at(tooth.frame.inP({at, z}));
      if (w >= kSolid) is_open = false;
      if (z >= tooth.chamber.roof_mm && z < tooth.chamber.roof_mm + kAboveRoof_mm) over += w;
    }
    if (is_open) return;
    closed += 1.0;
    solid += over;
  });
  const double column_mm2 = kColumn_mm * kColumn_mm;
  return {all > 0.0 ? 1.0 - closed / all : 0.0, closed * column_mm2, solid * column_mm2 * step_mm};
}

OutlineOutcome outlineOutcome(const ToothBlocks& before, const FineSolid& after, const assets::ToothCanals& tooth) {
  std::vector<glm::dvec2> orifices;
  for (const assets::ToothCanal& canal : tooth.canals) orifices.emplace_back(tooth.frame.local(canal.orifice_P_mm()));
  const std::vector<glm::dvec2> hull = assets::hullOf(std::move(orifices));
  OutlineOutcome out;
  forColumns(tooth, 3.0, [&](const glm::dvec2& at) {
    const double column_mm2 = kColumn_mm * kColumn_mm;
    const bool is_ideal = assets::outlineDistance_mm(hull, at) <= kIdealAround_mm ||
                          assets::outlineDistance_mm(tooth.chamber.outline_mm, at) <= tooth.chamber.round_mm;
    const glm::dvec3 p_P = tooth.frame.inP({at, tooth.chamber.roof_mm + kOutlineHeight_mm});
    const glm::ivec3 ijk(glm::floor(before.grid().indexFromPoint(p_P) + 0.5));
    const std::uint8_t label = before.label(ijk);
    const bool was_tooth = assets::Tissue{label} == assets::Tissue::pulp ||
                           (assets::isToothPart(label) && before.at(p_P) >= kSolid) || isWithinTooth(before, ijk);
    const bool is_open = was_tooth && after.at(p_P) < kSolid;
    if (is_ideal) out.ideal_mm2 += column_mm2;
    if (is_open) out.opened_mm2 += column_mm2;
    if (is_open && !is_ideal) out.too_wide_mm2 += column_mm2;
    if (is_ideal && !is_open) out.missing_mm2 += column_mm2;
  });
  return out;
}

LostTissue lostTissue(const ToothBlocks& before, const FineSolid& after, const assets::ToothCanals& tooth,
                      std::span<const glm::ivec3> blocks) {
  LostTissue lost;
  const double voxel_mm3 = before.grid().voxelVolume_mm3();
  const auto look = [&](glm::ivec3 ijk, double solid) {
    const std::uint8_t label = toothPartAt(before, ijk);
    if (!assets::isToothPart(label)) return;
    const double mm3 = solid * voxel_mm3;
    (assets::Tissue{label} == assets::Tissue::enamel ? lost.enamel_mm3 : lost.dentine_mm3) += mm3;
    const glm::dvec3 p_P = before.grid().centre_P_mm(ijk), p = tooth.frame.local(p_P);
    const bool is_deep = p.z < tooth.chamber.floor_mm;
    // Orifices are the files' work.
    if (p.z < tooth.chamber.floor_mm + kBesideOrifice_mm && besideCanals_mm(tooth, p_P) < kBesideOrifice_mm) return;
    lost.deepest_mm = std::max(lost.deepest_mm, belowCusp_mm(tooth, p_P));
    if (is_deep && p.z > tooth.chamber.floor_mm - kBelowFloor_mm) lost.floor_mm3 += mm3;
  };
  for (const glm::ivec3& block : blocks) forRemoved(before, after, block, look);
  return lost;
}

LostTissue& operator+=(LostTissue& lost, const LostTissue& more) {
  lost.enamel_mm3 += more.enamel_mm3, lost.dentine_mm3 += more.dentine_mm3, lost.floor_mm3 += more.floor_mm3;
  lost.deepest_mm = std::max(lost.deepest_mm, more.deepest_mm);
  return lost;
}

namespace {

/// Its middle, and how far around it a sample reads it.
std::pair<glm::dvec3, double> readAround(const assets::VolumeGrid& grid, glm::ivec3 block) {
  const glm::dvec3 middle_P =
      grid.centre_P_mm(FineSolid::kEdge * block) + 0.5 * (FineSolid::kEdge - 1) * grid.spacing_mm;
  return {middle_P, std::sqrt(3.0) * (0.5 * FineSolid::kEdge + 1.0) * grid.spacing_mm};
}

}  // namespace

bool isOverChamber(const assets::ToothCanals& tooth, const assets::VolumeGrid& grid, glm::ivec3 block) {
  const auto [middle_P, around_mm] = readAround(grid, block);
  const double lowest_mm =
      std::min(0.5 * (tooth.chamber.roof_mm + tooth.chamber.floor_mm), tooth.chamber.roof_mm + kOutlineHeight_mm);
  return tooth.frame.local(middle_P).z > lowest_mm - around_mm;
}

bool isOverOrifice(const assets::ToothCanal& canal, const assets::VolumeGrid& grid, glm::ivec3 block) {
  const auto [middle_P, around_mm] = readAround(grid, block);
  // The shaft is as wide as it is.
  return glm::dot(middle_P - canal.orifice_P_mm(), shaftAxis_P(canal)) > -around_mm - kShaftRadius_mm;
}

bool StraightLine::isFree() const { return least_angle_rad < 5.0 * std::numbers::pi / 180.0; }

StraightLine straightLine(const FineSolid& after, const assets::ToothCanal& canal) {
  constexpr double kAngleStep_rad = 0.5 * std::numbers::pi / 180.0;
  constexpr int kAzimuths = 72;
  const double step_mm = after.grid().spacing_mm;
  const glm::dvec3 from = canal.at(kFileDepth_mm).p_P_mm;
  const glm::dvec3 up = shaftAxis_P(canal);
  const glm::dvec3 other = std::abs(up.x) < 0.9 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
  const glm::dvec3 across = glm::normalize(glm::cross(up, other)), aside = glm::cross(up, across);

  StraightLine line;
  const double over_mm = glm::dot(canal.orifice_P_mm() - from, up);
  for (double mm = over_mm; mm < over_mm + kFileAbove_mm; mm += step_mm)
    for (double x = -kShaftRadius_mm; x <= kShaftRadius_mm; x += step_mm)
      for (double y = -kShaftRadius_mm; y <= kShaftRadius_mm; y += step_mm)
        if (x * x + y * y <= kShaftRadius_mm * kShaftRadius_mm)
          line.blocked_mm3 += after.at(from + mm * up + x * across + y * aside) * step_mm * step_mm * step_mm;

  const glm::dvec3 orifice = canal.orifice_P_mm();
  const auto is_free = [&](double angle_rad, double azimuth_rad) {
    const glm::dvec3 way = std::cos(angle_rad) * up +
                           std::sin(angle_rad) * (std::cos(azimuth_rad) * across + std::sin(azimuth_rad) * aside);
    for (double mm = 0.5 * step_mm; mm < kFileAbove_mm; mm += step_mm)
      if (after.at(orifice + mm * way) >= kSolid) return false;
    return true;
  };
  line.least_angle_rad = 0.5 * std::numbers::pi;
  for (double angle = 0.0; angle < 0.5 * std::numbers::pi; angle += kAngleStep_rad)
    for (int n = 0; n < kAzimuths; ++n) {
      const double azimuth = 2.0 * std::numbers::pi * n / kAzimuths;
      if (!is_free(angle, azimuth)) continue;
      double blocked = std::max(0.0, angle - kAngleStep_rad), free = angle;
      for (int halving = 0; halving < 6 && free > 0.0; ++halving) {
        const double middle = 0.5 * (blocked + free);
        (is_free(middle, azimuth) ? free : blocked) = middle;
      }
      line.least_angle_rad = std::min(line.least_angle_rad, free);
      angle = std::numbers::pi;  // the others of this angle lie within one step
      break;
    }
  return line;
}

DepthBand depthBand(double below_cusp_mm) {
  constexpr double kRoof_mm = 6.4, kFloor_mm = 7.95;
  if (below_cusp_mm > kFloor_mm) return DepthBand::red;
  return below_cusp_mm > kRoof_mm ? DepthBand::amber : DepthBand::fine;
}

double belowCusp_mm(const assets::ToothCanals& tooth, const glm::dvec3& p_P_mm) {
  return glm::dot(tooth.canals[0].reference_P_mm - p_P_mm, tooth.frame.axes_P[2]);
}

}  // namespace app
