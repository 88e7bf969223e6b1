#include "calibration/webcam/camera_file.h"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/mutants.h"
#include "tests/refusal.h"

namespace calibration {
namespace {

using testing::HasSubstr;

class CameraFile : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(path_); }
  std::string write(const std::string& text) {
    std::ofstream(path_, std::ios::binary) << text;
    return path_;
  }
  std::string refusal(const std::string& text) {
    return tests::refusalOf<CalibrationError>([&] { readCamera(write(text)); });
  }
  static std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  }

  std::string path_ =
      (std::filesystem::path(testing::TempDir()) /
       (std::string("camera_") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".yaml"))
          .string();
  CameraRecord record_{{{1280, 720}, {930.25, 931.5}, {644.0, 355.125}, 0.05, -0.1, 0.0006, -0.0004},
                       "Webcam Pro",
                       "A1B2C3",
                       "2026-11-22T08:20:00Z",
                       0.1875,
                       13};
};

TEST_F(CameraFile, ReadsBackWhatItWrites) {
  const CameraRecord back = readCamera(write(cameraText(record_)));
  EXPECT_EQ(back.camera.size_px, record_.camera.size_px);
  EXPECT_EQ(back.camera.focal_px, record_.camera.focal_px);
  EXPECT_EQ(back.camera.centre_px, record_.camera.centre_px);
  EXPECT_EQ(back.camera.k1, record_.camera.k1);
  EXPECT_EQ(back.camera.k2, record_.camera.k2);
  EXPECT_EQ(back.camera.p1, record_.camera.p1);
  EXPECT_EQ(back.camera.p2, record_.camera.p2);
  EXPECT_EQ(back.name, record_.name);
  EXPECT_EQ(back.serial, record_.serial);
  EXPECT_EQ(back.measured_utc, record_.measured_utc);
  EXPECT_EQ(back.rms_px, record_.rms_px);
  EXPECT_EQ(back.views, record_.views);
  record_.serial.clear();
  EXPECT_EQ(readCamera(write(cameraText(record_))).serial, "");
}

TEST_F(CameraFile, NamesWhatIsWrong) {
  const std::string good = cameraText(record_);
  EXPECT_THAT(refusal(replaced(good, "molar_camera", "molar_rig")), HasSubstr("not a camera file"));
  EXPECT_THAT(refusal(replaced(good, "schema: 1", "schema: 2")), HasSubstr("schema"));
  EXPECT_THAT(refusal(replaced(good, "[ 1280, 720 ]", "[ 1280, 7.5 ]")), HasSubstr("size_px"));
  EXPECT_THAT(refusal(replaced(good, "[ 1280, 720 ]", "[ 1280 ]")), HasSubstr("size_px"));
  EXPECT_THAT(refusal(replaced(good, "9.3025000000000000e+02", ".Nan")), HasSubstr("focal_px"));
  EXPECT_THAT(refusal(replaced(good, "9.3025000000000000e+02", "-930")), HasSubstr("focal_px"));
  EXPECT_THAT(refusal(replaced(good, "644.", "2644.")), HasSubstr("centre_px"));
  EXPECT_THAT(refusal(replaced(good, "-1.0000000000000001e-01", "-100.")), HasSubstr("distortion"));
  EXPECT_THAT(refusal(replaced(good, "views: 13", "views: -1")), HasSubstr("views"));
  EXPECT_THAT(refusal(replaced(good, "name: ", "nome: ")), HasSubstr("name"));
  EXPECT_THAT(refusal(""), HasSubstr(path_));
  EXPECT_THROW(readCamera("/nowhere/camera.yaml"), CalibrationError);
}

TEST_F(CameraFile, SurvivesAnyDamage) {
  int accepted = 0;
  mutants::forEachMutant({cameraText(record_)}, 600, [&](const std::string& text, std::size_t, std::uint64_t) {
    try {
      const CameraRecord record = readCamera(write(text));
      ++accepted;
      EXPECT_GT(record.camera.focal_px.x, 0.0);
      EXPECT_TRUE(std::isfinite(record.camera.pixelOf({{1.0, 2.0, 100.0}}).x));
    } catch (const CalibrationError&) {
    }
  });
  EXPECT_GT(accepted, 0);
}

}  // namespace
}  // namespace calibration
