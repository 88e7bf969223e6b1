// Camera model: pinhole with two radial and two tangential terms, pixel centres at integers (OpenCV's convention); and
// its grey images. px, mm. Frame C: x right, y down, z ahead. Plain data; any thread.
#pragma once

#include <cstdint>
#include <vector>

#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"

namespace calibration {

struct CameraModel {
  glm::ivec2 size_px{1920, 1080};
  glm::dvec2 focal_px{1400.0, 1400.0}, centre_px{959.5, 539.5};
  double k1 = 0.0, k2 = 0.0, p1 = 0.0, p2 = 0.0;

  /// Projection of a point in front of the camera.
  glm::dvec2 pixelOf(const Point<Camera>& p_C) const {
    const double x = p_C.mm.x / p_C.mm.z, y = p_C.mm.y / p_C.mm.z, r2 = x * x + y * y;
    const double radial = 1.0 + r2 * (k1 + r2 * k2);
    return {focal_px.x * (x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x)) + centre_px.x,
            focal_px.y * (y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y) + centre_px.y};
  }

  /// Inverse to 1e-12: x and y at z = 1 of a pixel. For moderate distortion.
  glm::dvec2 undistorted(const glm::dvec2& pixel) const {
    const glm::dvec2 seen = (pixel - centre_px) / focal_px;
    glm::dvec2 at = seen;
    for (int step = 0; step < 40; ++step) {
      const double r2 = glm::dot(at, at), radial = 1.0 + r2 * (k1 + r2 * k2);
      const glm::dvec2 shifted{2.0 * p1 * at.x * at.y + p2 * (r2 + 2.0 * at.x * at.x),
                               p1 * (r2 + 2.0 * at.y * at.y) + 2.0 * p2 * at.x * at.y};
      const glm::dvec2 next = (seen - shifted) / radial, change = next - at;
      at = next;
      if (glm::dot(change, change) < 1e-24) break;
    }
    return at;
  }
};

/// Grey levels shown to a camera: below glare, and above the screen's black level.
inline constexpr std::uint8_t kShownWhite = 235, kShownBlack = 16;

/// 8 bits per pixel, rows from the top.
struct GreyImage {
  glm::ivec2 size_px{0};
  std::vector<std::uint8_t> grey;

  static GreyImage filled(const glm::ivec2& size_px, std::uint8_t value) {
    return {size_px, std::vector<std::uint8_t>(pixels(size_px), value)};
  }
  static std::size_t pixels(const glm::ivec2& size_px) {
    return static_cast<std::size_t>(size_px.x) * static_cast<std::size_t>(size_px.y);
  }
  /// Not empty, size and bytes agree.
  bool isWhole() const { return size_px.x > 0 && size_px.y > 0 && grey.size() == pixels(size_px); }
  std::uint8_t& at(int x, int y) { return grey[indexOf(x, y)]; }
  std::uint8_t at(int x, int y) const { return grey[indexOf(x, y)]; }
  std::size_t indexOf(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_px.x) + static_cast<std::size_t>(x);
  }
};

}  // namespace calibration
