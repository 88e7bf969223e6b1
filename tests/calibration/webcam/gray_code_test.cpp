#include "calibration/webcam/gray_code.h"

#include <gtest/gtest.h>

#include "calibration/calibration_error.h"
#include "tests/calibration/webcam/seen_screen.h"

namespace calibration {
namespace {

const ShownScreen kScreen{{480, 270}, {531.0, 298.7}};
const CameraModel kWebcam{{640, 360}, {470.0, 470.0}, {322.0, 178.0}, 0.05, -0.1, 0.0005, -0.0004};
const GrayCode kCode{{480, 270}, 10};

std::vector<GreyImage> sweep(const Pose<World, Camera>& X_WC, double noise = 3.0) {
  const SeenScreen seen(kScreen, kWebcam, X_WC);
  std::vector<GreyImage> images;
  unsigned seed = 0;
  for (const GreyImage& shown : patternImages(kCode)) images.push_back(noisy(seen.of(shown), noise, ++seed));
  return images;
}

std::vector<GreyImage> flippedAll(std::vector<GreyImage> images, bool left_right, bool top_bottom) {
  for (GreyImage& image : images) image = flipped(image, left_right, top_bottom);
  return images;
}

TEST(GrayCode, LocatesEveryCell) {
  const Pose<World, Camera> X_WC = cameraTowards({150, 60, 520}, {0, 0, 0}, 0.1);
  const CodeDetection detection = decoded(kCode, sweep(X_WC));
  ASSERT_FALSE(detection.trouble) << detection.line;
  EXPECT_GT(double(detection.correspondences.size()), 0.95 * (kCode.cells().x - 2) * (kCode.cells().y - 2));
  EXPECT_GT(detection.correspondences.size(), 1000U);
  double sum = 0.0;
  for (const ScreenCorrespondence& observation : detection.correspondences) {
    const glm::dvec2 off =
        observation.camera_px - kWebcam.pixelOf(X_WC.inverse() * kScreen.position_W(observation.screen_px));
    EXPECT_LT(glm::length(off), 0.6);
    sum += glm::dot(off, off);
  }
  EXPECT_LT(std::sqrt(sum / double(detection.correspondences.size())), 0.2);
}

TEST(GrayCode, DetectsEveryFlip) {
  const auto images = sweep(cameraTowards({-120, 40, 540}, {10, 0, 0}, -0.1));
  EXPECT_FALSE(decoded(kCode, images).trouble);
  const auto sideways = decoded(kCode, flippedAll(images, true, false));
  EXPECT_EQ(sideways.trouble, CodeTrouble::mirrored);
  EXPECT_NE(sideways.line.find("left to right"), std::string::npos);
  const auto upright = decoded(kCode, flippedAll(images, false, true));
  EXPECT_EQ(upright.trouble, CodeTrouble::mirrored);
  EXPECT_NE(upright.line.find("top to bottom"), std::string::npos);
  EXPECT_EQ(decoded(kCode, flippedAll(images, true, true)).trouble, CodeTrouble::upside_down);
  EXPECT_TRUE(sideways.correspondences.empty());
}

TEST(GrayCode, IgnoresPixelsThatDoNotFollowTheScreen) {
  auto images = sweep(cameraTowards({0, 0, 700}, {0, 0, 0}));
  // A lamp's reflection: always bright.
  for (GreyImage& image : images)
    for (int y = 150; y < 200; ++y)
      for (int x = 300; x < 360; ++x) image.grey[static_cast<std::size_t>(y * image.size_px.x + x)] = 250;
  const CodeDetection detection = decoded(kCode, images);
  ASSERT_FALSE(detection.trouble) << detection.line;
  for (const ScreenCorrespondence& observation : detection.correspondences)
    EXPECT_FALSE(observation.camera_px.x > 300 && observation.camera_px.x < 359 && observation.camera_px.y > 150 &&
                 observation.camera_px.y < 199);
}

TEST(GrayCode, RefusesAnEmptyOrInconsistentSweep) {
  const std::vector<GreyImage> dark(static_cast<std::size_t>(kCode.images()),
                                    {{640, 360}, std::vector<std::uint8_t>(640 * 360, 20)});
  EXPECT_EQ(decoded(kCode, dark).trouble, CodeTrouble::not_seen);
  auto images = sweep(cameraTowards({0, 0, 560}, {0, 0, 0}));
  std::swap(images[4], images[5]);
  EXPECT_EQ(decoded(kCode, images).trouble, CodeTrouble::mixed_up);
  images.pop_back();
  EXPECT_THROW(decoded(kCode, images), CalibrationError);
  images.push_back({{4, 4}, std::vector<std::uint8_t>(16)});
  EXPECT_THROW(decoded(kCode, images), CalibrationError);
}

TEST(GrayCode, ShowsNeighboursThatDifferInOneBit) {
  const auto shown = patternImages(kCode);
  ASSERT_EQ(static_cast<int>(shown.size()), kCode.images());
  const auto differing = [&](int x1, int y1, int x2, int y2) {
    int count = 0;
    for (std::size_t i = 2; i < shown.size(); i += 2)
      count += shown[i].grey[static_cast<std::size_t>(y1 * 480 + x1)] !=
               shown[i].grey[static_cast<std::size_t>(y2 * 480 + x2)];
    return count;
  };
  for (int x = 5; x + 10 < 480; x += 10) EXPECT_EQ(differing(x, 5, x + 10, 5), 1);
  for (int y = 5; y + 10 < 270; y += 10) EXPECT_EQ(differing(5, y, 5, y + 10), 1);
  EXPECT_THROW(patternImages({{480, 270}, 1}), CalibrationError);
}

}  // namespace
}  // namespace calibration
