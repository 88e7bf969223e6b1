#include "calibration/record/rig_file.h"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/mutants.h"
#include "tests/refusal.h"

namespace calibration {
namespace {

class RigFile : public testing::Test {
 protected:
  std::string path_ = (std::filesystem::path(testing::TempDir()) /
                       (std::string("rig_") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".yaml"))
                          .string();
  void TearDown() override { std::filesystem::remove(path_); }

  std::string write(const std::string& text) {
    std::ofstream(path_) << text;
    return path_;
  }
  std::string refusal(const std::string& text) {
    return tests::refusalOf<CalibrationError>([&] { readRig(write(text)); });
  }
  static std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  }
};

Rig mirroredRig() {
  Rig rig = desktopRig({1920, 1080});
  rig.mirror = Plane<World>{glm::normalize(glm::dvec3(0, 1, 1)), 12.5};
  for (Point<World>* p : {&rig.screen.lower_left, &rig.screen.lower_right, &rig.screen.upper_left})
    *p = rig.mirror->reflect(*p);
  rig.X_WP = {glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, 2, 3))), {4, 5, 6}};
  return rig;
}

TEST_F(RigFile, ReadsBackWhatItWrites) {
  const Rig rig = mirroredRig();
  const Rig back = readRig(write(rigText(rig)));
  EXPECT_EQ(back.screen.px, rig.screen.px);
  EXPECT_LT(glm::distance(back.screen.upper_left.mm, rig.screen.upper_left.mm), 1e-9);
  EXPECT_LT(glm::distance(back.right_eye.mm, rig.right_eye.mm), 1e-9);
  EXPECT_LT(glm::distance(back.X_WP.translation_mm, rig.X_WP.translation_mm), 1e-9);
  EXPECT_LT(glm::distance((back.X_WP * Point<Patient>{{10, 20, 30}}).mm, (rig.X_WP * Point<Patient>{{10, 20, 30}}).mm),
            1e-6);
  ASSERT_TRUE(back.mirror.has_value());
  EXPECT_NEAR(back.mirror->offset_mm, 12.5, 1e-9);
}

TEST_F(RigFile, HoldsThePoseOfASecondDeviceWhereThereIsOne) {
  Rig rig = mirroredRig();
  EXPECT_FALSE(readRig(write(rigText(rig))).second_X_WD);
  rig.second_X_WD = {glm::angleAxis(0.4, glm::normalize(glm::dvec3(3, 1, 2))), {-150, 20, 30}};
  const Rig back = readRig(write(rigText(rig)));
  ASSERT_TRUE(back.second_X_WD);
  EXPECT_LT(glm::distance((*back.second_X_WD * Point<Device>{{1, 2, 3}}).mm,
                          (*rig.second_X_WD * Point<Device>{{1, 2, 3}}).mm),
            1e-9);
  std::string text = rigText(rig);
  text.replace(text.find("X_WD2:"), text.size(), "X_WD2: [ 1, 2, 3 ]\n");
  EXPECT_THROW(readRig(write(text)), CalibrationError);
}

TEST_F(RigFile, ScalesOffsetWithAnUnnormalisedMirrorNormal) {
  std::string text = rigText(mirroredRig());
  const auto at = text.find("normal:");
  text.replace(at, text.find(']', at) + 1 - at, "normal: [ 0., 2., 2. ]");
  const Rig rig = readRig(write(text));
  EXPECT_NEAR(rig.mirror->offset_mm, 12.5 / std::sqrt(8.0), 1e-9);
}

TEST_F(RigFile, RefusesWhatIsNotARig) {
  const std::string good = rigText(mirroredRig());
  EXPECT_NE(refusal(""), "accepted");
  EXPECT_NE(refusal("hello"), "accepted");
  EXPECT_NE(refusal(replaced(good, "molar_rig", "other")), "accepted");
  EXPECT_NE(refusal(replaced(good, "schema: 1", "schema: 2")), "accepted");
  EXPECT_NE(refusal(replaced(good, "1920, 1080", "1920, -5")), "accepted");
  EXPECT_NE(refusal(replaced(good, "1920, 1080", "19.5, 100")), "accepted");
  EXPECT_NE(refusal(replaced(good, "  left_mm: [ -3.15", "  left_mm: [ .Nan, -3.15")), "accepted");
  EXPECT_NE(refusal(replaced(good, "present: 1", "present: yes")), "accepted");
  EXPECT_NE(refusal(good.substr(0, good.size() / 2)), "accepted");
  EXPECT_NE(refusal(replaced(good, "X_WD", "X_WE")), "accepted");
}

TEST_F(RigFile, ReadsAMatrixWrittenAsRows) {
  std::string text = rigText(desktopRig({1920, 1080}));
  text = text.substr(0, text.find("X_WP")) +
         "X_WP: [ [1,0,0,7], [0,1,0,8], [0,0,1,9], [0,0,0,1] ]\nX_WD: [ 1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1 ]\n";
  EXPECT_EQ(readRig(write(text)).X_WP.translation_mm, glm::dvec3(7, 8, 9));
}

TEST_F(RigFile, RefusesAPoseThatScalesOrFlips) {
  Rig rig = mirroredRig();
  rig.X_WP = {};
  const std::string good = rigText(rig);
  const std::string data = "data: [ 1., 0., 0., 0., 0., 1.";
  EXPECT_NE(refusal(replaced(good, data, "data: [ 2., 0., 0., 0., 0., 1.")), "accepted");
  EXPECT_NE(refusal(replaced(good, data, "data: [ -1., 0., 0., 0., 0., 1.")), "accepted");
}

TEST_F(RigFile, RefusesAMatrixOfAnotherSizeWithoutAllocating) {
  const std::string good = rigText(mirroredRig());
  for (const char* rows : {"rows: 3", "rows: -4", "rows: 2000000000", "rows: four"})
    EXPECT_THAT(refusal(replaced(good, "rows: 4", rows)), testing::HasSubstr("4x4")) << rows;
}

TEST_F(RigFile, RefusesAnEyeOnTheScreen) {
  Rig rig = desktopRig({1920, 1080});
  rig.left_eye.mm.z = 0.0;
  EXPECT_NE(refusal(rigText(rig)), "accepted");
}

TEST_F(RigFile, SurvivesRandomDamage) {
  mutants::forEachMutant({rigText(mirroredRig())}, 400,
                         [&](const std::string& bad, std::size_t, std::uint64_t) { refusal(bad); });
}

TEST_F(RigFile, NamesAMissingFile) {
  try {
    readRig("/nonexistent/rig.yaml");
    FAIL();
  } catch (const CalibrationError& error) {
    EXPECT_NE(std::string(error.what()).find("/nonexistent/rig.yaml"), std::string::npos);
  }
}

}  // namespace
}  // namespace calibration
