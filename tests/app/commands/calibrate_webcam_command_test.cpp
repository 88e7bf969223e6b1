#include <nlohmann/json.hpp>

#include "tests/app/commands/program.h"

namespace app {
namespace {

namespace fs = std::filesystem;

/// Real pictures of a chessboard of 9 x 6 corners, 13 of 640 x 480 (Debian package opencv-doc).
const fs::path kRealPictures = "/usr/share/doc/opencv-doc/examples/data";

class CalibrateLens : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    if (!fs::exists(kRealPictures / "left01.jpg")) GTEST_SKIP() << "no real pictures here: install opencv-doc";
    fs::create_directories(at("left"));
    for (int i = 1; i <= 14; ++i) {
      const std::string name = "left" + std::string(i < 10 ? "0" : "") + std::to_string(i) + ".jpg";
      if (fs::exists(kRealPictures / name)) fs::copy_file(kRealPictures / name, at("left/" + name));
    }
  }
  std::string lens() const { return "calibrate lens " + at("left") + " --board 9x6 --square-mm 25"; }
};

TEST_F(CalibrateLens, IsMeasuredOnRealImages) {
  const ProgramOutput said = molar(lens() + " --out " + at("camera.yaml") + " --name desk --json");
  const auto json = nlohmann::json::parse(said.out);
  EXPECT_EQ(said.status, json["verdict"] == "green" ? 0 : 1) << said.err;
  EXPECT_EQ(json["views"], 13);
  EXPECT_LE(json["rms_px"].get<double>(), 0.45);
  EXPECT_NEAR(json["focal_px"][0].get<double>(), 535.0, 10.0);
  EXPECT_NE(said.err.find("13 views used"), std::string::npos) << said.err;
  EXPECT_NE(read("camera.yaml").find("molar_camera"), std::string::npos);
  expectRefusal(lens() + " --out " + at("camera.yaml"), "--force");
}

TEST_F(CalibrateLens, NamesUnusableImages) {
  // A board that is not there is looked for long: two pictures are enough.
  for (int i = 3; i <= 14; ++i)
    fs::remove(at("left/left" + std::string(i < 10 ? "0" : "") + std::to_string(i) + ".jpg"));
  write("left/left20.jpg", "");
  expectRefusal(lens(), "left20.jpg");
  fs::remove(at("left/left20.jpg"));
  const ProgramOutput said = molar("calibrate lens " + at("left") + " --board 11x8");
  EXPECT_EQ(said.status, 2) << said.err;
  EXPECT_NE(said.err.find("left01.jpg"), std::string::npos) << said.err;
  expectRefusal("calibrate lens " + at("left") + " --board nine", "9x6");
  expectRefusal("calibrate lens " + at("none") + " --board 9x6", "check the path");
}

class CalibratePivot : public ProgramTest {
 protected:
  /// A unit of a kind that can be calibrated well, and a bur that is 5 mm longer and bent.
  void SetUp() override {
    ProgramTest::SetUp();
    ASSERT_EQ(molar(unit() + " --out " + at("jig.yaml")).status, 0);
    ASSERT_EQ(
        molar(unit() + " --method pivot12 --bur-mm 1,0.5,-5 --out " + at("pit.yaml") + " --held-out " + at("held.yaml"))
            .status,
        0);
    ASSERT_NE(molar("calibrate fit " + at("jig.yaml") + " --out " + at("rig.yaml")).status, 2);
  }
  static std::string unit() { return "calibrate simulate --scenario A --seed 3"; }
  double error_mm(const std::string& rig) const {
    return nlohmann::json::parse(
        molar("calibrate verify " + at(rig) + " " + at("held.yaml") + " --json").out)["tre_rms_mm"];
  }
};

TEST_F(CalibratePivot, FindsAnotherBur) {
  const ProgramOutput said = molar("calibrate pivot " + at("pit.yaml") + " --rig " + at("rig.yaml") +
                                   " --tip bur-7 --out " + at("new.yaml") + " --json");
  ASSERT_EQ(said.status, 0) << said.err;
  const auto json = nlohmann::json::parse(said.out);
  EXPECT_LT(json["rms_mm"], 0.3);
  EXPECT_GE(json["tilt_spread_deg"], 40.0);
  EXPECT_NE(said.err.find("the verification no longer holds"), std::string::npos) << said.err;
  EXPECT_NE(read("new.yaml").find("bur-7"), std::string::npos);
  EXPECT_GT(error_mm("rig.yaml"), 4.0);
  EXPECT_LT(error_mm("new.yaml"), 0.6);
}

TEST_F(CalibratePivot, IsRefusedWithAReason) {
  expectRefusal("calibrate pivot " + at("jig.yaml") + " --rig " + at("rig.yaml"), "the tip moved");
  expectRefusal("calibrate pivot " + at("pit.yaml") + " --out " + at("new.yaml"), "--rig");
  ASSERT_EQ(molar(unit() + " --method check4 --out " + at("four.yaml")).status, 0);
  expectRefusal("calibrate pivot " + at("four.yaml") + " --rig " + at("rig.yaml"), "too few");
  EXPECT_FALSE(fs::exists(at("new.yaml")));
}

}  // namespace
}  // namespace app
