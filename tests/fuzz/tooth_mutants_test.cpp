// Damaged volumes of a single tooth: refused in one line, or a tooth that is whole.
#include <gtest/gtest.h>

#include <algorithm>

#include "assets/import/tooth_volume.h"
#include "assets/load_error.h"
#include "tests/assets/density_tooth.h"
#include "tests/mutants.h"
#include "tests/refusal.h"

namespace {

void expectWhole(const assets::ToothVolume& tooth) {
  const assets::CtVolume& ct = tooth.ct;
  const std::size_t count = ct.grid.voxelCount();
  ASSERT_TRUE(ct.label.size() == count && ct.solid.size() == count && ct.tooth.size() == count);
  ASSERT_EQ(ct.hounsfield.size(), count);
  EXPECT_LT(*std::ranges::max_element(ct.label), assets::kTissueCount);
  EXPECT_NE(std::ranges::find(ct.tooth, 46), ct.tooth.end());
  for (const std::string& remark : tooth.remarks) EXPECT_EQ(remark.find('\n'), std::string::npos) << remark;
}

TEST(ToothMutants, AreRefusedInALineOrWhole) {
  const on_disk::Folder folder;
  const on_disk::Scan scan = density_tooth::usualScan(0.5);
  const std::string soft = density_tooth::nrrd(scan), plain = density_tooth::nrrd(scan, {}, 1);
  int accepted = 0, tried = 0;
  constexpr std::uint64_t kCosts = 2;
  mutants::forEachMutant(
      {soft, plain}, 2000,
      [&](const std::string& mutant, std::size_t, std::uint64_t number) {
        on_disk::write(folder.at("tooth.nrrd"), mutant);
        const std::string said = tests::refusalOf<assets::LoadError>(
            [&] { expectWhole(assets::readToothVolume(folder.at("tooth.nrrd"), {.turns_upright = number % 3 == 0})); });
        if (said == "accepted") ++accepted;
        ++tried;
      },
      kCosts);
  if (tried < static_cast<int>(mutants::kEnoughToJudge)) return;
  EXPECT_GT(accepted, 0);
  EXPECT_LT(accepted, tried);
}

}  // namespace
