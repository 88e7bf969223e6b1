#include "haptics/contact/law_parameters.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <string>

namespace haptics {
namespace {

TEST(LawParameters, HaveTheirOwnPlaceAndANameOfTheirOwnInEveryLaw) {
  LawSettings settings;
  std::set<double*> places;
  std::set<std::string> names;
  for (const LawParameter& parameter : lawParameters()) {
    EXPECT_TRUE(places.insert(&parameter.of(settings)).second) << parameter.key;
    for (const LawName& law : kLaws) {
      if (parameter.law.value_or(law.kind) != law.kind) continue;
      EXPECT_TRUE(names.insert(std::string(law.key) + "." + std::string(parameter.key)).second) << parameter.key;
    }
  }
}

TEST(LawParameters, HaveADefaultWithinTheirRange) {
  for (const LawParameter& parameter : lawParameters()) {
    EXPECT_LT(parameter.lowest, parameter.highest) << parameter.key;
    EXPECT_GE(parameter.defaultValue(), parameter.lowest) << parameter.key;
    EXPECT_LE(parameter.defaultValue(), parameter.highest) << parameter.key;
    EXPECT_FALSE(parameter.meaning.empty() || parameter.source.empty()) << parameter.key;
  }
}

TEST(LawParameters, OfOneLawAreFoundByItAlone) {
  LawSettings settings;
  findLawParameter(LawKind::harmonic, "stiffness_N_per_mm")->of(settings) = 0.3;
  EXPECT_EQ(settings.harmonic.stiffness_N_per_mm, 0.3);
  EXPECT_EQ(settings.agus.stiffness_N_per_mm, AgusParameters{}.stiffness_N_per_mm);
  EXPECT_EQ(findLawParameter(LawKind::hertz, "stiffness_N_per_mm"), nullptr);
  EXPECT_EQ(findLawParameter(LawKind::hertz, "damping_Ns_per_mm"),
            findLawParameter(LawKind::shell, "damping_Ns_per_mm"));
  EXPECT_EQ(&findLawParameter(LawKind::agus, "stiffness_enamel")->of(settings), &settings.tissue.factor[4]);
}

TEST(LawParameters, GiveEveryTissueItsFactorByItsKey) {
  LawSettings settings;
  for (std::size_t tissue = 0; tissue < assets::kTissueCount; ++tissue) {
    const LawParameter* parameter =
        findLawParameter(LawKind::agus, "stiffness_" + std::string(assets::kTissues[tissue].key));
    ASSERT_NE(parameter, nullptr) << assets::kTissues[tissue].key;
    EXPECT_EQ(&parameter->of(settings), &settings.tissue.factor[tissue]);
  }
}

TEST(LawParameters, KnowEveryLawByItsKey) {
  for (std::size_t i = 0; i < kLaws.size(); ++i) {
    EXPECT_EQ(static_cast<std::size_t>(kLaws[i].kind), i);
    EXPECT_EQ(lawOfKey(kLaws[i].key), kLaws[i].kind);
  }
  EXPECT_FALSE(lawOfKey("hooke"));
}

TEST(LawParameters, AreObeyedWithinTheirRangeOnly) {
  LawSettings wild;
  wild.kind = static_cast<LawKind>(200);
  for (const LawParameter& parameter : lawParameters()) parameter.of(wild) = parameter.highest + 1.0;
  LawSettings safe = sanitised(wild);
  EXPECT_EQ(safe.kind, LawKind::agus);
  for (const LawParameter& parameter : lawParameters()) EXPECT_EQ(parameter.of(safe), parameter.highest);

  for (const LawParameter& parameter : lawParameters()) parameter.of(wild) = std::numeric_limits<double>::quiet_NaN();
  safe = sanitised(wild);
  for (const LawParameter& parameter : lawParameters()) EXPECT_EQ(parameter.of(safe), parameter.defaultValue());
}

}  // namespace
}  // namespace haptics
