#include "calibration/synthetic/webcam_image.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "calibration/geometry/units.h"
#include "tests/calibration/synthetic/glass_formulas.h"
#include "tests/calibration/synthetic/mirrored_workstation.h"

namespace calibration {
namespace {

GreyImage plain(glm::ivec2 size, std::uint8_t grey) {
  return {size, std::vector<std::uint8_t>(static_cast<std::size_t>(size.x * size.y), grey)};
}
std::uint8_t& at(GreyImage& image, int x, int y) {
  return image.grey[static_cast<std::size_t>(y * image.size_px.x + x)];
}
std::uint8_t at(const GreyImage& image, int x, int y) {
  return image.grey[static_cast<std::size_t>(y * image.size_px.x + x)];
}
void fill(GreyImage& image, glm::ivec2 low, glm::ivec2 high, std::uint8_t grey) {
  for (int y = low.y; y < high.y; ++y)
    for (int x = low.x; x < high.x; ++x) at(image, x, y) = grey;
}

/// Centroid of the light above the dark level.
glm::dvec2 middleOfLight(const GreyImage& image, double dark_grey = 5.0) {
  glm::dvec2 sum(0.0);
  double weight = 0.0;
  for (int y = 0; y < image.size_px.y; ++y)
    for (int x = 0; x < image.size_px.x; ++x) {
      const double grey = at(image, x, y);
      if (grey < dark_grey) continue;
      const double light = std::pow(grey / 255.0, 2.2);
      sum += light * glm::dvec2(x, y);
      weight += light;
    }
  return sum / weight;
}

/// Pixel of a point on the virtual screen.
glm::dvec2 seenPlace(const Webcam& webcam, const glm::dvec3& position_W) {
  return webcam.model.pixelOf(webcam.X_WC.inverse() * Point<World>{position_W});
}

/// 24 x 24 px of the framebuffer, centred there.
GreyImage squareAt(glm::ivec2 size, glm::ivec2 middle) {
  GreyImage shown = plain(size, 0);
  fill(shown, middle - 12, middle + 12, 255);
  return shown;
}

WebcamScene mirroredScene() { return {.panel = hangingMonitor(), .mirror = slantedMirror(), .room_light = 0.0}; }

TEST(WebcamImage, UndistortsWhatTheCameraDistorts) {
  const CameraModel model = webcamAtEye().model;
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> x(0.0, 1919.0), y(0.0, 1079.0);
  for (int i = 0; i < 1000; ++i) {
    const glm::dvec2 pixel(x(rng), y(rng));
    EXPECT_LT(glm::distance(model.pixelOf({glm::dvec3(model.undistorted(pixel), 1.0) * 400.0}), pixel), 1e-6);
  }
}

TEST(WebcamImage, APanelPointProjectsByTheCameraModel) {
  const ScreenCorners panel = uprightScreen();
  for (const glm::dvec3 from : {glm::dvec3(0, 0, 450), glm::dvec3(180, 60, 420), glm::dvec3(-150, 120, 500)}) {
    const Webcam webcam = perfect(webcamAtEye({1280, 720}, {from}));
    const WebcamRenderer direct({.panel = panel, .room_light = 0.0}, webcam);
    for (const glm::ivec2 middle : {glm::ivec2(500, 300), glm::ivec2(960, 540), glm::ivec2(1500, 800)}) {
      const GreyImage shown = squareAt(panel.px, middle);
      const glm::dvec3 position((middle.x / 1920.0 - 0.5) * 531.0, (0.5 - middle.y / 1080.0) * 531.0 * 9.0 / 16.0, 0.0);
      EXPECT_LT(glm::distance(middleOfLight(direct.image(&shown, {}, 1)), seenPlace(webcam, position)), 0.05);
    }
  }
}

TEST(WebcamImage, AMonitorInTheMirrorIsSwappedLeftToRight) {
  const Webcam webcam = perfect(webcamAtEye());
  const WebcamRenderer view(mirroredScene(), webcam);
  const GreyImage shown = squareAt({1920, 1080}, {500, 300});
  const glm::dvec3 position(-(500 / 1920.0 - 0.5) * 531.0, (0.5 - 300 / 1080.0) * 531.0 * 9.0 / 16.0, 0.0);
  EXPECT_LT(glm::distance(middleOfLight(view.image(&shown, {}, 1)), seenPlace(webcam, position)), 0.05);
}

TEST(WebcamImage, APixelHasTheMeanLightOfItsArea) {
  // Stripes of one pixel of the panel, seven to a pixel of the camera: half of white's light, or four sevenths.
  const Webcam webcam = perfect(webcamAtEye({320, 180}));
  const WebcamRenderer view({.panel = uprightScreen(), .room_light = 0.0}, webcam);
  GreyImage shown = plain({1920, 1080}, 0);
  for (int x = 0; x < 1920; x += 2) fill(shown, {x, 0}, {x + 1, 1080}, 255);
  const GreyImage seen = view.image(&shown, {}, 1);
  const double expected = 255.0 * std::pow(0.5 * 0.8, 1.0 / 2.2);
  for (int x = 100; x < 220; ++x) EXPECT_NEAR(at(seen, x, 90), expected, 12.0);
}

TEST(WebcamImage, TheFarFaceOfTheGlassShowsAGhost) {
  WebcamScene scene = mirroredScene();
  scene.plate_mm = 3.0;
  scene.ghost = 0.05;
  Webcam webcam = perfect(webcamAtEye());
  webcam.model.k1 = webcam.model.k2 = webcam.model.p1 = webcam.model.p2 = 0.0;
  GreyImage shown = plain({1920, 1080}, 0);
  fill(shown, {958, 538}, {962, 542}, 255);
  const GreyImage seen = WebcamRenderer(scene, webcam).image(&shown, {}, 1);
  // The brightest pixel away from the first image: 2.2 mm below or above it, at 450 mm.
  int brightest = 0, row = 0;
  for (int y = 500; y < 580; ++y)
    if (std::abs(y - 540) > 3 && at(seen, 959, y) > brightest) brightest = at(seen, 959, y), row = y;
  EXPECT_GT(brightest, 20);
  EXPECT_NEAR(std::abs(row - 539.5), 2.2 * 1400.0 / 450.0, 1.5);
}

TEST(WebcamImage, ALitTipProjectsByTheCameraModel) {
  const Webcam webcam = perfect(webcamAtEye({1920, 1080}, {{120, 40, 430}}));
  const WebcamRenderer view(mirroredScene(), webcam);
  std::mt19937 rng(3);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int i = 0; i < 10; ++i) {
    const LitTip tip{.middle_W = {{60 * any(rng), 40 * any(rng), 30 * any(rng)}}};
    EXPECT_LT(glm::distance(middleOfLight(view.image(nullptr, tip, 1)), seenPlace(webcam, tip.middle_W.mm)), 0.05);
  }
}

TEST(WebcamImage, ATipBehindTheGlassIsShiftedByTheFormula) {
  const Webcam webcam = perfect(webcamAtEye());
  WebcamScene scene = mirroredScene();
  const LitTip tip{.middle_W = {{0, 0, 0}}};
  const glm::dvec2 plain = middleOfLight(WebcamRenderer(scene, webcam).image(nullptr, tip, 1));
  scene.plate_mm = 3.0;
  const glm::dvec2 shifted = middleOfLight(WebcamRenderer(scene, webcam).image(nullptr, tip, 1));
  const double shift_mm = plateShift_mm({slantedMirror(), 3.0}, radFromDegrees(45.0));
  EXPECT_NEAR(glm::distance(plain, shifted), shift_mm * 1400.0 / 450.0, 0.03);
}

TEST(WebcamImage, AMovingTipIsBlurredAboutItsCentre) {
  const Webcam webcam = perfect(webcamAtEye());
  const WebcamRenderer view(mirroredScene(), webcam);
  LitTip tip{.middle_W = {{5, 5, 10}}};
  const GreyImage still = view.image(nullptr, tip, 1);
  tip.smear_mm = {{4, 0, 0}};
  const GreyImage smeared = view.image(nullptr, tip, 1);
  EXPECT_LT(glm::distance(middleOfLight(still), middleOfLight(smeared)), 0.1);
  const auto lit = [](const GreyImage& p) { return std::ranges::count_if(p.grey, [](auto g) { return g > 40; }); };
  EXPECT_GT(lit(smeared), 3 * lit(still) / 2);
}

TEST(WebcamImage, ASideLampShiftsTheCentreByLessThanTheRadius) {
  const Webcam webcam = perfect(webcamAtEye());
  const WebcamRenderer view(mirroredScene(), webcam);
  LitTip tip{.middle_W = {{0, 0, 0}}};
  const glm::dvec2 even = middleOfLight(view.image(nullptr, tip, 1));
  tip.lamp_share = 0.5;
  const glm::dvec2 lit = middleOfLight(view.image(nullptr, tip, 1));
  EXPECT_LT(lit.y, even.y) << "the lamp is above";
  EXPECT_LT(glm::distance(even, lit), 0.5 * 1.5 * 1400.0 / 450.0);
}

TEST(WebcamImage, DependsOnTheSeed) {
  const WebcamRenderer view(mirroredScene(), webcamAtEye({640, 360}));
  const GreyImage shown = squareAt({1920, 1080}, {900, 500});
  const LitTip tip{.middle_W = {{0, 0, 0}}};
  EXPECT_EQ(view.image(&shown, tip, 7).grey, view.image(&shown, tip, 7).grey);
  EXPECT_NE(view.image(&shown, tip, 7).grey, view.image(&shown, tip, 8).grey);
}

TEST(WebcamImage, HasTheRequestedNoise) {
  Webcam webcam = webcamAtEye({640, 360});
  webcam.vignetting = 0.0;
  webcam.noise_grey = 3.0;
  WebcamScene scene = mirroredScene();
  scene.room_light = 0.2;
  const GreyImage seen = WebcamRenderer(scene, webcam).image(nullptr, {}, 11);
  double mean = 0.0, square = 0.0;
  for (const std::uint8_t grey : seen.grey) mean += grey, square += grey * grey;
  mean /= static_cast<double>(seen.grey.size());
  EXPECT_NEAR(mean, 255.0 * std::pow(0.2, 1.0 / 2.2), 0.2);
  EXPECT_NEAR(std::sqrt(square / static_cast<double>(seen.grey.size()) - mean * mean), 3.0, 0.1);
}

}  // namespace
}  // namespace calibration
