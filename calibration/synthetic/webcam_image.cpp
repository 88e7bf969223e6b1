#include "calibration/synthetic/webcam_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "calibration/random.h"

namespace calibration {
namespace {

constexpr double kPanelGamma = 2.2;
constexpr int kTipRays = 6;           ///< per side of a pixel
constexpr double kPutDown_mm = 10.0;  ///< placement error, one sigma

/// Summed-area table of the framebuffer's light: exact mean over any rectangle.
class LightTable {
 public:
  explicit LightTable(const GreyImage& shown) : size_(shown.size_px), sum_(GreyImage::pixels(size_ + 1), 0.0) {
    std::array<double, 256> light{};
    for (std::size_t v = 0; v < 256; ++v) light[v] = std::pow(static_cast<double>(v) / 255.0, kPanelGamma);
    const std::size_t row = static_cast<std::size_t>(size_.x) + 1;
    for (int y = 0; y < size_.y; ++y) {
      double line = 0.0;
      for (int x = 0; x < size_.x; ++x) {
        const std::size_t at = static_cast<std::size_t>(y) * row + static_cast<std::size_t>(x);
        line += light[shown.grey[at - static_cast<std::size_t>(y)]];
        sum_[at + row + 1] = sum_[at + 1] + line;
      }
    }
  }

  /// Over a rectangle in pixels; dark outside the image.
  double mean(const glm::dvec2& middle, const glm::dvec2& half) const {
    const glm::dvec2 most(size_), low = glm::clamp(middle - half, glm::dvec2(0.0), most),
                                  high = glm::clamp(middle + half, glm::dvec2(0.0), most);
    const double light = upTo(high.x, high.y) - upTo(low.x, high.y) - upTo(high.x, low.y) + upTo(low.x, low.y);
    return light / (4.0 * half.x * half.y);
  }

 private:
  double upTo(double x, double y) const {
    const int column = std::min(static_cast<int>(x), size_.x - 1), line = std::min(static_cast<int>(y), size_.y - 1);
    const double u = x - column, v = y - line;
    const std::size_t row = static_cast<std::size_t>(size_.x) + 1;
    const double* const s = &sum_[static_cast<std::size_t>(line) * row + static_cast<std::size_t>(column)];
    return (1.0 - v) * ((1.0 - u) * s[0] + u * s[1]) + v * ((1.0 - u) * s[row] + u * s[row + 1]);
  }

  glm::ivec2 size_;
  std::vector<double> sum_;
};

/// Approximately normal, mean 0, variance 1, hashed from a pixel's number: sum of four 16-bit parts.
double chanceOf(std::uint64_t which) {
  const std::uint64_t z = mixedBits(which + kSplitMixStep);
  const double sum = static_cast<double>((z & 0xffff) + ((z >> 16) & 0xffff) + ((z >> 32) & 0xffff) + (z >> 48));
  return (sum / 65535.0 - 2.0) * std::sqrt(3.0);
}

void blur(std::vector<float>& light, const glm::ivec2& size, double sigma) {
  if (sigma <= 0.0) return;
  const int reach = static_cast<int>(std::ceil(3.0 * sigma));
  std::vector<float> weight(static_cast<std::size_t>(reach) + 1);
  double sum = 0.0;
  for (int i = 0; i <= reach; ++i) {
    weight[static_cast<std::size_t>(i)] = static_cast<float>(std::exp(-0.5 * i * i / (sigma * sigma)));
    sum += (i == 0 ? 1.0 : 2.0) * weight[static_cast<std::size_t>(i)];
  }
  for (float& w : weight) w /= static_cast<float>(sum);

  // Rows, then columns; edge pixels are repeated.
  std::vector<float> rows(light.size());
  const std::ptrdiff_t step = size.x;
  for (int y = 0; y < size.y; ++y) {
    const float* const in = light.data() + y * step;
    for (int x = 0; x < size.x; ++x) {
      float mean = weight[0] * in[x];
      for (int i = 1; i <= reach; ++i)
        mean += weight[static_cast<std::size_t>(i)] * (in[std::max(x - i, 0)] + in[std::min(x + i, size.x - 1)]);
      rows[static_cast<std::size_t>(y * step + x)] = mean;
    }
  }
  for (int y = 0; y < size.y; ++y) {
    float* const out = light.data() + y * step;
    const float* const in = rows.data() + y * step;
    for (int x = 0; x < size.x; ++x) out[x] = weight[0] * in[x];
    for (int i = 1; i <= reach; ++i) {
      const float* const above = rows.data() + std::max(y - i, 0) * step;
      const float* const below = rows.data() + std::min(y + i, size.y - 1) * step;
      const float w = weight[static_cast<std::size_t>(i)];
      for (int x = 0; x < size.x; ++x) out[x] += w * (above[x] + below[x]);
    }
  }
}

}  // namespace

Pose<World, Camera> lookingAt(const Point<World>& from_W, const Point<World>& at_W, const glm::dvec3& up_W) {
  const glm::dvec3 ahead = glm::normalize(at_W.mm - from_W.mm), right = glm::normalize(glm::cross(ahead, up_W));
  return {glm::normalize(glm::quat_cast(glm::dmat3(right, glm::cross(ahead, right), ahead))), from_W.mm};
}

Pose<World, Camera> roughlyPlacedCamera(const Rig& rig, double aside_deg, std::mt19937& rng) {
  const glm::dquat aside = glm::angleAxis(radFromDegrees(aside_deg), glm::dvec3(0.0, 1.0, 0.0));
  const Point<World> from_W{aside * rig.cyclopeanEye().mm + gaussianVector(rng, kPutDown_mm)};
  return lookingAt(from_W, {gaussianVector(rng, kPutDown_mm)}, {0.0, 1.0, 0.0});
}

WebcamRenderer::WebcamRenderer(const WebcamScene& scene, const Webcam& webcam) : scene_(scene), webcam_(webcam) {
  if (scene.mirror && scene.plate_mm > 0.0) plate_ = {*scene.mirror, scene.plate_mm, scene.refractive_index};
  if (!scene.mirror) {
    seen_ = panelMap([](const Ray& ray) { return ray; });
    return;
  }
  seen_ = panelMap([&](const Ray& ray) { return mirrored(*scene.mirror, ray); });
  if (plate_ && scene.ghost > 0.0) ghost_ = panelMap([&](const Ray& ray) { return mirroredByFarFace(*plate_, ray); });
}

Ray WebcamRenderer::rayOf(const glm::dvec2& pixel) const {
  const glm::dvec2 at = webcam_.model.undistorted(pixel);
  return {{webcam_.X_WC.translation_mm}, webcam_.X_WC * Vector<Camera>{glm::normalize(glm::dvec3(at, 1.0))}};
}

template <class SightOf>
WebcamRenderer::PanelMap WebcamRenderer::panelMap(const SightOf& ray_of) const {
  const ScreenCorners& panel = scene_.panel;
  const glm::dvec3 across = panel.across_mm(), up = panel.up_mm();
  const glm::dvec3 normal = glm::normalize(glm::cross(across, up));
  const glm::ivec2 size = webcam_.model.size_px;
  PanelMap map;
  map.reserve(GreyImage::pixels(size + 1));
  for (int y = 0; y <= size.y; ++y)
    for (int x = 0; x <= size.x; ++x) {
      const Ray ray = ray_of(rayOf({x - 0.5, y - 0.5}));
      const double into = glm::dot(ray.along_W.xyz, normal);
      const double way_mm = glm::dot(panel.lower_left.mm - ray.from_W.mm, normal) / into;
      const glm::dvec3 at = ray.from_W.mm + way_mm * ray.along_W.xyz - panel.lower_left.mm;
      const glm::vec2 position(glm::dot(at, across) / glm::dot(across, across),
                               1.0 - glm::dot(at, up) / glm::dot(up, up));
      const bool ahead = std::abs(into) > 1e-9 && way_mm > 0.0;
      map.push_back(ahead ? position : glm::vec2(std::numeric_limits<float>::quiet_NaN()));
    }
  return map;
}

void WebcamRenderer::addPanel(const PanelMap& map, const GreyImage& shown, double share,
                              std::vector<float>& light) const {
  const LightTable table(shown);
  const glm::dvec2 panel_px(shown.size_px);
  const glm::ivec2 size = webcam_.model.size_px;
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) {
      const glm::vec2* const corner = &map[static_cast<std::size_t>(y * (size.x + 1) + x)];
      const glm::dvec2 a = corner[0], b = corner[1], c = corner[size.x + 1], d = corner[size.x + 2];
      const glm::dvec2 middle = 0.25 * (a + b + c + d), right = 0.5 * (b + d - a - c), down = 0.5 * (c + d - a - b);
      const glm::dvec2 reach = 0.5 * (glm::abs(right) + glm::abs(down));
      const glm::dvec2 beside = glm::abs(middle - 0.5) - 0.5 - reach;
      if (!(beside.x < 0.0 && beside.y < 0.0)) continue;

      // The pixel's area on the panel as four rectangles.
      double mean = 0.0;
      for (const double i : {-0.25, 0.25})
        for (const double j : {-0.25, 0.25})
          mean += 0.25 * table.mean((middle + i * right + j * down) * panel_px, 0.5 * reach * panel_px);
      light[static_cast<std::size_t>(y * size.x + x)] += static_cast<float>(share * scene_.panel_light * mean);
    }
}

void WebcamRenderer::addTip(const LitTip& tip, std::vector<float>& light) const {
  const Point<Camera> tip_C = webcam_.X_WC.inverse() * tip.middle_W;
  if (tip_C.mm.z < 10.0 * tip.radius_mm) return;
  // Bounding box in the image; the glass moves the tip by less than its thickness.
  const double px_per_mm = std::max(webcam_.model.focal_px.x, webcam_.model.focal_px.y) / tip_C.mm.z;
  const double smear_mm = glm::length(tip.smear_mm.xyz);
  const double reach_px = 3.0 + px_per_mm * (1.2 * tip.radius_mm + 0.5 * smear_mm + scene_.plate_mm);
  const glm::dvec2 at_px = webcam_.model.pixelOf(tip_C);
  const glm::ivec2 low = glm::max(glm::ivec2(glm::floor(at_px - reach_px)), glm::ivec2(0));
  const glm::ivec2 high = glm::min(glm::ivec2(glm::ceil(at_px + reach_px)), webcam_.model.size_px - 1);

  const int moments = std::clamp(1 + static_cast<int>(2.0 * px_per_mm * smear_mm), 1, 64);
  const glm::dvec3 to_lamp = glm::normalize(tip.to_lamp_W.xyz);
  const bool behind =
      plate_ && plate_->face.distance_mm(tip.middle_W) * plate_->face.distance_mm({webcam_.X_WC.translation_mm}) < 0.0;
  const auto light_along = [&](const Ray& ray) {
    double sum = 0.0;
    for (int m = 0; m < moments; ++m) {
      const glm::dvec3 middle = tip.middle_W.mm + ((m + 0.5) / moments - 0.5) * tip.smear_mm.xyz;
      const glm::dvec3 to_middle = middle - ray.from_W.mm;
      const double nearest = glm::dot(to_middle, ray.along_W.xyz);
      const double inside = tip.radius_mm * tip.radius_mm - glm::dot(to_middle, to_middle) + nearest * nearest;
      if (inside < 0.0) continue;
      const glm::dvec3 hit = ray.from_W.mm + (nearest - std::sqrt(inside)) * ray.along_W.xyz;
      const double lit = std::max(0.0, glm::dot(hit - middle, to_lamp) / tip.radius_mm);
      sum += tip.light * (1.0 - tip.lamp_share + tip.lamp_share * lit);
    }
    return sum / moments;
  };
  for (int y = low.y; y <= high.y; ++y)
    for (int x = low.x; x <= high.x; ++x) {
      double mean = 0.0;
      for (int i = 0; i < kTipRays; ++i)
        for (int j = 0; j < kTipRays; ++j) {
          const Ray ray = rayOf({x + (i + 0.5) / kTipRays - 0.5, y + (j + 0.5) / kTipRays - 0.5});
          mean += light_along(behind ? seenThrough(*plate_, ray) : ray);
        }
      light[static_cast<std::size_t>(y * webcam_.model.size_px.x + x)] +=
          static_cast<float>(mean / (kTipRays * kTipRays));
    }
}

GreyImage WebcamRenderer::image(const GreyImage* shown, const std::optional<LitTip>& tip, std::uint64_t seed) const {
  const glm::ivec2 size = webcam_.model.size_px;
  std::vector<float> light(GreyImage::pixels(size), 0.0F);
  if (shown != nullptr) {
    addPanel(seen_, *shown, 1.0, light);
    if (!ghost_.empty()) addPanel(ghost_, *shown, scene_.ghost, light);
  }
  if (tip) addTip(*tip, light);
  blur(light, size, webcam_.defocus_px);

  // Vignetting, encoding, noise, quantisation.
  constexpr std::size_t kSteps = 4096;
  std::vector<float> encoded(kSteps + 1);
  for (std::size_t i = 0; i <= kSteps; ++i)
    encoded[i] = static_cast<float>(255.0 * std::pow(static_cast<double>(i) / kSteps, 1.0 / webcam_.gamma));
  const glm::dvec2 middle = 0.5 * glm::dvec2(size);
  GreyImage image = GreyImage::filled(size, 0);
  std::size_t at = 0;
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x, ++at) {
      const glm::dvec2 off = glm::dvec2(x, y) - middle;
      const double dim = 1.0 - webcam_.vignetting * glm::dot(off, off) / glm::dot(middle, middle);
      const double amount = std::min(dim * (static_cast<double>(light[at]) + scene_.room_light), 1.0) * kSteps;
      const std::size_t step = std::min(static_cast<std::size_t>(amount), kSteps - 1);
      const double between = amount - static_cast<double>(step);
      const double grey = (1.0 - between) * static_cast<double>(encoded[step]) +
                          between * static_cast<double>(encoded[step + 1]) +
                          webcam_.noise_grey * chanceOf(seed * 0x100000001b3ULL + at);
      image.grey[at] = static_cast<std::uint8_t>(std::clamp(grey + 0.5, 0.0, 255.0));
    }
  return image;
}

}  // namespace calibration
