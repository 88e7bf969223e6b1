#include "tests/mutants.h"

#include <gtest/gtest.h>

#include <set>

namespace {

std::string goodFile() {
  std::string file = "NRRD0004\ntype: short\nsizes: 24 24 24\nspacings: 0.5 0.5 0.5\n\n";
  for (int v = 0; v < 400; ++v) file += static_cast<char>(v * v);
  return file;
}

const std::string kGood = goodFile();

TEST(DamagedCopies, AreTheSameBytesForTheSameNumber) {
  for (std::uint64_t number = 1; number < 200; ++number)
    EXPECT_EQ(mutants::mutantOf(kGood, number), mutants::mutantOf(kGood, number));
}

TEST(DamagedCopies, DifferFromTheGoodFileAndFromEachOther) {
  std::set<std::string> seen;
  for (std::uint64_t number = 1; number <= 2000; ++number) seen.insert(mutants::mutantOf(kGood, number));
  seen.erase(kGood);
  EXPECT_GT(seen.size(), 1800u);
}

TEST(DamagedCopies, HoldEveryKindOfDamage) {
  int cut = 0, grown = 0, far_too_long = 0, not_finite = 0, head_lost = 0, same_length = 0;
  for (std::uint64_t number = 1; number <= 5000; ++number) {
    const std::string mutant = mutants::mutantOf(kGood, number);
    cut += mutant.size() < kGood.size() / 2 ? 1 : 0;
    grown += mutant.size() > kGood.size() ? 1 : 0;
    far_too_long += mutant.size() > 60000 ? 1 : 0;
    not_finite += mutant.find("nan") != std::string::npos ? 1 : 0;
    head_lost += mutant.starts_with("NRRD0004\n") ? 0 : 1;
    same_length += mutant.size() == kGood.size() ? 1 : 0;
  }
  for (const int kind : {cut, grown, far_too_long, not_finite, head_lost, same_length}) EXPECT_GT(kind, 20);
}

TEST(DamagedCopies, LeaveAnEmptyFileEmpty) { EXPECT_EQ(mutants::mutantOf("", 5), ""); }

}  // namespace
