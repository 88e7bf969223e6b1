// `molar rehearse --task preparation`: a tooth cut by poses, its measures, and what is refused.
#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <sstream>

#include <fmt/core.h>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>

#include "app/session/session_reader.h"
#include "assets/tissue.h"
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
  // Splinters are left at the neighbours.
  EXPECT_GT(of.at("P8_within_mm").at("0.2").get<double>(), 0.85);
  EXPECT_LT(of.at("P7_neighbour_mm3").get<double>(), 0.05);
}

TEST_F(PreparationCommand, AScriptedHandGoesAfterAnIdealFromAFile) {
  // The cavity that a rule makes, as a file.
  ASSERT_EQ(scripted("class-1").at("ideal"), "class-1");
  ASSERT_EQ(molar("replay " + at("s.molar") + " --volume " + at("ideal.nrrd")).status, 0);
  std::filesystem::remove(at("s.molar"));
  const nlohmann::json of = scripted(at("ideal.nrrd"));
  EXPECT_EQ(of.at("ideal"), "file");
  EXPECT_GT(of.at("P8_within_mm").at("0.2").get<double>(), 0.95);
  // Cut twice by a stepping bur, along the ideal's own groove, which lies beside the fissure.
  EXPECT_NEAR(of.at("P9_isthmus_mm").get<double>(), 1.5, 0.15);
  EXPECT_GT(of.at("P9_depth_mm").get<double>(), 1.3);
}

TEST_F(PreparationCommand, APracticeBlockIsPreparedAndMeasured) {
  const std::string block = "rehearse --headless --pace fast --device scripted --record " + at("b.molar") + " --case ";
  const ProgramOutput said = molar(block + "block-slot --snapshot " + at("b.png"));
  ASSERT_EQ(said.status, 0) << said.err;
  const auto slot = nlohmann::json::parse(molar("metrics " + at("b.molar") + " --json").out).at("preparation");
  EXPECT_EQ(slot.at("ideal"), "class-1");
  EXPECT_NEAR(slot.at("P9_depth_mm").get<double>(), 2.0, 0.1);
  EXPECT_NEAR(slot.at("P9_isthmus_mm").get<double>(), 1.5, 0.1);
  EXPECT_GT(slot.at("P8_within_mm").at("0.2").get<double>(), 0.97);
  EXPECT_EQ(slot.at("P7_neighbour_mm3").get<double>(), 0.0);
  EXPECT_EQ(molar("replay " + at("b.molar") + " --verify").status, 0);
  const ProgramOutput reported = molar("report " + at("b.molar") + " --out " + at("b.html"));
  ASSERT_EQ(reported.status, 0) << reported.err;
  EXPECT_NE(read("b.html").find("Form of the cavity"), std::string::npos);
  // A session of a block is gone on with.
  const ProgramOutput further =
      molar("rehearse --headless --pace fast --no-record --continue " + at("b.molar") + " --device poses:" + farAway());
  EXPECT_EQ(further.status, 0) << further.err;
  EXPECT_NE(molar("rehearse --cases").out.find("block-stump"), std::string::npos);
}

/// A plane over a tooth, where its frame stands: two faces.
std::string planeOver(const assets::ToothFrame& frame, double level_mm, double half_mm) {
  std::string bytes(80, ' ');
  const auto put = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  const auto corner = [&](int x, int y) { return glm::vec3(frame.inP({half_mm * x, half_mm * y, level_mm})); };
  put(std::uint32_t{2});
  for (const auto& face : {std::array{corner(-1, -1), corner(1, -1), corner(1, 1)},
                           std::array{corner(-1, -1), corner(1, 1), corner(-1, 1)}}) {
    put(glm::vec3(0.0F));
    for (const glm::vec3& p : face) put(p);
    put(std::uint16_t{0});
  }
  return bytes;
}

TEST_F(PreparationCommand, ABiteOnTeethFromAFileNeedsItNoMore) {
  ASSERT_EQ(prepare(farAway(), "--record " + at("far.molar")).status, 0);
  const assets::PreparedTooth tooth = toothOf("far.molar");
  const StoredStart start = SessionReader(at("far.molar")).start();
  double top_mm = 0.0;
  assets::forVoxels(start.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (assets::isToothPart(start.label[v]) && start.solid[v] >= 128)
      top_mm = std::max(top_mm, tooth.frame.local(start.grid.centre_P_mm(ijk)).z);
  });
  const std::string file = write("upper_of_Jones.stl", planeOver(tooth.frame, top_mm - 0.2, 25.0));
  const std::string hand = write("bite.csv",
                                 "t_s,px_mm,py_mm,pz_mm,qw,qx,qy,qz,drill,action\n0,0,-300,0,1,0,0,0,0,\n"
                                 "0.1,0,-300,0,1,0,0,0,0,bite\n0.3,0,-300,0,1,0,0,0,0,\n");
  const ProgramOutput said = prepare(hand, "--antagonist " + file + " --record " + at("s.molar"));
  ASSERT_EQ(said.status, 0) << said.err;
  std::filesystem::remove(file);
  const auto of = nlohmann::json::parse(molar("metrics " + at("s.molar") + " --json").out).at("preparation");
  const auto& bite = of.at("bites")[0];
  EXPECT_EQ(bite.at("antagonist"), "scanned");
  EXPECT_EQ(bite.at("closing"), "hinge") << "as broad as an arch";
  EXPECT_NEAR(bite.at("high_spot_um").get<double>(), 200.0, 60.0);
  EXPECT_EQ(bite.at("contacts"), 1);
  EXPECT_EQ(of.at("bite").at("marks"), bite.at("marks")) << "measured without the file";
  EXPECT_EQ(of.at("antagonist_sha256").get<std::string>().size(), 64u);
  EXPECT_EQ(read("s.molar").find("Jones"), std::string::npos);
  const ProgramOutput again = molar("replay " + at("s.molar") + " --bites");
  EXPECT_NE(again.out.find("the same: 40 µm paper, closing about the hinge"), std::string::npos) << again.out;
  const std::string page = (molar("report " + at("s.molar") + " --out " + at("s.html")), read("s.html"));
  EXPECT_NE(page.find("about the hinge of the condyles"), std::string::npos);
  // On the tooth's own form it rests as a tripod.
  ASSERT_EQ(prepare(hand, "--bite balance --record " + at("t.molar")).status, 0);
  const auto rests = nlohmann::json::parse(molar("metrics " + at("t.molar") + " --json").out).at("preparation");
  EXPECT_EQ(rests.at("bites")[0].at("closing"), "balance");
  EXPECT_TRUE(rests.at("bites")[0].at("balanced").get<bool>());
}

TEST_F(PreparationCommand, OfTwoSessionsIsMeasuredFromTheIntactTooth) {
  const auto measures = [&](const std::string& session) {
    return nlohmann::json::parse(molar("metrics " + at(session) + " --json").out).at("preparation");
  };
  const auto goOn = [&](const std::string& from, const std::string& to, const std::string& hand) {
    const ProgramOutput said = molar("rehearse --headless --pace fast --continue " + at(from) + " --record " + at(to) +
                                     " --device poses:" + hand);
    EXPECT_EQ(said.status, 0) << said.err;
  };
  // A cavity that was cut to begin with counts; nothing more is done: the very same.
  ASSERT_EQ(prepare(farAway(), "--ideal class-1 --cavity ready --record " + at("ready.molar")).status, 0);
  goOn("ready.molar", "on.molar", farAway());
  const nlohmann::json ready = measures("ready.molar");
  EXPECT_EQ(measures("on.molar"), ready);
  EXPECT_GT(ready.at("P9_depth_mm").get<double>(), 1.0);
  const ProgramOutput bites = molar("replay " + at("on.molar") + " --bites");
  EXPECT_EQ(bites.status, 0) << bites.err;

  // Two grooves, in one go and in two.
  const assets::ToothFrame frame = toothOf("ready.molar").frame;
  const glm::dquat turn(glm::dvec3(0.0, 0.0, 1.0), frame.axes_P[2]);
  const auto groove = [&](double x_mm, double from_s) {
    std::string rows;
    const auto row = [&](double t_s, const glm::dvec3& p_mm) {
      const glm::dvec3 p_P = frame.inP(p_mm);
      rows += fmt::format("{:.4f},{:.5f},{:.5f},{:.5f},{:.7f},{:.7f},{:.7f},{:.7f},1\n", from_s + t_s, p_P.x, p_P.y,
                          p_P.z, turn.w, turn.x, turn.y, turn.z);
    };
    row(0.0, {x_mm, 6.0, 14.0});
    row(0.5, {x_mm, 6.0, 7.5});
    row(3.5, {x_mm, -6.0, 7.5});
    row(4.0, {x_mm, -6.0, 14.0});
    return rows;
  };
  const std::string head = "t_s,px_mm,py_mm,pz_mm,qw,qx,qy,qz,drill\n";
  const std::string a = write("a.csv", head + groove(-0.5, 0.0)), b = write("b.csv", head + groove(0.5, 0.0));
  ASSERT_EQ(prepare(a, "--ideal class-1 --record " + at("a.molar")).status, 0);
  goOn("a.molar", "b.molar", b);
  const std::string both = write("both.csv", head + groove(-0.5, 0.0) + groove(0.5, 4.5));
  ASSERT_EQ(prepare(both, "--ideal class-1 --record " + at("one.molar")).status, 0);
  const nlohmann::json one = measures("one.molar"), two = measures("b.molar");
  EXPECT_GT(one.at("enamel_mm3").get<double>(), 1.0);
  for (const char* key : {"P1_over_mm3", "P1_under_mm3", "P1_wanted_mm3", "enamel_mm3", "dentine_mm3"})
    EXPECT_NEAR(one.at(key).get<double>(), two.at(key).get<double>(), 0.03 * one.at("P1_wanted_mm3").get<double>())
        << key;
  for (const char* key : {"P2_mean_mm", "P2_rms_mm", "P2_too_deep_mm", "P9_depth_mm", "P9_isthmus_mm"})
    EXPECT_NEAR(one.at(key).get<double>(), two.at(key).get<double>(), 0.02) << key;
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
  refused("--task preparation --tooth 45 --flap closed --device poses:" + farAway(), "is of an extraction");
  refused("--task preparation --tooth 11 --device poses:" + farAway(), "no such tooth");
  refused("--task preparation --tooth 45 --paper-um 0.5 --device poses:" + farAway(), "--paper-um");
  refused("--task preparation --tooth 45 --antagonist /nowhere.stl --device poses:" + farAway(), "/nowhere.stl");
  refused("--task preparation --tooth 45 --hinge 5,x --device poses:" + farAway(), "--hinge 5,x");
  refused("--task preparation --tooth 45 --bite sideways --device poses:" + farAway(), "--bite");
  refused("--case block-slot --task preparation --tooth 45 --device poses:" + farAway(), "a tooth of its own");
  refused("--case block-slot --task root-canal --tooth 46 --device poses:" + farAway(), "no canals");
  refused("--paper-um 40 --device poses:" + farAway(), "--task");
  refused("--task preparation --tooth 45 --ideal crown:wood --device poses:" + farAway(), "crown:wood");
}

}  // namespace
}  // namespace app
