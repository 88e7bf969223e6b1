// `molar teeth`: keys, table and refusals; canals are tested at tests/assets/synthetic/built_in_teeth_test.cpp and
// tests/assets/import/modelled_canals_test.cpp.
#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "assets/patient/patient_folder.h"
#include "tests/app/commands/program.h"

namespace app {
namespace {

class TeethCommand : public ProgramTest {
 protected:
  /// A round premolar, enamel over dentine with a pulp, and one without a pulp beside it.
  std::string patientWithTeeth() const {
    assets::Patient patient;
    patient.title = "two teeth";
    patient.ct.grid = {{50, 30, 90}, 0.3, {0.0, 0.0, 0.0}};
    const std::size_t voxels = patient.ct.grid.voxelCount();
    patient.ct.hounsfield.assign(voxels, -1000);
    patient.ct.label.assign(voxels, 0);
    patient.ct.solid.assign(voxels, 0);
    patient.ct.tooth.assign(voxels, 0);
    assets::forVoxels(patient.ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
      const glm::dvec3 p = patient.ct.grid.centre_P_mm(ijk);
      const bool first = p.x < 7.5;
      const double aside = std::hypot(p.x - (first ? 3.8 : 11.2), p.y - 4.5);
      if (p.z < 2.0 || p.z > 24.0 || aside > std::min(2.6, 0.8 + 0.2 * (p.z - 2.0))) return;
      assets::Tissue tissue = p.z > 16.5 && aside > 1.2 ? assets::Tissue::enamel : assets::Tissue::dentine;
      if (first && aside < 0.7 && p.z > 12.0 && p.z < 18.0) tissue = assets::Tissue::pulp;
      patient.ct.label[v] = static_cast<std::uint8_t>(tissue);
      patient.ct.solid[v] = 255;
      patient.ct.tooth[v] = first ? 45 : 44;
    });
    assets::savePatient(patient, at("patient"), false);
    return at("patient");
  }
};

TEST_F(TeethCommand, ListsTheCanalsOfABuiltInJaw) {
  const ProgramOutput said = molar("teeth --case usual --json");
  ASSERT_EQ(said.status, 0) << said.err;
  const auto teeth = nlohmann::json::parse(said.out).at("teeth");
  ASSERT_EQ(teeth.size(), 5U);
  EXPECT_EQ(teeth[2].at("fdi"), 46);
  EXPECT_EQ(teeth[2].at("name"), "lower right first molar");
  EXPECT_EQ(teeth[2].at("canals_are"), "built-in");
  ASSERT_EQ(teeth[2].at("canals").size(), 3U);
  const auto& canal = teeth[2].at("canals")[0];
  EXPECT_EQ(canal.at("name"), "mesiobuccal");
  EXPECT_NEAR(canal.at("smallest_width_mm").get<double>(), 0.28, 0.005);
  EXPECT_GT(canal.at("schneider_deg").get<double>(), 25.0);
  EXPECT_GT(canal.at("working_length_mm").get<double>(), canal.at("length_mm").get<double>());
  EXPECT_LT(canal.at("foramen_P_mm")[2].get<double>(), canal.at("orifice_P_mm")[2].get<double>());
  EXPECT_FALSE(canal.contains("least_dentine_mm"));
  EXPECT_EQ(teeth[3].at("canals")[1].at("joins"), "mesiobuccal");
  EXPECT_FALSE(teeth[4].at("remark").is_null());

  const ProgramOutput table = molar("teeth --case usual");
  EXPECT_EQ(table.status, 0) << table.err;
  EXPECT_NE(table.out.find("mesiolingual"), std::string::npos);
  EXPECT_EQ(std::ranges::count(table.out, '\n'), 12);
}

TEST_F(TeethCommand, MeasuresTheDentineOfOneToothAndDrawsItsSections) {
  const ProgramOutput said = molar("teeth --case usual --tooth 46 --json --sections " + at("s.png"));
  ASSERT_EQ(said.status, 0) << said.err;
  const auto teeth = nlohmann::json::parse(said.out).at("teeth");
  ASSERT_EQ(teeth.size(), 1U);
  for (const auto& canal : teeth[0].at("canals")) {
    EXPECT_GT(canal.at("least_dentine_mm").get<double>(), 0.5);
    EXPECT_LT(canal.at("least_dentine_mm").get<double>(), 1.2);
  }
  EXPECT_EQ(read("s.png").substr(1, 3), "PNG");
  expectRefusal("teeth --case usual --tooth 46 --sections " + at("s.png"), "--force");
}

TEST_F(TeethCommand, ModelsCanalsIntoAScanAndSaysWhyNot) {
  const std::string patient = patientWithTeeth();
  const ProgramOutput said = molar("teeth " + patient + " --json");
  ASSERT_EQ(said.status, 0) << said.err;
  const auto teeth = nlohmann::json::parse(said.out).at("teeth");
  ASSERT_EQ(teeth.size(), 2U);
  EXPECT_EQ(teeth[0].at("fdi"), 44);
  EXPECT_TRUE(teeth[0].at("canals_are").is_null());
  EXPECT_NE(teeth[0].at("remark").get<std::string>().find("no pulp is labelled"), std::string::npos);
  EXPECT_EQ(teeth[1].at("canals_are"), "modelled");
  ASSERT_EQ(teeth[1].at("canals").size(), 1U);
  EXPECT_NEAR(teeth[1].at("canals")[0].at("length_mm").get<double>(), 12.0, 1.5);
  // Straight down the middle, bent at the end alone.
  EXPECT_LT(teeth[1].at("canals")[0].at("schneider_deg").get<double>(), 25.0);
  const ProgramOutput table = molar("teeth " + patient);
  EXPECT_NE(table.out.find("modelled"), std::string::npos);
  EXPECT_NE(table.out.find("no pulp is labelled"), std::string::npos);
  expectRefusal("teeth " + patient + " --tooth 44", "no pulp is labelled");
  const ProgramOutput one = molar("teeth " + patient + " --tooth 45 --sections " + at("t.png"));
  EXPECT_EQ(one.status, 0) << one.err;
}

TEST_F(TeethCommand, RefusesInOneLine) {
  expectRefusal("teeth", "exactly one");
  expectRefusal("teeth --case no-such", "no-such");
  expectRefusal("teeth " + at("missing"), "missing");
  expectRefusal("teeth --case usual --tooth 36", "no tooth 36");
  expectRefusal("teeth --case usual --sections " + at("s.png"), "--tooth");
  expectRefusal("teeth --case usual --tooth 46 --sections " + at("s.jpg"), ".png");
  EXPECT_FALSE(std::filesystem::exists(at("s.png")));
}

}  // namespace
}  // namespace app
