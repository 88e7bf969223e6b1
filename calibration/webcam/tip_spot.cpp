#include "calibration/webcam/tip_spot.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "calibration/calibration_error.h"
#include "calibration/geometry/units.h"
#include "calibration/median.h"
#include "calibration/webcam/image_matrix.h"

namespace calibration {
namespace {

constexpr double kMinOverNoise = 8.0, kMinHeight = 14.0;  ///< grey levels
constexpr double kRival = 0.4;     ///< a second spot this bright, relative to the brightest, is one too many
constexpr double kPedestal = 0.2;  ///< relative to the peak: below, pixels do not count for the centre
constexpr int kMinPixels = 4;
constexpr int kSmallest_px = 16;     ///< of an image's side
constexpr double kMaxLength = 1.8;   ///< length to width of a spot
constexpr double kSoftSpread = 3.2;  ///< area at a quarter of the height to that at three quarters
constexpr double kMaxSoft_px = 8.0;  ///< a soft spot narrower than this is an LED, not out of focus
constexpr double kSaturated = 250.0;
constexpr double kMaxOfWidth = 1.0 / 48.0;  ///< of the image width: a 3 mm ball covers a quarter of that

/// One sigma of pixel noise, from differences between near pixels without outliers.
double noiseOf(const cv::Mat& difference) {
  std::vector<float> steps;
  for (int y = 0; y < difference.rows; y += 4)
    for (int x = 0; x + 2 < difference.cols; x += 4)
      steps.push_back(std::abs(difference.at<float>(y, x + 2) - difference.at<float>(y, x)));
  const double most = 4.0 * (1.48 * medianOf(steps) + 0.5);
  double sum = 0.0, count = 1.0;
  for (const float step : steps)
    if (step < most) sum += double{step} * step, count += 1.0;
  return std::max(0.3, std::sqrt(0.5 * sum / count));
}

/// Low-frequency change: room light, the inside of a shadow.
cv::Mat slowChange(const cv::Mat& difference) {
  const int cell = std::max(8, difference.cols / 80);
  cv::Mat coarse, median, slow;
  cv::resize(difference, coarse, {std::max(8, difference.cols / cell), std::max(8, difference.rows / cell)}, 0, 0,
             cv::INTER_AREA);
  cv::medianBlur(coarse, median, 5);
  cv::resize(median, slow, difference.size(), 0, 0, cv::INTER_LINEAR);
  return slow;
}

double diameterOf(double area) { return 2.0 * std::sqrt(area / kPi); }

/// A connected region above a threshold.
struct Patch {
  cv::Rect box;
  int pixels = 0, label = 0;
};
std::vector<Patch> patchesAbove(const cv::Mat& values, double threshold, cv::Mat& labels) {
  cv::Mat stats, unused_middles;
  const int count = cv::connectedComponentsWithStats(values > threshold, labels, stats, unused_middles, 8, CV_32S);
  std::vector<Patch> patches;
  for (int label = 1; label < count; ++label) {
    const int* row = stats.ptr<int>(label);
    if (row[cv::CC_STAT_AREA] >= kMinPixels)
      patches.push_back({{row[cv::CC_STAT_LEFT], row[cv::CC_STAT_TOP], row[cv::CC_STAT_WIDTH], row[cv::CC_STAT_HEIGHT]},
                         row[cv::CC_STAT_AREA],
                         label});
  }
  return patches;
}

/// Moments of the light above the pedestal.
struct Shape {
  glm::dvec2 centre_px{0.0};
  double length_to_width = 1.0;
};
Shape shapeOf(const cv::Mat& height, const cv::Rect& window, double pedestal) {
  double sum = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
  glm::dvec2 first{0.0};
  const auto each_pixel = [&](auto&& use) {
    for (int y = window.y; y < window.y + window.height; ++y)
      for (int x = window.x; x < window.x + window.width; ++x)
        if (const double weight = height.at<float>(y, x) - pedestal; weight > 0.0) use(glm::dvec2(x, y), weight);
  };
  each_pixel([&](const glm::dvec2& px, double weight) { sum += weight, first += weight * px; });
  Shape shape;
  shape.centre_px = first / sum;
  each_pixel([&](const glm::dvec2& px, double weight) {
    const glm::dvec2 d = px - shape.centre_px;
    xx += weight * d.x * d.x, xy += weight * d.x * d.y, yy += weight * d.y * d.y;
  });
  // 1/12 px^2 is the variance of a pixel.
  const double half = 0.5 * (xx + yy) / sum, apart = std::hypot(0.5 * (xx - yy), xy) / sum;
  shape.length_to_width = std::sqrt((half + apart + 0.08) / (std::max(0.0, half - apart) + 0.08));
  return shape;
}

}  // namespace

TipSpot findTipSpot(const GreyImage& before, const GreyImage& with_tip) {
  const bool fit = before.size_px == with_tip.size_px && before.isWhole() && with_tip.isWhole();
  if (!fit || before.size_px.x < kSmallest_px || before.size_px.y < kSmallest_px)
    throw CalibrationError("tip: the images with and without it differ in size, take both again");
  cv::Mat dark, lit;
  matrixOf(before).convertTo(dark, CV_32F);
  matrixOf(with_tip).convertTo(lit, CV_32F);
  const cv::Mat difference = lit - dark;
  const double noise = noiseOf(difference), max_px = std::max(16.0, kMaxOfWidth * difference.cols);
  TipSpot spot;
  const auto rejected = [&](SpotTrouble trouble, const char* line) {
    spot.trouble = trouble;
    spot.line = line;
    return spot;
  };
  cv::Mat labels;

  // Glare: saturated, new, and larger than any tip.
  for (const Patch& patch : patchesAbove(cv::min(difference * 4.0, lit), kSaturated, labels))
    if (diameterOf(patch.pixels) > max_px)
      return rejected(SpotTrouble::too_large,
                      "the light is too large: dim it, shorten the exposure, avoid reflections");

  // New and small.
  const cv::Mat height = difference - slowChange(difference);
  cv::Mat without_specks, smooth;
  cv::medianBlur(height, without_specks, 3);
  cv::GaussianBlur(without_specks, smooth, {}, 1.0);
  double peak = 0.0;
  cv::minMaxLoc(smooth, nullptr, &peak);
  spot.above_noise = peak / noise;
  if (peak < kMinHeight || spot.above_noise < kMinOverNoise)
    return rejected(SpotTrouble::nothing, "no lit tip is seen: light it, bring it into the image, darken the room");
  const std::vector<Patch> patches = patchesAbove(smooth, kRival * peak, labels);
  if (patches.empty()) return rejected(SpotTrouble::nothing, "only specks are seen: light the tip, darken the room");
  if (patches.size() > 1)
    return rejected(SpotTrouble::several, "more than one light is seen: cover the others, avoid reflections");
  const Patch& patch = patches.front();
  const cv::Rect image(0, 0, height.cols, height.rows);
  const int margin = 2 + std::max(patch.box.width, patch.box.height) / 2;
  const cv::Rect window(patch.box.x - margin, patch.box.y - margin, patch.box.width + 2 * margin,
                        patch.box.height + 2 * margin);

  const Shape shape = shapeOf(height, window & image, kPedestal * peak);
  spot.centre_px = shape.centre_px;
  const cv::Mat around = smooth(window & image);
  const auto area_above = [&](double share) { return double(cv::countNonZero(around > share * peak)); };
  spot.across_px = diameterOf(area_above(0.5));
  const bool touches_edge =
      patch.box.x < 3 || patch.box.y < 3 || patch.box.br().x > image.width - 3 || patch.box.br().y > image.height - 3;
  if (touches_edge) return rejected(SpotTrouble::at_the_edge, "the tip is at the image's edge: bring it further in");
  if (spot.across_px > max_px)
    return rejected(SpotTrouble::too_large, "the light is too large: dim it, shorten the exposure, avoid reflections");
  if (shape.length_to_width > kMaxLength) return rejected(SpotTrouble::blurred, "the tip was moved: hold it still");
  if (spot.across_px > kMaxSoft_px && area_above(0.25) > kSoftSpread * area_above(0.75))
    return rejected(SpotTrouble::blurred, "the tip is out of focus: focus the camera on it");
  return spot;
}

}  // namespace calibration
