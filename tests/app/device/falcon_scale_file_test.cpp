#include "app/device/falcon_scale_file.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "app/text/usage_error.h"
#include "calibration/calibration_error.h"
#include "haptics/device/haptic_device.h"

namespace app {
namespace {

class FalconScaleFile : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::remove(path); }
  void TearDown() override { std::filesystem::remove(path); }
  void write(const std::string& text) { std::ofstream(path) << text; }
  void expectRefused(const std::string& text, const std::string& words) {
    write(text);
    try {
      readFalconScale(path);
      ADD_FAILURE() << "accepted: " << text;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  }
  const std::string path =
      (std::filesystem::temp_directory_path() /
       (std::string("molar_scale_") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".toml"))
          .string();
};

TEST_F(FalconScaleFile, ComesBackAsItWasWritten) {
  for (const haptics::FalconForceScale& scale :
       {haptics::FalconForceScale{12.3456789, 0.98, "FH000001"}, haptics::FalconForceScale{2.0, 10.0, ""}}) {
    writeFalconScale(path, scale, true);
    const haptics::FalconForceScale read = readFalconScale(path);
    EXPECT_NEAR(read.words_per_Nmm, scale.words_per_Nmm, 1e-7);
    EXPECT_DOUBLE_EQ(read.max_weighed_N, scale.max_weighed_N);
    EXPECT_EQ(read.serial, scale.serial);
    EXPECT_TRUE(read.isWeighed());
  }
}

TEST_F(FalconScaleFile, IsNotReplacedWithoutForce) {
  writeFalconScale(path, {10.0, 1.0, "A"}, false);
  EXPECT_THROW(writeFalconScale(path, {11.0, 1.0, "A"}, false), calibration::CalibrationError);
  EXPECT_EQ(readFalconScale(path).words_per_Nmm, 10.0);
}

TEST_F(FalconScaleFile, IsInTheSettingsFolderOfTheUser) {
  setenv("XDG_CONFIG_HOME", "/settings", 1);
  EXPECT_EQ(defaultFalconScaleFile(), "/settings/molar/falcon.toml");
  unsetenv("XDG_CONFIG_HOME");
  setenv("HOME", "/her", 1);
  EXPECT_EQ(defaultFalconScaleFile(), "/her/.config/molar/falcon.toml");
}

TEST_F(FalconScaleFile, RefusesImplausibleValues) {
  expectRefused("version = 2\nwords_per_Nmm = 10.0\nheaviest_N = 1.0\n", "version");
  expectRefused("words_per_Nmm = 10.0\nheaviest_N = 1.0\n", "version");
  expectRefused("version = 1\nwords_per_Nmm = 1000.0\nheaviest_N = 1.0\n", "words_per_Nmm");
  expectRefused("version = 1\nwords_per_Nmm = 10.0\nheaviest_N = 0.0\n", "heaviest_N");
  expectRefused("version = 1\nwords_per_Nmm = nan\nheaviest_N = 1.0\n", "words_per_Nmm");
  expectRefused("version = 1\nwords_per_Nmm = 10.0\nheaviest_N = 1.0\npeak_N = 9.0\n", "peak_N");
  expectRefused("not toml", "");
  EXPECT_THROW(writeFalconScale(path, {1000.0, 1.0, ""}, true), haptics::DeviceError);
}

TEST_F(FalconScaleFile, ASerialNumberThatCouldBreakTheFileIsLeftOut) {
  writeFalconScale(path, {10.0, 1.0, "A\"\nheaviest_N = 9"}, false);
  EXPECT_EQ(readFalconScale(path).serial, "");
  EXPECT_EQ(readFalconScale(path).max_weighed_N, 1.0);
}

}  // namespace
}  // namespace app
