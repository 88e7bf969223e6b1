#include "calibration/webcam/flip_check.h"

#include <algorithm>
#include <cmath>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "calibration/rig.h"
#include "calibration/webcam/image_matrix.h"

namespace calibration {
namespace {

constexpr int kTemplate_px = 64;
constexpr double kMinLikeness = 0.55, kMinLead = 0.12;
constexpr double kMinShare = 0.002;  ///< of the image, covered by the F's square

/// The white square with the F, `side` px.
GreyImage squareWithF(int side) {
  GreyImage square = GreyImage::filled({side, side}, 255);
  const auto bar = [&](double left, double top, double right, double bottom) {
    for (int y = static_cast<int>(top * side); y < static_cast<int>(bottom * side); ++y)
      for (int x = static_cast<int>(left * side); x < static_cast<int>(right * side); ++x) square.at(x, y) = 0;
  };
  bar(0.27, 0.14, 0.43, 0.86);
  bar(0.43, 0.14, 0.77, 0.30);
  bar(0.43, 0.44, 0.66, 0.58);
  return square;
}

/// Corners of a convex quadrangle, clockwise, starting so that the first edge points right.
std::optional<std::array<cv::Point2f, 4>> quadrangle(const std::vector<cv::Point>& outline) {
  std::vector<cv::Point> hull, corners;
  cv::convexHull(outline, hull);
  const double round = cv::arcLength(hull, true);
  for (double slack = 0.01; slack < 0.08 && corners.size() != 4; slack += 0.01)
    cv::approxPolyDP(hull, corners, slack * round, true);
  if (corners.size() != 4 || cv::contourArea(outline) < 0.8 * cv::contourArea(corners)) return std::nullopt;
  if (cv::contourArea(corners, true) < 0.0) std::ranges::reverse(corners);
  std::size_t first = 0;
  double most = -2.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const cv::Point2d edge = corners[(i + 1) % 4] - corners[i];
    const double rightward = edge.x / std::max(cv::norm(edge), 1e-9);
    if (rightward > most) most = rightward, first = i;
  }
  std::array<cv::Point2f, 4> ordered;
  for (std::size_t i = 0; i < 4; ++i) ordered[i] = corners[(first + i) % 4];
  return ordered;
}

/// Normalised correlation of two images of one size.
double likeness(const cv::Mat& a, const cv::Mat& b) {
  cv::Mat result;
  cv::matchTemplate(a, b, result, cv::TM_CCOEFF_NORMED);
  return static_cast<double>(result.at<float>(0, 0));
}

/// The orientation that fits best, and the scores of the best two.
struct Likeness {
  ImageOrientation best;
  double first = -1.0, second = -1.0;
};

Likeness compared(const cv::Mat& square) {
  const GreyImage letter = squareWithF(kTemplate_px);
  Likeness found;
  for (const ImageOrientation& orientation : kImageOrientations) {
    const GreyImage expected = oriented(orientation, letter);
    const double alike = likeness(square, matrixOf(expected));
    if (alike > found.first) {
      found = {orientation, alike, found.first};
    } else {
      found.second = std::max(found.second, alike);
    }
  }
  return found;
}

}  // namespace

ImageOrientation inverseOf(const ImageOrientation& orientation) {
  // A mirrored and rotated image is its own inverse.
  return orientation.mirrored ? orientation : ImageOrientation{false, (4 - orientation.quarters) % 4};
}

std::string_view nameOf(const ImageOrientation& orientation) {
  constexpr std::array<std::string_view, 8> kNames{"right",
                                                   "turned to the right",
                                                   "upside down",
                                                   "turned to the left",
                                                   "mirrored",
                                                   "mirrored and turned to the right",
                                                   "mirrored and upside down",
                                                   "mirrored and turned to the left"};
  return kNames[static_cast<std::size_t>((orientation.mirrored ? 4 : 0) + orientation.quarters)];
}

std::string remedyFor(const ImageOrientation& orientation) {
  if (orientation.isUpright()) return "the picture is upright, continue";
  if (orientation.quarters % 2 == 1)
    return "the picture is " + std::string(nameOf(orientation)) +
           ", set the screen's rotation in the system's settings";
  return "the picture is " + std::string(nameOf(orientation)) +
         ", switch off any flip in the monitor's or system's settings, or correct the screen's corners in the rig file";
}

GreyImage oriented(const ImageOrientation& orientation, const GreyImage& image) {
  const glm::ivec2 in = image.size_px, out = orientation.quarters % 2 == 0 ? in : glm::ivec2(in.y, in.x);
  GreyImage seen{out, std::vector<std::uint8_t>(image.grey.size())};
  std::size_t at = 0;
  for (int y = 0; y < out.y; ++y)
    for (int x = 0; x < out.x; ++x) {
      // Undo the rotation, then the mirroring.
      glm::ivec2 from(x, y);
      if (orientation.quarters == 1) from = {y, in.y - 1 - x};
      if (orientation.quarters == 2) from = in - 1 - from;
      if (orientation.quarters == 3) from = {in.x - 1 - y, x};
      if (orientation.mirrored) from.x = in.x - 1 - from.x;
      seen.grey[at++] = image.at(from.x, from.y);
    }
  return seen;
}

ImageOrientation framebufferOrientation(const Rig& rig) {
  const ScreenCorners seen = virtualScreen(rig);
  const glm::dvec3 across = seen.across_mm(), up = seen.up_mm();
  // x and y of W are right and up for the eye. Direction of the framebuffer's up edge, after any mirroring.
  const bool mirrored = across.x * up.y - across.y * up.x < 0.0;
  const bool upright = std::abs(up.y) >= std::abs(up.x);
  if (upright) return {mirrored, up.y > 0.0 ? 0 : 2};
  return {mirrored, up.x > 0.0 ? 1 : 3};
}

GreyImage framebufferFor(const Rig& rig, const GreyImage& as_seen) {
  return oriented(inverseOf(framebufferOrientation(rig)), as_seen);
}

glm::ivec2 seenSize_px(const Rig& rig) {
  const glm::ivec2 px = rig.screen.px;
  return framebufferOrientation(rig).quarters % 2 == 0 ? px : glm::ivec2(px.y, px.x);
}

ScreenCorners seenScreen(const Rig& rig) {
  const ScreenCorners seen = virtualScreen(rig);
  glm::dvec3 across = seen.across_mm(), up = seen.up_mm();
  if (framebufferOrientation(rig).quarters % 2 == 1) std::swap(across, up);
  if (across.x < 0.0) across = -across;
  if (up.y < 0.0) up = -up;
  return screenAround(seen.centre_mm(), across, up, seenSize_px(rig));
}

Point<World> positionOn(const ScreenCorners& seen_screen, const glm::dvec2& px) {
  const glm::dvec2 share = (px + 0.5) / glm::dvec2(seen_screen.px);
  return {seen_screen.upper_left.mm + share.x * seen_screen.across_mm() - share.y * seen_screen.up_mm()};
}

GreyImage letterF(const glm::ivec2& size_px) {
  GreyImage page = GreyImage::filled(size_px, 0);
  const int side = 6 * std::min(size_px.x, size_px.y) / 10;
  GreyImage square = squareWithF(side);
  const glm::ivec2 low = (size_px - side) / 2;
  for (int y = 0; y < side; ++y) std::copy_n(&square.at(0, y), side, &page.at(low.x, low.y + y));
  return page;
}

std::optional<ImageOrientation> orientationOfF(const GreyImage& seen) {
  if (seen.size_px.x < kTemplate_px || seen.size_px.y < kTemplate_px) return std::nullopt;
  cv::Mat smooth, bright;
  cv::GaussianBlur(matrixOf(seen), smooth, {5, 5}, 0.0);
  cv::threshold(smooth, bright, 0.0, 255.0, cv::THRESH_BINARY | cv::THRESH_OTSU);
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(bright, outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  std::ranges::sort(outlines, std::ranges::greater(), [](const auto& o) { return cv::contourArea(o); });

  // The largest bright areas: the one most like an F, by a clear margin.
  Likeness best;
  for (std::size_t i = 0; i < std::min<std::size_t>(outlines.size(), 5); ++i) {
    if (cv::contourArea(outlines[i]) < kMinShare * static_cast<double>(smooth.total())) break;
    const auto corners = quadrangle(outlines[i]);
    if (!corners) continue;
    constexpr float kEnd = kTemplate_px;
    const std::array<cv::Point2f, 4> square{{{0, 0}, {kEnd, 0}, {kEnd, kEnd}, {0, kEnd}}};
    const double finer = std::sqrt(cv::contourArea(outlines[i])) / kTemplate_px;
    cv::Mat even = smooth, straight;
    if (finer > 1.5) cv::GaussianBlur(smooth, even, {0, 0}, 0.4 * finer);
    cv::warpPerspective(even, straight, cv::getPerspectiveTransform(corners->data(), square.data()),
                        {kTemplate_px, kTemplate_px});
    const Likeness found = compared(straight);
    if (found.first > best.first) best = found;
  }
  if (best.first < kMinLikeness || best.first - best.second < kMinLead) return std::nullopt;
  return best.best;
}

}  // namespace calibration
