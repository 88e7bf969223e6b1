#include "app/case/risk_structures.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "app/case/cache_folder.h"
#include "app/case/clearance_source.h"
#include "tests/app/case/block_with_risks.h"
#include "tests/scratch_folder.h"

namespace app {
namespace {

using assets::RiskStructure;
using assets::RiskStructures;

constexpr double kHalfVoxel_mm = 0.25;

TEST(RiskStructures, AreAsFarAsTheirClosedForms) {
  const RiskStructures risks = riskStructures(test::blockWithRisks());
  const auto& canal = risks.of(RiskStructure::canal);
  const auto& lingual = risks.of(RiskStructure::lingual);
  const auto& second = risks.of(RiskStructure::second_molar);
  for (const double y : {34.0, 40.0, 46.0})
    for (const double x : {-26.0, -20.0, -14.0, -11.0, -8.0})
      for (const double z : {-16.0, -8.0, -3.0}) {
        const glm::dvec3 p(x, y, z);
        EXPECT_NEAR(canal.at_mm(p), std::hypot(x + 20.0, z - test::kCanalAxis_z_mm) - test::kCanalTube_mm,
                    kHalfVoxel_mm);
        // The plane halfway between the last voxel of bone and the next; the arch leans a little.
        EXPECT_NEAR(lingual.at_mm(p), test::kPlate_x_mm + kHalfVoxel_mm - x, 2.0 * kHalfVoxel_mm);
        if (z > -14.0) {
          EXPECT_NEAR(second.at_mm(p), std::hypot(x + 20.0, y - 28.0) - 5.2, kHalfVoxel_mm);
        }
      }
}

TEST(RiskStructures, TheLingualSurfaceEndsAtTheCrest) {
  const RiskStructures risks = riskStructures(test::blockWithRisks());
  const auto& lingual = risks.of(RiskStructure::lingual);
  EXPECT_NEAR(lingual.at_mm({-8.0, 40.0, 5.0}), 5.0 - kHalfVoxel_mm, 2.0 * kHalfVoxel_mm);
  EXPECT_GT(lingual.at_mm({-20.0, 40.0, 3.0}), 9.0);
  EXPECT_LT(lingual.at_mm({-8.0, 40.0, -5.0}), -1.5);
}

TEST(RiskStructures, TheNervesBandLiesOffPlateAndUnderCrest) {
  const RiskStructures risks = riskStructures(test::blockWithRisks());
  const auto& band = risks.of(RiskStructure::lingual_nerve);
  ASSERT_FALSE(band.isEmpty());
  const glm::dvec3 middle(test::kPlate_x_mm + 2.06, 40.0, test::kCrest_z_mm - 3.01);
  EXPECT_LT(band.at_mm(middle), 0.0);
  EXPECT_NEAR(band.at_mm(middle + glm::dvec3(6.0, 0.0, 0.0)), 6.0 - 2.2, 3.0 * kHalfVoxel_mm);
  EXPECT_NEAR(band.at_mm(middle + glm::dvec3(0.0, 0.0, 5.0)), 5.0 - 0.84, 3.0 * kHalfVoxel_mm);
}

TEST(RiskStructures, WhatACaseDoesNotHaveIsEmpty) {
  assets::Patient patient = test::blockWithRisks();
  patient.ct.tooth.clear();
  EXPECT_TRUE(riskStructures(patient).of(RiskStructure::second_molar).isEmpty());
  patient.site.reset();
  EXPECT_TRUE(riskStructures(patient).of(RiskStructure::lingual).isEmpty());
  EXPECT_TRUE(riskStructures(patient).of(RiskStructure::lingual_nerve).isEmpty());
  EXPECT_FALSE(riskStructures(patient).of(RiskStructure::canal).isEmpty());
  for (std::uint8_t& label : patient.ct.label)
    if (assets::Tissue{label} == assets::Tissue::mandibular_canal) label = 2;
  EXPECT_FALSE(riskStructures(patient).of(RiskStructure::canal).isEmpty()) << "the tube about its line";
  patient.mandibular_canal_P_mm.clear();
  EXPECT_TRUE(riskStructures(patient).of(RiskStructure::canal).isEmpty());
}

class ClearanceSource : public testing::Test {
 protected:
  ClearanceSource() {
    if (const char* before = std::getenv("XDG_CACHE_HOME")) before_ = before;
    ::setenv("XDG_CACHE_HOME", folder_.file("cache").c_str(), 1);
  }
  ~ClearanceSource() override {
    if (before_.empty())
      ::unsetenv("XDG_CACHE_HOME");
    else
      ::setenv("XDG_CACHE_HOME", before_.c_str(), 1);
  }
  static std::vector<std::filesystem::path> kept() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(cacheFolder())) files.push_back(entry.path());
    return files;
  }

  tests::ScratchFolder folder_;
  std::string before_;
  assets::Patient patient_ = test::blockWithRisks();
  RiskStructures made_ = riskStructures(patient_);
};

TEST_F(ClearanceSource, KeepsTheDistancesAndReadsTheSameBack) {
  EXPECT_EQ(cachedRiskStructures(patient_).distance, made_.distance);
  ASSERT_EQ(kept().size(), 1u);
  const auto written = std::filesystem::last_write_time(kept().front());
  EXPECT_EQ(cachedRiskStructures(patient_).distance, made_.distance);
  EXPECT_EQ(std::filesystem::last_write_time(kept().front()), written) << "read, not made again";
}

TEST_F(ClearanceSource, MakesADamagedFileAgain) {
  cachedRiskStructures(patient_);
  const std::filesystem::path file = kept().front();
  const auto bytes = std::filesystem::file_size(file);
  for (const std::uintmax_t left : {std::uintmax_t{0}, std::uintmax_t{20}, bytes / 2}) {
    std::filesystem::resize_file(file, left);
    EXPECT_EQ(cachedRiskStructures(patient_).distance, made_.distance);
    EXPECT_EQ(std::filesystem::file_size(file), bytes);
  }
  for (const int at : {3, 12, 40, 90, 5000}) {
    std::fstream(file, std::ios::in | std::ios::out | std::ios::binary).seekp(at).put('\x55');
    EXPECT_EQ(cachedRiskStructures(patient_).distance, made_.distance);
  }
}

TEST_F(ClearanceSource, OtherLabelsHaveDistancesOfTheirOwn) {
  cachedRiskStructures(patient_);
  for (std::uint8_t& fdi : patient_.ct.tooth)
    if (fdi == 47) fdi = 46;
  EXPECT_TRUE(cachedRiskStructures(patient_).of(RiskStructure::second_molar).isEmpty());
  EXPECT_EQ(kept().size(), 2u);
}

TEST_F(ClearanceSource, DoesWithoutACacheThatCannotBeWritten) {
  std::ofstream(folder_.file("cache")) << "a file where the folder should be";
  EXPECT_EQ(cachedRiskStructures(patient_).distance, made_.distance);
}

}  // namespace
}  // namespace app
