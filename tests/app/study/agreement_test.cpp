#include "app/study/agreement.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace app {
namespace {

const auto kNone = std::optional<int>();
/// Krippendorff's four observers (2011).
const Ratings kObservers{{1, 2, 3, 3, 2, 1, 4, 1, 2, kNone, kNone, kNone},
                         {1, 2, 3, 3, 2, 2, 4, 1, 2, 5, kNone, 3},
                         {kNone, 3, 3, 3, 2, 3, 4, 2, 2, 5, 1, kNone},
                         {1, 2, 3, 3, 2, 4, 4, 1, 2, 5, 1, kNone}};
/// Shrout and Fleiss 1979, table 2: four judges, six targets.
const Ratings kJudges{{9, 6, 8, 7, 10, 6}, {2, 1, 4, 1, 5, 2}, {5, 3, 6, 2, 6, 4}, {8, 2, 8, 6, 9, 7}};

TEST(Agreement, AlphaOfFourObserversIsThePublishedOne) {
  EXPECT_NEAR(*krippendorffAlpha(kObservers, RatingScale::nominal), 0.743, 5e-4);
  EXPECT_NEAR(*krippendorffAlpha(kObservers, RatingScale::ordinal), 0.815, 5e-4);
  EXPECT_NEAR(*krippendorffAlpha(kObservers, RatingScale::interval), 0.849, 5e-4);
}

TEST(Agreement, AlphaByHand) {
  // Two raters, units (1,1) (1,2): values 1 1 1 2, so D_o = 2/4, D_e = 2 * 3 * 1 / (4 * 3): alpha is nought.
  EXPECT_NEAR(*krippendorffAlpha({{1, 1}, {1, 2}}, RatingScale::nominal), 0.0, 1e-12);
  EXPECT_EQ(*krippendorffAlpha({{1, 2, 3}, {1, 2, 3}}, RatingScale::ordinal), 1.0);
}

TEST(Agreement, ItsIntervalIsTheSameOfTheSameSeed) {
  for (const RatingScale scale : {RatingScale::nominal, RatingScale::ordinal, RatingScale::interval}) {
    const auto one = alphaInterval(kObservers, scale, 1), again = alphaInterval(kObservers, scale, 1),
               other = alphaInterval(kObservers, scale, 2);
    ASSERT_TRUE(one && other);
    EXPECT_EQ(one->low, again->low);
    EXPECT_EQ(one->high, again->high);
    const double alpha = *krippendorffAlpha(kObservers, scale);
    EXPECT_LT(one->low, alpha);
    EXPECT_GT(one->high, alpha);
    EXPECT_LE(one->high, 1.0);
    EXPECT_NEAR(one->low, other->low, 0.1) << "another sample of the same";
  }
}

TEST(Agreement, IntraclassCorrelationsAreShroutAndFleissOwn) {
  const auto found = intraclassCorrelation(kJudges);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->agreement, 0.29, 5e-3);
  EXPECT_NEAR(found->consistency, 0.71, 5e-3);
  // BMS 11.24, JMS 32.49, EMS 1.02 of their table 3: (11.24 - 1.02) / (11.24 + 3 * 1.02) = 0.715.
  EXPECT_NEAR(found->consistency_interval->low, 0.34, 5e-3);
  EXPECT_NEAR(found->consistency_interval->high, 0.95, 5e-3);
  EXPECT_NEAR(found->agreement_interval->low, 0.02, 5e-3);
  EXPECT_NEAR(found->agreement_interval->high, 0.76, 5e-3);
}

TEST(Agreement, WhatEachRaterAddsCountsForAgreementAlone) {
  Ratings ratings{{1, 2, 3, 4}, {1, 2, 3, 4}};
  EXPECT_NEAR(intraclassCorrelation(ratings)->agreement, 1.0, 1e-12);
  for (auto& one : ratings[1]) *one += 3;
  const auto found = intraclassCorrelation(ratings);
  EXPECT_NEAR(found->consistency, 1.0, 1e-12);
  // BMS 10/3, JMS 18, EMS 0: (10/3) / (10/3 + 2 * 18 / 4).
  EXPECT_NEAR(found->agreement, 10.0 / 37.0, 1e-12);
}

TEST(Agreement, SaysNothingOfTooFewOrOfOneValue) {
  const Ratings missing{{kNone, kNone}, {kNone, kNone}}, equal{{3, 3}, {3, 3}}, one{{1, 2, 3}},
      apart{{1, kNone}, {kNone, 2}};
  for (const Ratings& ratings : {Ratings{}, missing, equal, one, apart, Ratings{{1}, {2}}}) {
    const bool may_have_alpha = ratings.size() == 2 && ratings.front().size() == 1;
    for (const RatingScale scale : {RatingScale::nominal, RatingScale::ordinal, RatingScale::interval}) {
      EXPECT_EQ(krippendorffAlpha(ratings, scale).has_value(), may_have_alpha);
      EXPECT_TRUE(may_have_alpha || !alphaInterval(ratings, scale, 1));
    }
    EXPECT_FALSE(intraclassCorrelation(ratings));
  }
  EXPECT_FALSE(intraclassCorrelation({{1, 2, kNone}, {1, 2, 3}})) << "one is missing";
}

TEST(Agreement, NothingIsEverNoNumber) {
  std::mt19937 random(5);
  for (int round = 0; round < 2000; ++round) {
    Ratings ratings(1 + random() % 4, std::vector<std::optional<int>>(1 + random() % 6));
    for (auto& rater : ratings)
      for (auto& value : rater)
        if (random() % 8 != 0) value = static_cast<int>(random() % (1 + random() % 5));
    const auto is_number = [](const std::optional<ValueRange>& range) {
      return !range || (std::isfinite(range->low) && std::isfinite(range->high));
    };
    for (const RatingScale scale : {RatingScale::nominal, RatingScale::ordinal, RatingScale::interval})
      if (const auto alpha = krippendorffAlpha(ratings, scale)) {
        EXPECT_TRUE(std::isfinite(*alpha) && *alpha <= 1.0);
      }
    const auto found = intraclassCorrelation(ratings);
    if (!found) continue;
    EXPECT_TRUE(std::isfinite(found->agreement) && std::isfinite(found->consistency));
    EXPECT_TRUE(is_number(found->agreement_interval) && is_number(found->consistency_interval));
  }
}

}  // namespace
}  // namespace app
