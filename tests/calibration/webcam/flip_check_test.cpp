#include "calibration/webcam/flip_check.h"

#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibration/calibration_error.h"
#include "tests/calibration/synthetic/mirrored_workstation.h"

namespace calibration {
namespace {

constexpr glm::ivec2 kScreen_px{960, 540};

GreyImage numbered(glm::ivec2 size) {
  GreyImage image{size, {}};
  for (int i = 0; i < size.x * size.y; ++i) image.grey.push_back(static_cast<std::uint8_t>(i));
  return image;
}

/// A webcam in front of the screen with realistic roll, blur and noise.
Webcam someWebcam(std::mt19937& rng) {
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const double roll = 0.5 * any(rng);
  Webcam webcam = webcamAtEye({640, 360});
  webcam.X_WC = lookingAt({{200 * any(rng), 150 * any(rng), 470 + 80 * any(rng)}}, {{30 * any(rng), 20 * any(rng), 0}},
                          {std::sin(roll), std::cos(roll), 0});
  webcam.defocus_px = 1.5 + 1.5 * any(rng);
  webcam.noise_grey = 6.0 + 6.0 * any(rng);
  return webcam;
}

TEST(FlipCheck, TheInverseRestoresTheImage) {
  const GreyImage image = numbered({5, 3});
  for (const ImageOrientation& reading : kImageOrientations) {
    const GreyImage back = oriented(inverseOf(reading), oriented(reading, image));
    EXPECT_EQ(back.size_px, image.size_px) << nameOf(reading);
    EXPECT_EQ(back.grey, image.grey) << nameOf(reading);
  }
}

TEST(FlipCheck, AQuarterTurnMovesTheUpperLeftToTheUpperRight) {
  const GreyImage seen = oriented({false, 1}, numbered({3, 2}));
  EXPECT_EQ(seen.size_px, glm::ivec2(2, 3));
  EXPECT_THAT(seen.grey, testing::ElementsAre(3, 0, 4, 1, 5, 2));
  EXPECT_THAT(oriented({true, 0}, numbered({3, 2})).grey, testing::ElementsAre(2, 1, 0, 5, 4, 3));
}

TEST(FlipCheck, EveryOrientationOfAnFIsRecognised) {
  std::mt19937 rng(41);
  int told = 0;
  for (int pose = 0; pose < 20; ++pose) {
    const WebcamRenderer view({.panel = uprightScreen(kScreen_px)}, someWebcam(rng));
    for (const ImageOrientation& reading : kImageOrientations) {
      // A rotated image is drawn so that it fits the screen again.
      const bool on_its_side = reading.quarters % 2 == 1;
      const GreyImage letter = letterF(on_its_side ? glm::ivec2(kScreen_px.y, kScreen_px.x) : kScreen_px);
      const GreyImage shown = oriented(reading, letter);
      const GreyImage seen = view.image(&shown, {}, static_cast<std::uint64_t>(pose));
      const auto read = orientationOfF(seen);
      EXPECT_TRUE(read == reading) << "pose " << pose << ": " << nameOf(reading) << " read as "
                                   << (read ? nameOf(*read) : "nothing");
      told += read == reading;
    }
  }
  EXPECT_EQ(told, 160);
}

TEST(FlipCheck, AMonitorInTheMirrorReadsRightWithTheRigsFlip) {
  Rig rig = desktopRig(kScreen_px);
  rig.mirror = slantedMirror();
  const ScreenCorners seen = rig.screen;
  const Point<World> upper_right{seen.upper_left.mm + seen.lower_right.mm - seen.lower_left.mm};
  const std::vector<ScreenCorners> arrangements{
      inTheMirror(seen), hangingMonitor(kScreen_px),
      inTheMirror({kScreen_px, upper_right, seen.upper_left, seen.lower_right}),
      inTheMirror({kScreen_px, seen.upper_left, upper_right, seen.lower_left})};
  std::mt19937 rng(2);
  for (const ScreenCorners& corners : arrangements) {
    rig.screen = corners;
    const GreyImage shown = framebufferFor(rig, letterF(seenSize_px(rig)));
    EXPECT_EQ(shown.size_px, kScreen_px);
    EXPECT_LT(glm::distance(seenScreen(rig).lower_left.mm, seen.lower_left.mm), 1e-9);
    EXPECT_LT(glm::distance(seenScreen(rig).upper_left.mm, seen.upper_left.mm), 1e-9);
    const WebcamRenderer view({.panel = corners, .mirror = rig.mirror}, someWebcam(rng));
    const GreyImage image = view.image(&shown, {}, 1);
    keepPicture("f_in_the_mirror", image);
    EXPECT_TRUE(orientationOfF(image) == ImageOrientation{}) << "as the rig turns it";
    const GreyImage plain = letterF(kScreen_px);
    EXPECT_TRUE(orientationOfF(view.image(&plain, {}, 1)) == framebufferOrientation(rig))
        << "as the framebuffer has it";
  }
}

TEST(FlipCheck, APixelAsSeenHasItsPositionOnTheVirtualScreen) {
  const ScreenCorners seen = seenScreen(desktopRig({1000, 500}, 500.0));
  EXPECT_LT(glm::distance(positionOn(seen, {499.5, 249.5}).mm, glm::dvec3(0.0)), 1e-9);
  EXPECT_LT(glm::distance(positionOn(seen, {-0.5, -0.5}).mm, glm::dvec3(-250, 125, 0)), 1e-9);
  EXPECT_LT(glm::distance(positionOn(seen, {999.5, 249.5}).mm, glm::dvec3(250, 0, 0)), 1e-9);
}

TEST(FlipCheck, AWrongCornerInTheRigFileIsFound) {
  // The file has left and right exchanged.
  Rig rig = desktopRig(kScreen_px);
  rig.mirror = slantedMirror();
  const ScreenCorners truth = hangingMonitor(kScreen_px);
  rig.screen = inTheMirror(uprightScreen(kScreen_px));
  const WebcamRenderer view({.panel = truth, .mirror = rig.mirror}, webcamAtEye({640, 360}));
  const GreyImage shown = framebufferFor(rig, letterF(seenSize_px(rig)));
  const auto read = orientationOfF(view.image(&shown, {}, 1));
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(nameOf(*read), "mirrored");
  EXPECT_THAT(remedyFor(*read), testing::HasSubstr("flip"));
}

TEST(FlipCheck, NoOrientationWithoutAnF) {
  const WebcamRenderer view({.panel = uprightScreen(kScreen_px)}, webcamAtEye({640, 360}));
  GreyImage white = letterF(kScreen_px);
  for (std::uint8_t& grey : white.grey) grey = grey > 0 || &grey - white.grey.data() > 300000 ? 255 : 0;
  EXPECT_FALSE(orientationOfF(view.image(nullptr, {}, 1)).has_value()) << "dark";
  EXPECT_FALSE(orientationOfF(view.image(&white, {}, 1)).has_value()) << "another shape";
  std::mt19937 rng(1);
  for (std::uint8_t& grey : white.grey) grey = static_cast<std::uint8_t>(rng());
  EXPECT_FALSE(orientationOfF(view.image(&white, {}, 1)).has_value()) << "noise";
  EXPECT_FALSE(orientationOfF(GreyImage{{8, 8}, std::vector<std::uint8_t>(64)}).has_value()) << "hardly an image";

  Webcam blurred = webcamAtEye({640, 360});
  blurred.defocus_px = 40.0;
  const GreyImage shown = letterF(kScreen_px);
  EXPECT_FALSE(
      orientationOfF(WebcamRenderer({.panel = uprightScreen(kScreen_px)}, blurred).image(&shown, {}, 1)).has_value());
  Webcam aside = webcamAtEye({640, 360});
  aside.X_WC = lookingAt({{0, 0, 450}}, {{270, 0, 0}}, {0, 1, 0});
  const GreyImage cropped = WebcamRenderer({.panel = uprightScreen(kScreen_px)}, aside).image(&shown, {}, 1);
  keepPicture("f_cropped", cropped);
  EXPECT_FALSE(orientationOfF(cropped).has_value()) << "half of it is outside the image";
}

}  // namespace
}  // namespace calibration
