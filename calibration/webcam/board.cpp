#include "calibration/webcam/board.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "calibration/calibration_error.h"

namespace calibration {
namespace {

constexpr double kSpotRadius = 0.22;  ///< of a square's side

/// Contrast of a square's centre against its outer parts, 0..255.
double spotOf(const GreyImage& image, const std::array<glm::dvec2, 4>& corners_px) {
  const glm::dvec2 middle = 0.25 * (corners_px[0] + corners_px[1] + corners_px[2] + corners_px[3]);
  const auto grey_at = [&](const glm::dvec2& px) {
    const int x = std::clamp(static_cast<int>(std::lround(px.x)), 0, image.size_px.x - 1);
    const int y = std::clamp(static_cast<int>(std::lround(px.y)), 0, image.size_px.y - 1);
    return double(image.at(x, y));
  };
  double inside = 2.0 * grey_at(middle), outside = 0.0;
  for (const glm::dvec2& corner : corners_px) {
    inside += 0.5 * grey_at(glm::mix(middle, corner, 0.15));
    outside += 0.25 * grey_at(glm::mix(middle, corner, 0.68));
  }
  return std::abs(inside / 4.0 - outside);
}

/// The four corner orders that a finder may return.
struct Order {
  bool backwards_x = false, backwards_y = false;
};
std::size_t indexIn(const Order& order, const glm::ivec2& count, int x, int y) {
  return static_cast<std::size_t>((order.backwards_y ? count.y - 1 - y : y) * count.x +
                                  (order.backwards_x ? count.x - 1 - x : x));
}

/// Squares whose spot contradicts this order.
int contradictions(const ShownBoard& board, const Order& order, const std::vector<double>& spots, double threshold) {
  const glm::ivec2 inner = board.corners() - 1;
  int wrong = 0;
  for (int y = 0; y < inner.y; ++y)
    for (int x = 0; x < inner.x; ++x)
      wrong += (spots[indexIn(order, inner, x, y)] > threshold) != board.hasSpot({x + 1, y + 1});
  return wrong;
}

}  // namespace

std::vector<glm::dvec2> ShownBoard::cornerPositions_px() const {
  std::vector<glm::dvec2> positions;
  for (int y = 1; y < squares.y; ++y)
    for (int x = 1; x < squares.x; ++x)
      positions.push_back(glm::dvec2(upper_left_px + square_px * glm::ivec2(x, y)) - 0.5);
  return positions;
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

GreyImage boardImage(const ShownBoard& board) {
  GreyImage image = GreyImage::filled(board.screen_px, kShownWhite);
  for (int y = 0; y < board.screen_px.y; ++y)
    for (int x = 0; x < board.screen_px.x; ++x) {
      const glm::dvec2 at = (glm::dvec2(x, y) + 0.5 - glm::dvec2(board.upper_left_px)) / double(board.square_px);
      const glm::ivec2 square(glm::floor(at));
      const bool on_board =
          glm::all(glm::greaterThanEqual(square, glm::ivec2(0))) && glm::all(glm::lessThan(square, board.squares));
      bool black = on_board && (square.x + square.y) % 2 == 0;
      if (on_board && board.hasSpot(square) && glm::distance(at, glm::dvec2(square) + 0.5) < kSpotRadius)
        black = !black;
      if (black) image.at(x, y) = kShownBlack;
    }
  return image;
}

BoardDetection findBoard(const GreyImage& image, const ShownBoard& board) {
  const glm::ivec2 count = board.corners(), inner = count - 1;
  BoardDetection detection = findChessboard(image, count);
  if (detection.trouble) return detection;

  // Spots per square, in the finder's order.
  std::vector<double> spots;
  for (int y = 0; y < inner.y; ++y)
    for (int x = 0; x < inner.x; ++x) {
      const auto at = [&](int column, int row) { return detection.corners_px[indexIn({}, count, column, row)]; };
      spots.push_back(spotOf(image, {at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)}));
    }
  const double threshold = 0.5 * *std::ranges::max_element(spots);

  // The order in which the F is readable.
  std::optional<Order> order;
  for (const Order candidate : {Order{false, false}, Order{true, true}, Order{true, false}, Order{false, true}})
    if (contradictions(board, candidate, spots, threshold) <= 1) order = candidate;
  if (!order)
    return detection.rejected(
        BoardTrouble::not_found,
        "a board is seen, but not its F: show the program's board, avoid reflections and uncover the screen");
  std::vector<glm::dvec2> ordered;
  for (int y = 0; y < count.y; ++y)
    for (int x = 0; x < count.x; ++x) ordered.push_back(detection.corners_px[indexIn(*order, count, x, y)]);

  // Left-handed: seen in one mirror too many.
  const glm::dvec2 across = ordered[static_cast<std::size_t>(count.x - 1)] - ordered.front();
  const glm::dvec2 down = ordered[static_cast<std::size_t>((count.y - 1) * count.x)] - ordered.front();
  if (across.x * down.y - across.y * down.x < 0.0)
    return detection.rejected(
        BoardTrouble::mirrored,
        "the F is mirrored: correct the screen's corners in the rig file, or the camera's mirror setting");
  detection.corners_px = std::move(ordered);
  return detection;
}

}  // namespace calibration
