// `molar rehearse --task root-canal`: a treatment from the open cavity to its measures, and what is refused.
#include <algorithm>

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
  EXPECT_NE(molar("metrics " + at("s.molar")).out.find("Root canals of tooth 45"), std::string::npos);

  // The same as a page, with the films of the tooth within its jaw.
  const ProgramOutput reported = molar("report " + at("s.molar") + " --out " + at("s.html"));
  ASSERT_EQ(reported.status, 0) << reported.err;
  const std::string page = read("s.html");
  for (const char* words : {"<b>No</b>: File separated", "E4 wall untouched", "Shape of each canal",
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
