#include "calibration/webcam/webcam_file.h"

#include <filesystem>
#include <fstream>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/mutants.h"
#include "tests/refusal.h"

namespace calibration {
namespace {

using testing::HasSubstr;

WebcamObservations someObservations() {
  std::mt19937 rng(9);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  WebcamObservations all;
  all.serial = "60623200012", all.mount = "left";
  all.camera = {{1280, 720}, {931.25, 930.5}, {640.125, 361.0}, 0.05, -0.1, 0.001, -0.002};
  all.tip_noise_px = 0.75;
  for (int p = 0; p < 3; ++p) {
    CameraPosition position;
    for (int i = 0; i < 12; ++i)
      position.screen.push_back({{{200 * any(rng), 100 * any(rng), 0}}, {640 + 600 * any(rng), 300}});
    for (int i = 0; i < 5; ++i)
      position.tips.push_back({i,
                               {any(rng), any(rng), any(rng), any(rng), any(rng), any(rng)},
                               {640 + 300 * any(rng), 360 + 300 * any(rng)}});
    all.positions.push_back(position);
  }
  return all;
}

class WebcamFile : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(path_); }
  std::string write(const std::string& text) {
    std::ofstream(path_) << text;
    return path_;
  }
  std::string refusal(const std::string& text) {
    return tests::refusalOf<CalibrationError>([&] { readWebcamFile(write(text)); });
  }
  static std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
  }

  std::string path_ =
      testing::TempDir() + "webcam_file_" + testing::UnitTest::GetInstance()->current_test_info()->name() + ".yaml";
  const WebcamObservations all_ = someObservations();
  const std::string text_ = webcamFileText(all_);
};

TEST_F(WebcamFile, ReadsBackEveryBitOfWhatItWrites) {
  const WebcamObservations back = readWebcamFile(write(text_));
  EXPECT_EQ(back.serial, all_.serial);
  EXPECT_EQ(back.mount, all_.mount);
  EXPECT_EQ(back.device_model, "omni");
  EXPECT_EQ(back.camera.size_px, all_.camera.size_px);
  EXPECT_EQ(back.camera.focal_px, all_.camera.focal_px);
  EXPECT_EQ(back.camera.p2, all_.camera.p2);
  EXPECT_EQ(back.tip_noise_px, 0.75);
  ASSERT_EQ(back.positions.size(), 3u);
  for (std::size_t p = 0; p < 3; ++p) {
    const CameraPosition &was = all_.positions[p], &is = back.positions[p];
    ASSERT_EQ(is.screen.size(), was.screen.size());
    for (std::size_t i = 0; i < was.screen.size(); ++i) {
      EXPECT_EQ(is.screen[i].position_W.mm, was.screen[i].position_W.mm);
      EXPECT_EQ(is.screen[i].camera_px, was.screen[i].camera_px);
    }
    ASSERT_EQ(is.tips.size(), was.tips.size());
    for (std::size_t i = 0; i < was.tips.size(); ++i) {
      EXPECT_EQ(is.tips[i].id, was.tips[i].id);
      EXPECT_EQ(is.tips[i].joints_rad, was.tips[i].joints_rad);
      EXPECT_EQ(is.tips[i].camera_px, was.tips[i].camera_px);
    }
  }
}

TEST_F(WebcamFile, IsRecognisedByItsKind) {
  EXPECT_TRUE(isWebcamFile(write(text_)));
  EXPECT_FALSE(isWebcamFile(write("%YAML:1.0\n---\nkind: \"molar_rig\"\n")));
  EXPECT_FALSE(isWebcamFile("/nonexistent.yaml"));
}

TEST_F(WebcamFile, RefusesWithTheReason) {
  EXPECT_THAT(refusal(replaced(text_, "molar_webcam_observations", "molar_rig")), HasSubstr("kind"));
  EXPECT_THAT(refusal(replaced(text_, "schema: 1", "schema: 2")), HasSubstr("schema"));
  EXPECT_THAT(refusal(replaced(text_, "device_model: omni", "device_model: hand")), HasSubstr("'hand' is not known"));
  EXPECT_THAT(refusal(replaced(text_, "1280", "0")), HasSubstr("size_px"));
  EXPECT_THAT(refusal(replaced(text_, "9.3125", "0.3")), HasSubstr("implausible"));
  EXPECT_THAT(refusal(replaced(text_, "noise_px: [ ", "noise_px: [ -")), HasSubstr("noise_px"));
  EXPECT_THAT(refusal(replaced(text_, "joints_rad: [ ", "joints_rad: [ 99., ")), HasSubstr("position 1, tip 1"));
  EXPECT_THAT(refusal(replaced(text_, "joints_rad: [ ", "joints_rad: [ .Nan, ")), HasSubstr("joints_rad"));
  EXPECT_THAT(refusal(replaced(text_, "camera_px: [ ", "camera_px: [ 9")), HasSubstr("outside the image"));
  EXPECT_THAT(refusal(replaced(text_, "id: 0", "id: -4")), HasSubstr("'id'"));
  EXPECT_THAT(refusal(text_.substr(0, text_.size() / 2)), testing::StartsWith("webcam observations "));
  EXPECT_THAT(refusal(""), HasSubstr("size"));
  EXPECT_THROW(readWebcamFile("/nonexistent.yaml"), CalibrationError);

  WebcamObservations crowd = all_;
  crowd.positions.resize(13);
  EXPECT_THAT(refusal(webcamFileText(crowd)), HasSubstr("more than 12"));
}

TEST_F(WebcamFile, DamagedTextIsRefusedOrReadAsNumbers) {
  mutants::forEachMutant({text_}, 600, [&](const std::string& spoilt, std::size_t, std::uint64_t) {
    try {
      for (const CameraPosition& position : readWebcamFile(write(spoilt)).positions)
        for (const TipObservation& tip : position.tips)
          for (const double angle : tip.joints_rad) EXPECT_TRUE(std::isfinite(angle));
    } catch (const CalibrationError&) {
    }
  });
}

}  // namespace
}  // namespace calibration
