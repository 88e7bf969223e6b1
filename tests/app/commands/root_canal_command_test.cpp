// `molar rehearse --task root-canal`: a treatment from the open cavity to its measures, and what is refused.
#include <algorithm>
#include <fstream>
#include <sstream>

#include <nlohmann/json.hpp>

#include "app/session/session_reader.h"
#include "tests/app/commands/program.h"

namespace app {
namespace {

class RootCanalCommand : public ProgramTest {
 protected:
  /// A premolar: one canal, the smallest volume.
  ProgramOutput treat(const std::string& more) const {
    return molar("rehearse --task root-canal --tooth 45 --headless " + more);
  }
};

TEST_F(RootCanalCommand, FilesACanalAndTellsWhatItHasComeTo) {
  const ProgramOutput said = treat("--access open --device scripted --pace fast --record " + at("s.molar"));
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_NE(said.out.find("lower right second premolar (45), root canals"), std::string::npos) << said.out;
  EXPECT_NE(said.out.find("mm³ filed"), std::string::npos) << said.out;

  // Every tick again, to the bit; the canals are in the session.
  const ProgramOutput replayed = molar("replay " + at("s.molar") + " --verify");
  EXPECT_EQ(replayed.status, 0) << replayed.out << replayed.err;
  ASSERT_TRUE(SessionReader(at("s.molar")).about().setup.canals);
  EXPECT_EQ(SessionReader(at("s.molar")).about().setup.canals->fdi, 45);

  const ProgramOutput measured = molar("metrics " + at("s.molar") + " --json --sections " + at("s.png"));
  ASSERT_EQ(measured.status, 0) << measured.err;
  const auto of = nlohmann::json::parse(measured.out).at("root_canals");
  EXPECT_EQ(of.at("fdi"), 45);
  EXPECT_EQ(of.at("gates").at("perforation"), false);
  EXPECT_EQ(of.at("gates").at("separated_file"), false);
  EXPECT_GT(of.at("access").at("roof_removed_share").get<double>(), 0.95) << "the cavity was open";
  EXPECT_EQ(of.at("access").at("floor_gouged_mm3").get<double>(), 0.0);
  const auto& canal = of.at("canals")[0];
  EXPECT_GE(canal.at("size").get<int>(), 15);
  EXPECT_GT(canal.at("E1_removed_mm3").get<double>(), 0.0005);
  EXPECT_NEAR(canal.at("E1_removed_mm3").get<double>(), of.at("files").at("filed_mm3").get<double>(), 0.0005);
  EXPECT_GT(canal.at("E4_untouched_share").get<double>(), 0.3);
  EXPECT_NEAR(canal.at("E7_most_over_mm").get<double>(), 0.0, 0.05);
  EXPECT_EQ(read("s.png").substr(1, 3), "PNG");
  // Then its cone: to length, hardly a void, nothing beyond the foramen.
  EXPECT_NE(said.err.find("a cone stays, seared off at the orifice"), std::string::npos) << said.err;
  const auto& filling = canal.at("filling");
  EXPECT_EQ(filling.at("length"), "right") << filling;
  EXPECT_NEAR(filling.at("end_mm").get<double>(), 0.0, 0.5);
  EXPECT_GT(filling.at("filled_share").get<double>(), 0.6) << filling;
  EXPECT_LE(filling.at("filled_share").get<double>(), 1.02) << filling;
  EXPECT_LT(filling.at("extruded_mm3").get<double>(), 0.05);
  EXPECT_NE(molar("metrics " + at("s.molar")).out.find("Root canals of tooth 45"), std::string::npos);

  // It is there when it is gone on with.
  const ProgramOutput next = molar("rehearse --continue " + at("s.molar") +
                                   " --headless --device scripted --pace fast --seconds 2 --record " + at("t.molar"));
  ASSERT_EQ(next.status, 0) << next.err;
  const ProgramOutput again = molar("metrics " + at("t.molar") + " --json");
  const auto kept = nlohmann::json::parse(again.out).at("root_canals").at("canals")[0].at("filling");
  EXPECT_NEAR(kept.at("filled_mm3").get<double>(), filling.at("filled_mm3").get<double>(), 1e-6);
  EXPECT_EQ(molar("replay " + at("t.molar") + " --verify").status, 0);

  // The same as a page, with the films of the tooth within its jaw.
  const ProgramOutput reported = molar("report " + at("s.molar") + " --out " + at("s.html"));
  ASSERT_EQ(reported.status, 0) << reported.err;
  const std::string page = read("s.html");
  for (const char* words : {"<b>No</b>: File separated", "E4 wall untouched", "Shape of each canal", "Root filling",
                            "tube 20° to distal: before, after", "within the jaw"})
    EXPECT_NE(page.find(words), std::string::npos) << words;
  EXPECT_EQ(page.find("lingual plate"), std::string::npos) << "of an extraction";
}

TEST_F(RootCanalCommand, DrillsTheAccessItselfAndFilesByCounters) {
  const ProgramOutput said = treat("--device scripted --pace fast --wear counters --record " + at("s.molar"));
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_EQ(molar("replay " + at("s.molar") + " --verify").status, 0);
  const ProgramOutput measured = molar("metrics " + at("s.molar") + " --json");
  ASSERT_EQ(measured.status, 0) << measured.err;
  const auto of = nlohmann::json::parse(measured.out).at("root_canals");
  const auto& access = of.at("access");
  EXPECT_GT(access.at("roof_removed_share").get<double>(), 0.9);
  EXPECT_GT(access.at("enamel_lost_mm3").get<double>(), 1.0);
  EXPECT_LT(access.at("floor_gouged_mm3").get<double>(), 0.05);
  EXPECT_EQ(of.at("gates").at("perforation"), false);
  EXPECT_EQ(of.at("files").at("wear_law"), "counters");
  EXPECT_GT(of.at("files").at("filed_mm3").get<double>(), 0.0);
  EXPECT_GT(of.at("files").at("motion_s").at("filing").get<double>(), 1.0);
}

TEST_F(RootCanalCommand, GoesOnWhereItEnded) {
  ASSERT_EQ(treat("--access open --device scripted --pace fast --seconds 12 --record " + at("s.molar")).status, 0);
  const ProgramOutput said = molar("rehearse --continue " + at("s.molar") +
                                   " --headless --device scripted --pace fast --seconds 3 --record " + at("t.molar"));
  ASSERT_EQ(said.status, 0) << said.err;
  const StoredStart before = SessionReader(at("s.molar")).start();
  const auto left = SessionReader(at("s.molar")).finalBone(before);
  ASSERT_TRUE(left);
  EXPECT_NE(left->solid, before.solid) << "it was filed";
  EXPECT_EQ(SessionReader(at("t.molar")).start().solid, left->solid);
}

/// A hand that jams a file in the first canal of a session's tooth and turns it for `turned_s`, as poses of a CSV.
std::string jamming(const assets::ToothCanals& tooth, const std::string& tool, double turned_s) {
  const assets::ToothCanal& canal = tooth.canals.front();
  const glm::dvec3 orifice = canal.places.front().p_P_mm, up = glm::normalize(orifice - canal.places[12].p_P_mm);
  const glm::dquat along = glm::dquat(glm::dvec3(0.0, 0.0, 1.0), up);
  std::ostringstream rows;
  rows << "t_s,px_mm,py_mm,pz_mm,qw,qx,qy,qz,tool\n";
  double t_s = 0.0;
  const auto add = [&](double deep_mm, double turned_rad, double for_s) {
    const glm::dvec3 p = orifice + (25.0 - deep_mm) * up;
    const glm::dquat q = along * glm::angleAxis(-turned_rad, glm::dvec3(0.0, 0.0, 1.0));
    for (const double value : {t_s, p.x, p.y, p.z, q.w, q.x, q.y, q.z}) rows << value << ',';
    rows << tool << '\n';
    t_s += for_s;
  };
  for (int n = 0; n < 100; ++n) add(-10.0, 0.0, 0.002);
  for (double deep_mm = -10.0; deep_mm < 16.0; deep_mm += 0.04) add(deep_mm, 0.0, 0.002);
  for (double turned = 0.0; turned < turned_s; turned += 0.004) add(16.0, 30.0 * turned, 0.004);
  return rows.str();
}

TEST_F(RootCanalCommand, WhatABrokenFileLeavesIsInTheToothFromThenOn) {
  ASSERT_EQ(treat("--access open --device scripted --pace fast --seconds 0.1 --record " + at("s.molar")).status, 0);
  const assets::ToothCanals tooth = *SessionReader(at("s.molar")).about().setup.canals;
  std::ofstream(at("p.csv")) << jamming(tooth, "k-file:40", 1.2);
  const std::string hand = " --pace fast --tool sphere:0.5 --tool k-file:40,25 --device poses:" + at("p.csv");
  const ProgramOutput said = treat("--access open --record " + at("b.molar") + hand);
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_NE(said.err.find("the file has broken"), std::string::npos) << said.err;
  EXPECT_NE(said.out.find("of a #40 in the single canal"), std::string::npos) << said.out;
  EXPECT_EQ(molar("replay " + at("b.molar") + " --verify").status, 0);

  const auto files_of = [&](const char* session) {
    const ProgramOutput measured = molar("metrics " + at(session) + " --json");
    EXPECT_EQ(measured.status, 0) << measured.err;
    return nlohmann::json::parse(measured.out).at("root_canals").at("files");
  };
  const auto files = files_of("b.molar");
  ASSERT_EQ(files.at("fragments").size(), files.at("fragments_left").get<std::size_t>());
  ASSERT_GE(files.at("fragments").size(), 1u);
  EXPECT_EQ(files.at("fragments")[0].at("canal"), "single");
  EXPECT_EQ(files.at("fragments")[0].at("size"), 40);
  EXPECT_GT(files.at("fragments")[0].at("length_mm").get<double>(), 1.0);

  // On the film, and in the session that goes on.
  ASSERT_EQ(molar("radiograph --session " + at("s.molar") + " --tooth 45 --out " + at("s.png")).status, 0);
  ASSERT_EQ(molar("radiograph --session " + at("b.molar") + " --tooth 45 --out " + at("b.png")).status, 0);
  EXPECT_NE(read("s.png"), read("b.png"));
  const ProgramOutput next =
      molar("rehearse --continue " + at("b.molar") +
            " --headless --pace fast --seconds 1 --device poses:" + at("p.csv") + " --record " + at("c.molar"));
  ASSERT_EQ(next.status, 0) << next.err;
  EXPECT_EQ(SessionReader(at("c.molar")).about().setup.fragments.size(), files.at("fragments").size());
  EXPECT_EQ(files_of("c.molar").at("fragments"), files.at("fragments"));
  EXPECT_EQ(molar("replay " + at("c.molar") + " --verify").status, 0);
}

TEST_F(RootCanalCommand, RefusesInOneLine) {
  const auto refused = [&](const std::string& arguments, const std::string& words) {
    const ProgramOutput said = molar("rehearse --headless " + arguments);
    EXPECT_EQ(said.status, 2) << arguments;
    EXPECT_NE(said.err.find(words), std::string::npos) << said.err;
    EXPECT_EQ(std::count(said.err.begin(), said.err.end(), '\n'), 1) << said.err;
  };
  refused("--task root-canal --device scripted", "which tooth?");
  refused("--task root-canal --tooth 45 --device scripted --wear grinding", "counters-helical");
  refused("--task root-canal --tooth 45 --flap closed --device scripted --access open", "is of an extraction");
  refused("--task root-canal --tooth 45 --case block-ball --device scripted --access open", "has no tooth");
  refused("--task root-canal --tooth 45 --device scripted --tool round:1.2 --tool k-file:140,25", "widest orifice");
  refused("--task root-canal --tooth 11 --device scripted", "no such tooth");
  refused("--device scripted --tool round:1.0 --tool k-file:7,25", "no such file is made");
  refused("--device scripted --tool round:1.0 --tool k-file:25,25,bent:130", "0 to 90 degrees");
  refused("--device scripted --tool round:1.0 --tool k-file:25,x", "'x' is not understood");
  refused("--device scripted --tool round:1.0 --tool gp-cone:25,3", "no such cone is made");
  refused("--task root-canal --tooth 45 --access open --device scripted --tool round:1.2 --tool k-file:10,25",
          "it is not on the tray");
}

TEST_F(RootCanalCommand, ASessionOfAnotherOperationHasNoSections) {
  ASSERT_EQ(
      molar("rehearse --case block-ball --headless --device scripted --pace fast --seconds 1 --record " + at("b.molar"))
          .status,
      0);
  const ProgramOutput said = molar("metrics " + at("b.molar") + " --sections " + at("b.png"));
  EXPECT_EQ(said.status, 2);
  EXPECT_NE(said.err.find("no finished root-canal treatment"), std::string::npos) << said.err;
  EXPECT_FALSE(std::filesystem::exists(at("b.png")));
}

}  // namespace
}  // namespace app
