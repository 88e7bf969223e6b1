#include "app/psychophysics/psychometric_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "calibration/random.h"

namespace app {
namespace {

std::vector<LevelCount> answers(const Psychometric& observer, int trials, std::uint64_t seed) {
  calibration::RandomGenerator chance(seed);
  std::vector<LevelCount> counts;
  for (const double level : {0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1}) {
    LevelCount count{level, trials, 0};
    for (int i = 0; i < trials; ++i) count.harder += chance.coin(observer.probability(level)) ? 1 : 0;
    counts.push_back(count);
  }
  return counts;
}

TEST(PsychometricFit, KnowsTheNormalDistribution) {
  EXPECT_NEAR(normalCdf(0.0), 0.5, 1e-15);
  EXPECT_NEAR(normalCdf(1.0), 0.8413447460685429, 1e-14);
  EXPECT_NEAR(normalQuantile(0.75), 0.6744897501960817, 1e-12);
  EXPECT_NEAR(normalQuantile(0.975), 1.959963984540054, 1e-12);
}

TEST(PsychometricFit, ReturnsTheFunctionOfAnswersWithoutChance) {
  const Psychometric known{0.83, 0.17, 0.0};
  std::vector<LevelCount> counts;
  for (const double level : {0.5, 0.7, 0.9, 1.1})
    counts.push_back({level, 1'000'000, static_cast<int>(std::lround(1e6 * known.probability(level)))});
  const auto found = fitPsychometric(counts);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->pse, known.pse, 1e-3);
  EXPECT_NEAR(found->sigma, known.sigma, 1e-3);
  EXPECT_NEAR(found->probability(found->pse + found->jnd()), 0.75, 1e-3);
  EXPECT_NEAR(found->jnd(), found->sigma * normalQuantile(0.75), 1e-12);
}

/// Seen from many experiments: no bias beyond chance, and intervals that hold the truth as often as they say.
TEST(PsychometricFit, CoversTheTruthAsOftenAsItSays) {
  const Psychometric known{0.8, 0.16, 0.0};
  constexpr int kExperiments = 120;
  int pse_held = 0, jnd_held = 0;
  double pse_sum = 0.0, jnd_sum = 0.0;
  for (std::uint64_t n = 0; n < kExperiments; ++n) {
    const auto fit = fitWithIntervals(answers(known, 40, n), 200, n, 0.0);
    ASSERT_TRUE(fit);
    pse_sum += fit->function.pse / kExperiments, jnd_sum += fit->function.jnd() / kExperiments;
    pse_held += fit->pse_95.low <= known.pse && known.pse <= fit->pse_95.high;
    jnd_held += fit->jnd_95.low <= known.jnd() && known.jnd() <= fit->jnd_95.high;
  }
  EXPECT_NEAR(pse_sum, known.pse, 0.005);
  EXPECT_NEAR(jnd_sum, known.jnd(), 0.05 * known.jnd());
  // 95 % of 120, less three standard deviations of chance and the small-sample shortfall of percentiles.
  EXPECT_GE(pse_held, 105);
  EXPECT_GE(jnd_held, 102);
}

TEST(PsychometricFit, FittingLapsesKeepsTheSlope) {
  const Psychometric lapsing{0.8, 0.1, 0.03};
  double fitted = 0.0, ignored = 0.0;
  constexpr int kExperiments = 20;
  for (std::uint64_t n = 0; n < kExperiments; ++n) {
    const auto counts = answers(lapsing, 200, 100 + n);
    fitted += fitPsychometric(counts)->sigma / kExperiments;
    ignored += fitPsychometric(counts, 0.0)->sigma / kExperiments;
  }
  EXPECT_NEAR(fitted, lapsing.sigma, 0.005);
  EXPECT_GT(ignored, lapsing.sigma + 0.01);
}

TEST(PsychometricFit, HasNoneWhereAnswersKnowNoSlope) {
  EXPECT_FALSE(fitPsychometric({}));
  EXPECT_FALSE(fitPsychometric({{0.8, 20, 10}}));
  EXPECT_FALSE(fitPsychometric({{0.7, 20, 20}, {0.9, 20, 20}}));
  EXPECT_FALSE(fitPsychometric({{0.7, 20, 15}, {0.9, 20, 5}}));
}

TEST(PsychometricFit, StaysFiniteForAnswersThatChangeAtOnce) {
  const auto found = fitPsychometric({{0.7, 20, 0}, {0.8, 20, 0}, {0.9, 20, 20}, {1.0, 20, 20}});
  ASSERT_TRUE(found);
  EXPECT_GT(found->pse, 0.8);
  EXPECT_LT(found->pse, 0.9);
  EXPECT_GT(found->sigma, 0.0);
  EXPECT_LT(found->sigma, 0.05);
}

TEST(PsychometricFit, DoubtsACurveThatIsNone) {
  // Alternating answers on a rising trend.
  const auto fit = fitWithIntervals({{0.5, 60, 0}, {0.6, 60, 45}, {0.7, 60, 5}, {0.8, 60, 55}, {0.9, 60, 30}}, 200, 5);
  ASSERT_TRUE(fit);
  EXPECT_LT(fit->deviance_p_value, 0.01);
}

TEST(PsychometricFit, GivesWilsonsInterval) {
  const Interval half = wilson95(5, 10);
  EXPECT_NEAR(half.low, 0.2366, 1e-4);
  EXPECT_NEAR(half.high, 0.7634, 1e-4);
  EXPECT_EQ(wilson95(0, 0).high, 1.0);
}

}  // namespace
}  // namespace app
