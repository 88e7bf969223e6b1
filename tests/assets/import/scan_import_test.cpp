#include "assets/import/scan_import.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include <nlohmann/json.hpp>

#include "assets/image_file.h"
#include "assets/import/tissue_from_grey.h"
#include "assets/load_error.h"
#include "assets/patient_toml.h"
#include "assets/solid_fraction.h"
#include "tests/assets/scan_on_disk.h"

namespace {

using assets::importScan;
using assets::VolumeGrid;
using testing::HasSubstr;
using testing::Not;

std::string sharedData() {
  const char* shared = std::getenv("MOLAR_SHARED");
  return std::string(shared != nullptr ? shared : MOLAR_SHARED_DEFAULT) + "/data";
}

std::string refusalOf(const std::string& source) {
  try {
    importScan(source, {});
  } catch (const assets::LoadError& error) {
    EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
    return error.what();
  }
  return "accepted";
}

double distanceToLine(const std::vector<glm::dvec3>& line, const glm::dvec3& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s + 1 < line.size(); ++s) {
    const glm::dvec3 segment = line[s + 1] - line[s];
    const double t = glm::clamp(glm::dot(p - line[s], segment) / glm::dot(segment, segment), 0.0, 1.0);
    nearest = std::min(nearest, glm::distance(p, line[s] + t * segment));
  }
  return nearest;
}

class RealJaw : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::is_directory(folder_))
      GTEST_SKIP() << "NO SHARED DATA at " << folder_ << ": set MOLAR_SHARED";
  }
  const std::string folder_ = sharedData() + "/patients/right_third_molar";
};

TEST_F(RealJaw, HasItsThirdMolarAndCanalWhereTheTruthSays) {
  const auto truth = nlohmann::json::parse(on_disk::read(folder_ + "/truth.json"));
  const auto patient = importScan(folder_, {});
  EXPECT_EQ(patient.ct.grid.size, glm::ivec3(132, 169, 188));
  const auto pointOf = [&](const nlohmann::json& ijk) {
    return patient.ct.grid.origin_P_mm +
           0.4 * glm::dvec3(ijk[0].get<double>(), ijk[1].get<double>(), ijk[2].get<double>());
  };

  ASSERT_TRUE(patient.site.known);
  EXPECT_EQ(patient.site.tooth_fdi, 48);
  EXPECT_LT(glm::distance(patient.site.third_molar_P_mm, pointOf(truth["M3"]["centroid_ijk"])), 0.5);
  const auto crown = truth["M3"]["crown_dir_ijk"];
  const glm::dvec3 crown_P =
      glm::normalize(glm::dvec3(crown[0].get<double>(), crown[1].get<double>(), crown[2].get<double>()));
  EXPECT_GT(glm::dot(patient.site.crown_direction_P, crown_P), std::cos(15.0 * std::acos(-1.0) / 180.0));

  std::vector<glm::dvec3> canal;
  for (const auto& ijk : truth["canal_polyline_ijk"]) canal.push_back(pointOf(ijk));
  for (const auto& p : canal) EXPECT_LT(distanceToLine(patient.canal_P_mm, p), 1.0);
  for (const auto& p : patient.canal_P_mm)
    if (p.y > canal.front().y && p.y < canal.back().y) {
      EXPECT_LT(distanceToLine(canal, p), 1.0);
    }
  EXPECT_NEAR(patient.canal_radius_mm, 1.3, 0.2);
}

TEST_F(RealJaw, IsReadWithoutLabelsToo) {
  const auto patient = importScan(folder_ + "/ct.nrrd", {});
  EXPECT_FALSE(patient.site.known);
  EXPECT_TRUE(patient.canal_P_mm.empty());
  EXPECT_EQ(patient.ct.label, assets::labelsFromGrey(patient.ct.hounsfield));
  EXPECT_EQ(patient.ct.solid, assets::classify(patient.ct.grid, patient.ct.hounsfield, {}));
  const glm::dvec3 index = patient.ct.grid.indexFromPoint(patient.site.third_molar_P_mm);
  EXPECT_TRUE(glm::all(glm::greaterThan(index, glm::dvec3(0.0)))) << "in the volume";
  EXPECT_TRUE(glm::all(glm::lessThan(index, glm::dvec3(patient.ct.grid.size))));
}

void writeBlock(const std::string& path, const VolumeGrid& grid, std::int16_t hounsfield) {
  auto file = assets::nrrdOutput(path, true);
  assets::writeHounsfield(grid, std::vector<std::int16_t>(grid.voxelCount(), hounsfield), file);
}

void writeLabels(const std::string& path, const VolumeGrid& grid) {
  auto file = assets::nrrdOutput(path, true);
  assets::writeSolid(grid, std::vector<std::uint8_t>(grid.voxelCount(), 1), file);
}

const VolumeGrid kBlock{{12, 12, 12}, 0.5, {0, 0, 0}};

TEST(ScanImport, RefusesWhatItCanNotUse) {
  const on_disk::Folder folder;
  EXPECT_THAT(refusalOf(folder.at("none")), HasSubstr("no such scan"));
  EXPECT_THAT(refusalOf(folder.at("")), HasSubstr("no ct.nrrd"));
  on_disk::write(folder.at("slice"), std::string(128, '\0') + "DICM");
  EXPECT_THAT(refusalOf(folder.at("")), HasSubstr("DICOM is not read yet"));
  EXPECT_THAT(refusalOf(folder.at("slice")), HasSubstr("DICOM is not read yet"));
  writeBlock(folder.at("ct.nrrd"), kBlock, -1000);
  EXPECT_THAT(refusalOf(folder.at("")), HasSubstr("above 300 HU"));
  writeBlock(folder.at("ct.nrrd"), kBlock, 1000);
  EXPECT_EQ(refusalOf(folder.at("")), "accepted");
  VolumeGrid moved = kBlock;
  moved.origin_P_mm.z = 0.1;
  writeLabels(folder.at("labels.nrrd"), moved);
  EXPECT_THAT(refusalOf(folder.at("")), HasSubstr("labels.nrrd: its voxels do not lie"));
  writeLabels(folder.at("labels.nrrd"), kBlock);
  EXPECT_EQ(refusalOf(folder.at("")), "accepted");
  writeBlock(folder.at("ct2.nrrd"), kBlock, 1000);
  std::filesystem::rename(folder.at("ct2.nrrd"), folder.at("ct.nhdr"));
  EXPECT_THAT(refusalOf(folder.at("")), HasSubstr("more than one volume"));
}

TEST(ScanImport, KeepsNothingThatTellsWho) {
  const on_disk::Folder folder;
  on_disk::Scan scan{{12, 12, 12}, glm::dmat3(0.5), {0, 0, 0}};
  std::string bytes = on_disk::nrrd(scan, "short", on_disk::bytesOf(std::vector<std::int16_t>(1728, 1000)));
  bytes.insert(9, "# Jane Doe\ncontent: Jane Doe\nPatientName:=Jane Doe\n");
  on_disk::write(folder.at("jane_doe.nrrd"), bytes);
  const auto patient = importScan(folder.at("jane_doe.nrrd"), {});
  std::string words = assets::patientToml(patient);
  std::transform(words.begin(), words.end(), words.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  EXPECT_THAT(words, Not(HasSubstr("jane")));
}

TEST(TissueFromGrey, GoesByThresholds) {
  using assets::Tissue;
  using assets::tissueFromGrey;
  EXPECT_EQ(tissueFromGrey(2500), Tissue::enamel);
  EXPECT_EQ(tissueFromGrey(1650), Tissue::dentine);
  EXPECT_EQ(tissueFromGrey(1250), Tissue::cortical);
  EXPECT_EQ(tissueFromGrey(420), Tissue::trabecular);
  EXPECT_EQ(tissueFromGrey(60), Tissue::unlabelled);
  EXPECT_EQ(tissueFromGrey(-1000), Tissue::unlabelled);
}

}  // namespace
