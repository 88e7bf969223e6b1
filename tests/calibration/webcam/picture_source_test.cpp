#include <atomic>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibration/picture_file.h"
#include "calibration/webcam/live_pictures.h"
#include "calibration/webcam/webcam_source.h"

namespace calibration {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

std::string refusal(const std::function<void()>& act) {
  try {
    act();
  } catch (const CalibrationError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "a refusal is one line";
    return error.what();
  }
  return "accepted";
}

TEST(PictureFolder, GivesItsPicturesByTheirNumbers) {
  const std::string folder = testing::TempDir() + "picture_folder_test";
  std::filesystem::create_directories(folder);
  for (const int number : {10, 2, 1, 33})
    writePng(folder + "/view" + std::to_string(number) + ".png", {16, 16},
             std::vector<std::uint8_t>(16 * 16 * 4, static_cast<std::uint8_t>(number)));
  std::ofstream(folder + "/notes3.txt") << "not a picture";
  const auto source = openPictures({.device = folder, .exposure_ms = {}, .focus = {}}).pictures;
  for (const int number : {1, 2, 10, 33}) EXPECT_EQ(source->take().grey[0], number);
  EXPECT_THAT(refusal([&] { source->take(); }), HasSubstr("used up"));
  std::filesystem::remove_all(folder);
  EXPECT_THAT(refusal([&] { pictureFolder(folder); }), HasSubstr("can not be read"));
  std::filesystem::create_directories(folder);
  EXPECT_THAT(refusal([&] { pictureFolder(folder); }), HasSubstr("no PNG or JPEG"));
  std::filesystem::remove_all(folder);
}

/// Counts its frames; hangs or ends when told to.
class NumberedFrames final : public FrameGiver {
 public:
  explicit NumberedFrames(std::atomic<int>& given) : given_(given) {}
  bool next() override {
    std::this_thread::sleep_for(given_ == 20 ? 400ms : 1ms);
    return ++given_ <= 30;
  }
  GreyPicture decoded() override { return {{1, 1}, {static_cast<std::uint8_t>(given_)}}; }
  std::string remarks() override { return "no focus"; }

 private:
  std::atomic<int>& given_;
};

TEST(LivePictures, GiveAPictureThatBeganAfterTheCall) {
  std::atomic<int> given{0};
  LivePictures live("webcam", [&] { return std::make_unique<NumberedFrames>(given); }, {1000ms, 3000ms});
  EXPECT_EQ(live.remarks(), "no focus");
  for (int i = 0; i < 3; ++i) {
    const int before = given;
    const int taken = live.take().grey[0];
    EXPECT_GE(taken, before + 2);
  }
}

TEST(LivePictures, WaitNoLongerThanTold) {
  std::atomic<int> given{20};
  LivePictures live("webcam", [&] { return std::make_unique<NumberedFrames>(given); }, {1000ms, 50ms});
  EXPECT_THAT(refusal([&] { live.take(); }), HasSubstr("in time"));
}

TEST(LivePictures, SayThatTheCameraIsGone) {
  std::atomic<int> given{29};
  LivePictures live("webcam", [&] { return std::make_unique<NumberedFrames>(given); }, {1000ms, 3000ms});
  EXPECT_THAT(refusal([&] { live.take(), live.take(); }), HasSubstr("no more pictures"));
  EXPECT_THAT(refusal([&] { live.take(); }), HasSubstr("no more pictures"));
}

TEST(LivePictures, SayWhyTheCameraDoesNotOpen) {
  const auto fails = []() -> std::unique_ptr<FrameGiver> { throw CalibrationError("webcam: busy"); };
  EXPECT_EQ(refusal([&] { LivePictures("webcam", fails, {1000ms, 100ms}); }), "webcam: busy");
  const auto sleeps = []() -> std::unique_ptr<FrameGiver> {
    std::this_thread::sleep_for(200ms);
    return nullptr;
  };
  EXPECT_THAT(refusal([&] { LivePictures("webcam", sleeps, {20ms, 100ms}); }), HasSubstr("does not answer"));
}

TEST(WebcamSource, SaysInOneLineThatThereIsNoCamera) {
  EXPECT_THAT(refusal([] { openPictures({.device = "97", .exposure_ms = {}, .focus = {}}); }),
              testing::AllOf(HasSubstr("webcam /dev/video97"), HasSubstr("not there")));
  EXPECT_THAT(refusal([] { openPictures({.device = "/dev/null", .exposure_ms = {}, .focus = {}}); }),
              HasSubstr("no camera"));
}

}  // namespace
}  // namespace calibration
