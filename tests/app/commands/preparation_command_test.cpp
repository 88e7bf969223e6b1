// `molar rehearse --task preparation`: a tooth cut by poses, its measures, and what is refused.
#include <algorithm>
#include <sstream>

#include <fmt/core.h>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>

#include "app/session/session_reader.h"
#include "tests/app/commands/program.h"

namespace app {
namespace {

class PreparationCommand : public ProgramTest {
 protected:
  /// A premolar: the smallest crown.
  ProgramOutput prepare(const std::string& hand, const std::string& more) const {
    return molar("rehearse --task preparation --tooth 45 --headless --pace fast --tool cylinder:0.8,4 --device poses:" +
                 hand + " " + more);
  }
  assets::PreparedTooth toothOf(const std::string& session) const {
    return SessionReader(at(session)).about().setup.prepared.value();
  }
  /// From one place of the tooth's frame to another, the bur upright and turning.
  std::string stroke(const assets::ToothFrame& frame, const glm::dvec3& from_mm, const glm::dvec3& to_mm,
                     double mm_per_s) const {
    const glm::dquat turn(glm::dvec3(0.0, 0.0, 1.0), frame.axes_P[2]);
    std::string rows = "t_s,px_mm,py_mm,pz_mm,qw,qx,qy,qz,drill\n";
    const double length_s = glm::distance(from_mm, to_mm) / mm_per_s;
    for (int n = 0; n <= 200; ++n) {
      const glm::dvec3 p_P = frame.inP(glm::mix(from_mm, to_mm, n / 200.0));
      rows += fmt::format("{:.4f},{:.5f},{:.5f},{:.5f},{:.7f},{:.7f},{:.7f},{:.7f},1\n", n / 200.0 * length_s, p_P.x,
                          p_P.y, p_P.z, turn.w, turn.x, turn.y, turn.z);
    }
    return write("stroke.csv", rows);
  }
  /// What a scripted hand has made of the premolar.
  nlohmann::json scripted(const std::string& ideal) const {
    const ProgramOutput said =
        molar("rehearse --task preparation --tooth 45 --headless --pace fast --device scripted --ideal " + ideal +
              " --record " + at("s.molar"));
    EXPECT_EQ(said.status, 0) << said.err;
    return nlohmann::json::parse(molar("metrics " + at("s.molar") + " --json").out).at("preparation");
  }
  std::string farAway() const {
    return write("far.csv", "t_s,px_mm,py_mm,pz_mm,qw,qx,qy,qz,drill\n0,0,-300,0,1,0,0,0,0\n0.2,0,-300,0,1,0,0,0,0\n");
  }
};

TEST_F(PreparationCommand, TellsWhatACutHasComeTo) {
  ASSERT_EQ(prepare(farAway(), "--record " + at("far.molar")).status, 0);
  const assets::PreparedTooth tooth = toothOf("far.molar");
  EXPECT_EQ(tooth.fdi, 45);
  EXPECT_EQ(tooth.ideal, "crown:all-ceramic");
  const auto untouched = nlohmann::json::parse(molar("metrics " + at("far.molar") + " --json").out).at("preparation");
  EXPECT_EQ(untouched.at("P1_over_mm3").get<double>(), 0.0);
  EXPECT_NEAR(untouched.at("P1_under_mm3").get<double>(), untouched.at("P1_wanted_mm3").get<double>(), 1e-6);
  EXPECT_GT(untouched.at("P1_wanted_mm3").get<double>(), 30.0);
  EXPECT_EQ(untouched.at("P4_margin_missing_share").get<double>(), 1.0);

  // A groove across the biting surface from cheek to tongue.
  const std::string hand = stroke(tooth.frame, {0.0, 6.0, 7.5}, {0.0, -6.0, 7.5}, 1.0);
  const ProgramOutput said = prepare(hand, "--record " + at("s.molar"));
  ASSERT_EQ(said.status, 0) << said.err;
  const ProgramOutput replayed = molar("replay " + at("s.molar") + " --verify");
  EXPECT_EQ(replayed.status, 0) << replayed.out << replayed.err;
  const ProgramOutput measured = molar("metrics " + at("s.molar") + " --json --sections " + at("s.png"));
  ASSERT_EQ(measured.status, 0) << measured.err;
  const auto of = nlohmann::json::parse(measured.out).at("preparation");
  EXPECT_GT(of.at("enamel_mm3").get<double>(), 0.1);
  EXPECT_LT(of.at("P1_under_mm3").get<double>(), untouched.at("P1_under_mm3").get<double>() - 0.1);
  EXPECT_EQ(of.at("P7_neighbour_mm3").get<double>(), 0.0);
  EXPECT_EQ(of.at("pulp_open_mm2").get<double>(), 0.0);
  EXPECT_EQ(read("s.png").substr(1, 3), "PNG");
  EXPECT_NE(molar("metrics " + at("s.molar")).out.find("Preparation of tooth 45"), std::string::npos);

  const ProgramOutput reported = molar("report " + at("s.molar") + " --out " + at("s.html"));
  ASSERT_EQ(reported.status, 0) << reported.err;
  const std::string page = read("s.html");
  for (const char* words : {"<b>No</b>: Neighbour cut", "No wall is prepared", "Against the ideal"})
    EXPECT_NE(page.find(words), std::string::npos) << words;
  EXPECT_EQ(page.find("lingual plate"), std::string::npos) << "of an extraction";
}

TEST_F(PreparationCommand, AScriptedHandCutsACavityToItsIdeal) {
  const nlohmann::json of = scripted("class-1");
  const double wanted_mm3 = of.at("P1_wanted_mm3").get<double>();
  EXPECT_GT(wanted_mm3, 3.0);
  EXPECT_LT(of.at("P1_under_mm3").get<double>(), 0.1 * wanted_mm3);
  EXPECT_LT(of.at("P1_over_mm3").get<double>(), 0.05 * wanted_mm3);
  EXPECT_NEAR(of.at("P9_isthmus_mm").get<double>(), 1.5, 0.1);
  EXPECT_GT(of.at("P8_within_mm").at("0.2").get<double>(), 0.98);
}

TEST_F(PreparationCommand, AScriptedHandPreparesForACrownAndGrazesTheNeighboursAtMost) {
  const nlohmann::json of = scripted("crown:all-ceramic");
  const double wanted_mm3 = of.at("P1_wanted_mm3").get<double>();
  EXPECT_GT(wanted_mm3, 50.0);
  EXPECT_LT(of.at("P1_under_mm3").get<double>(), 0.05 * wanted_mm3);
  EXPECT_LT(of.at("P1_over_mm3").get<double>(), 0.02 * wanted_mm3);
  EXPECT_NEAR(of.at("P4_margin_mm").get<double>(), 1.0, 0.05);
  EXPECT_GT(of.at("P8_within_mm").at("0.2").get<double>(), 0.95);
  EXPECT_LT(of.at("P7_neighbour_mm3").get<double>(), 1.0);
}

TEST_F(PreparationCommand, OfTwoSessionsIsMeasuredFromTheIntactTooth) {
  ASSERT_EQ(prepare(farAway(), "--ideal class-1 --record " + at("far.molar")).status, 0);
  const assets::ToothFrame frame = toothOf("far.molar").frame;
  // Two grooves, in one go and in two.
  const auto groove = [&](double x_mm) { return stroke(frame, {x_mm, 3.0, 7.2}, {x_mm, -3.0, 7.2}, 2.0); };
  const auto goOn = [&](const std::string& from, const std::string& to, const std::string& hand) {
    return molar("rehearse --headless --pace fast --continue " + at(from) + " --record " + at(to) +
                 " --device poses:" + hand);
  };
  const auto measures = [&](const std::string& session) {
    return nlohmann::json::parse(molar("metrics " + at(session) + " --json").out).at("preparation");
  };
  ASSERT_EQ(prepare(groove(-0.5), "--ideal class-1 --record " + at("a.molar")).status, 0);
  const ProgramOutput said = goOn("a.molar", "b.molar", groove(0.5));
  ASSERT_EQ(said.status, 0) << said.err;
  std::string both = read("stroke.csv");
  {
    const std::string first = (groove(-0.5), read("stroke.csv")), second = (groove(0.5), read("stroke.csv"));
    both = first;
    std::istringstream rows(second);
    std::string row;
    std::getline(rows, row);
    while (std::getline(rows, row)) both += fmt::format("{:.4f}{}\n", 6.0 + std::stod(row), row.substr(row.find(',')));
  }
  ASSERT_EQ(prepare(write("both.csv", both), "--ideal class-1 --record " + at("one.molar")).status, 0);
  const nlohmann::json one = measures("one.molar"), two = measures("b.molar"), half = measures("a.molar");
  EXPECT_LT(one.at("P1_under_mm3").get<double>(), half.at("P1_under_mm3").get<double>() - 0.1);
  for (const char* key : {"P1_over_mm3", "P1_under_mm3", "P1_wanted_mm3", "enamel_mm3", "dentine_mm3"})
    EXPECT_NEAR(one.at(key).get<double>(), two.at(key).get<double>(), 0.02 * one.at("P1_wanted_mm3").get<double>())
        << key;
  for (const char* key :
       {"P2_mean_mm", "P2_rms_mm", "P2_too_high_mm", "P2_too_deep_mm", "P9_depth_mm", "P9_isthmus_mm"})
    EXPECT_NEAR(one.at(key).get<double>(), two.at(key).get<double>(), 0.03) << key;
  // Nothing more is done: the very same.
  ASSERT_EQ(goOn("b.molar", "c.molar", farAway()).status, 0);
  EXPECT_EQ(measures("c.molar"), two);
  const ProgramOutput bites = molar("replay " + at("c.molar") + " --bites");
  EXPECT_EQ(bites.status, 0) << bites.err;
  // A cavity that was cut to begin with counts, too.
  ASSERT_EQ(prepare(farAway(), "--ideal class-1 --cavity ready --record " + at("ready.molar")).status, 0);
  ASSERT_EQ(goOn("ready.molar", "on.molar", farAway()).status, 0);
  EXPECT_EQ(measures("on.molar"), measures("ready.molar"));
  EXPECT_GT(measures("on.molar").at("P9_depth_mm").get<double>(), 1.0);
}

TEST_F(PreparationCommand, ANeighbourThatIsCutIsTold) {
  ASSERT_EQ(prepare(farAway(), "--ideal class-1 --record " + at("far.molar")).status, 0);
  const assets::PreparedTooth tooth = toothOf("far.molar");
  EXPECT_EQ(tooth.ideal, "class-1");
  // Down between it and the tooth behind.
  const std::string hand = stroke(tooth.frame, {-3.9, 0.0, 12.0}, {-3.9, 0.0, 6.0}, 1.0);
  ASSERT_EQ(prepare(hand, "--ideal class-1 --record " + at("s.molar")).status, 0);
  const auto of = nlohmann::json::parse(molar("metrics " + at("s.molar") + " --json").out).at("preparation");
  EXPECT_GT(of.at("P7_neighbour_mm3").get<double>(), 0.05);
}

TEST_F(PreparationCommand, ABiteIsRecordedAndMarksAgain) {
  // On the intact tooth, and where the rest of the teeth meet first.
  const std::string hand = write("bite.csv",
                                 "t_s,px_mm,py_mm,pz_mm,qw,qx,qy,qz,drill,action\n0,0,-300,0,1,0,0,0,0,\n"
                                 "0.1,0,-300,0,1,0,0,0,0,bite\n0.3,0,-300,0,1,0,0,0,0,\n");
  const ProgramOutput said = prepare(
      hand, "--paper-um 100 --layers deviation,insertion --snapshot " + at("p.png") + " --record " + at("s.molar"));
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_NE(said.err.find("marks of 100 µm paper"), std::string::npos) << said.err;
  EXPECT_EQ(read("p_left.png").substr(1, 3), "PNG");

  const auto of = nlohmann::json::parse(molar("metrics " + at("s.molar") + " --json").out).at("preparation");
  ASSERT_EQ(of.at("bites").size(), 1u);
  const auto& bite = of.at("bites")[0];
  EXPECT_EQ(bite.at("antagonist"), "made");
  EXPECT_EQ(bite.at("paper_um"), 100.0);
  EXPECT_EQ(bite.at("high_spot_um"), 0.0);
  EXPECT_EQ(bite.at("clearance_um"), 0.0);
  EXPECT_GE(bite.at("contacts"), 3) << "an intact tooth rests as a tripod";
  EXPECT_GT(bite.at("mark_area_mm2"), 0.2);
  EXPECT_EQ(of.at("bite").at("marks"), bite.at("marks")) << "nothing was cut since";

  const ProgramOutput again = molar("replay " + at("s.molar") + " --bites");
  EXPECT_EQ(again.status, 0) << again.out << again.err;
  EXPECT_NE(again.out.find("the same: 100 µm paper on a made antagonist"), std::string::npos) << again.out;
  const std::string page = (molar("report " + at("s.molar") + " --out " + at("s.html")), read("s.html"));
  EXPECT_NE(page.find("was made from the tooth's own biting surface"), std::string::npos);
  EXPECT_NE(page.find("not how hard"), std::string::npos);
}

TEST_F(PreparationCommand, RefusesInOneLine) {
  const auto refused = [&](const std::string& arguments, const std::string& words) {
    const ProgramOutput said = molar("rehearse --headless " + arguments);
    EXPECT_EQ(said.status, 2) << arguments;
    EXPECT_NE(said.err.find(words), std::string::npos) << said.err;
    EXPECT_EQ(std::count(said.err.begin(), said.err.end(), '\n'), 1) << said.err;
  };
  refused("--task preparation --device poses:" + farAway(), "which tooth?");
  refused("--task preparation --tooth 45 --device scripted --tool round:1.2", "burs of its own");
  refused("--task preparation --tooth 45 --flap closed --device poses:" + farAway(), "is of an extraction");
  refused("--task preparation --tooth 11 --device poses:" + farAway(), "no such tooth");
  refused("--task preparation --tooth 45 --paper-um 0.5 --device poses:" + farAway(), "--paper-um");
  refused("--paper-um 40 --device poses:" + farAway(), "--task");
  refused("--task preparation --tooth 45 --ideal crown:wood --device poses:" + farAway(), "crown:wood");
}

}  // namespace
}  // namespace app
