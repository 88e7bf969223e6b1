#include <filesystem>
#include <fstream>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibration/opencv_module.h"
#include "calibration/png_file.h"
#include "calibration/webcam/live_image_source.h"
#include "calibration/webcam/webcam_source.h"
#include "tests/refusal.h"
#include "tests/scratch_folder.h"

namespace calibration {
namespace {

using testing::HasSubstr;

TEST(ImageFolder, ReturnsImagesInNumericOrder) {
  const tests::ScratchFolder scratch;
  const std::string folder = scratch.file("");
  for (const int number : {10, 2, 1, 33})
    writePng(folder + "/view" + std::to_string(number) + ".png", {16, 16},
             std::vector<std::uint8_t>(16 * 16 * 4, static_cast<std::uint8_t>(number)));
  std::ofstream(folder + "/notes3.txt") << "not an image";
  const auto source = openImageSource({.device = folder, .exposure_ms = {}, .focus = {}}).images;
  for (const int number : {1, 2, 10, 33}) EXPECT_EQ(source->take().grey[0], number);
  EXPECT_THAT(tests::refusalOf<CalibrationError>([&] { source->take(); }), HasSubstr("all used"));
  std::filesystem::remove_all(folder);
  EXPECT_THAT(tests::refusalOf<CalibrationError>([&] { imageFolder(folder); }), HasSubstr("cannot be read"));
  std::filesystem::create_directories(folder);
  EXPECT_THAT(tests::refusalOf<CalibrationError>([&] { imageFolder(folder); }), HasSubstr("no PNG or JPEG"));
  std::filesystem::remove_all(folder);
}

TEST(OpenCvModule, ItsRefusalsAreCaughtByTheProgram) {
  EXPECT_THROW(openCvModule().camera("/nowhere/video", {}), CalibrationError);
  EXPECT_EQ(openCvModule().decoded_grey({}).size_px, glm::ivec2(0));
}

TEST(WebcamSource, ReportsAMissingCameraInOneLine) {
  EXPECT_THAT(
      tests::refusalOf<CalibrationError>([] { openImageSource({.device = "97", .exposure_ms = {}, .focus = {}}); }),
      testing::AllOf(HasSubstr("webcam /dev/video97"), HasSubstr("not there")));
  EXPECT_THAT(tests::refusalOf<CalibrationError>(
                  [] { openImageSource({.device = "/dev/null", .exposure_ms = {}, .focus = {}}); }),
              HasSubstr("not a camera"));
}

}  // namespace
}  // namespace calibration
