// `molar clearance`: against all labelled voxels, and refusals; the structures are tested at
// tests/app/case/risk_structures_test.cpp.
#include <sstream>

#include <nlohmann/json.hpp>

#include "app/session/session_reader.h"
#include "assets/patient/patient_folder.h"
#include "tests/app/case/block_with_risks.h"
#include "tests/app/commands/program.h"
#include "tests/haptics/structure_phantom.h"

namespace app {
namespace {

using haptics::phantom::ToolPose;

class ClearanceCommand : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    std::string csv = "t_s,px_mm,py_mm,pz_mm,qw,qx,qy,qz\n";
    std::mt19937 random(5);
    for (int n = 0; n < 1000; ++n) {
      ToolPose X_PT = haptics::phantom::randomPose(random, 16.0);
      X_PT.translation_mm += glm::dvec3(-20.0, 36.0, -8.0);
      poses_.push_back(X_PT);
      const glm::dvec3& p = X_PT.translation_mm;
      const glm::dquat& q = X_PT.rotation;
      std::ostringstream row;
      row.precision(17);
      row << 0.001 * n << ',' << p.x << ',' << p.y << ',' << p.z << ',' << q.w << ',' << q.x << ',' << q.y << ','
          << q.z;
      csv += row.str() + "\n";
    }
    write("p.csv", csv);
  }

  std::vector<std::string> rows(const std::string& name) const {
    std::istringstream text(read(name));
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
  }

  std::vector<ToolPose> poses_;
};

TEST_F(ClearanceCommand, OfEveryShapeIsThatOfAllVoxels) {
  const assets::Patient patient = test::blockWithRisks();
  assets::savePatient(patient, at("patient"), false);
  haptics::phantom::VoxelStructure canal{patient.ct.grid, {}, {}}, second{patient.ct.grid, {}, {}};
  assets::forVoxels(patient.ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (patient.ct.label[v] == 7) canal.voxels_P_mm.push_back(patient.ct.grid.centre_P_mm(ijk));
    if (patient.ct.tooth[v] == 47) second.voxels_P_mm.push_back(patient.ct.grid.centre_P_mm(ijk));
  });
  using haptics::ShapeKind;
  const std::vector<std::pair<std::string, haptics::BurShape>> heads{{"sphere:1.5", {ShapeKind::sphere, 1.5, 0.0}},
                                                                     {"capsule:1,4", {ShapeKind::capsule, 1.0, 4.0}},
                                                                     {"cylinder:2,5", {ShapeKind::cylinder, 2.0, 5.0}},
                                                                     {"cone:1.5,6", {ShapeKind::cone, 1.5, 6.0}}};
  for (const auto& [name, head] : heads) {
    const ProgramOutput said = molar("clearance " + at("patient") + " --tool " + name + " --poses " + at("p.csv") +
                                     " --out " + at("f.csv") + " --force");
    ASSERT_EQ(said.status, 0) << said.err;
    const std::vector<std::string> lines = rows("f.csv");
    ASSERT_EQ(lines.size(), poses_.size() + 1);
    EXPECT_EQ(lines.front(), "t_s,canal_mm,lingual_mm,second_molar_mm");
    for (std::size_t n = 0; n < poses_.size(); ++n) {
      double t_s = 0.0, canal_mm = 0.0, lingual_mm = 0.0, second_mm = 0.0;
      ASSERT_EQ(std::sscanf(lines[n + 1].c_str(), "%lf,%lf,%lf,%lf", &t_s, &canal_mm, &lingual_mm, &second_mm), 4);
      for (const auto& [found_mm, of] : {std::pair{canal_mm, &canal}, std::pair{second_mm, &second}}) {
        const double slow_mm = haptics::phantom::slowClearance_mm(*of, head, poses_[n]);
        const bool touches = slow_mm < 0.0;
        if (touches) {
          EXPECT_LT(found_mm, 0.25) << name;
        } else if (found_mm > 0.0) {
          EXPECT_NEAR(found_mm, slow_mm, 0.25) << name;
        }
      }
    }
  }
}

TEST_F(ClearanceCommand, LeavesEmptyWhatACaseDoesNotHave) {
  assets::Patient patient = test::blockWithRisks();
  patient.ct.tooth.clear();
  patient.site.reset();
  assets::savePatient(patient, at("patient"), false);
  ASSERT_EQ(
      molar("clearance " + at("patient") + " --tool round:2 --poses " + at("p.csv") + " --out " + at("f.csv")).status,
      0);
  const std::string row = rows("f.csv").at(1);
  EXPECT_EQ(row.substr(row.size() - 2), ",,");
  EXPECT_NE(row.substr(0, 3), "0,,");
}

/// Live, from the recording, and by the command on the poses of the recording's moment.
TEST_F(ClearanceCommand, OfARehearsalIsTheSameLiveAndMeasured) {
  const ProgramOutput said =
      molar("rehearse --headless --voxel 0.5 --device scripted --pace fast --seconds 12 --record " + at("s.molar"));
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_NE(said.out.find("came as near as"), std::string::npos) << said.out;
  nlohmann::json live;
  for (const SessionEvent& event : SessionReader(at("s.molar")).events())
    if (event.kind == "clearance") live = nlohmann::json::parse(event.text);
  ASSERT_TRUE(live.is_object());
  const ProgramOutput measured = molar("metrics " + at("s.molar") + " --json");
  ASSERT_EQ(measured.status, 0) << measured.err;
  const auto measures = nlohmann::json::parse(measured.out).at("measures");
  for (const char* key : {"canal", "lingual", "second_molar", "lingual_nerve"}) {
    const auto measure = std::ranges::find_if(
        measures, [&](const nlohmann::json& one) { return one.at("id") == "S1." + std::string(key); });
    ASSERT_NE(measure, measures.end()) << key;
    ASSERT_TRUE(live.contains(key)) << key;
    EXPECT_EQ(measure->at("value"), live.at(key).at("mm")) << key;
    EXPECT_EQ(measure->at("t_s"), live.at(key).at("t_s")) << key;
    EXPECT_NE(measure->at("conditions").get<std::string>().find("0.5 mm"), std::string::npos) << key;
  }
}

TEST_F(ClearanceCommand, RefusesInOneLineAndWritesNothing) {
  assets::savePatient(test::blockWithRisks(), at("patient"), false);
  const std::string patient = "clearance " + at("patient"), poses = " --poses " + at("p.csv"),
                    out = " --out " + at("f.csv");
  expectRefusal("clearance --tool round:2" + poses + out, "exactly one");
  expectRefusal(patient + " --case usual --tool round:2" + poses + out, "exactly one");
  expectRefusal("clearance " + at("missing") + " --tool round:2" + poses + out, "missing");
  expectRefusal(patient + " --tool cube:2" + poses + out, "cube");
  expectRefusal(patient + " --tool round:2 --poses " + at("none.csv") + out, "none.csv");
  expectRefusal(patient + " --tool round:2 --out " + at("f.csv") + " --poses " +
                    write("bad.csv", "t_s,px_mm,py_mm,pz_mm,qw,qx,qy,qz\n0,0,0,zero,1,0,0,0\n"),
                "line 2");
  expectRefusal(patient + " --tool round:2" + poses + " --out " + at("p.csv"), "p.csv");
  EXPECT_FALSE(std::filesystem::exists(at("f.csv")));
}

}  // namespace
}  // namespace app
