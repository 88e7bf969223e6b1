#include "assets/scan/metal_shadow.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace assets {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr int kBeamsAcross = 4;  ///< of a pixel: a thin file is narrower than one

/// Where a point falls on the film, in pixels.
dvec2 shadowOf_px(const PeriapicalView& view, const dvec3& p_P_mm) {
  const dvec3 out = glm::cross(view.right_P, view.down_P), way = p_P_mm - view.source_P_mm;
  const double depth = glm::dot(out, view.corner_P_mm - view.source_P_mm) / glm::dot(out, way);
  const dvec3 on_film = view.source_P_mm + depth * way - view.corner_P_mm;
  return dvec2(glm::dot(on_film, view.right_P), glm::dot(on_film, view.down_P)) / view.pixel_mm;
}

struct Box {
  glm::ivec2 from{0}, end{0};
};

Box boxOf(const PeriapicalView& view, const dvec3& from, const dvec3& to, double radius_mm) {
  const dvec2 a = shadowOf_px(view, from), b = shadowOf_px(view, to);
  // The film lies behind the tooth: a shadow is a little wider than what casts it.
  const double around_px = 1.2 * radius_mm / view.pixel_mm + 1.0;
  return {glm::clamp(glm::ivec2(glm::floor(glm::min(a, b) - around_px)), glm::ivec2(0), view.size_px),
          glm::clamp(glm::ivec2(glm::ceil(glm::max(a, b) + around_px)) + 1, glm::ivec2(0), view.size_px)};
}

void addCone(const PeriapicalView& view, const MetalFragment& one, std::size_t n, std::vector<float>& bone_mm) {
  const dvec3 &from = one.node_P_mm[n], &to = one.node_P_mm[n + 1];
  const double from_radius = one.radius_mm[n], to_radius = one.radius_mm[n + 1];
  const double bone = one.nickel_titanium ? kNickelTitaniumToBone : kSteelToBone;
  const Box box = boxOf(view, from, to, std::max(from_radius, to_radius));
  for (int y = box.from.y; y < box.end.y; ++y)
    for (int x = box.from.x; x < box.end.x; ++x) {
      double sum_mm = 0.0;
      for (int v = 0; v < kBeamsAcross; ++v)
        for (int u = 0; u < kBeamsAcross; ++u) {
          const dvec2 px = dvec2(x, y) + (dvec2(u, v) + 0.5) / static_cast<double>(kBeamsAcross) - 0.5;
          const dvec3 film = view.corner_P_mm + view.pixel_mm * (px.x * view.right_P + px.y * view.down_P);
          sum_mm +=
              chord_mm(view.source_P_mm, glm::normalize(film - view.source_P_mm), from, from_radius, to, to_radius);
        }
      const auto at =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(view.size_px.x) + static_cast<std::size_t>(x);
      bone_mm[at] += static_cast<float>(bone * sum_mm / (kBeamsAcross * kBeamsAcross));
    }
}

}  // namespace

double chord_mm(const dvec3& from, const dvec3& way, const dvec3& cone_from, double from_radius_mm,
                const dvec3& cone_to, double to_radius_mm) {
  const dvec3 along = cone_to - cone_from;
  const double length = glm::length(along);
  if (!(length > 0.0)) return 0.0;
  const dvec3 axis = along / length;
  // Along the axis z = z0 + t dz; aside |a + t b|; radius r0 + z slope.
  const double z0 = glm::dot(from - cone_from, axis), dz = glm::dot(way, axis);
  const dvec3 a = from - cone_from - z0 * axis, b = way - dz * axis;
  const double slope = (to_radius_mm - from_radius_mm) / length, r0 = from_radius_mm + slope * z0, dr = slope * dz;
  // Between its ends.
  double first = 0.0, last = 1e9;
  if (std::fabs(dz) > 1e-12) {
    const double t0 = -z0 / dz, t1 = (length - z0) / dz;
    first = std::max(first, std::min(t0, t1)), last = std::min(last, std::max(t0, t1));
  } else if (z0 < 0.0 || z0 > length) {
    return 0.0;
  }
  // |a + t b|^2 <= (r0 + t dr)^2, of a cone that is slimmer than the beam is across: an interval.
  const double A = glm::dot(b, b) - dr * dr, B = glm::dot(a, b) - r0 * dr, C = glm::dot(a, a) - r0 * r0;
  if (A > 1e-12) {
    const double root = B * B - A * C;
    if (!(root > 0.0)) return 0.0;
    first = std::max(first, (-B - std::sqrt(root)) / A), last = std::min(last, (-B + std::sqrt(root)) / A);
  } else if (C > 0.0) {
    // Along it, outside.
    return 0.0;
  }
  return std::max(0.0, last - first);
}

void addMetal(const PeriapicalView& view, std::span<const MetalFragment> fragments, std::vector<float>& bone_mm) {
  assert(bone_mm.size() == static_cast<std::size_t>(view.size_px.x) * static_cast<std::size_t>(view.size_px.y));
  for (const MetalFragment& one : fragments)
    for (std::size_t n = 0; n + 1 < std::min(one.node_P_mm.size(), one.radius_mm.size()); ++n)
      addCone(view, one, n, bone_mm);
}

}  // namespace assets
