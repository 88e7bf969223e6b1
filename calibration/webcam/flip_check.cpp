#include "calibration/webcam/flip_check.h"

#include <algorithm>
#include <cmath>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "calibration/virtual_screen.h"
#include "calibration/webcam/image_matrix.h"

namespace calibration {
namespace {

constexpr int kTemplate_px = 64;
constexpr double kLeastLikeness = 0.55, kLeastLead = 0.12;
constexpr double kLeastShare = 0.002;  ///< of the image, that the F's square must cover

/// The square with the F in it, `side` px.
GreyImage squareWithF(int side) {
  GreyImage square{{side, side}, std::vector<std::uint8_t>(static_cast<std::size_t>(side * side), 255)};
  const auto bar = [&](double left, double top, double right, double bottom) {
    for (int y = static_cast<int>(top * side); y < static_cast<int>(bottom * side); ++y)
      for (int x = static_cast<int>(left * side); x < static_cast<int>(right * side); ++x)
        square.grey[static_cast<std::size_t>(y * side + x)] = 0;
  };
  bar(0.27, 0.14, 0.43, 0.86);
  bar(0.43, 0.14, 0.77, 0.30);
  bar(0.43, 0.44, 0.66, 0.58);
  return square;
}

/// Corners of a convex quadrangle, clockwise in the image, the first so that the first edge runs most to the right.
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

/// Correlation of two images of one size, without regard to brightness.
double likeness(const cv::Mat& a, const cv::Mat& b) {
  cv::Mat result;
  cv::matchTemplate(a, b, result, cv::TM_CCOEFF_NORMED);
  return static_cast<double>(result.at<float>(0, 0));
}

/// How alike the two best readings of this square are to what is seen.
struct Likeness {
  ImageOrientation best;
  double first = -1.0, second = -1.0;
};

Likeness compared(const cv::Mat& square) {
  const GreyImage letter = squareWithF(kTemplate_px);
  Likeness found;
  for (const ImageOrientation& reading : kImageOrientations) {
    const GreyImage expected = oriented(reading, letter);
    const double alike = likeness(square, matrixOf(expected));
    if (alike > found.first) {
      found = {reading, alike, found.first};
    } else {
      found.second = std::max(found.second, alike);
    }
  }
  return found;
}

}  // namespace

ImageOrientation inverseOf(const ImageOrientation& reading) {
  // A mirrored image that is turned goes back by mirroring and the same turn again.
  return reading.mirrored ? reading : ImageOrientation{false, (4 - reading.quarters) % 4};
}

std::string_view nameOf(const ImageOrientation& reading) {
  constexpr std::array<std::string_view, 8> kNames{"right",
                                                   "turned to the right",
                                                   "upside down",
                                                   "turned to the left",
                                                   "mirrored",
                                                   "mirrored and turned to the right",
                                                   "mirrored and upside down",
                                                   "mirrored and turned to the left"};
  return kNames[static_cast<std::size_t>((reading.mirrored ? 4 : 0) + reading.quarters)];
}

std::string remedyFor(const ImageOrientation& reading) {
  if (reading.right()) return "the picture reads right, go on";
  if (reading.quarters % 2 == 1)
    return "the picture is " + std::string(nameOf(reading)) + ", set the screen's rotation in the system's settings";
  return "the picture is " + std::string(nameOf(reading)) +
         ", switch off any flip in the monitor's or system's settings, or correct the screen's corners in the rig file";
}

GreyImage oriented(const ImageOrientation& reading, const GreyImage& image) {
  const glm::ivec2 in = image.size_px, out = reading.quarters % 2 == 0 ? in : glm::ivec2(in.y, in.x);
  GreyImage seen{out, std::vector<std::uint8_t>(image.grey.size())};
  std::size_t at = 0;
  for (int y = 0; y < out.y; ++y)
    for (int x = 0; x < out.x; ++x) {
      // Back by the turn, then by the mirror.
      glm::ivec2 from(x, y);
      if (reading.quarters == 1) from = {y, in.y - 1 - x};
      if (reading.quarters == 2) from = in - 1 - from;
      if (reading.quarters == 3) from = {in.x - 1 - y, x};
      if (reading.mirrored) from.x = in.x - 1 - from.x;
      seen.grey[at++] = image.grey[static_cast<std::size_t>(from.y * in.x + from.x)];
    }
  return seen;
}

ImageOrientation framebufferOrientation(const Rig& rig) {
  const ScreenCorners seen = virtualScreen(rig);
  const glm::dvec3 across = seen.lower_right.mm - seen.lower_left.mm, up = seen.upper_left.mm - seen.lower_left.mm;
  // x and y of W are right and up to the eye. Where the framebuffer's upward edge points, after any mirroring.
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
  glm::dvec3 across = seen.lower_right.mm - seen.lower_left.mm, up = seen.upper_left.mm - seen.lower_left.mm;
  const glm::dvec3 middle = seen.lower_left.mm + 0.5 * (across + up);
  if (framebufferOrientation(rig).quarters % 2 == 1) std::swap(across, up);
  if (across.x < 0.0) across = -across;
  if (up.y < 0.0) up = -up;
  return {
      seenSize_px(rig), {middle - 0.5 * (across + up)}, {middle + 0.5 * (across - up)}, {middle - 0.5 * (across - up)}};
}

Point<World> positionOn(const ScreenCorners& seen_screen, const glm::dvec2& px) {
  const glm::dvec3 across = seen_screen.lower_right.mm - seen_screen.lower_left.mm;
  const glm::dvec3 down = seen_screen.lower_left.mm - seen_screen.upper_left.mm;
  return {seen_screen.upper_left.mm + (px.x + 0.5) / seen_screen.px.x * across +
          (px.y + 0.5) / seen_screen.px.y * down};
}

GreyImage letterF(const glm::ivec2& size_px) {
  GreyImage page{size_px, std::vector<std::uint8_t>(static_cast<std::size_t>(size_px.x * size_px.y), 0)};
  const int side = 6 * std::min(size_px.x, size_px.y) / 10;
  const GreyImage square = squareWithF(side);
  const glm::ivec2 low = (size_px - side) / 2;
  for (int y = 0; y < side; ++y)
    std::copy_n(&square.grey[static_cast<std::size_t>(y * side)], side,
                &page.grey[static_cast<std::size_t>((low.y + y) * size_px.x + low.x)]);
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

  // The brightest fields, the largest first: that which is most like an F by far is it.
  Likeness best;
  for (std::size_t i = 0; i < std::min<std::size_t>(outlines.size(), 5); ++i) {
    if (cv::contourArea(outlines[i]) < kLeastShare * static_cast<double>(smooth.total())) break;
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
  if (best.first < kLeastLikeness || best.first - best.second < kLeastLead) return std::nullopt;
  return best.best;
}

}  // namespace calibration
