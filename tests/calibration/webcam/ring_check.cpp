#include "tests/calibration/webcam/ring_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "calibration/webcam/image_matrix.h"

namespace calibration {
namespace {

constexpr double kOverNoise = 6.0, kMinGrey = 12.0;
constexpr double kOfBrightest =
    0.4;  ///< below it is the glass's ghost: a twentieth of the light is a quarter of the grey level
constexpr int kSectors = 72;
constexpr double kWholeRing = 0.9;  ///< of the sectors that must contain some

/// What is brighter than before.
cv::Mat1f brighter(const GreyImage& dark, const GreyImage& bright) {
  cv::Mat1f difference;
  cv::subtract(matrixOf(bright), matrixOf(dark), difference, cv::noArray(), CV_32F);
  cv::GaussianBlur(difference, difference, {3, 3}, 0.0);
  return difference;
}

struct Blob {
  int label = 0;
  cv::Rect box;
  int pixels = 0;
  glm::dvec2 middle_px{0.0};  ///< weighed by light
};

std::vector<Blob> blobsOf(const cv::Mat1f& light, double least, cv::Mat1i& labels) {
  cv::Mat stats, middles;
  const int count = cv::connectedComponentsWithStats(light > least, labels, stats, middles, 8, CV_32S);
  std::vector<Blob> blobs;
  for (int label = 1; label < count; ++label) {
    const int* const s = stats.ptr<int>(label);
    if (s[cv::CC_STAT_AREA] < 5) continue;
    Blob blob{label,
              {s[cv::CC_STAT_LEFT], s[cv::CC_STAT_TOP], s[cv::CC_STAT_WIDTH], s[cv::CC_STAT_HEIGHT]},
              s[cv::CC_STAT_AREA],
              {}};
    double weight = 0.0;
    for (int y = blob.box.y; y < blob.box.br().y; ++y)
      for (int x = blob.box.x; x < blob.box.br().x; ++x)
        if (labels(y, x) == label) {
          const double w = static_cast<double>(light(y, x)) - least;
          blob.middle_px += w * glm::dvec2(x, y);
          weight += w;
        }
    blob.middle_px /= std::max(weight, 1e-9);
    blobs.push_back(blob);
  }
  return blobs;
}

/// Centre and radius of a ring-shaped blob: an ellipse through its line's centroids by sector.
std::optional<std::pair<glm::dvec2, double>> ringIn(const Blob& blob, const cv::Mat1f& light, const cv::Mat1i& labels,
                                                    double least) {
  const glm::dvec2 inside =
      0.5 * glm::dvec2(blob.box.tl().x + blob.box.br().x - 1, blob.box.tl().y + blob.box.br().y - 1);
  std::array<double, kSectors> weight{}, radius{};
  double nearest_px = 1e9;
  for (int y = blob.box.y; y < blob.box.br().y; ++y)
    for (int x = blob.box.x; x < blob.box.br().x; ++x) {
      if (labels(y, x) != blob.label) continue;
      const glm::dvec2 out = glm::dvec2(x, y) - inside;
      const double rotation = (std::atan2(out.y, out.x) / (2.0 * CV_PI) + 0.5) * kSectors;
      const std::size_t sector = static_cast<std::size_t>(rotation) % kSectors;
      const double w = static_cast<double>(light(y, x)) - least;
      weight[sector] += w;
      radius[sector] += w * glm::length(out);
      nearest_px = std::min(nearest_px, glm::length(out));
    }
  std::vector<cv::Point2f> line;
  double mean_px = 0.0;
  for (std::size_t s = 0; s < kSectors; ++s) {
    if (weight[s] <= 0.0) continue;
    const double r = radius[s] / weight[s], rotation = ((static_cast<double>(s) + 0.5) / kSectors - 0.5) * 2.0 * CV_PI;
    line.emplace_back(static_cast<float>(r * std::cos(rotation)), static_cast<float>(r * std::sin(rotation)));
    mean_px += r;
  }
  if (static_cast<double>(line.size()) < kWholeRing * kSectors) return std::nullopt;
  mean_px /= static_cast<double>(line.size());
  if (nearest_px < 0.5 * mean_px) return std::nullopt;
  const cv::RotatedRect ellipse = cv::fitEllipseDirect(line);
  return std::pair{inside + glm::dvec2(ellipse.center.x, ellipse.center.y), mean_px};
}

}  // namespace

RingDetection detectRing(const GreyImage& dark, const GreyImage& with_both) {
  if (dark.size_px != with_both.size_px || !dark.isWhole() || !with_both.isWhole())
    throw CalibrationError("ring check: the images are not of one size, take both with one camera");
  const cv::Mat1f light = brighter(dark, with_both);
  double brightest = 0.0;
  cv::minMaxLoc(light, nullptr, &brightest);
  const double noise = cv::mean(cv::abs(light))[0] / 0.8;
  const double least = std::max({kOverNoise * noise, kMinGrey, kOfBrightest * brightest});

  cv::Mat1i labels;
  std::vector<Blob> blobs = blobsOf(light, least, labels);
  std::ranges::sort(blobs, std::ranges::greater(), [](const Blob& b) { return b.box.area(); });
  RingDetection detection;
  if (blobs.empty()) {
    detection.line = "neither ring nor tip is seen: look whether the webcam faces the mirror and the tip is lit";
    return detection;
  }
  const auto ring = ringIn(blobs.front(), light, labels, least);
  if (!ring) {
    detection.line = "no whole ring is seen: hold the tip away from the edge of the image, nothing before the ring";
    return detection;
  }
  std::tie(detection.ring_px, detection.ring_radius_px) = *ring;

  // The tip is the largest of the rest, and compact.
  const auto compact = [](const Blob& b) {
    const double fill = static_cast<double>(b.pixels) / b.box.area();
    return fill > 0.5 && b.box.width < 4 * b.box.height && b.box.height < 4 * b.box.width;
  };
  blobs.erase(blobs.begin());
  const auto tip = std::ranges::find_if(blobs, compact);
  if (tip == blobs.end()) {
    detection.line = "the ring is seen, the tip is not: light it, and calibrate again where it touches the ring";
    return detection;
  }
  detection.tip_px = tip->middle_px;
  return detection;
}

Vector<Camera> ringOffset_mm(const CameraModel& camera, const RingDetection& detection, double tip_ahead_mm) {
  const glm::dvec2 off = camera.undistorted(detection.tip_px) - camera.undistorted(detection.ring_px);
  return {{tip_ahead_mm * off.x, tip_ahead_mm * off.y, 0.0}};
}

RingCheck judgedRing(const std::vector<Vector<Camera>>& offsets_mm) {
  if (offsets_mm.size() < static_cast<std::size_t>(kRingPlaces))
    throw CalibrationError("ring check: " + std::to_string(offsets_mm.size()) + " places, take 8");
  RingCheck check;
  for (std::size_t i = 0; i < offsets_mm.size(); ++i) {
    const double off_mm = glm::length(offsets_mm[i].xyz);
    check.mean_mm += off_mm / static_cast<double>(offsets_mm.size());
    if (off_mm > check.max_mm) check.max_mm = off_mm, check.worst = static_cast<int>(i);
  }
  check.passed = check.mean_mm <= kRingLimit_mm;
  std::array<char, 160> line{};
  std::snprintf(line.data(), line.size(),
                "tip and ring are %.1f mm apart on average, %.1f mm at the worst place (%d): %s", check.mean_mm,
                check.max_mm, check.worst + 1, check.passed ? "passed" : "calibrate again");
  check.line = line.data();
  return check;
}

}  // namespace calibration
