// Renders a lit screen as a camera sees it: rays through the lens to the plane z = 0 of W. For tests of pattern
// detection; slow and simple.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "calibration/webcam/board.h"

namespace calibration {

/// The virtual screen: centre at the origin of W, x right, y up.
struct ShownScreen {
  glm::ivec2 size_px{1920, 1080};
  glm::dvec2 size_mm{531.0, 298.7};

  Point<World> position_W(const glm::dvec2& px) const {
    return {{((px.x + 0.5) / size_px.x - 0.5) * size_mm.x, (0.5 - (px.y + 0.5) / size_px.y) * size_mm.y, 0.0}};
  }
};

/// From `eye_W`, towards `at_W`, its image rotated by `roll_rad`.
inline Pose<World, Camera> cameraTowards(const glm::dvec3& eye_W, const glm::dvec3& at_W, double roll_rad = 0.0) {
  const glm::dvec3 ahead = glm::normalize(at_W - eye_W);
  const glm::dvec3 right = glm::normalize(glm::cross(ahead, glm::dvec3(0, 1, 0)));
  const glm::dmat3 axes(right, glm::cross(ahead, right), ahead);
  return {glm::quat_cast(axes) * glm::angleAxis(roll_rad, glm::dvec3(0, 0, 1)), eye_W};
}

class SeenScreen {
 public:
  SeenScreen(const ShownScreen& screen, const CameraModel& camera, const Pose<World, Camera>& X_WC)
      : screen_(screen), size_px_(camera.size_px) {
    places_.reserve(static_cast<std::size_t>(size_px_.x * size_px_.y * kRays));
    for (int y = 0; y < size_px_.y; ++y)
      for (int x = 0; x < size_px_.x; ++x)
        for (int ray = 0; ray < kRays; ++ray)
          places_.push_back(hit(camera, X_WC, glm::dvec2(x, y) + 0.5 * glm::dvec2(ray % 2, ray / 2) - 0.25));
  }

  /// `around`: grey level outside the screen.
  GreyImage of(const GreyImage& shown, int around = 8) const {
    GreyImage seen{size_px_, {}};
    for (std::size_t i = 0; i < places_.size(); i += kRays) {
      double sum = 0.0;
      for (std::size_t ray = 0; ray < kRays; ++ray) sum += greyAt(shown, places_[i + ray], around);
      seen.grey.push_back(static_cast<std::uint8_t>(std::lround(sum / kRays)));
    }
    return seen;
  }

 private:
  static constexpr int kRays = 4;

  glm::vec2 hit(const CameraModel& camera, const Pose<World, Camera>& X_WC, const glm::dvec2& px) const {
    // Inverse of the lens by iteration.
    glm::dvec2 slope = (px - camera.centre_px) / camera.focal_px;
    for (int step = 0; step < 8; ++step) slope += (px - camera.pixelOf({glm::dvec3(slope, 1.0)})) / camera.focal_px;
    const glm::dvec3 ray_W = X_WC.rotation * glm::dvec3(slope, 1.0);
    const glm::dvec3 p_W = X_WC.translation_mm - X_WC.translation_mm.z / ray_W.z * ray_W;
    return {(p_W.x / screen_.size_mm.x + 0.5) * screen_.size_px.x - 0.5,
            (0.5 - p_W.y / screen_.size_mm.y) * screen_.size_px.y - 0.5};
  }

  static double greyAt(const GreyImage& shown, const glm::vec2& px, int around) {
    const glm::vec2 corner = glm::floor(px), part = px - corner;
    double sum = 0.0;
    for (int k = 0; k < 4; ++k) {
      const glm::ivec2 at = glm::ivec2(corner) + glm::ivec2(k % 2, k / 2);
      const bool lit = at.x >= 0 && at.y >= 0 && at.x < shown.size_px.x && at.y < shown.size_px.y;
      const double share = (k % 2 ? part.x : 1.0F - part.x) * (k / 2 ? part.y : 1.0F - part.y);
      sum += share * (lit ? shown.grey[static_cast<std::size_t>(at.y * shown.size_px.x + at.x)] : around);
    }
    return sum;
  }

  ShownScreen screen_;
  glm::ivec2 size_px_;
  std::vector<glm::vec2> places_;
};

inline GreyImage flipped(const GreyImage& image, bool left_right, bool top_bottom) {
  GreyImage out = image;
  const glm::ivec2 size = image.size_px;
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x)
      out.grey[static_cast<std::size_t>(y * size.x + x)] = image.grey[static_cast<std::size_t>(
          (top_bottom ? size.y - 1 - y : y) * size.x + (left_right ? size.x - 1 - x : x))];
  return out;
}

inline GreyImage noisy(const GreyImage& image, double sigma, unsigned seed) {
  std::mt19937 rng(seed);
  std::normal_distribution<double> noise(0.0, sigma);
  GreyImage out = image;
  for (std::uint8_t& grey : out.grey)
    grey = static_cast<std::uint8_t>(std::clamp(std::lround(grey + noise(rng)), 0L, 255L));
  return out;
}

/// Three box filters of `width` (odd) px across and down: nearly a Gaussian; `down` 1: horizontal motion blur.
inline GreyImage blurred(const GreyImage& image, int across, int down) {
  GreyImage out = image;
  const glm::ivec2 size = image.size_px;
  for (int pass = 0; pass < 6; ++pass) {
    const int width = pass % 2 == 0 ? across : down;
    const GreyImage in = out;
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x) {
        int sum = 0;
        for (int k = -(width / 2); k <= width / 2; ++k) {
          const int at = std::clamp((pass % 2 == 0 ? x : y) + k, 0, (pass % 2 == 0 ? size.x : size.y) - 1);
          sum += in.grey[static_cast<std::size_t>((pass % 2 == 0 ? y : at) * size.x + (pass % 2 == 0 ? at : x))];
        }
        out.grey[static_cast<std::size_t>(y * size.x + x)] = static_cast<std::uint8_t>((sum + width / 2) / width);
      }
  }
  return out;
}

}  // namespace calibration
