// Damaged labels, teeth and grey values: refused in one line, or a consistent patient.
#include <gtest/gtest.h>

#include <algorithm>

#include "assets/import/scan_import.h"
#include "assets/load_error.h"
#include "assets/tooth.h"
#include "tests/assets/scan_on_disk.h"
#include "tests/mutants.h"
#include "tests/refusal.h"

namespace {

const on_disk::Scan kScan{{24, 24, 20}, glm::dmat3(0.6), {10, -20, 30}};

/// A tooth with a canal under it and bone in front.
struct Voxels {
  std::vector<std::int16_t> hounsfield;
  std::vector<std::uint8_t> label, tooth;

  Voxels() {
    for (int k = 0; k < kScan.size.z; ++k)
      for (int j = 0; j < kScan.size.y; ++j)
        for (int i = 0; i < kScan.size.x; ++i) {
          const bool is_tooth = k >= 8 && i >= 6 && i < 14 && j >= 14 && j < 22;
          const bool is_canal = (k == 4 || k == 5) && (i == 8 || i == 9);
          const bool is_bone = j < 4 && i > 12 && k < 8;
          hounsfield.push_back(is_tooth ? (k > 14 ? 2500 : 1650) : is_bone ? 1350 : is_canal ? 40 : -900);
          label.push_back(is_tooth ? (k > 14 ? 4 : 5) : is_bone ? 1 : is_canal ? 7 : 0);
          tooth.push_back(is_tooth ? 48 : 0);
        }
  }
};

void expectWhole(const assets::ImportedScan& imported) {
  const assets::Patient& patient = imported.patient;
  const assets::CtVolume& ct = patient.ct;
  ASSERT_EQ(ct.hounsfield.size(), ct.grid.voxelCount());
  ASSERT_EQ(ct.solid.size(), ct.grid.voxelCount());
  ASSERT_EQ(ct.label.size(), ct.grid.voxelCount());
  ASSERT_TRUE(ct.tooth.empty() || ct.tooth.size() == ct.grid.voxelCount());
  EXPECT_LT(*std::ranges::max_element(ct.label), assets::kScanTissueCount);
  for (const std::uint8_t fdi : ct.tooth) ASSERT_TRUE(fdi == 0 || assets::isToothNumber(fdi));
  for (const std::string& remark : imported.remarks) EXPECT_EQ(remark.find('\n'), std::string::npos) << remark;
  if (!patient.site) return;
  EXPECT_NE(std::ranges::find(ct.tooth, patient.site->fdi), ct.tooth.end());
  EXPECT_NEAR(glm::length(patient.site->axis_P), 1.0, 1.0e-6);
  EXPECT_TRUE(ct.grid.contains(glm::ivec3(glm::round(ct.grid.indexFromPoint(patient.site->centre_P_mm)))));
}

/// Mutants of one of the files, the others as they are.
void check(const std::string& damaged) {
  const on_disk::Folder folder;
  const Voxels voxels;
  const std::string head = on_disk::nrrd(kScan, "uchar", "");
  on_disk::write(folder.at("ct.nrrd"), on_disk::nrrd(kScan, "short", on_disk::bytesOf(voxels.hounsfield)));
  on_disk::write(folder.at("labels.nrrd"), head + on_disk::bytesOf(voxels.label));
  if (damaged == "teeth.nrrd") on_disk::write(folder.at("teeth.nrrd"), head + on_disk::bytesOf(voxels.tooth));
  const std::string good = on_disk::read(folder.at(damaged));
  const auto import = [&] { expectWhole(assets::importScan(folder.at(""), {})); };
  EXPECT_EQ(tests::refusalOf<assets::LoadError>(import), "accepted");
  constexpr std::uint64_t kImportCosts = 10;
  const auto judge_one = [&](const std::string& mutant, std::size_t, std::uint64_t) {
    on_disk::write(folder.at(damaged), mutant);
    tests::refusalOf<assets::LoadError>(import);
  };
  mutants::forEachMutant({good}, 100, judge_one, kImportCosts);
}

TEST(ImportMutants, OfGreyValues) { check("ct.nrrd"); }
TEST(ImportMutants, OfLabels) { check("labels.nrrd"); }
TEST(ImportMutants, OfTeeth) { check("teeth.nrrd"); }

}  // namespace
