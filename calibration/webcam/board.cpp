#include "calibration/webcam/board.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "calibration/calibration_error.h"
#include "calibration/geometry/units.h"

namespace calibration {
namespace {

constexpr std::uint8_t kWhite = 235, kBlack = 16;
constexpr double kSpotRadius = 0.22;  ///< of a square's side
constexpr double kLeastSide_px = 9.0, kMostSlant_deg = 60.0;
constexpr double kMostEdge_px = 6.0, kMostEdgeOfSide = 0.3;
constexpr int kLargePicture_px = 1280;
constexpr double kWindowOfSide = 0.3;
constexpr int kMostWindow_px = 11;
constexpr std::array<int, 2> kCoarser = {3, 6};  ///< where a blurred board is looked for

using Corners = std::vector<cv::Point2f>;

std::optional<Corners> chessboardAsItIs(const cv::Mat& grey, const cv::Size& size) {
  Corners corners;
  try {
    // Corners are refined afterwards: the finder's own, slower, accuracy is the second choice, for poor light.
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

/// A large picture is looked through at half its size first: four times as fast, and corners are refined anyway.
std::optional<Corners> chessboardIn(const cv::Mat& grey, const cv::Size& size) {
  if (grey.cols > kLargePicture_px)
    if (auto corners = chessboardAsItIs(coarser(grey, 2), size)) {
      for (cv::Point2f& corner : *corners) corner = 2.0F * corner + cv::Point2f(0.5F, 0.5F);
      return corners;
    }
  return chessboardAsItIs(grey, size);
}

/// Whether a part of a board is there that is too small to be all of it.
bool holdsAPart(const cv::Mat& grey) {
  Corners corners;
  try {
    constexpr int kFlags = cv::CALIB_CB_LARGER | cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_EXHAUSTIVE;
    return cv::findChessboardCornersSB(grey, {4, 4}, corners, kFlags);
  } catch (const cv::Exception&) {
    return false;
  }
}

std::string withNumber(const char* format, double value) {
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

BoardSighting refused(BoardTrouble trouble, std::string line, BoardSighting sighting = {}) {
  sighting.trouble = trouble;
  sighting.line = std::move(line);
  sighting.corners_px.clear();
  return sighting;
}

BoardSighting notFound(const cv::Mat& grey, const cv::Size& size) {
  for (const int factor : kCoarser) {
    const cv::Mat coarse = coarser(grey, factor);
    if (std::min(coarse.cols, coarse.rows) > 60 && chessboardAsItIs(coarse, size))
      return refused(BoardTrouble::blurred, "the picture is blurred: hold the camera still and focus on the screen");
  }
  if (holdsAPart(grey))
    return refused(BoardTrouble::cropped,
                   "only part of the board is seen: take the camera back or turn it, and uncover the screen");
  return refused(BoardTrouble::not_found,
                 "no board is seen: point the camera at the screen, darken the room, avoid reflections");
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

/// The finder leaves about 0.25 px, a saddle fitted to the grey about 0.05: in a window that holds no spot.
void refine(const cv::Mat& grey, Corners& corners, const cv::Size& size) {
  const int half = std::clamp(static_cast<int>(kWindowOfSide * leastSide_px(corners, size)), 2, kMostWindow_px);
  const cv::TermCriteria until(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 40, 0.005);
  cv::cornerSubPix(grey, corners, {half, half}, {-1, -1}, until);
}

/// From how much shorter the board's middle looks in one direction than in another.
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

/// How far it is, along `across`, from a quarter to three quarters of the step between two squares; px.
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

/// Rise of the edges from 10 to 90 %, in the worse direction: a moved camera blurs one alone. Measured from a quarter
/// to three quarters, where the faint ghost of a glass has no say, and taken for a Gaussian's.
double edgeOf_px(const cv::Mat& grey, const Corners& corners, const cv::Size& size) {
  constexpr double kWholeToHalf = 1.9;
  constexpr float kReach = 0.25F;  ///< of a square: no spot is met
  const auto at = [&](int x, int y) { return corners[static_cast<std::size_t>(y * size.width + x)]; };
  std::vector<double> down, sideways;
  for (int y = 0; y + 1 < size.height; ++y)
    for (int x = 0; x + 1 < size.width; ++x) {
      down.push_back(riseOf_px(grey, 0.5F * (at(x, y) + at(x + 1, y)), kReach * (at(x, y + 1) - at(x, y))));
      sideways.push_back(riseOf_px(grey, 0.5F * (at(x, y) + at(x, y + 1)), kReach * (at(x + 1, y) - at(x, y))));
    }
  const auto middle = [](std::vector<double>& values) {
    const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), half, values.end());
    return *half;
  };
  return kWholeToHalf * std::max(middle(down), middle(sideways));
}

/// Found, and good enough to be used: corners still in the finder's order.
BoardSighting judged(const cv::Mat& grey, const glm::ivec2& count) {
  const cv::Size size(count.x, count.y);
  auto corners = chessboardIn(grey, size);
  if (!corners) return notFound(grey, size);

  refine(grey, *corners, size);
  BoardSighting sighting;
  for (const cv::Point2f& corner : *corners) sighting.corners_px.emplace_back(corner.x, corner.y);
  sighting.slant_deg = slantOf_deg(*corners, size);
  const double side_px = leastSide_px(*corners, size);
  if (sighting.slant_deg > kMostSlant_deg)
    return refused(
        BoardTrouble::too_oblique,
        withNumber("the board is seen too obliquely (%.0f degrees, at most 60): face it more", sighting.slant_deg),
        sighting);
  if (side_px < kLeastSide_px)
    return refused(
        BoardTrouble::too_small,
        withNumber("the board is too small in the picture (a square is %.0f px, at least 9): go nearer", side_px),
        sighting);
  sighting.edge_px = edgeOf_px(grey, *corners, size);
  if (sighting.edge_px > std::min(kMostEdge_px, kMostEdgeOfSide * side_px))
    return refused(BoardTrouble::blurred,
                   withNumber("the picture is blurred (edges are %.1f px wide): hold the camera still and focus on "
                              "the screen",
                              sighting.edge_px),
                   sighting);
  return sighting;
}

/// How much darker or brighter a square is in its middle than towards its corners, 0..255.
double spotOf(const cv::Mat& grey, const std::array<glm::dvec2, 4>& corners_px) {
  const glm::dvec2 middle = 0.25 * (corners_px[0] + corners_px[1] + corners_px[2] + corners_px[3]);
  const auto greyAt = [&](const glm::dvec2& px) {
    const int x = std::clamp(static_cast<int>(std::lround(px.x)), 0, grey.cols - 1);
    const int y = std::clamp(static_cast<int>(std::lround(px.y)), 0, grey.rows - 1);
    return static_cast<double>(grey.at<std::uint8_t>(y, x));
  };
  double inside = 2.0 * greyAt(middle), outside = 0.0;
  for (const glm::dvec2& corner : corners_px) {
    inside += 0.5 * greyAt(glm::mix(middle, corner, 0.15));
    outside += 0.25 * greyAt(glm::mix(middle, corner, 0.68));
  }
  return std::abs(inside / 4.0 - outside);
}

/// The four orders in which a finder may name the corners of a rectangle.
struct Order {
  bool backwards_x = false, backwards_y = false;
};
std::size_t indexIn(const Order& order, const glm::ivec2& count, int x, int y) {
  return static_cast<std::size_t>((order.backwards_y ? count.y - 1 - y : y) * count.x +
                                  (order.backwards_x ? count.x - 1 - x : x));
}

/// Squares whose spot is not as this order has it, of those with four corners seen.
int contradictions(const ShownBoard& board, const Order& order, const std::vector<double>& spots, double threshold) {
  const glm::ivec2 inner = board.corners() - 1;
  int wrong = 0;
  for (int y = 0; y < inner.y; ++y)
    for (int x = 0; x < inner.x; ++x)
      wrong += (spots[indexIn(order, inner, x, y)] > threshold) != board.hasSpot({x + 1, y + 1});
  return wrong;
}

cv::Mat matrixOf(const GreyPicture& picture) {
  const glm::ivec2 size = picture.size_px;
  if (size.x < 1 || size.y < 1 ||
      picture.grey.size() != static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y))
    throw CalibrationError("camera picture: its size and its bytes disagree, take it again");
  return {size.y, size.x, CV_8U, const_cast<std::uint8_t*>(picture.grey.data())};
}

}  // namespace

std::vector<glm::dvec2> ShownBoard::cornerPlaces_px() const {
  std::vector<glm::dvec2> places;
  for (int y = 1; y < squares.y; ++y)
    for (int x = 1; x < squares.x; ++x)
      places.push_back(glm::dvec2(upper_left_px + square_px * glm::ivec2(x, y)) - 0.5);
  return places;
}

bool ShownBoard::hasSpot(const glm::ivec2& square) const {
  const int stem = squares.x / 2 - 1;
  const bool in_stem = square.x == stem && square.y >= 1 && square.y <= squares.y - 2;
  const bool in_top = square.y == 1 && square.x > stem && square.x <= stem + 3;
  const bool in_middle = square.y == 3 && square.x > stem && square.x <= stem + 2;
  return in_stem || in_top || in_middle;
}

ShownBoard boardFor(const glm::ivec2& screen_px) {
  if (screen_px.x < 320 || screen_px.y < 200)
    throw CalibrationError("board: a screen under 320 x 200 px is too coarse for it, use a larger window");
  ShownBoard board;
  board.screen_px = screen_px;
  const glm::ivec2 fits = screen_px / (board.squares + 1);
  board.square_px = std::min(fits.x, fits.y);
  board.upper_left_px = (screen_px - board.square_px * board.squares) / 2;
  return board;
}

GreyPicture pictureOf(const ShownBoard& board) {
  GreyPicture picture{board.screen_px, {}};
  picture.grey.reserve(static_cast<std::size_t>(board.screen_px.x) * static_cast<std::size_t>(board.screen_px.y));
  for (int y = 0; y < board.screen_px.y; ++y)
    for (int x = 0; x < board.screen_px.x; ++x) {
      const glm::dvec2 at = (glm::dvec2(x, y) + 0.5 - glm::dvec2(board.upper_left_px)) / double(board.square_px);
      const glm::ivec2 square(glm::floor(at));
      const bool on_board =
          glm::all(glm::greaterThanEqual(square, glm::ivec2(0))) && glm::all(glm::lessThan(square, board.squares));
      bool black = on_board && (square.x + square.y) % 2 == 0;
      if (on_board && board.hasSpot(square) && glm::distance(at, glm::dvec2(square) + 0.5) < kSpotRadius)
        black = !black;
      picture.grey.push_back(black ? kBlack : kWhite);
    }
  return picture;
}

BoardSighting findBoard(const GreyPicture& picture, const ShownBoard& board) {
  const cv::Mat grey = matrixOf(picture);
  const glm::ivec2 count = board.corners(), inner = count - 1;
  BoardSighting sighting = judged(grey, count);
  if (sighting.trouble) return sighting;

  // Which squares hold a spot, still in the finder's order.
  std::vector<double> spots;
  for (int y = 0; y < inner.y; ++y)
    for (int x = 0; x < inner.x; ++x) {
      const auto at = [&](int column, int row) { return sighting.corners_px[indexIn({}, count, column, row)]; };
      spots.push_back(spotOf(grey, {at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)}));
    }
  const double threshold = 0.5 * *std::ranges::max_element(spots);

  // The order that reads the F.
  std::optional<Order> order;
  for (const Order candidate : {Order{false, false}, Order{true, true}, Order{true, false}, Order{false, true}})
    if (contradictions(board, candidate, spots, threshold) <= 1) order = candidate;
  if (!order)
    return refused(BoardTrouble::not_found,
                   "a board is seen, but not its F: show our own board, avoid reflections and uncover the screen",
                   sighting);
  std::vector<glm::dvec2> ordered;
  for (int y = 0; y < count.y; ++y)
    for (int x = 0; x < count.x; ++x) ordered.push_back(sighting.corners_px[indexIn(*order, count, x, y)]);

  // Right-handed as on the screen, or seen in a mirror too many.
  const glm::dvec2 across = ordered[static_cast<std::size_t>(count.x - 1)] - ordered.front();
  const glm::dvec2 down = ordered[static_cast<std::size_t>((count.y - 1) * count.x)] - ordered.front();
  if (across.x * down.y - across.y * down.x < 0.0)
    return refused(BoardTrouble::mirrored,
                   "the F is mirrored: correct the screen's corners in the rig file, or the camera's mirror setting",
                   sighting);
  sighting.corners_px = std::move(ordered);
  return sighting;
}

BoardSighting findChessboard(const GreyPicture& picture, const glm::ivec2& corners) {
  return judged(matrixOf(picture), corners);
}

}  // namespace calibration
