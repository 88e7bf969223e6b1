// Ways of a bur in flat bone with the surface z = 0, for tests of measures. mm, s, 1 kHz.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "app/session/measures/work_sample.h"

namespace app::bur_path {

inline constexpr double kRadius_mm = 1.5;

inline WorkSample sampleAt(double t_s, const glm::dvec3& p) {
  WorkSample sample;
  sample.t_s = t_s;
  sample.dt_s = 1e-3;
  sample.bur_P_mm = p;
  sample.axis_P = sample.normal_P = glm::dvec3(0.0, 0.0, 1.0);
  sample.force_P_N = glm::dvec3(0.0, 0.0, 2.0);
  sample.radius_mm = kRadius_mm;
  sample.turns = sample.touches = sample.irrigated = true;
  return sample;
}

/// From corner to corner at a speed, with velocities; `removed_mm3_per_mm` along the way.
inline std::vector<WorkSample> along(const std::vector<glm::dvec3>& corners, double speed_mm_per_s,
                                     double removed_mm3_per_mm) {
  std::vector<WorkSample> samples;
  double t_s = 0.0;
  for (std::size_t n = 1; n < corners.size(); ++n) {
    const glm::dvec3 way = corners[n] - corners[n - 1];
    const int ticks = std::max(1, static_cast<int>(std::lround(glm::length(way) / speed_mm_per_s * 1e3)));
    for (int k = 0; k < ticks; ++k, t_s += 1e-3) {
      samples.push_back(sampleAt(t_s, corners[n - 1] + way * (static_cast<double>(k) / ticks)));
      samples.back().velocity_P_mm_per_s = way / (1e-3 * ticks);
      samples.back().removed_mm3 = removed_mm3_per_mm * glm::length(way) / ticks;
    }
  }
  return samples;
}

/// Strokes of 6 mm to and fro along x, half a radius apart in y, at a depth; each turn is a short slant.
inline std::vector<WorkSample> raster(int strokes, double depth_mm) {
  const double step_mm = 0.5 * kRadius_mm, speed_mm_per_s = 30.0;
  std::vector<glm::dvec3> corners;
  for (int n = 0; n < strokes; ++n) {
    const double y = n * step_mm, from = n % 2 == 0 ? 0.0 : 6.0;
    corners.push_back({from, y, -depth_mm});
    corners.push_back({6.0 - from, y, -depth_mm});
  }
  return along(corners, speed_mm_per_s, step_mm * depth_mm);
}

}  // namespace app::bur_path
