#include "calibration/webcam/chessboard.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "calibration/calibration_error.h"
#include "calibration/geometry/units.h"
#include "calibration/median.h"
#include "calibration/webcam/image_matrix.h"

namespace calibration {
namespace {

constexpr double kMinSide_px = 9.0, kMaxSlant_deg = 60.0;
constexpr double kMaxEdge_px = 6.0, kMaxEdgeOfSide = 0.3;
constexpr int kLargePicture_px = 1280;
constexpr double kWindowOfSide = 0.3;
constexpr int kMaxWindow_px = 11;
constexpr std::array<int, 2> kCoarser = {3, 6};  ///< downscaling to find a blurred board

using Corners = std::vector<cv::Point2f>;

std::optional<Corners> chessboardAsItIs(const cv::Mat& grey, const cv::Size& size) {
  Corners corners;
  try {
    // Corners are refined later; the finder's own accurate mode is slower and used for poor light.
    for (const int flags : {int{cv::CALIB_CB_EXHAUSTIVE}, cv::CALIB_CB_ACCURACY | cv::CALIB_CB_NORMALIZE_IMAGE})
      if (cv::findChessboardCornersSB(grey, size, corners, flags)) return corners;
  } catch (const cv::Exception&) {
    return std::nullopt;
  }
  return std::nullopt;
}

cv::Mat coarser(const cv::Mat& grey, int factor) {
  cv::Mat coarse;
  cv::resize(grey, coarse, {grey.cols / factor, grey.rows / factor}, 0.0, 0.0, cv::INTER_AREA);
  return coarse;
}

/// A large image is searched at half size first: four times as fast.
std::optional<Corners> chessboardIn(const cv::Mat& grey, const cv::Size& size) {
  if (grey.cols > kLargePicture_px)
    if (auto corners = chessboardAsItIs(coarser(grey, 2), size)) {
      for (cv::Point2f& corner : *corners) corner = 2.0F * corner + cv::Point2f(0.5F, 0.5F);
      return corners;
    }
  return chessboardAsItIs(grey, size);
}

/// Whether part of a board is visible.
bool holdsAPart(const cv::Mat& grey) {
  Corners corners;
  try {
    constexpr int kFlags = cv::CALIB_CB_LARGER | cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_EXHAUSTIVE;
    return cv::findChessboardCornersSB(grey, {4, 4}, corners, kFlags);
  } catch (const cv::Exception&) {
    return false;
  }
}

BoardDetection notFound(const cv::Mat& grey, const cv::Size& size) {
  for (const int factor : kCoarser) {
    const cv::Mat coarse = coarser(grey, factor);
    if (std::min(coarse.cols, coarse.rows) > 60 && chessboardAsItIs(coarse, size))
      return BoardDetection{}.rejected(BoardTrouble::blurred,
                                       "the image is blurred: hold the camera still and focus on the screen");
  }
  if (holdsAPart(grey))
    return BoardDetection{}.rejected(
        BoardTrouble::cropped,
        "only part of the board is seen: take the camera back or turn it, and uncover the screen");
  return BoardDetection{}.rejected(
      BoardTrouble::not_found, "no board is seen: point the camera at the screen, darken the room, avoid reflections");
}

/// The shortest side of a square, px.
double leastSide_px(const Corners& corners, const cv::Size& size) {
  double least = 1e9;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const auto at = [&](int column, int row) { return corners[static_cast<std::size_t>(row * size.width + column)]; };
      if (x + 1 < size.width) least = std::min(least, cv::norm(at(x + 1, y) - at(x, y)));
      if (y + 1 < size.height) least = std::min(least, cv::norm(at(x, y + 1) - at(x, y)));
    }
  return least;
}

/// From about 0.25 px (finder) to about 0.05 px (saddle fit), in a window without spots.
void refine(const cv::Mat& grey, Corners& corners, const cv::Size& size) {
  const int half = std::clamp(static_cast<int>(kWindowOfSide * leastSide_px(corners, size)), 2, kMaxWindow_px);
  const cv::TermCriteria until(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 40, 0.005);
  cv::cornerSubPix(grey, corners, {half, half}, {-1, -1}, until);
}

/// From the ratio of the homography's principal stretches at the centre.
double slantOf_deg(const Corners& corners, const cv::Size& size) {
  Corners squares;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) squares.emplace_back(static_cast<float>(x), static_cast<float>(y));
  const cv::Mat H = cv::findHomography(squares, corners);
  if (H.empty()) return 90.0;
  const cv::Matx33d h = H;
  const cv::Vec3d middle((size.width - 1) / 2.0, (size.height - 1) / 2.0, 1.0);
  const cv::Vec3d at = h * middle;
  cv::Matx22d J;
  for (int row = 0; row < 2; ++row)
    for (int column = 0; column < 2; ++column)
      J(row, column) = (h(row, column) - at[row] / at[2] * h(2, column)) / at[2];
  cv::Vec2d stretch;
  cv::SVD::compute(J, stretch, cv::SVD::NO_UV);
  return degreesFromRad(std::acos(std::clamp(stretch[1] / std::max(stretch[0], 1e-12), 0.0, 1.0)));
}

double greyAt(const cv::Mat& grey, const cv::Point2f& px) {
  const int x = std::clamp(static_cast<int>(std::floor(px.x)), 0, grey.cols - 2);
  const int y = std::clamp(static_cast<int>(std::floor(px.y)), 0, grey.rows - 2);
  const double right = std::clamp(double(px.x) - x, 0.0, 1.0), below = std::clamp(double(px.y) - y, 0.0, 1.0);
  const auto at = [&](int column, int row) { return double(grey.at<std::uint8_t>(row, column)); };
  return (1.0 - below) * ((1.0 - right) * at(x, y) + right * at(x + 1, y)) +
         below * ((1.0 - right) * at(x, y + 1) + right * at(x + 1, y + 1));
}

/// Distance, along `across`, between a quarter and three quarters of the step between two squares; px.
double riseOf_px(const cv::Mat& grey, const cv::Point2f& middle, const cv::Point2f& across) {
  constexpr int kHalf = 24;
  std::array<double, 2 * kHalf + 1> profile{};
  for (int i = -kHalf; i <= kHalf; ++i)
    profile[static_cast<std::size_t>(i + kHalf)] = greyAt(grey, middle + across * (float(i) / kHalf));
  const double from = (profile[0] + profile[1] + profile[2]) / 3.0;
  const double to = (profile[2 * kHalf] + profile[2 * kHalf - 1] + profile[2 * kHalf - 2]) / 3.0;
  int between = 0;
  for (const double value : profile) {
    const double share = (value - from) / (to - from + (to > from ? 1e-9 : -1e-9));
    between += share > 0.25 && share < 0.75;
  }
  return between * cv::norm(across) / kHalf;
}

/// 10 to 90 % width of the edges in the worse direction (motion blurs one). Measured between a quarter and three
/// quarters, where a faint ghost has no influence, assuming a Gaussian.
double edgeOf_px(const cv::Mat& grey, const Corners& corners, const cv::Size& size) {
  constexpr double kWholeToHalf = 1.9;
  constexpr float kReach = 0.25F;  ///< of a square: avoids the spots
  const auto at = [&](int x, int y) { return corners[static_cast<std::size_t>(y * size.width + x)]; };
  std::vector<double> down, sideways;
  for (int y = 0; y + 1 < size.height; ++y)
    for (int x = 0; x + 1 < size.width; ++x) {
      down.push_back(riseOf_px(grey, 0.5F * (at(x, y) + at(x + 1, y)), kReach * (at(x, y + 1) - at(x, y))));
      sideways.push_back(riseOf_px(grey, 0.5F * (at(x, y) + at(x, y + 1)), kReach * (at(x + 1, y) - at(x, y))));
    }
  return kWholeToHalf * std::max(medianOf(down), medianOf(sideways));
}

/// Finds the board and checks its quality; corners in the finder's order.
BoardDetection charted(const cv::Mat& grey, const glm::ivec2& count) {
  const cv::Size size(count.x, count.y);
  auto corners = chessboardIn(grey, size);
  if (!corners) return notFound(grey, size);

  refine(grey, *corners, size);
  BoardDetection detection;
  for (const cv::Point2f& corner : *corners) detection.corners_px.emplace_back(corner.x, corner.y);
  detection.slant_deg = slantOf_deg(*corners, size);
  const double side_px = leastSide_px(*corners, size);
  if (detection.slant_deg > kMaxSlant_deg)
    return detection.rejected(
        BoardTrouble::too_oblique,
        fmt::format("the board is seen too obliquely ({:.0f} degrees, at most 60): face it more", detection.slant_deg));
  if (side_px < kMinSide_px)
    return detection.rejected(
        BoardTrouble::too_small,
        fmt::format("the board is too small in the image (a square is {:.0f} px, at least 9): go nearer", side_px));
  detection.edge_px = edgeOf_px(grey, *corners, size);
  if (detection.edge_px > std::min(kMaxEdge_px, kMaxEdgeOfSide * side_px))
    return detection.rejected(
        BoardTrouble::blurred,
        fmt::format("the image is blurred (edges are {:.1f} px wide): hold the camera still and focus on "
                    "the screen",
                    detection.edge_px));
  return detection;
}

}  // namespace

BoardDetection findChessboard(const GreyImage& image, const glm::ivec2& corners) {
  if (!image.isWhole()) throw CalibrationError("camera image: its size and its bytes disagree, take it again");
  return charted(matrixOf(image), corners);
}

}  // namespace calibration
