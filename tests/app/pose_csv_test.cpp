#include "app/pose_csv.h"

#include <filesystem>
#include <fstream>
#include <random>

#include <gtest/gtest.h>

#include "app/usage_error.h"

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
    try {
      readPoses(write(text));
    } catch (const UsageError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      return error.what();
    }
    return "accepted";
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

TEST_F(PoseCsv, NamesAMissingFile) { EXPECT_THROW(readPoses("/nonexistent/p.csv"), UsageError); }

TEST_F(PoseCsv, SurvivesRandomDamage) {
  const std::string good = std::string(kHeader) + "0,1,2,3,1,0,0,0\n0.001,1,2,3,1,0,0,0\n";
  std::mt19937 generator(5);
  for (int i = 0; i < 500; ++i) {
    std::string bad = good;
    for (int k = 0; k < 1 + i % 5; ++k) bad[generator() % bad.size()] = static_cast<char>(generator() % 256);
    refusal(bad);
  }
}

}  // namespace
}  // namespace app
