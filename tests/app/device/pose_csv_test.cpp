#include "app/device/pose_csv.h"

#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "app/text/usage_error.h"
#include "tests/mutants.h"
#include "tests/refusal.h"

namespace app {
namespace {

constexpr char kHeader[] = "t_s,px_mm,py_mm,pz_mm,qw,qx,qy,qz\n";

class PoseCsv : public testing::Test {
 protected:
  std::string path_ =
      testing::TempDir() + "poses_" + testing::UnitTest::GetInstance()->current_test_info()->name() + ".csv";
  void TearDown() override { std::filesystem::remove(path_); }
  std::string write(const std::string& text) {
    std::ofstream(path_, std::ios::binary) << text;
    return path_;
  }
  std::string refusal(const std::string& text) {
    return tests::refusalOf<UsageError>([&] { readPoses(write(text)); });
  }
};

TEST_F(PoseCsv, ReadsTimesPosesAndPedal) {
  const auto poses =
      readPoses(write("t_s,px_mm,py_mm,pz_mm,qw,qx,qy,qz,drill\r\n0,1,2,3,1,0,0,0,1\r\n0.5, 4,5,6,0,1,0,0,0\n"));
  ASSERT_EQ(poses.size(), 2u);
  EXPECT_EQ(poses[1].t_s, 0.5);
  EXPECT_EQ(poses[1].X_PT.translation_mm, glm::dvec3(4, 5, 6));
  EXPECT_EQ(poses[1].X_PT.rotation.x, 1.0);
  EXPECT_TRUE(poses[0].drill);
  EXPECT_FALSE(poses[1].drill);
}

TEST_F(PoseCsv, DrillsWhereThereIsNoDrillColumn) {
  EXPECT_TRUE(readPoses(write(std::string(kHeader) + "0,0,0,0,1,0,0,0\n"))[0].drill);
}

TEST_F(PoseCsv, RefusesWithLineAndColumn) {
  const std::string h = kHeader;
  EXPECT_NE(refusal(h + "0,0,0,0,1,0,0,0\n1,x,0,0,1,0,0,0\n").find("line 3: px_mm"), std::string::npos);
  EXPECT_NE(refusal(""), "accepted");
  EXPECT_NE(refusal(h), "accepted");
  EXPECT_NE(refusal("t,x,y,z\n0,0,0,0\n"), "accepted");
  EXPECT_NE(refusal(h + "0,0,0,0,1,0,0\n"), "accepted");
  EXPECT_NE(refusal(h + "0,0,0,0,1,0,0,0,1\n"), "accepted");
  EXPECT_NE(refusal(h + "0,nan,0,0,1,0,0,0\n"), "accepted");
  EXPECT_NE(refusal(h + "0,inf,0,0,1,0,0,0\n"), "accepted");
  EXPECT_NE(refusal(h + "0,1e300,0,0,1,0,0,0\n"), "accepted");
  EXPECT_NE(refusal(h + "0,0,0,0,2,0,0,0\n"), "accepted");
  EXPECT_NE(refusal(h + "0,0,0,0,0,0,0,0\n"), "accepted");
  EXPECT_NE(refusal(h + "1,0,0,0,1,0,0,0\n1,0,0,0,1,0,0,0\n"), "accepted");
  EXPECT_NE(refusal(h.substr(0, h.size() - 1) + ",drill\n0,0,0,0,1,0,0,0,0.5\n"), "accepted");
}

TEST_F(PoseCsv, ReadsRequestsAsWritten) {
  const auto poses =
      readPoses(write("t_s,px_mm,py_mm,pz_mm,qw,qx,qy,qz,drill,tool,action\n0,1,2,3,1,0,0,0,1,,\n0.5,4,5,6,0,1,0,0,0, "
                      "sphere:1 ,undo\n"));
  ASSERT_EQ(poses.size(), 2u);
  EXPECT_EQ(poses[0].tool + poses[0].action, "");
  EXPECT_EQ(poses[1].tool, "sphere:1");
  EXPECT_EQ(poses[1].action, "undo");
  EXPECT_EQ(lineOf("a.csv", poses[1]), "pose file a.csv line 3");
  const auto without_pedal = readPoses(write("t_s,px_mm,py_mm,pz_mm,qw,qx,qy,qz,action\n0,1,2,3,1,0,0,0,end\n"));
  EXPECT_EQ(without_pedal[0].action, "end");
  EXPECT_TRUE(without_pedal[0].drill);
}

TEST_F(PoseCsv, ReadsTheSecondButton) {
  const std::string h = "t_s,px_mm,py_mm,pz_mm,qw,qx,qy,qz,button\n";
  const auto poses = readPoses(write(h + "0,1,2,3,1,0,0,0,0\n1,1,2,3,1,0,0,0,1\n"));
  EXPECT_FALSE(poses[0].button);
  EXPECT_TRUE(poses[1].button);
  EXPECT_THROW(refuseControls(poses, "a.csv"), UsageError);
  EXPECT_NE(refusal(h + "0,1,2,3,1,0,0,0,2\n").find("button is not 0 or 1"), std::string::npos);
}

TEST_F(PoseCsv, RefusesColumnsItDoesNotKnowOrHasTwice) {
  const std::string h = "t_s,px_mm,py_mm,pz_mm,qw,qx,qy,qz";
  EXPECT_NE(refusal(h + ",colour\n0,0,0,0,1,0,0,0,red\n").find("line 1: there is no column \"colour\""),
            std::string::npos);
  EXPECT_NE(refusal(h + ",tool,tool\n0,0,0,0,1,0,0,0,1,1\n").find("column tool comes twice"), std::string::npos);
  EXPECT_NE(refusal("t_s,px_mm,py_mm,pz_mm,qw,qx,qy,action\n").find("column qz is missing"), std::string::npos);
}

TEST_F(PoseCsv, RefusesAPipeAndAFolderWithoutWaiting) {
  ASSERT_EQ(mkfifo(path_.c_str(), 0600), 0);
  EXPECT_THROW(readPoses(path_), UsageError);
  EXPECT_THROW(readPoses(testing::TempDir()), UsageError);
  EXPECT_THROW(readPoses("/dev/zero"), UsageError);
}

TEST_F(PoseCsv, RefusesALineWithoutEnd) {
  EXPECT_NE(refusal(std::string(kHeader) + std::string(100'000, '1')).find("longer"), std::string::npos);
}

TEST_F(PoseCsv, NamesTheRowWithARequestThatIsNotSupported) {
  const auto poses =
      readPoses(write("t_s,px_mm,py_mm,pz_mm,qw,qx,qy,qz,tool,action\n0,1,2,3,1,0,0,0,,\n1,1,2,3,1,0,0,0,,undo\n"));
  try {
    refuseControls(poses, "a.csv");
    ADD_FAILURE() << "accepted";
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("a.csv line 3"), std::string::npos) << error.what();
  }
  refuseControls({poses[0]}, "a.csv");
}

TEST_F(PoseCsv, NamesAMissingFile) { EXPECT_THROW(readPoses("/nonexistent/p.csv"), UsageError); }

TEST_F(PoseCsv, SurvivesRandomDamage) {
  const std::string good = std::string(kHeader) + "0,1,2,3,1,0,0,0\n0.001,1,2,3,1,0,0,0\n";
  mutants::forEachMutant({good}, 500, [&](const std::string& bad, std::size_t, std::uint64_t) { refusal(bad); });
}

}  // namespace
}  // namespace app
