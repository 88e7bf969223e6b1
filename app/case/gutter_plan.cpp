#include "app/case/gutter_plan.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "app/case/gutter_strokes.h"
#include "app/case/height_map.h"
#include "app/case/operated_crown.h"
#include "app/case/trough_plan.h"
#include "assets/synthetic/face.h"
#include "assets/tooth.h"

namespace app {
namespace {

using assets::CtVolume;
using assets::Tissue;

constexpr double kOffTooth_mm = 0.2, kOffNeighbour_mm = 0.8, kOffCanal_mm = 1.5;
constexpr double kBelowCervix_mm = 0.5;  ///< of the bur's lowest point
constexpr double kBehindAxis_mm = 1.0;   ///< of the bur's centre, on the crown's far side
constexpr double kLingual_mm = 1.5;      ///< of the bur's centre from the crown's middle
constexpr double kBoneReach_mm = 22.0;   ///< of the bone that is looked at
constexpr double kLeastDepth_mm = 0.15, kMostDepth_mm = 10.0, kRamusDepth_mm = 13.0;
constexpr double kSightStep_mm = 0.5, kSightLength_mm = 26.0;
constexpr std::size_t kLeastColumns = 40;

Heights heightsOf(const assets::Patient& patient, const WayIn& way, const OperatedCrown& crown, double bur_radius_mm) {
  const CtVolume& ct = patient.ct;
  const int fdi = patient.site->fdi;
  const double rest_mm = bur_radius_mm + kOffTooth_mm,
               beside_mm = std::max(rest_mm + 0.5 * HeightMap::kColumn_mm, kGutterWidth_mm - bur_radius_mm);
  Heights h;
  const auto is_bone = [&](std::size_t v) {
    const Tissue tissue{ct.label[v]};
    return (tissue == Tissue::cortical || tissue == Tissue::trabecular) && ct.solid[v] >= assets::kHalfSolid;
  };
  const glm::ivec3 low(glm::floor(ct.grid.indexFromPoint(way.middle_P_mm - kBoneReach_mm)));
  const glm::ivec3 high(glm::ceil(ct.grid.indexFromPoint(way.middle_P_mm + kBoneReach_mm)));
  assets::forVoxels(glm::max(low, glm::ivec3(1)), glm::min(high, ct.grid.size - 1), [&](glm::ivec3 ijk) {
    const std::size_t v = ct.grid.index(ijk);
    const bool operated = isOfTooth(ct, v, fdi), other = isOtherTooth(ct, v, fdi), bone = is_bone(v);
    if (!operated && !other && !bone) return;
    const glm::dvec3 q = way.local(ct.grid.centre_P_mm(ijk));
    // Only what is on a surface can be touched first.
    const std::size_t row = static_cast<std::size_t>(ct.grid.size.x),
                      slice = row * static_cast<std::size_t>(ct.grid.size.y);
    const auto on_surface = [&](const auto& is_same) {
      return !(is_same(v - 1) && is_same(v + 1) && is_same(v - row) && is_same(v + row) && is_same(v - slice) &&
               is_same(v + slice));
    };
    if (operated && on_surface([&](std::size_t w) { return isOfTooth(ct, w, fdi); })) h.tooth.rest(q, rest_mm);
    if (other && on_surface([&](std::size_t w) { return isOtherTooth(ct, w, fdi); }))
      h.lowest.rest(q, bur_radius_mm + kOffNeighbour_mm);
    if (bone && on_surface(is_bone)) h.bone.rest(q, bur_radius_mm);
  });
  for (const glm::dvec3& p : crown.voxels_P_mm)
    HeightMap::near(way.local(p), beside_mm, [&](int i, int j, double) { h.crown.at(i, j) = 0.0; });
  for (const glm::dvec3& p : patient.mandibular_canal_P_mm)
    h.lowest.rest(way.local(p), bur_radius_mm + patient.mandibular_canal_radius_mm + kOffCanal_mm);

  // Down to the cervical line, on the side of the crown that faces the way in.
  const glm::dvec3 axis = glm::normalize(patient.site->axis_P);
  const double steep = glm::dot(axis, way.outward);
  const glm::dvec3 facing = way.outward - steep * axis;
  const double slope = glm::dot(facing, way.outward);
  for (int j = 0; j < HeightMap::kSide; ++j)
    for (int i = 0; i < HeightMap::kSide; ++i) {
      double& lowest = h.lowest.at(i, j);
      const glm::dvec3 foot = way.inPatient({HeightMap::place_mm(i), HeightMap::place_mm(j), 0.0});
      lowest = std::max(lowest, h.tooth.at(i, j));
      const double over_mm = crown.cervix_mm - kBelowCervix_mm + bur_radius_mm - glm::dot(foot, axis);
      if (steep > 0.05)
        lowest = std::max(lowest, over_mm / steep);
      else if (over_mm - steep * h.bone.at(i, j) > 0.0)
        h.crown.at(i, j) = kNoHeight_mm;
      if (slope > 0.05)
        lowest = std::max(lowest, (-kBehindAxis_mm - glm::dot(foot - crown.middle_P_mm, facing)) / slope);
      if (HeightMap::place_mm(j) < -kLingual_mm) h.crown.at(i, j) = kNoHeight_mm;
    }
  return h;
}

/// Nothing hard stands between a place on the bone and an eye.
bool isSeenBy(const CtVolume& ct, int fdi, const glm::dvec3& from_P_mm, const glm::dvec3& sight) {
  for (double way_mm = 1.0; way_mm < kSightLength_mm; way_mm += kSightStep_mm) {
    const glm::ivec3 ijk(glm::round(ct.grid.indexFromPoint(from_P_mm + way_mm * sight)));
    if (!ct.grid.contains(ijk)) continue;
    const std::size_t v = ct.grid.index(ijk);
    if (isOtherTooth(ct, v, fdi) || (way_mm > 2.0 && ct.solid[v] >= assets::kHalfSolid)) return false;
  }
  return true;
}

/// Both eyes, a little farther apart than they are: half of 63 mm in 500 mm is 3.6 degrees.
bool isSeen(const CtVolume& ct, int fdi, const glm::dvec3& from_P_mm, const glm::dvec3& sight) {
  constexpr double kHalfApart = 0.1;
  const glm::dvec3 aside = kHalfApart * glm::normalize(glm::cross(sight, assets::occlusalDirection_P(fdi)));
  return isSeenBy(ct, fdi, from_P_mm, sight) && isSeenBy(ct, fdi, from_P_mm, glm::normalize(sight - aside)) &&
         isSeenBy(ct, fdi, from_P_mm, glm::normalize(sight + aside));
}

/// The largest connected part of the columns that are to be cut; 1 where a column belongs to it.
std::vector<char> largestPart(const std::vector<char>& wanted) {
  constexpr int kSide = HeightMap::kSide;
  std::vector<int> part(wanted.size(), 0);
  int parts = 0, best = 0;
  std::size_t most = 0;
  std::vector<int> open;
  for (int first = 0; first < kSide * kSide; ++first) {
    if (!wanted[static_cast<std::size_t>(first)] || part[static_cast<std::size_t>(first)]) continue;
    part[static_cast<std::size_t>(first)] = ++parts;
    open.assign(1, first);
    std::size_t count = 0;
    while (!open.empty()) {
      const int at = open.back();
      open.pop_back();
      ++count;
      const int i = at % kSide, j = at / kSide;
      for (const auto& [x, y] : {std::pair{i - 1, j}, {i + 1, j}, {i, j - 1}, {i, j + 1}}) {
        const auto next = HeightMap::column(x, y);
        if (x < 0 || y < 0 || x >= kSide || y >= kSide || !wanted[next] || part[next]) continue;
        part[next] = parts;
        open.push_back(static_cast<int>(next));
      }
    }
    if (count > most) most = count, best = parts;
  }
  std::vector<char> kept(wanted.size());
  std::ranges::transform(part, kept.begin(), [best](int one) { return static_cast<char>(best > 0 && one == best); });
  return kept;
}

}  // namespace

std::optional<assets::PlannedCut> planGutter(const assets::Patient& patient, double bur_radius_mm) {
  if (!patient.site) return std::nullopt;
  const auto crown = operatedCrown(patient.ct, *patient.site);
  if (!crown) return std::nullopt;
  const int fdi = patient.site->fdi;
  const WayIn way = wayIn(patient.ct, *patient.site, crown->middle_P_mm);
  Heights h = heightsOf(patient, way, *crown, bur_radius_mm);
  const glm::dvec3 sight = assets::surgeonEyeDirection(fdi);

  // Where the bone under a line would be hidden from an eye.
  const auto at = [&](int i, int j, double height_mm) {
    return way.inPatient({HeightMap::place_mm(i), HeightMap::place_mm(j), height_mm});
  };
  HeightMap hidden;
  for (int j = 0; j < HeightMap::kSide; ++j)
    for (int i = 0; i < HeightMap::kSide; ++i) {
      if (h.bone.at(i, j) == kNoHeight_mm) continue;
      const glm::dvec3 surface = at(i, j, h.bone.at(i, j) - bur_radius_mm);
      if (!isSeen(patient.ct, fdi, surface, sight))
        HeightMap::near(way.local(surface), bur_radius_mm, [&](int x, int y, double) { hidden.at(x, y) = 0.0; });
    }

  // Columns with bone over the lowest place; those without still bare the crown.
  assets::PlannedCut cut;
  cut.outward_P = way.outward;
  cut.lateral_P = way.across;
  cut.sight_P = sight;
  cut.bur_radius_mm = bur_radius_mm;
  std::vector<char> wanted(HeightMap::kColumns, 0);
  for (int j = 0; j < HeightMap::kSide; ++j)
    for (int i = 0; i < HeightMap::kSide; ++i) {
      if (h.crown.at(i, j) == kNoHeight_mm || h.bone.at(i, j) == kNoHeight_mm) continue;
      // Never far down into the ramus; elsewhere no deeper than a bur can be led.
      const double depth_mm = h.bone.at(i, j) - h.lowest.at(i, j);
      if (depth_mm > kRamusDepth_mm) continue;
      h.lowest.at(i, j) = std::max(h.lowest.at(i, j), h.bone.at(i, j) - kMostDepth_mm);
      if (depth_mm > kLeastDepth_mm && hidden.at(i, j) == kNoHeight_mm)
        wanted[HeightMap::column(i, j)] = 1;
      else if (depth_mm <= kLeastDepth_mm && h.tooth.at(i, j) > h.bone.at(i, j) && i % 3 == 0 && j % 3 == 0)
        cut.bare_P_mm.push_back(at(i, j, h.tooth.at(i, j)));
    }
  const std::vector<char> planned = largestPart(wanted);
  if (static_cast<std::size_t>(std::ranges::count(planned, 1)) < kLeastColumns) return std::nullopt;
  cut.strokes_P_mm = gutterStrokes(way, h, planned);
  if (cut.strokes_P_mm.empty()) return std::nullopt;

  // The column nearest to the middle of the cut.
  const glm::dvec3 middle = way.local(middleOf_P_mm(cut));
  double nearest = -kNoHeight_mm;
  for (int j = 0; j < HeightMap::kSide; ++j)
    for (int i = 0; i < HeightMap::kSide; ++i) {
      if (!planned[HeightMap::column(i, j)]) continue;
      const double off = std::hypot(HeightMap::place_mm(i) - middle.x, HeightMap::place_mm(j) - middle.y);
      if (off >= nearest) continue;
      nearest = off;
      cut.surface_P_mm =
          way.inPatient({HeightMap::place_mm(i), HeightMap::place_mm(j), h.bone.at(i, j) - bur_radius_mm});
    }
  return cut;
}

}  // namespace app
