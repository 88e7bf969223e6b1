// `molar rehearse --assess`, practice blocks, `molar reference`: what a supervisor judges a hand by.
#include <algorithm>

#include <nlohmann/json.hpp>

#include "tests/app/commands/program.h"

namespace app {
namespace {

class AssessmentCommand : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    setenv("XDG_CACHE_HOME", MOLAR_TEST_CACHE, 1);
    setenv("MOLAR_CALIBRATION", at("store").c_str(), 1);
  }
  ProgramOutput rehearse(const std::string& more) {
    return molar("rehearse --headless --pace fast --device scripted --size 96x64 " + more);
  }
  nlohmann::json metrics(const std::string& file, const std::string& more = "") {
    const ProgramOutput said = molar("metrics " + at(file) + " --json " + more);
    EXPECT_EQ(said.status, 0) << said.err;
    return nlohmann::json::parse(said.out);
  }
  static nlohmann::json measure(const nlohmann::json& metrics, const std::string& id) {
    for (const nlohmann::json& one : metrics.at("measures"))
      if (one.at("id") == id) return one;
    ADD_FAILURE() << id;
    return {};
  }
};

TEST_F(AssessmentCommand, AnAssessmentSaysSoAndRefusesUndo) {
  const std::string hand = write("hand.csv",
                                 "t_s,px_mm,py_mm,pz_mm,qw,qx,qy,qz,drill,action\n"
                                 "0,0,0,5,1,0,0,0,0,\n"
                                 "0.5,0,0,-0.5,1,0,0,0,1,\n"
                                 "1.0,0,0,5,1,0,0,0,0,undo\n"
                                 "1.5,0,0,5,1,0,0,0,0,layer:plan\n"
                                 "2.0,0,0,5,1,0,0,0,0,\n");
  const auto run = [&](const std::string& more) {
    return molar("rehearse --headless --pace fast --case block-groove --device poses:" + hand + " " + more);
  };
  ASSERT_EQ(run("--assess --record " + at("a.molar")).status, 0);
  ASSERT_EQ(run("--record " + at("b.molar")).status, 0);
  const nlohmann::json assessed = metrics("a.molar"), free = metrics("b.molar");
  EXPECT_EQ(assessed.at("assessed"), true);
  EXPECT_EQ(assessed.at("help_refused"), 2);
  EXPECT_EQ(assessed.at("returned_mm3"), 0.0);
  EXPECT_GT(assessed.at("removed_mm3").get<double>(), 0.01);
  EXPECT_EQ(free.at("assessed"), false);
  EXPECT_EQ(free.at("help_refused"), 0);
  EXPECT_GT(free.at("returned_mm3").get<double>(), 0.01);
}

TEST_F(AssessmentCommand, WhatContradictsAnAssessmentIsRefusedInOneLine) {
  for (const char* more :
       {"--coach on", "--clearance view", "--clearance sound", "--procedure coronectomy --guidance guided",
        "--no-record", "--continue last", "--layers plan", "--procedure third-molar"}) {
    const ProgramOutput said = rehearse(std::string("--assess ") + more);
    EXPECT_EQ(said.status, 2) << more;
    EXPECT_TRUE(said.err.starts_with("molar: --assess: ")) << said.err;
    EXPECT_EQ(std::ranges::count(said.err, '\n'), 1) << said.err;
  }
}

TEST_F(AssessmentCommand, APracticeBlockIsMeasuredAgainstItsTarget) {
  const std::string list = molar("rehearse --cases").out;
  for (const char* block : {"block-plate", "block-groove", "block-ball"}) {
    EXPECT_NE(list.find(block), std::string::npos);
    const std::string file = std::string(block) + ".molar";
    const ProgramOutput said = rehearse(std::string("--voxel 0.3 --case ") + block + " --record " + at(file));
    ASSERT_EQ(said.status, 0) << said.err;
    const nlohmann::json told = metrics(file);
    EXPECT_GT(measure(told, "O2.plan").at("value").get<double>(), 0.55) << block;
    EXPECT_GT(measure(told, "O3.dice").at("value").get<double>(), 0.7) << block;
    EXPECT_LT(measure(told, "O3.over").at("value").get<double>(), 5.0) << block;
    EXPECT_LT(measure(told, "S7").at("value").get<double>(), 0.3) << block << " is cut in sight, but for its near wall";
  }
  const nlohmann::json plate = metrics("block-plate.molar"), ball = metrics("block-ball.molar");
  EXPECT_NEAR(measure(plate, "B.plate_mean").at("value").get<double>(), 1.3, 0.35);
  EXPECT_EQ(measure(plate, "B.plate_through").at("value"), 0.0);
  EXPECT_GT(measure(ball, "B.ball_bare").at("value").get<double>(), 0.7);
  EXPECT_LT(measure(ball, "B.ball_cut").at("value").get<double>(), 0.2) << "grazed in coarse voxels at most";
  ASSERT_EQ(molar("report " + at("block-ball.molar") + " --out " + at("ball.html")).status, 0);
  EXPECT_NE(read("ball.html").find("practice block: a buried ball"), std::string::npos);
  EXPECT_EQ(rehearse("--case block-ball --flap closed").status, 2);
  EXPECT_EQ(molar("rehearse --headless --pace fast --device scripted --seconds 1 --continue " + at("block-ball.molar") +
                  " --record " + at("more.molar"))
                .status,
            0);
}

TEST_F(AssessmentCommand, RunsOfACaseAreAReferenceForOthers) {
  std::string files;
  for (const char* seconds : {"4", "5", "6"}) {
    const std::string file = at(std::string(seconds) + ".molar");
    ASSERT_EQ(rehearse(std::string("--case block-groove --seconds ") + seconds + " --record " + file).status, 0);
    files += " " + file;
  }
  const ProgramOutput made = molar("reference expert" + files);
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_EQ(molar("reference expert" + files).status, 2) << "not without --force";
  EXPECT_NE(molar("reference").out.find("expert"), std::string::npos);
  const nlohmann::json told = metrics("5.molar", "--reference expert");
  EXPECT_EQ(told.at("reference").at("runs"), 3);
  for (const nlohmann::json& score : told.at("reference").at("scores")) {
    if (score.at("id") != "M1.total") continue;
    EXPECT_NEAR(score.at("z").get<double>(), 0.0, 1e-6) << "the middle one";
    EXPECT_NEAR(score.at("median").get<double>(), 5.0, 0.01);
  }
  const std::string words = molar("metrics " + at("5.molar") + " --reference expert").out;
  EXPECT_LT(words.find("lingual plate broken through"), words.find("length of the work"));
  EXPECT_NE(words.find("conditions: "), std::string::npos);
  EXPECT_NE(molar("trend " + at("") + " --reference expert").out.find("as the set expert"), std::string::npos);
  ASSERT_EQ(molar("report " + at("5.molar") + " --reference expert --out " + at("r.html")).status, 0);
  EXPECT_NE(read("r.html").find("Against the reference"), std::string::npos);
  ASSERT_EQ(rehearse("--case block-plate --seconds 2 --record " + at("p.molar")).status, 0);
  const ProgramOutput other = molar("metrics " + at("p.molar") + " --reference expert");
  EXPECT_EQ(other.status, 2);
  EXPECT_NE(other.err.find("is of another case"), std::string::npos) << other.err;
  EXPECT_EQ(molar("metrics " + at("5.molar") + " --reference nobody").status, 2);
}

}  // namespace
}  // namespace app
