// `molar import --tooth`: a single tooth becomes a patient that is inspected, prepared and treated; bad files are
// refused in a line. Ideals from files and caries, as their user gives them.
#include <algorithm>
#include <filesystem>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "app/session/session_reader.h"
#include "tests/app/commands/program.h"
#include "tests/assets/density_tooth.h"

namespace app {
namespace {

class ToothImportCommand : public ProgramTest {
 protected:
  std::string tooth(const density_tooth::Form& form = {}) const {
    return write("Mueller_1961.nrrd", density_tooth::nrrd(density_tooth::usualScan(0.2), form));
  }
  ProgramOutput imported(const std::string& file, const std::string& more = "") const {
    return molar("import --tooth " + file + " --out " + at("patient") + " " + more);
  }
  std::string farAway() const {
    return write("far.csv", "t_s,px_mm,py_mm,pz_mm,qw,qx,qy,qz,drill\n0,0,-300,0,1,0,0,0,0\n0.2,0,-300,0,1,0,0,0,0\n");
  }
  ProgramOutput prepare(const std::string& more) const {
    return molar("rehearse " + at("patient") + " --task preparation --tooth 46 --headless --pace fast --device poses:" +
                 farAway() + " --record " + at("s.molar") + " --force " + more);
  }
  nlohmann::json measures(const std::string& session = "s.molar") const {
    const ProgramOutput said = molar("metrics " + at(session) + " --json");
    EXPECT_EQ(said.status, 0) << said.err;
    return nlohmann::json::parse(said.out).at("preparation");
  }
  void expectRefused(const ProgramOutput& said, const std::string& words) const {
    EXPECT_EQ(said.status, 2) << said.err;
    EXPECT_NE(said.err.find(words), std::string::npos) << said.err;
    EXPECT_EQ(std::count(said.err.begin(), said.err.end(), '\n'), 1) << said.err;
  }
};

TEST_F(ToothImportCommand, ASingleToothIsInspectedPreparedAndTreated) {
  const ProgramOutput said = imported(tooth());
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_NE(said.err.find("levels judged"), std::string::npos) << said.err;
  const auto inspected = nlohmann::json::parse(molar("inspect " + at("patient") + " --json").out);
  EXPECT_NEAR(inspected.at("tissue_mm3").at("enamel").get<double>(), 115.0, 50.0);
  EXPECT_GT(inspected.at("tissue_mm3").at("other_teeth").get<double>(), 50.0) << "its neighbours";
  // Nothing of the file's name.
  for (const auto& entry : std::filesystem::directory_iterator(at("patient"))) {
    const std::string bytes = read("patient/" + entry.path().filename().string());
    EXPECT_EQ(bytes.find("Mueller"), std::string::npos) << entry.path();
    EXPECT_EQ(bytes.find("1961"), std::string::npos) << entry.path();
  }
  ASSERT_EQ(prepare("").status, 0);
  const auto crown = measures();
  EXPECT_EQ(crown.at("fdi"), 46);
  EXPECT_GT(crown.at("P1_wanted_mm3").get<double>(), 80.0);
  EXPECT_EQ(crown.at("P7_neighbour_mm3").get<double>(), 0.0);
  const ProgramOutput replayed = molar("replay " + at("s.molar") + " --verify");
  EXPECT_EQ(replayed.status, 0) << replayed.out << replayed.err;
  const ProgramOutput seen = molar("see --patient " + at("patient") + " --size 160x120 --out " + at("p.png"));
  EXPECT_EQ(seen.status, 0) << seen.err;
  const ProgramOutput treated =
      molar("rehearse " + at("patient") +
            " --task root-canal --tooth 46 --headless --pace fast --no-record --device poses:" + farAway());
  EXPECT_EQ(treated.status, 0) << treated.err;
}

TEST_F(ToothImportCommand, AToothWithoutPulpIsPreparedAndNotTreated) {
  ASSERT_EQ(imported(tooth({.has_pulp = false})).status, 0);
  const ProgramOutput said = prepare("--ideal class-1");
  EXPECT_EQ(said.status, 0) << said.err;
  expectRefused(
      molar("rehearse " + at("patient") + " --task root-canal --tooth 46 --headless --device poses:" + farAway()),
      "no pulp");
}

TEST_F(ToothImportCommand, RefusesInOneLine) {
  const std::string good = tooth();
  std::string bytes = density_tooth::nrrd(density_tooth::usualScan(0.25));
  std::fill(bytes.begin() + static_cast<long>(bytes.find("\n\n")) + 2, bytes.end(), '\x96');
  expectRefused(imported(write("one.nrrd", bytes)), "every voxel is 150");
  expectRefused(imported(good, "--tooth-number 16"), "stands upside down");
  expectRefused(imported(good, "--tooth-number 19"), "no tooth of adults");
  expectRefused(imported(good, "--levels 0,100,150"), "--levels");
  expectRefused(molar("import " + good + " --tooth " + good + " --out " + at("patient")), "without SOURCE");
  expectRefused(molar("import --out " + at("patient")), "SOURCE");
  expectRefused(imported(at("nothing.nrrd")), "nothing.nrrd");
  EXPECT_FALSE(std::filesystem::exists(at("patient")));
  // Upside down it is an upper one, turned.
  const ProgramOutput turned = imported(good, "--tooth-number 16 --upright");
  EXPECT_EQ(turned.status, 0) << turned.err;
  EXPECT_NE(turned.err.find("was turned"), std::string::npos) << turned.err;
}

TEST_F(ToothImportCommand, ATeachersPreparationIsTheIdealOfOthers) {
  ASSERT_EQ(imported(tooth()).status, 0);
  ASSERT_EQ(prepare("").status, 0);
  const assets::PreparedTooth prepared = SessionReader(at("s.molar")).about().setup.prepared.value();
  // The teacher cuts a groove across the biting surface.
  std::string rows = "t_s,px_mm,py_mm,pz_mm,qw,qx,qy,qz,drill\n";
  for (int n = 0; n <= 100; ++n) {
    const glm::dvec3 p_P = prepared.frame.inP({0.0, 6.0 - 0.12 * n, 4.8});
    rows += fmt::format("{:.3f},{:.4f},{:.4f},{:.4f},1,0,0,0,1\n", 0.08 * n, p_P.x, p_P.y, p_P.z);
  }
  const std::string teacher =
      "rehearse " + at("patient") +
      " --task preparation --tooth 46 --headless --pace fast --tool cylinder:0.8,4 --device poses:" +
      write("teacher.csv", rows) + " --record " + at("teacher.molar");
  ASSERT_EQ(molar(teacher).status, 0);
  const ProgramOutput exported = molar("replay " + at("teacher.molar") + " --volume " + at("teacher.nrrd"));
  ASSERT_EQ(exported.status, 0) << exported.err;

  const ProgramOutput said = prepare("--ideal " + at("teacher.nrrd"));
  ASSERT_EQ(said.status, 0) << said.err;
  std::filesystem::remove(at("teacher.nrrd"));
  const auto untouched = measures();
  EXPECT_EQ(untouched.at("ideal"), "file");
  EXPECT_EQ(untouched.at("ideal_sha256").get<std::string>().size(), 64u);
  const double wanted_mm3 = untouched.at("P1_wanted_mm3").get<double>();
  EXPECT_GT(wanted_mm3, 3.0);
  EXPECT_NEAR(untouched.at("P1_under_mm3").get<double>(), wanted_mm3, 1e-6);
  EXPECT_EQ(read("s.molar").find("teacher"), std::string::npos) << "the file's name is not kept";
  const ProgramOutput reported = molar("report " + at("s.molar") + " --out " + at("s.html"));
  ASSERT_EQ(reported.status, 0) << reported.err;
  EXPECT_NE(read("s.html").find("an ideal from a file"), std::string::npos);
  const ProgramOutput replayed = molar("replay " + at("s.molar") + " --verify");
  EXPECT_EQ(replayed.status, 0) << replayed.out << replayed.err;
  expectRefused(prepare("--ideal " + at("nothing.stl")), "nothing.stl");
}

TEST_F(ToothImportCommand, CariesIsPlacedAndMeasured) {
  ASSERT_EQ(imported(tooth()).status, 0);
  for (const char* place : {"occlusal", "mesial", "distal"}) {
    const ProgramOutput said = prepare(std::string("--caries ") + place);
    ASSERT_EQ(said.status, 0) << said.err;
    const auto of = measures();
    const auto& caries = of.at("caries");
    EXPECT_EQ(caries.at("place"), place);
    EXPECT_GT(caries.at("soft_mm3").get<double>(), 0.5) << place;
    EXPECT_GT(caries.at("firm_mm3").get<double>(), 1.0) << place;
    EXPECT_EQ(caries.at("soft_left_mm3"), caries.at("soft_mm3"));
    EXPECT_EQ(caries.at("sound_cut_mm3").get<double>(), 0.0);
    EXPECT_EQ(of.at("ideal"), std::string(place) == "occlusal" ? "class-1" : "class-2:" + std::string(place));
  }
  EXPECT_EQ(molar("replay " + at("s.molar") + " --verify").status, 0);
  EXPECT_NE(molar("metrics " + at("s.molar")).out.find("caries: soft"), std::string::npos);
  const ProgramOutput reported = molar("report " + at("s.molar") + " --out " + at("s.html"));
  ASSERT_EQ(reported.status, 0) << reported.err;
  EXPECT_NE(read("s.html").find("Soft caries left"), std::string::npos);
  expectRefused(prepare("--caries buccal"), "--caries");
}

}  // namespace
}  // namespace app
