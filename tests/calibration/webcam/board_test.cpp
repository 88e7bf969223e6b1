#include "calibration/webcam/board.h"

#include <gtest/gtest.h>

#include "calibration/calibration_error.h"
#include "calibration/webcam/image_reader.h"
#include "tests/calibration/webcam/seen_screen.h"

namespace calibration {
namespace {

const ShownScreen kScreen{{960, 540}, {531.0, 298.7}};
const CameraModel kWebcam{{960, 540}, {700.0, 700.0}, {481.0, 268.0}, 0.05, -0.1, 0.0005, -0.0004};

GreyImage seenFrom(const glm::dvec3& eye_W, double roll_rad = 0.0, const glm::dvec3& at_W = {0, 0, 0}) {
  return SeenScreen(kScreen, kWebcam, cameraTowards(eye_W, at_W, roll_rad)).of(boardImage(boardFor(kScreen.size_px)));
}

std::optional<BoardTrouble> troubleWith(const GreyImage& image) {
  const BoardDetection detection = findBoard(image, boardFor(kScreen.size_px));
  EXPECT_EQ(detection.trouble.has_value(), detection.corners_px.empty());
  EXPECT_EQ(detection.trouble.has_value(), !detection.line.empty());
  return detection.trouble;
}

TEST(Board, IsFoundWithEveryCornerAtItsProjection) {
  const ShownBoard board = boardFor(kScreen.size_px);
  const glm::dvec3 eyes[] = {{0, 0, 520}, {200, 60, 480}, {-220, -40, 470}, {30, 220, 500}};
  for (const glm::dvec3& eye : eyes) {
    const Pose<World, Camera> X_WC = cameraTowards(eye, {5, -4, 0}, 0.1);
    const BoardDetection detection =
        findBoard(noisy(SeenScreen(kScreen, kWebcam, X_WC).of(boardImage(board)), 2.0, 7), board);
    ASSERT_FALSE(detection.trouble) << detection.line;
    const auto positions = board.cornerPositions_px();
    ASSERT_EQ(detection.corners_px.size(), positions.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const glm::dvec2 true_px = kWebcam.pixelOf(X_WC.inverse() * kScreen.position_W(positions[i]));
      EXPECT_LT(glm::distance(detection.corners_px[i], true_px), 0.35) << i;
      sum += glm::dot(detection.corners_px[i] - true_px, detection.corners_px[i] - true_px);
    }
    EXPECT_LT(std::sqrt(sum / double(positions.size())), 0.12);
  }
}

TEST(Board, ReadsRightForAnyCameraRotation) {
  const ShownBoard board = boardFor(kScreen.size_px);
  for (const double roll : {0.0, 3.14159, 1.5708 * 0.3, -2.9}) {
    const Pose<World, Camera> X_WC = cameraTowards({40, 30, 640}, {0, 0, 0}, roll);
    const BoardDetection detection = findBoard(SeenScreen(kScreen, kWebcam, X_WC).of(boardImage(board)), board);
    ASSERT_FALSE(detection.trouble) << detection.line;
    const glm::dvec2 first_px =
        kWebcam.pixelOf(X_WC.inverse() * kScreen.position_W(board.cornerPositions_px().front()));
    EXPECT_LT(glm::distance(detection.corners_px.front(), first_px), 0.5) << roll;
  }
}

TEST(Board, DetectsAMirroredImage) {
  std::mt19937 rng(3);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int i = 0; i < 4; ++i) {
    const GreyImage seen =
        noisy(seenFrom({200 * any(rng), 120 * any(rng), 540 + 40 * any(rng)}, 0.3 * any(rng) + (i % 2) * 3.14), 2.0,
              static_cast<unsigned>(i));
    EXPECT_NE(troubleWith(seen), BoardTrouble::mirrored);
    EXPECT_EQ(troubleWith(flipped(seen, true, false)), BoardTrouble::mirrored) << i;
    EXPECT_EQ(troubleWith(flipped(seen, false, true)), BoardTrouble::mirrored) << i;
  }
}

TEST(Board, RefusesABlurredImage) {
  const GreyImage sharp = seenFrom({30, 20, 520});
  EXPECT_EQ(troubleWith(sharp), std::nullopt);
  EXPECT_EQ(troubleWith(blurred(sharp, 9, 9)), BoardTrouble::blurred);
  EXPECT_EQ(troubleWith(blurred(sharp, 11, 1)), BoardTrouble::blurred) << "the camera was moved";
  EXPECT_EQ(troubleWith(blurred(sharp, 25, 25)), BoardTrouble::blurred) << "not even found";
}

TEST(Board, RefusesACroppedImage) {
  EXPECT_EQ(troubleWith(seenFrom({0, 0, 520}, 0.0, {150, 20, 0})), BoardTrouble::cropped);
  EXPECT_EQ(troubleWith(seenFrom({0, 0, 260})), BoardTrouble::cropped);
}

TEST(Board, RefusesWhatIsTooFarOrTooOblique) {
  EXPECT_EQ(troubleWith(seenFrom({0, 0, 3600})), BoardTrouble::too_small);
  EXPECT_EQ(troubleWith(seenFrom({620, 0, 300})), BoardTrouble::too_oblique);
}

TEST(Board, RefusesAnImageWithoutIt) {
  EXPECT_EQ(troubleWith({{640, 480}, std::vector<std::uint8_t>(640 * 480, 90)}), BoardTrouble::not_found);
  EXPECT_EQ(troubleWith(noisy({{640, 480}, std::vector<std::uint8_t>(640 * 480, 90)}, 40.0, 1)),
            BoardTrouble::not_found);
  EXPECT_THROW(findBoard({{640, 480}, {1, 2, 3}}, boardFor({960, 540})), CalibrationError);
}

TEST(Board, RefusesAChessboardWithoutTheF) {
  const ShownBoard board = boardFor(kScreen.size_px);
  GreyImage plain = boardImage(board);
  for (int y = 0; y < board.squares.y * board.square_px; ++y)
    for (int x = 0; x < board.squares.x * board.square_px; ++x) {
      const glm::ivec2 px = board.upper_left_px + glm::ivec2(x, y);
      plain.grey[static_cast<std::size_t>(px.y * plain.size_px.x + px.x)] =
          (x / board.square_px + y / board.square_px) % 2 == 0 ? 16 : 235;
    }
  const auto seen = SeenScreen(kScreen, kWebcam, cameraTowards({20, 10, 540}, {0, 0, 0})).of(plain);
  EXPECT_EQ(troubleWith(seen), BoardTrouble::not_found);
  EXPECT_FALSE(findChessboard(seen, board.corners()).trouble);
}

TEST(Board, HasOddByEvenSquaresAndAUniqueF) {
  const ShownBoard board = boardFor({1920, 1080});
  EXPECT_EQ(board.squares.x % 2, 1);
  EXPECT_EQ(board.squares.y % 2, 0);
  int turned = 0, mirrored = 0, upside_down = 0;
  for (int y = 0; y < board.squares.y; ++y)
    for (int x = 0; x < board.squares.x; ++x) {
      const glm::ivec2 last = board.squares - 1;
      turned += board.hasSpot({x, y}) != board.hasSpot({last.x - x, last.y - y});
      mirrored += board.hasSpot({x, y}) != board.hasSpot({last.x - x, y});
      upside_down += board.hasSpot({x, y}) != board.hasSpot({x, last.y - y});
    }
  EXPECT_GE(std::min({turned, mirrored, upside_down}), 4);
  EXPECT_THROW(boardFor({200, 150}), CalibrationError);
}

TEST(BoardImage, RefusesAnInvalidImage) {
  EXPECT_THROW(readGreyImage("/nowhere/left01.jpg"), CalibrationError);
  EXPECT_THROW(readGreyImage(__FILE__), CalibrationError);
}

}  // namespace
}  // namespace calibration
