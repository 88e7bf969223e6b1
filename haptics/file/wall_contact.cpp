#include "haptics/file/wall_contact.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace haptics {
namespace {

using glm::dmat3;
using glm::dvec3;

constexpr std::size_t kAllRays = kRays, kTipRays = 13;
constexpr int kMostSamples = 24;

/// Cosines of a sixteenth of a turn; the sine is that of twelve sixteenths on.
constexpr std::array<double, kAllRays> kCosine{1.0,  0.92387953251128674,  0.70710678118654752,  0.38268343236508977,
                                               0.0,  -0.38268343236508977, -0.70710678118654752, -0.92387953251128674,
                                               -1.0, -0.92387953251128674, -0.70710678118654752, -0.38268343236508977,
                                               0.0,  0.38268343236508977,  0.70710678118654752,  0.92387953251128674};
constexpr double cosineOf(std::size_t ray) { return kCosine[ray]; }
constexpr double sineOf(std::size_t ray) { return kCosine[(ray + 12) % kAllRays]; }

struct Across {
  dvec3 e1, e2;
};
Across across(const dvec3& axis) {
  const dvec3 aside = std::fabs(axis.x) < 0.7 ? dvec3(1.0, 0.0, 0.0) : dvec3(0.0, 1.0, 0.0);
  const dvec3 normal = glm::cross(axis, aside), e1 = normal / std::sqrt(glm::dot(normal, normal));
  return {e1, glm::cross(axis, e1)};
}

/// One along the axis, six at 30 and six at 60 degrees from it; the rest are spare.
std::array<dvec3, kAllRays> tipRays(const dvec3& axis) {
  constexpr double kHalfRoot3 = 0.5 * std::numbers::sqrt3;
  constexpr std::array<std::array<double, 2>, 6> kRound{
      {{1.0, 0.0}, {0.5, kHalfRoot3}, {-0.5, kHalfRoot3}, {-1.0, 0.0}, {-0.5, -kHalfRoot3}, {0.5, -kHalfRoot3}}};
  const Across plane = across(axis);
  std::array<dvec3, kAllRays> rays;
  rays.fill(axis);
  for (std::size_t n = 0; n < 6; ++n) {
    const dvec3 out = kRound[n][0] * plane.e1 + kRound[n][1] * plane.e2;
    rays[1 + n] = kHalfRoot3 * axis + 0.5 * out;
    rays[7 + n] = 0.5 * axis + kHalfRoot3 * out;
  }
  return rays;
}

/// The rays' depths in voxels.
bool cast(const FileLaw& law, const SolidField& wall, const SectionPlace& at, const std::array<dvec3, kAllRays>& rays,
          RayDepths& out) {
  const double per_mm = 1.0 / wall.grid.spacing_mm, reach = at.radius_mm * per_mm + 1.5;
  const dvec3 centre = wall.grid.indexFromPoint(at.centre_P_mm);
  const dvec3 size(wall.grid.size);
  for (int axis = 0; axis < 3; ++axis)
    if (!(centre[axis] + reach > 0.0 && centre[axis] - reach < size[axis] - 1.0) || size[axis] < 3.0) return false;

  SectionRays section;
  for (int axis = 0; axis < 3; ++axis) {
    section.centre[axis] = static_cast<float>(centre[axis]);
    for (std::size_t n = 0; n < kAllRays; ++n) section.along[axis][n] = static_cast<float>(rays[n][axis]);
  }
  const double step_mm = std::min(law.ray_step_mm, wall.grid.spacing_mm);
  section.radius = static_cast<float>(at.radius_mm * per_mm);
  section.step = static_cast<float>(step_mm * per_mm);
  section.flat_face = static_cast<float>(law.flat_face_voxels);
  section.samples = std::clamp(static_cast<int>(std::lround(law.ray_reach_mm / step_mm)), 1, kMostSamples);
  const WallVoxels voxels{wall.slot_of,
                          wall.solid,
                          {wall.grid.size.x, wall.grid.size.y, wall.grid.size.z},
                          {wall.blocks.x, wall.blocks.y, wall.blocks.z}};
  return castRays(voxels, section, out);
}

struct RayStiffness {
  double N_per_mm;
  bool rubs;
};

void add(const RayDepths& cast, const RayStiffness& ray, std::size_t count, double spacing_mm, SectionContact& sum) {
  const double k = ray.N_per_mm;
  for (std::size_t n = 0; n < count; ++n) {
    if (!(cast.depth[n] > 0.0F)) continue;
    const double depth_mm = static_cast<double>(cast.depth[n]) * spacing_mm;
    const dvec3 slope(static_cast<double>(cast.slope[0][n]), static_cast<double>(cast.slope[1][n]),
                      static_cast<double>(cast.slope[2][n]));
    sum.energy_Nmm += 0.5 * k * depth_mm * depth_mm;
    sum.force_N -= k * depth_mm * slope;
    if (ray.rubs) sum.normal_N += k * depth_mm * std::sqrt(glm::dot(slope, slope));

    // Slope and curvature of the depth: a file presses into a trough and is held across it too.
    const double bent = k * depth_mm / spacing_mm;
    const auto curve = [&](int pair) { return bent * static_cast<double>(cast.curve[pair][n]); };
    const double xy = curve(3), xz = curve(4), yz = curve(5);
    sum.stiffness_N_per_mm +=
        glm::outerProduct(k * slope, slope) + dmat3(curve(0), xy, xz, xy, curve(1), yz, xz, yz, curve(2));
  }
}

}  // namespace

std::array<dvec3, kRays> raysAbout(const dvec3& axis) noexcept {
  const Across plane = across(axis);
  std::array<dvec3, kAllRays> rays;
  for (std::size_t n = 0; n < kAllRays; ++n) rays[n] = cosineOf(n) * plane.e1 + sineOf(n) * plane.e2;
  return rays;
}

bool rayDepths(const FileLaw& law, const SolidField& wall, const SectionPlace& at,
               std::array<double, kRays>& depth_mm) noexcept {
  RayDepths found;
  if (!cast(law, wall, at, raysAbout(at.axis), found)) return false;
  for (std::size_t n = 0; n < kAllRays; ++n)
    depth_mm[n] = std::max(0.0, static_cast<double>(found.depth[n]) * wall.grid.spacing_mm);
  return true;
}

void addSection(const FileLaw& law, const SolidField& wall, const SectionPlace& at, SectionContact& sum) noexcept {
  RayDepths found;
  if (!cast(law, wall, at, raysAbout(at.axis), found)) return;
  const double area_mm2 = at.length_mm * at.radius_mm * 2.0 * std::numbers::pi / kRays;
  add(found, {law.wall_N_per_mm3 * area_mm2, true}, kAllRays, wall.grid.spacing_mm, sum);
}

void addTip(const FileLaw& law, const SolidField& wall, const SectionPlace& at, SectionContact& sum) noexcept {
  RayDepths found;
  if (!cast(law, wall, at, tipRays(at.axis), found)) return;
  const double area_mm2 = std::numbers::pi * at.radius_mm * at.radius_mm / static_cast<double>(kTipRays);
  add(found, {law.tip_factor * law.wall_N_per_mm3 * area_mm2, false}, kTipRays, wall.grid.spacing_mm, sum);
}

}  // namespace haptics
