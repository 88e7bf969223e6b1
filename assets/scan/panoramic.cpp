#include "assets/scan/panoramic.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <tbb/parallel_for.h>

#include "assets/trilinear.h"

namespace assets {
namespace {

constexpr double kAir_HU = -1000.0;

/// Points `step_mm` apart along a polyline.
std::vector<glm::dvec2> equallySpaced(const std::vector<glm::dvec2>& curve, double step_mm) {
  std::vector<glm::dvec2> points{curve.front()};
  double left_mm = step_mm;  // to the next point
  for (std::size_t n = 0; n + 1 < curve.size(); ++n) {
    const double length_mm = glm::distance(curve[n], curve[n + 1]);
    double at_mm = left_mm;
    for (; at_mm <= length_mm; at_mm += step_mm) points.push_back(glm::mix(curve[n], curve[n + 1], at_mm / length_mm));
    left_mm = at_mm - length_mm;
  }
  return points;
}

glm::dvec2 normalAt(const std::vector<glm::dvec2>& points, std::size_t n) {
  const glm::dvec2 along = points[std::min(n + 1, points.size() - 1)] - points[n > 0 ? n - 1 : 0];
  return glm::length(along) > 0.0 ? glm::normalize(glm::dvec2(-along.y, along.x)) : glm::dvec2(0.0, 1.0);
}

/// Air outside.
double greyAt(const CtVolume& ct, const glm::dvec3& p_P_mm) {
  return trilinearAt(ct.grid, p_P_mm, [&](glm::ivec3 ijk) {
    return ct.grid.contains(ijk) ? static_cast<double>(ct.hounsfield[ct.grid.index(ijk)]) : kAir_HU;
  });
}

}  // namespace

Panoramic panoramicOf(const CtVolume& ct, const std::vector<glm::dvec2>& curve_P_mm, double pixel_mm, double layer_mm) {
  assert(curve_P_mm.size() >= 2 && pixel_mm > 0.0);
  const double height_mm = ct.grid.spacing_mm * (ct.grid.size.z - 1);
  Panoramic view;
  view.columns_P_mm = equallySpaced(curve_P_mm, pixel_mm);
  view.pixel_mm = pixel_mm;
  view.size_px = {static_cast<int>(view.columns_P_mm.size()), std::max(1, static_cast<int>(height_mm / pixel_mm))};
  view.top_P_mm = ct.grid.origin_P_mm.z + height_mm;
  view.hounsfield.assign(countIn({view.size_px, 1}), 0.0f);

  const int samples = std::max(1, static_cast<int>(std::lround(layer_mm / ct.grid.spacing_mm)));
  tbb::parallel_for(0, view.size_px.x, [&](int x) {
    const auto column = static_cast<std::size_t>(x);
    const glm::dvec2 normal = normalAt(view.columns_P_mm, column);
    for (int y = 0; y < view.size_px.y; ++y) {
      const double z = view.top_P_mm - (y + 0.5) * pixel_mm;
      double sum = 0.0;
      for (int s = 0; s < samples; ++s) {
        const glm::dvec2 p = view.columns_P_mm[column] + ((s + 0.5) / samples - 0.5) * layer_mm * normal;
        sum += greyAt(ct, {p, z});
      }
      view.hounsfield[static_cast<std::size_t>(y * view.size_px.x + x)] = static_cast<float>(sum / samples);
    }
  });
  return view;
}

std::optional<Panoramic::Position> Panoramic::positionOf(const glm::dvec3& p_P_mm) const {
  const glm::dvec2 p{p_P_mm};
  const auto nearest =
      std::ranges::min_element(columns_P_mm, {}, [&](const glm::dvec2& c) { return glm::dot(c - p, c - p); });
  if (nearest == columns_P_mm.end()) return std::nullopt;
  const double distance_mm = glm::distance(*nearest, p);
  // Beyond an end: the point is not across from it.
  const auto n = static_cast<std::size_t>(nearest - columns_P_mm.begin());
  const glm::dvec2 normal = normalAt(columns_P_mm, n);
  const double across_mm = std::abs(glm::dot(p - *nearest, normal));
  if ((n == 0 || n + 1 == columns_P_mm.size()) && distance_mm - across_mm > pixel_mm) return std::nullopt;
  // Between columns.
  const double beyond_mm = glm::dot(p - *nearest, glm::dvec2(normal.y, -normal.x));
  const double column = static_cast<double>(n) + 0.5 + std::clamp(beyond_mm / pixel_mm, -0.5, 0.5);
  return Position{{column, (top_P_mm - p_P_mm.z) / pixel_mm}, across_mm};
}

}  // namespace assets
