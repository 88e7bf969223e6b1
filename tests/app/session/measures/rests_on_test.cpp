#include "app/session/measures/rests_on.h"

#include <gtest/gtest.h>

namespace app {
namespace {

constexpr assets::Proposed kToothFound{true, false}, kCanalFound{false, true}, kBothFound{true, true};

TEST(RestsOn, DistancesToTheCanalRestOnTheCanalAlone) {
  for (const char* id :
       {"S1.canal", "S1.canal_force", "S2.canal_1mm", "S3.canal_p95", "S4.canal", "S5.canal", "S6.force"}) {
    EXPECT_TRUE(isConfirmed(id, {})) << id;
    EXPECT_TRUE(isConfirmed(id, kToothFound)) << id;
    EXPECT_FALSE(isConfirmed(id, kCanalFound)) << id;
  }
}

TEST(RestsOn, NeighboursPlanAndLabelsRestOnTheTooth) {
  for (const char* id :
       {"S1.lingual", "S1.second_molar", "S1.lingual_nerve", "S3.lingual_max", "S8.bone", "M9.planned_size", "O1.bone",
        "O2.plan", "O6.wall", "O11.volume", "perforation", "retained", "pieces_out"}) {
    EXPECT_TRUE(isConfirmed(id, kCanalFound)) << id;
    EXPECT_FALSE(isConfirmed(id, kToothFound)) << id;
  }
}

TEST(RestsOn, TheHandsWorkRestsOnNeither) {
  for (const char* id : {"M1.total", "M2.path", "M4.LDLJ", "PI", "PI.plunge", "S7", "S9.time", "S10.dry", "S11",
                         "path_mm", "removed_mm3", "duration_s"})
    EXPECT_TRUE(isConfirmed(id, kBothFound)) << id;
}

TEST(RestsOn, AStructureIsTheCanalOrToldByTheTooth) {
  for (std::size_t n = 0; n < assets::kRiskStructures; ++n) {
    const auto structure = static_cast<assets::RiskStructure>(n);
    const bool is_canal = structure == assets::RiskStructure::canal;
    EXPECT_EQ(isConfirmed(structure, kToothFound), is_canal) << n;
    EXPECT_EQ(isConfirmed(structure, kCanalFound), !is_canal) << n;
  }
}

TEST(RestsOn, WordsNameWhatIsNotConfirmed) {
  EXPECT_EQ(assets::Proposed{}.words(), "");
  EXPECT_EQ(kToothFound.words(), "tooth");
  EXPECT_EQ(kCanalFound.words(), "canal");
  EXPECT_EQ(kBothFound.words(), "tooth and canal");
}

}  // namespace
}  // namespace app
