#include "calibration/webcam/intrinsics.h"

#include <filesystem>
#include <iostream>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

#include "calibration/webcam/board.h"
#include "calibration/webcam/image_reader.h"
#include "tests/calibration/webcam/seen_screen.h"
#include "tests/refusal.h"

namespace calibration {
namespace {

using testing::HasSubstr;

const CameraModel kWebcam{{1280, 720}, {930.0, 931.5}, {644.0, 355.0}, 0.05, -0.1, 0.0006, -0.0004};

/// 12 x 7 corners, 30 mm apart, about the origin.
std::vector<glm::dvec2> boardPlaces() {
  std::vector<glm::dvec2> positions_mm;
  for (int y = 0; y < 7; ++y)
    for (int x = 0; x < 12; ++x) positions_mm.emplace_back(30.0 * (x - 5.5), 30.0 * (y - 3.0));
  return positions_mm;
}

/// `n` views from all sides, each slanted up to `slant` (tangent).
std::vector<BoardView> views(std::size_t n, double slant, double noise_px, double aside_mm = 70.0) {
  std::mt19937 rng(11);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  std::normal_distribution<double> noise(0.0, noise_px);
  std::vector<BoardView> all;
  while (all.size() < n) {
    const double away_mm = 520.0 + 60.0 * any(rng);
    const glm::dvec3 eye(slant * away_mm * any(rng), slant * away_mm * any(rng), away_mm);
    const glm::dvec3 at(aside_mm * any(rng), aside_mm * any(rng), 0.0);
    const Pose<World, Camera> X_WC =
        cameraTowards(slant == 0.0 ? at + glm::dvec3(0, 0, away_mm) : eye, at, 0.3 * any(rng));
    BoardView view{"view " + std::to_string(all.size() + 1), {}};
    for (const glm::dvec2& mm : boardPlaces())
      view.corners_px.push_back(kWebcam.pixelOf(X_WC.inverse() * Point<World>{{mm.x, -mm.y, 0.0}}) +
                                glm::dvec2(noise(rng), noise(rng)));
    all.push_back(view);
  }
  return all;
}

std::string refusal(const std::vector<BoardView>& given) {
  return tests::refusalOf<CalibrationError>([&] { fitIntrinsics(kWebcam.size_px, boardPlaces(), given); });
}

TEST(Intrinsics, FindTheLensThatTookTheViews) {
  const Intrinsics found = fitIntrinsics(kWebcam.size_px, boardPlaces(), views(14, 0.6, 0.15));
  EXPECT_NEAR(found.rms_px, 0.15 * std::sqrt(2.0), 0.03);
  EXPECT_TRUE(found.left_out.empty());
  EXPECT_LT(glm::distance(found.camera.focal_px, kWebcam.focal_px), 2.5);
  EXPECT_LT(glm::distance(found.camera.centre_px, kWebcam.centre_px), 2.0);
  // The criterion: projections over the whole image.
  for (const double x : {-0.55, 0.0, 0.55})
    for (const double y : {-0.3, 0.0, 0.3})
      EXPECT_LT(
          glm::distance(found.camera.pixelOf({{500 * x, 500 * y, 500}}), kWebcam.pixelOf({{500 * x, 500 * y, 500}})),
          2.5);
}

TEST(Intrinsics, NameAViewThatDoesNotFitTheOthers) {
  auto given = views(13, 0.6, 0.15);
  for (std::size_t i = 0; i < given[4].corners_px.size(); ++i)
    given[4].corners_px[i] += glm::dvec2(i % 12 < 6 ? 6.0 : -6.0, i % 5 < 2 ? 4.0 : -3.0);
  const Intrinsics found = fitIntrinsics(kWebcam.size_px, boardPlaces(), given);
  EXPECT_THAT(found.left_out, testing::ElementsAre("view 5"));
  EXPECT_EQ(found.view_rms_px.size(), 13U);
  EXPECT_NEAR(found.rms_px, 0.15 * std::sqrt(2.0), 0.03);
}

TEST(Intrinsics, RefuseDegenerateSets) {
  EXPECT_THAT(refusal(views(7, 0.6, 0.15)), HasSubstr("too few"));
  EXPECT_THAT(refusal(views(12, 0.0, 0.15)), HasSubstr("squarely"));
  auto given = views(12, 0.6, 0.15);
  given[2].corners_px.pop_back();
  EXPECT_THAT(refusal(given), HasSubstr("view 3"));
  given = views(12, 0.6, 0.15);
  given[2].corners_px[5].x = std::nan("");
  EXPECT_THAT(refusal(given), HasSubstr("not finite"));
  given = views(12, 0.6, 0.15);
  std::mt19937 rng(2);
  std::normal_distribution<double> wild(0.0, 12.0);
  for (std::size_t i = 0; i < 6; ++i)
    for (glm::dvec2& px : given[i].corners_px) px += glm::dvec2(wild(rng), wild(rng));
  EXPECT_THAT(refusal(given), HasSubstr("fit together"));
}

TEST(Intrinsics, RefuseViewsInOnePartOfTheImage) {
  // Far away: the board covers the centre only.
  std::vector<BoardView> given;
  for (int i = 0; i < 12; ++i) {
    const Pose<World, Camera> X_WC =
        cameraTowards({600.0 * (i % 4 - 1.5), 500.0 * (i % 3 - 1), 1500.0}, {0, 0, 0}, 0.1);
    BoardView view{"far", {}};
    for (const glm::dvec2& mm : boardPlaces())
      view.corners_px.push_back(kWebcam.pixelOf(X_WC.inverse() * Point<World>{{mm.x, -mm.y, 0.0}}));
    given.push_back(view);
  }
  EXPECT_THAT(refusal(given), HasSubstr("cover"));
}

/// Real images: a 9 x 6 chessboard before two cameras, 640 x 480, from Debian's opencv-doc.
class OpenCvChessboards : public testing::Test {
 protected:
  static std::vector<BoardView> sightings(const std::string& side) {
    std::vector<BoardView> found;
    for (int i = 1; i <= 14; ++i) {
      if (i == 10) continue;  // there is none
      const std::string name = side + (i < 10 ? "0" : "") + std::to_string(i) + ".jpg";
      const BoardDetection detection = findChessboard(readGreyImage(kFolder + name), {9, 6});
      EXPECT_FALSE(detection.trouble) << name << ": " << detection.line;
      found.push_back({name, detection.corners_px});
    }
    return found;
  }
  static inline const std::string kFolder = "/usr/share/doc/opencv-doc/examples/data/";
};

/// Stereo residual of the two lenses with fixed relative pose.
double stereoRms_px(const Intrinsics& left, const Intrinsics& right, const std::vector<glm::dvec2>& positions_mm,
                    const std::vector<BoardView>& left_views, const std::vector<BoardView>& right_views) {
  const auto pixels = [](const std::vector<BoardView>& views) {
    std::vector<std::vector<cv::Point2f>> all;
    for (const BoardView& view : views) {
      all.emplace_back();
      for (const glm::dvec2& px : view.corners_px) all.back().emplace_back(px.x, px.y);
    }
    return all;
  };
  const auto matrix = [](const CameraModel& camera) {
    return cv::Mat(
        cv::Matx33d(camera.focal_px.x, 0, camera.centre_px.x, 0, camera.focal_px.y, camera.centre_px.y, 0, 0, 1));
  };
  const auto bent = [](const CameraModel& camera) {
    return cv::Mat(cv::Vec4d(camera.k1, camera.k2, camera.p1, camera.p2), true);
  };
  std::vector<cv::Point3f> positions;
  for (const glm::dvec2& mm : positions_mm) positions.emplace_back(mm.x, mm.y, 0.0);
  cv::Mat left_K = matrix(left.camera), left_D = bent(left.camera), right_K = matrix(right.camera),
          right_D = bent(right.camera), R, t, E, F;
  return cv::stereoCalibrate(std::vector(left_views.size(), positions), pixels(left_views), pixels(right_views), left_K,
                             left_D, right_K, right_D, {left.camera.size_px.x, left.camera.size_px.y}, R, t, E, F,
                             cv::CALIB_FIX_INTRINSIC);
}

TEST_F(OpenCvChessboards, AreAllFoundAndMakeGoodLenses) {
  if (!std::filesystem::exists(kFolder + "left01.jpg"))
    GTEST_SKIP() << "NO REAL PICTURES WERE TESTED: " << kFolder << " is missing (apt-get install opencv-doc)";
  std::vector<glm::dvec2> positions_mm;
  for (int y = 0; y < 6; ++y)
    for (int x = 0; x < 9; ++x) positions_mm.emplace_back(25.0 * x, 25.0 * y);
  const auto left_views = sightings("left"), right_views = sightings("right");
  ASSERT_FALSE(HasFailure());
  const Intrinsics left = fitIntrinsics({640, 480}, positions_mm, left_views);
  const Intrinsics right = fitIntrinsics({640, 480}, positions_mm, right_views);
  const double stereo_rms_px = stereoRms_px(left, right, positions_mm, left_views, right_views);
  std::cout << "13 pairs: left " << left.rms_px << ", right " << right.rms_px << ", stereo " << stereo_rms_px
            << " px RMS\n";
  EXPECT_TRUE(left.left_out.empty() && right.left_out.empty());
  EXPECT_LE(left.rms_px, 0.45);
  EXPECT_LE(right.rms_px, 0.45);
  EXPECT_LE(stereo_rms_px, 0.5);
}

}  // namespace
}  // namespace calibration
