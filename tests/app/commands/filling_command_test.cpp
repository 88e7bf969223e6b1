// `molar rehearse --task preparation --cavity ready`: a cavity that is filled by poses, its measures, and what is
// refused.
#include <algorithm>

#include <fmt/core.h>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>

#include "app/session/session_reader.h"
#include "tests/app/commands/program.h"

namespace app {
namespace {

/// A hand in the frame of a tooth, its instrument upright.
struct FillingHand {
  assets::ToothFrame frame;
  std::string rows = "t_s,px_mm,py_mm,pz_mm,qw,qx,qy,qz,drill,tool\n";
  double t_s = 0.0;
  glm::dvec3 at_mm{0.0, 0.0, 14.0};

  void row(const glm::dvec3& p_mm, bool works, const std::string& tool) {
    const glm::dvec3 p_P = frame.inP(p_mm);
    const glm::dquat turn(glm::dvec3(0.0, 0.0, 1.0), frame.axes_P[2]);
    rows += fmt::format("{:.4f},{:.5f},{:.5f},{:.5f},{:.7f},{:.7f},{:.7f},{:.7f},{:d},{}\n", t_s, p_P.x, p_P.y, p_P.z,
                        turn.w, turn.x, turn.y, turn.z, works ? 1 : 0, tool);
  }
  void go(const glm::dvec3& to_mm, double seconds, bool works = false, const std::string& tool = "") {
    constexpr int kRows = 20;
    for (int n = 1; n <= kRows; ++n) {
      t_s += seconds / kRows;
      row(glm::mix(at_mm, to_mm, static_cast<double>(n) / kRows), works, n == 1 ? tool : "");
    }
    at_mm = to_mm;
  }
};

class FillingCommand : public ProgramTest {
 protected:
  ProgramOutput fill(const std::string& hand, const std::string& more) const {
    return molar("rehearse --task preparation --tooth 45 --ideal class-1 --cavity ready --headless --pace fast " +
                 more + " --device poses:" + hand);
  }
  nlohmann::json measuresOf(const std::string& session) const {
    return nlohmann::json::parse(molar("metrics " + at(session) + " --json").out).at("preparation");
  }
};

TEST_F(FillingCommand, TellsWhatAFillingHasComeToAndReplaysItBitForBit) {
  FillingHand away;
  away.frame.axes_P = glm::dmat3(1.0);
  away.go({0.0, 0.0, 200.0}, 0.2);
  ASSERT_EQ(fill(write("far.csv", away.rows), "--record " + at("far.molar")).status, 0);
  const nlohmann::json ready = measuresOf("far.molar");
  // Cut to its ideal, against the tooth as it was.
  EXPECT_NEAR(ready.at("P1_under_mm3").get<double>(), 0.0, 0.05);
  EXPECT_NEAR(ready.at("P1_over_mm3").get<double>(), 0.0, 0.05);
  EXPECT_GT(ready.at("P9_depth_mm").get<double>(), 1.0);
  EXPECT_FALSE(ready.contains("filling"));

  FillingHand hand;
  hand.frame = SessionReader(at("far.molar")).about().setup.prepared->frame;
  hand.go({0.0, 0.0, 9.0}, 0.3, false, "composite");
  for (const double height_mm : {3.0, 3.5, 4.0})  // the floor holds it off
    for (const double x_mm : {-1.2, 1.2}) hand.go({x_mm, 0.0, height_mm}, 0.35, true);
  hand.go({0.0, 0.0, 14.0}, 0.4);
  hand.go({0.0, 0.0, 4.5}, 0.4, false, "plugger");
  hand.go({0.8, 0.0, 4.5}, 0.4, true);
  hand.go({0.0, 0.0, 14.0}, 0.4);
  hand.go({0.0, 0.0, 10.5}, 0.3, false, "curing-lamp");
  hand.go({0.0, 0.0, 10.4}, 11.5, true);
  hand.go({0.0, 0.0, 14.0}, 0.3);
  hand.go({0.0, 0.0, 9.0}, 0.3, false, "composite");
  hand.go({0.3, 0.0, 4.0}, 0.4, true);
  hand.go({0.0, 0.0, 14.0}, 0.4);
  const ProgramOutput said = fill(write("hand.csv", hand.rows), "--record " + at("s.molar"));
  ASSERT_EQ(said.status, 0) << said.err;
  const ProgramOutput replayed = molar("replay " + at("s.molar") + " --verify");
  EXPECT_EQ(replayed.status, 0) << replayed.out << replayed.err;
  EXPECT_NE(replayed.out.find("bit-identical"), std::string::npos) << replayed.out << replayed.err;

  const nlohmann::json of = measuresOf("s.molar").at("filling");
  EXPECT_GT(of.at("F1_laid_mm3").get<double>(), 2.0);
  EXPECT_GT(of.at("F2_filled_share").get<double>(), 0.2);
  EXPECT_LE(of.at("F2_filled_share").get<double>(), 1.0);
  EXPECT_GT(of.at("F7_cured_share").get<double>(), 0.4);
  EXPECT_LT(of.at("F7_cured_share").get<double>(), 1.0);
  ASSERT_EQ(of.at("F6_increments").size(), 2U);
  EXPECT_GT(of.at("F1_materials_mm3").at("composite").get<double>(), 0.5);
  EXPECT_GT(of.at("F1_materials_mm3").at("composite_soft").get<double>(), 0.1);
  const ProgramOutput reported = molar("report " + at("s.molar") + " --out " + at("s.html"));
  ASSERT_EQ(reported.status, 0) << reported.err;
  EXPECT_NE(read("s.html").find("F2 share of the cavity filled"), std::string::npos);
  // Gone on with it cannot be.
  const ProgramOutput again =
      molar("rehearse --headless --device poses:" + at("far.csv") + " --continue " + at("s.molar"));
  EXPECT_EQ(again.status, 2);
  EXPECT_NE(again.err.find("its tooth was filled"), std::string::npos) << again.err;
}

TEST_F(FillingCommand, RefusesInOneLine) {
  const auto refused = [&](const std::string& arguments, const std::string& words) {
    const ProgramOutput said =
        molar("rehearse --headless --device poses:none.csv --task preparation --tooth 45 " + arguments);
    EXPECT_EQ(said.status, 2) << arguments;
    EXPECT_NE(said.err.find(words), std::string::npos) << said.err;
    EXPECT_EQ(std::count(said.err.begin(), said.err.end(), '\n'), 1) << said.err;
  };
  refused("--cavity ready", "no cavity by rule");
  refused("--cavity filled", "filled");
}

}  // namespace
}  // namespace app
