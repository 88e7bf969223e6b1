#include "app/procedure/root_canal/canal_section.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "assets/tissue.h"

namespace app {
namespace {

constexpr double kReach_mm = 7.0, kWall = 0.5, kFarthestWall_mm = 3.0;
/// Of the solid at the wall; 0.02 would also count what a touched voxel does to its neighbours: 0.03 of the wall.
constexpr double kTouched = 0.05;
constexpr double kNone = std::numeric_limits<double>::infinity();

/// Solid along a stretch, mm. A voxel's share is the length of it that is solid: where a wall lies follows from the sum
/// within a few micrometres, from one value within a tenth of a voxel.
double solidBetween_mm(const FineSolid& field, const glm::dvec3& origin, const glm::dvec3& way, double from_mm,
                       double to_mm) {
  constexpr int kSamples = 28;
  const double step_mm = (to_mm - from_mm) / kSamples;
  double sum = 0.0;
  for (int n = 0; n < kSamples; ++n) sum += field.at(origin + (from_mm + (n + 0.5) * step_mm) * way);
  return sum * step_mm;
}

double around(const FineSolid& field) { return 1.75 * field.grid().spacing_mm; }

/// Where solid begins on the way; infinity: nowhere.
double wallOf(const FineSolid& field, const glm::dvec3& origin, const glm::dvec3& way) {
  const double step_mm = 0.5 * field.grid().spacing_mm;
  for (double mm = 0.0; mm <= kFarthestWall_mm; mm += step_mm) {
    if (field.at(origin + mm * way) < kWall) continue;
    const double low_mm = std::max(0.0, mm - 0.5 * step_mm - around(field)), high_mm = low_mm + 2.0 * around(field);
    return high_mm - solidBetween_mm(field, origin, way, low_mm, high_mm);
  }
  return kNone;
}

/// Where the tooth ends on the way, beyond its other canals; infinity: nowhere.
double surfaceOf(const ToothBlocks& tooth, const glm::dvec3& origin, const glm::dvec3& way, double from_mm) {
  const double step_mm = 0.5 * tooth.grid().spacing_mm;
  for (double mm = from_mm; mm <= kReach_mm; mm += step_mm) {
    const glm::ivec3 ijk(glm::floor(tooth.grid().indexFromPoint(origin + mm * way) + 0.5));
    if (assets::isToothPart(tooth.label(ijk))) continue;
    const double low_mm = std::max(from_mm, mm - 0.5 * step_mm - around(tooth));
    return low_mm + solidBetween_mm(tooth, origin, way, low_mm, mm - 0.5 * step_mm + around(tooth));
  }
  return kNone;
}

}  // namespace

glm::dvec2 CanalSection::wayOf(std::size_t ray) const {
  const double turn = 2.0 * std::numbers::pi * static_cast<double>(ray) / static_cast<double>(kRays);
  return {std::cos(turn), std::sin(turn)};
}

glm::dvec3 CanalSection::wayInP(std::size_t ray) const {
  const glm::dvec2 way = wayOf(ray);
  return way.x * furcation_P + way.y * aside_P;
}

CanalSection sectionBefore(const ToothBlocks& before, const assets::ToothCanal& canal, const glm::dvec3& furcation_P,
                           double from_foramen_mm) {
  constexpr double kTangent_mm = 0.1;
  CanalSection section;
  section.from_foramen_mm = from_foramen_mm;
  const double along_mm = canal.length_mm() - from_foramen_mm;
  section.centre_P_mm = canal.at(along_mm).p_P_mm;
  const glm::dvec3 along_P =
      glm::normalize(canal.at(along_mm + kTangent_mm).p_P_mm - canal.at(along_mm - kTangent_mm).p_P_mm);
  section.furcation_P = glm::normalize(furcation_P - glm::dot(furcation_P, along_P) * along_P);
  section.aside_P = glm::cross(along_P, section.furcation_P);
  for (std::size_t ray = 0; ray < CanalSection::kRays; ++ray) {
    const glm::dvec3 way_P = section.wayInP(ray);
    section.before_mm[ray] = wallOf(before, section.centre_P_mm, way_P);
    section.root_mm[ray] = kNone;
    if (section.before_mm[ray] == kNone) continue;
    const double in_wall_mm = section.before_mm[ray] + before.grid().spacing_mm;
    section.root_mm[ray] = surfaceOf(before, section.centre_P_mm, way_P, in_wall_mm);
  }
  return section;
}

void measureAfter(CanalSection& section, const ToothBlocks& before, const FineSolid& after) {
  section.read_mm = 0.0;
  for (std::size_t ray = 0; ray < CanalSection::kRays; ++ray) {
    const glm::dvec3 way_P = section.wayInP(ray);
    section.after_mm[ray] = wallOf(after, section.centre_P_mm, way_P);
    const double read_mm = std::min(section.after_mm[ray], kFarthestWall_mm);
    section.read_mm = std::max(section.read_mm, read_mm + 2.5 * around(after));
    section.is_untouched[ray] = false;
    if (section.before_mm[ray] == kNone) continue;
    // A wall that is gone: the root is open there.
    if (section.after_mm[ray] > section.root_mm[ray]) section.after_mm[ray] = section.root_mm[ray];
    const glm::dvec3 on_wall = section.centre_P_mm + section.before_mm[ray] * way_P;
    section.is_untouched[ray] = before.at(on_wall) - after.at(on_wall) < kTouched;
    section.read_mm = std::max(section.read_mm, section.before_mm[ray]);
  }
}

void lookAtLaid(CanalSection& section, const FineSolid& laid) {
  constexpr int kEdge = CanalSection::kLaidEdge;
  constexpr double kHalfLaid = 0.5;
  section.is_laid.assign(static_cast<std::size_t>(kEdge) * kEdge, false);
  bool any = false;
  for (int row = 0; row < kEdge; ++row)
    for (int column = 0; column < kEdge; ++column) {
      const glm::dvec2 at_mm = CanalSection::kLaidCell_mm * glm::dvec2(column - kEdge / 2, row - kEdge / 2);
      if (laid.at(section.centre_P_mm + at_mm.x * section.furcation_P + at_mm.y * section.aside_P) < kHalfLaid)
        continue;
      section.is_laid[static_cast<std::size_t>(row * kEdge + column)] = any = true;
    }
  if (!any) section.is_laid.clear();
}

CanalSection canalSection(const ToothBlocks& before, const FineSolid& after, const assets::ToothCanal& canal,
                          const glm::dvec3& furcation_P, double from_foramen_mm) {
  CanalSection section = sectionBefore(before, canal, furcation_P, from_foramen_mm);
  measureAfter(section, before, after);
  return section;
}

namespace {

/// Towards the furcation, and away from it.
glm::dvec2 removals_mm(const CanalSection& section) {
  constexpr std::size_t kAway = CanalSection::kRays / 2;
  return {section.after_mm[0] - section.before_mm[0], section.after_mm[kAway] - section.before_mm[kAway]};
}

}  // namespace

double transportation_mm(const CanalSection& section) {
  const glm::dvec2 removed_mm = removals_mm(section);
  return removed_mm.x - removed_mm.y;
}

double centring(const CanalSection& section) {
  const glm::dvec2 removed_mm = removals_mm(section);
  const double larger_mm = std::max(removed_mm.x, removed_mm.y);
  return larger_mm <= 0.0 ? 1.0 : std::max(0.0, std::min(removed_mm.x, removed_mm.y)) / larger_mm;
}

glm::dvec2 centroid_mm(const CanalSection::Radii& radii_mm) {
  glm::dvec2 moment(0.0);
  double area = 0.0;
  const CanalSection ways;
  for (std::size_t ray = 0; ray < radii_mm.size(); ++ray) {
    const double r = std::min(radii_mm[ray], kFarthestWall_mm);
    moment += r * r * r / 3.0 * ways.wayOf(ray);
    area += 0.5 * r * r;
  }
  return moment / area;
}

}  // namespace app
