#include "assets/import/scan_import.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>

#include <nlohmann/json.hpp>

#include "assets/import/tissue_from_grey.h"
#include "assets/load_error.h"
#include "assets/patient/patient_toml.h"
#include "assets/scan/image_file.h"
#include "assets/scan/solid_fraction.h"
#include "tests/assets/import/distance_to_line.h"
#include "tests/assets/scan_on_disk.h"
#include "tests/refusal.h"
#include "tests/shared_data.h"

namespace {

using assets::importScan;
using assets::VolumeGrid;
using testing::HasSubstr;
using testing::Not;

std::string refusalOf(const std::string& source, const assets::ScanImportOptions& choices = {}) {
  return tests::refusalOf<assets::LoadError>([&] { importScan(source, choices); });
}

std::string refusalOfReading(const std::string& path) {
  return tests::refusalOf<assets::LoadError>([&] { assets::readHounsfield(path); });
}

class ScanImportRealData : public testing::Test {
 protected:
  void SetUp() override { MOLAR_NEEDS(folder_); }
  const std::string folder_ = tests::sharedData("patients/right_third_molar");
};

TEST_F(ScanImportRealData, HasItsThirdMolarAndCanalAtTheKnownPosition) {
  const auto truth = nlohmann::json::parse(on_disk::read(folder_ + "/truth.json"));
  const auto patient = importScan(folder_, {}).patient;
  EXPECT_EQ(patient.ct.grid.size, glm::ivec3(132, 169, 188));
  const auto pointOf = [&](const nlohmann::json& ijk) {
    return patient.ct.grid.origin_P_mm +
           0.4 * glm::dvec3(ijk[0].get<double>(), ijk[1].get<double>(), ijk[2].get<double>());
  };

  ASSERT_TRUE(patient.site);
  EXPECT_EQ(patient.site->fdi, 48);
  EXPECT_LT(glm::distance(patient.site->centre_P_mm, pointOf(truth["M3"]["centroid_ijk"])), 0.5);
  const auto crown = truth["M3"]["crown_dir_ijk"];
  const glm::dvec3 crown_P =
      glm::normalize(glm::dvec3(crown[0].get<double>(), crown[1].get<double>(), crown[2].get<double>()));
  EXPECT_GT(glm::dot(patient.site->axis_P, crown_P), std::cos(5.0 * std::acos(-1.0) / 180.0));

  std::vector<glm::dvec3> canal;
  for (const auto& ijk : truth["canal_polyline_ijk"]) canal.push_back(pointOf(ijk));
  for (const auto& p : canal) EXPECT_LT(tests::distanceToLine(patient.mandibular_canal_P_mm, p), 1.0);
  for (const auto& p : patient.mandibular_canal_P_mm)
    if (p.y > canal.front().y && p.y < canal.back().y) {
      EXPECT_LT(tests::distanceToLine(canal, p), 1.0);
    }
  EXPECT_NEAR(patient.mandibular_canal_radius_mm, 1.3, 0.2);
}

TEST_F(ScanImportRealData, WithoutLabelsJawAndTeethAreFound) {
  const auto imported = importScan(folder_ + "/ct.nrrd", {});
  ASSERT_TRUE(imported.jaw);
  const auto& patient = imported.patient;
  const auto truth = nlohmann::json::parse(on_disk::read(folder_ + "/truth.json"));
  const auto centroid = truth["M3"]["centroid_ijk"];
  ASSERT_TRUE(patient.site);
  EXPECT_EQ(patient.site->fdi, 48);
  EXPECT_LT(
      glm::distance(patient.site->centre_P_mm,
                    patient.ct.grid.origin_P_mm + 0.4 * glm::dvec3(centroid[0].get<double>(), centroid[1].get<double>(),
                                                                   centroid[2].get<double>())),
      1.0);
  EXPECT_GT(patient.mandibular_canal_P_mm.size(), 30u) << "proposed";
  EXPECT_TRUE(patient.isProposed());
  EXPECT_THAT(patient.shownTitle(), HasSubstr("not confirmed"));
  EXPECT_THAT(imported.remarks, testing::Contains(HasSubstr("tooth 48 and the mandibular canal were found")));
}

TEST_F(ScanImportRealData, GreyOnlyFindsNoTeeth) {
  const auto patient = importScan(folder_ + "/ct.nrrd", {.grey_only = true}).patient;
  EXPECT_FALSE(patient.site);
  EXPECT_TRUE(patient.mandibular_canal_P_mm.empty());
  EXPECT_EQ(patient.ct.label, assets::labelsFromGrey(patient.ct.grid, patient.ct.hounsfield));
  EXPECT_EQ(patient.ct.solid, assets::classify(patient.ct.grid, patient.ct.hounsfield, {}));
  const glm::dvec3 index = patient.ct.grid.indexFromPoint(patient.focus_P_mm());
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

TEST(ScanImport, RefusesUnusableInput) {
  const on_disk::Folder folder;
  EXPECT_THAT(refusalOf(folder.at("none")), HasSubstr("no such scan"));
  EXPECT_THAT(refusalOf(folder.at("")), HasSubstr("nor a ct.nrrd"));
  on_disk::write(folder.at("slice"), std::string(128, '\0') + "DICM");
  EXPECT_TRUE(assets::isDicomSource(folder.at("")));
  EXPECT_TRUE(assets::isDicomSource(folder.at("slice")));
  writeBlock(folder.at("ct.nrrd"), kBlock, -1000);
  EXPECT_FALSE(assets::isDicomSource(folder.at("")));
  EXPECT_THAT(refusalOf(folder.at("")), HasSubstr("above 300 HU"));
  writeBlock(folder.at("ct.nrrd"), kBlock, 1000);
  EXPECT_EQ(refusalOf(folder.at("")), "accepted");
  VolumeGrid moved = kBlock;
  moved.origin_P_mm.z = 0.1;
  writeLabels(folder.at("labels.nrrd"), moved);
  EXPECT_THAT(refusalOf(folder.at("")), HasSubstr("labels.nrrd: its grid differs from that of"));
  writeLabels(folder.at("labels.nrrd"), kBlock);
  EXPECT_EQ(refusalOf(folder.at("")), "accepted");
  writeBlock(folder.at("ct2.nrrd"), kBlock, 1000);
  std::filesystem::rename(folder.at("ct2.nrrd"), folder.at("ct.nhdr"));
  EXPECT_THAT(refusalOf(folder.at("")), HasSubstr("more than one volume"));
}

TEST(ScanImport, KeepsNoPersonalData) {
  const on_disk::Folder folder;
  on_disk::Scan scan{{12, 12, 12}, glm::dmat3(0.5), {0, 0, 0}};
  std::string bytes = on_disk::nrrd(scan, "short", on_disk::bytesOf(std::vector<std::int16_t>(1728, 1000)));
  bytes.insert(9, "# Jane Doe\ncontent: Jane Doe\nPatientName:=Jane Doe\n");
  on_disk::write(folder.at("jane_doe.nrrd"), bytes);
  const auto patient = importScan(folder.at("jane_doe.nrrd"), {}).patient;
  std::string words = assets::patientToml(patient);
  std::transform(words.begin(), words.end(), words.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  EXPECT_THAT(words, Not(HasSubstr("jane")));
}

void writeGreys(const std::string& path, const VolumeGrid& grid, const std::vector<std::uint8_t>& values) {
  auto file = assets::nrrdOutput(path, true);
  assets::writeSolid(grid, values, file);
}

TEST(ScanImport, WarnsOfAMissingOrientation) {
  const on_disk::Folder folder;
  const std::string head = "NRRD0001\ntype: short\ndimension: 3\nsizes: 12 12 12\nspacings: .5 .5 .5\n";
  on_disk::write(folder.at("a.nrrd"),
                 head + "endian: little\nencoding: raw\n\n" + on_disk::bytesOf(std::vector<std::int16_t>(1728, 1000)));
  const auto remarks = importScan(folder.at("a.nrrd"), {}).remarks;
  EXPECT_THAT(remarks, testing::Contains(HasSubstr("states no orientation; assumed LPS")));
  EXPECT_THAT(remarks, testing::Contains(HasSubstr("6 mm at its narrowest: below 35 mm no teeth are looked for")));
  EXPECT_THAT(importScan(folder.at("a.nrrd"), {.grey_only = true}).remarks,
              Not(testing::Contains(HasSubstr("at its narrowest"))));
}

/// Two teeth, 8 mm high, of which the lower half is dentine.
struct TwoTeeth {
  VolumeGrid grid{{40, 40, 40}, 0.5, {0, 0, 0}};
  std::vector<std::int16_t> hounsfield = std::vector<std::int16_t>(64000, -1000);
  std::vector<std::uint8_t> label = std::vector<std::uint8_t>(64000), tooth = label;

  TwoTeeth() {
    for (int k = 10; k < 26; ++k)
      for (int j = 8; j < 32; ++j)
        for (int i = 14; i < 26; ++i) {
          if (j > 18 && j < 22) continue;
          const std::size_t v = grid.index({i, j, k});
          hounsfield[v] = k > 18 ? 2500 : 1650;
          label[v] = k > 18 ? 4 : 5;
          tooth[v] = j < 20 ? 36 : 38;
        }
  }
  void writeTo(const on_disk::Folder& folder) const {
    auto file = assets::nrrdOutput(folder.at("ct.nrrd"), true);
    assets::writeHounsfield(grid, hounsfield, file);
    writeGreys(folder.at("labels.nrrd"), grid, label);
    writeGreys(folder.at("teeth.nrrd"), grid, tooth);
  }
};

TEST(ScanImport, TakesTheRequestedToothAsTheSite) {
  const on_disk::Folder folder;
  TwoTeeth scan;
  scan.writeTo(folder);
  const auto by_itself = importScan(folder.at(""), {});
  ASSERT_TRUE(by_itself.patient.site);
  EXPECT_EQ(by_itself.patient.site->fdi, 38) << "the third molar";
  const auto asked = importScan(folder.at(""), {.tooth_fdi = 36});
  ASSERT_TRUE(asked.patient.site);
  EXPECT_EQ(asked.patient.site->fdi, 36);
  EXPECT_NEAR(asked.patient.site->centre_P_mm.y, 6.5, 0.3);
  EXPECT_GT(asked.patient.site->axis_P.z, 0.99);
  EXPECT_EQ(asked.patient.ct.tooth, scan.tooth);
  EXPECT_THAT(asked.patient.title, HasSubstr("lower left first molar (36)"));
  EXPECT_THAT(refusalOf(folder.at(""), {.tooth_fdi = 47}), HasSubstr("these are: 36, 38"));

  // Without a third molar the view is centred on the teeth.
  std::ranges::replace(scan.tooth, std::uint8_t{38}, std::uint8_t{37});
  scan.writeTo(folder);
  const auto none = importScan(folder.at(""), {});
  EXPECT_FALSE(none.patient.site);
  EXPECT_THAT(none.remarks, testing::Contains(HasSubstr("no third molar is labelled; these teeth are: 36, 37")));
  EXPECT_NEAR(none.patient.focus_P_mm().y, 9.75, 0.3);

  scan.tooth[0] = 17;
  scan.tooth[1] = 9;
  scan.writeTo(folder);
  EXPECT_THAT(refusalOf(folder.at("")), HasSubstr("its value 9 is not an FDI number"));
}

/// One tooth, 6 x 6 x 8 mm, enamel above dentine around a pulp; bone 12 mm in front of it, to its left.
struct OneTooth {
  VolumeGrid grid{{48, 60, 40}, 0.5, {0, 0, 0}};
  std::vector<std::int16_t> hounsfield = std::vector<std::int16_t>(grid.voxelCount(), -1000);
  std::vector<std::uint8_t> label = std::vector<std::uint8_t>(grid.voxelCount()), tooth = label;

  OneTooth() {
    for (int k = 10; k < 26; ++k)
      for (int j = 36; j < 48; ++j)
        for (int i = 10; i < 22; ++i) {
          const std::size_t v = grid.index({i, j, k});
          const bool is_pulp = k < 16 && std::abs(i - 15) < 2 && std::abs(j - 42) < 2;
          hounsfield[v] = k > 18 ? 2500 : is_pulp ? 150 : 1650;
          label[v] = k > 18 ? 4 : is_pulp ? 6 : 5;
          tooth[v] = 48;
        }
    for (int k = 4; k < 12; ++k)
      for (int j = 8; j < 16; ++j)
        for (int i = 30; i < 40; ++i) {
          hounsfield[grid.index({i, j, k})] = 1350;
          label[grid.index({i, j, k})] = 1;
        }
  }

  assets::ImportedScan imported(const on_disk::Folder& folder, const assets::ScanImportOptions& choices = {}) const {
    auto file = assets::nrrdOutput(folder.at("ct.nrrd"), true);
    assets::writeHounsfield(grid, hounsfield, file);
    return importScan(folder.at(""), choices);
  }
  void forVoxels(const std::function<void(glm::ivec3, std::size_t)>& visit) const {
    for (int k = 0; k < grid.size.z; ++k)
      for (int j = 0; j < grid.size.y; ++j)
        for (int i = 0; i < grid.size.x; ++i) visit({i, j, k}, grid.index({i, j, k}));
  }
};

TEST(ScanImport, TakesASingleLabelledToothAsThirdMolar) {
  const on_disk::Folder folder;
  const OneTooth scan;
  writeGreys(folder.at("labels.nrrd"), scan.grid, scan.label);
  const auto imported = scan.imported(folder);
  ASSERT_TRUE(imported.patient.site);
  EXPECT_EQ(imported.patient.site->fdi, 48);
  EXPECT_THAT(imported.remarks, testing::IsEmpty());
}

TEST(ScanImport, FindsNoThirdMolarInTissuesEstimatedFromGrey) {
  const on_disk::Folder folder;
  const OneTooth scan;
  writeGreys(folder.at("labels.nrrd"), scan.grid, std::vector<std::uint8_t>(scan.label.size(), 0));
  const auto imported = scan.imported(folder);
  EXPECT_FALSE(imported.patient.site);
  EXPECT_TRUE(imported.patient.ct.tooth.empty());
  EXPECT_THAT(imported.remarks, testing::Contains(HasSubstr("all are 0")));
}

TEST(ScanImport, FindsNoThirdMolarInMoreThanOneTooth) {
  const on_disk::Folder folder;
  OneTooth scan;
  scan.grid.spacing_mm = 1.2;
  writeGreys(folder.at("labels.nrrd"), scan.grid, scan.label);
  const auto imported = scan.imported(folder);
  EXPECT_FALSE(imported.patient.site);
  EXPECT_TRUE(imported.patient.ct.tooth.empty());
  EXPECT_THAT(imported.remarks, testing::Contains(HasSubstr("mm3, more than one tooth")));
  EXPECT_THAT(refusalOf(folder.at(""), {.tooth_fdi = 48}), HasSubstr("not labelled in it"));
}

TEST(ScanImport, DoesNotGuessTheSide) {
  const on_disk::Folder folder;
  OneTooth scan;
  std::ranges::replace(scan.label, std::uint8_t{1}, std::uint8_t{0});
  writeGreys(folder.at("labels.nrrd"), scan.grid, scan.label);
  const auto imported = scan.imported(folder);
  EXPECT_FALSE(imported.patient.site);
  EXPECT_THAT(imported.remarks, testing::Contains(HasSubstr("--tooth 48 or --tooth 38")));
  const auto told = importScan(folder.at(""), {.tooth_fdi = 38});
  ASSERT_TRUE(told.patient.site);
  EXPECT_EQ(told.patient.site->fdi, 38);
}

TEST(ScanImport, RefusesUnknownLabels) {
  const on_disk::Folder folder;
  OneTooth scan;
  scan.imported(folder);
  const auto refusalWith = [&](const std::function<std::uint8_t(std::uint8_t)>& legend) {
    std::vector<std::uint8_t> label = scan.label;
    std::ranges::transform(label, label.begin(), legend);
    writeGreys(folder.at("labels.nrrd"), scan.grid, label);
    return refusalOf(folder.at(""));
  };
  EXPECT_THAT(refusalWith([](std::uint8_t l) { return static_cast<std::uint8_t>(l == 0 ? 0 : l + 100); }),
              HasSubstr("labels.nrrd: unknown label 101, 104, 105, 106; use 1 cortical bone"));
  EXPECT_THAT(refusalWith([](std::uint8_t l) { return static_cast<std::uint8_t>(l == 4 ? 44 : l); }),
              HasSubstr("labels.nrrd: unknown label 44; use"));
}

/// Masks that end half a voxel early, undivided teeth: the surface voxels belong to the tooth.
TEST(ScanImport, AssignsSurfaceVoxelsToTheTooth) {
  const on_disk::Folder folder;
  OneTooth scan;
  scan.forVoxels([&](glm::ivec3 at, std::size_t v) {
    if (scan.tooth[v] == 0) return;
    const bool is_skin = at.x == 10 || at.x == 21 || at.y == 36 || at.y == 47 || at.z == 10 || at.z == 25;
    scan.label[v] = is_skin ? 0 : 3;
    scan.tooth[v] = is_skin ? 0 : 48;
  });
  writeGreys(folder.at("labels.nrrd"), scan.grid, scan.label);
  writeGreys(folder.at("teeth.nrrd"), scan.grid, scan.tooth);
  const auto ct = scan.imported(folder).patient.ct;
  for (std::size_t v = 0; v < ct.label.size(); ++v)
    if (ct.label[v] == 3) {
      ASSERT_EQ(ct.tooth[v], 48) << v;
    }
  EXPECT_EQ(ct.tooth[ct.grid.index({10, 40, 20})], 48) << "surface";
}

TEST(ScanImport, LabelsTheTissuesOfNumberedTeeth) {
  const on_disk::Folder folder;
  OneTooth scan;
  scan.forVoxels([&](glm::ivec3, std::size_t v) {
    if (scan.hounsfield[v] == 1650) scan.hounsfield[v] = 1400;  // below what is dentine anywhere in a head
    if (scan.tooth[v] != 0) scan.label[v] = v % 2 == 0 ? 0 : 1;
  });
  writeGreys(folder.at("labels.nrrd"), scan.grid, scan.label);
  writeGreys(folder.at("teeth.nrrd"), scan.grid, scan.tooth);
  const auto patient = scan.imported(folder).patient;
  ASSERT_TRUE(patient.site);
  EXPECT_EQ(patient.site->fdi, 48);
  EXPECT_EQ(patient.ct.label[scan.grid.index({15, 42, 22})], 4);
  EXPECT_EQ(patient.ct.label[scan.grid.index({12, 38, 14})], 5);
  EXPECT_EQ(patient.ct.label[scan.grid.index({15, 42, 13})], 6);
}

TEST(ScanImport, GivesTeethWithoutLabelsNoShellOfPulp) {
  const on_disk::Folder folder;
  OneTooth scan;
  // A soft surface, as blurred by a scanner.
  scan.forVoxels([&](glm::ivec3 at, std::size_t v) {
    if (scan.tooth[v] != 0 && (at.x == 10 || at.x == 21 || at.y == 36 || at.y == 47 || at.z == 10))
      scan.hounsfield[v] = 500;
  });
  writeGreys(folder.at("teeth.nrrd"), scan.grid, scan.tooth);
  const auto label = scan.imported(folder).patient.ct.label;
  EXPECT_EQ(label[scan.grid.index({10, 42, 14})], 5) << "surface";
  EXPECT_EQ(label[scan.grid.index({15, 42, 13})], 6) << "inside";
}

/// Too small for a site.
TEST(ScanImport, OffersOnlyTeethThatCanBeTheSite) {
  const on_disk::Folder folder;
  OneTooth scan;
  std::ranges::replace(scan.tooth, std::uint8_t{48}, std::uint8_t{46});
  scan.tooth[0] = 31;
  writeGreys(folder.at("teeth.nrrd"), scan.grid, scan.tooth);
  scan.imported(folder);
  EXPECT_THAT(refusalOf(folder.at(""), {.tooth_fdi = 31}), HasSubstr("these are: 46;"));
}

TEST(ScanImport, RefusesEightBitGreysWithoutAWindow) {
  const on_disk::Folder folder;
  std::vector<std::uint8_t> greys(kBlock.voxelCount(), 30);
  for (std::size_t v = 400; v < 1300; ++v) greys[v] = 180;
  writeGreys(folder.at("u8.nrrd"), kBlock, greys);
  EXPECT_THAT(refusalOf(folder.at("u8.nrrd")), HasSubstr("--window"));
  EXPECT_THAT(refusalOfReading(folder.at("u8.nrrd")), HasSubstr("8-bit greys")) << "by any reader";
  const auto windowed = importScan(folder.at("u8.nrrd"), {.window = assets::GreyWindow{-1000.0, 3000.0}});
  EXPECT_EQ(windowed.patient.ct.hounsfield[500], 1824);
}

TEST(ScanImport, AStatedScaleCountsForSmallAndLabelledScansToo) {
  const on_disk::Folder folder;
  writeBlock(folder.at("ct.nrrd"), kBlock, 2024);
  const assets::GreyMap higher{assets::GreyScale::shifted, 1.0, -1024.0};
  EXPECT_EQ(importScan(folder.at("ct.nrrd"), {.scale = higher}).patient.ct.hounsfield[500], 1000);
  writeLabels(folder.at("labels.nrrd"), kBlock);
  EXPECT_EQ(importScan(folder.at(""), {.scale = higher}).patient.ct.hounsfield[500], 1000);
  EXPECT_EQ(importScan(folder.at(""), {}).patient.ct.hounsfield[500], 2024);
}

TEST(ScanImport, ClicksNeedAWholeScanWithoutLabels) {
  const on_disk::Folder folder;
  writeBlock(folder.at("ct.nrrd"), kBlock, 1000);
  const assets::JawClicks clicks{{{assets::ToothEdit::no_tooth, {}, 0}}, {}};
  EXPECT_THAT(refusalOf(folder.at("ct.nrrd"), {.clicks = clicks}),
              HasSubstr("clicks change what is found in a whole scan without labels"));
}

}  // namespace
