#include "app/psychophysics/staircase.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/psychophysics/psychometric_fit.h"
#include "calibration/random.h"

namespace app {
namespace {

StaircaseRule rule(int up, int down) {
  StaircaseRule r;
  r.up = up, r.down = down;
  r.low = 0.0, r.high = 10.0;
  return r;
}

TEST(Staircase, SettlesWhereLevittSaysItDoes) {
  EXPECT_NEAR(targetProbability(rule(1, 1)), 0.5, 1e-9);
  EXPECT_NEAR(targetProbability(rule(1, 2)), std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(targetProbability(rule(1, 3)), std::cbrt(0.5), 1e-9);
  EXPECT_NEAR(targetProbability(rule(2, 1)), 1.0 - std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(targetProbability(rule(3, 3)), 0.5, 1e-9);
  StaircaseRule weighted = rule(1, 1);
  weighted.up_to_down = 3.0;
  EXPECT_NEAR(targetProbability(weighted), 0.75, 1e-9);
}

TEST(Staircase, FallsAfterTwoAndRisesAfterOne) {
  Staircase track(rule(1, 2), 1.0);
  EXPECT_FALSE(track.answer(true));
  EXPECT_EQ(track.level(), 1.0);
  EXPECT_FALSE(track.answer(true));
  EXPECT_NEAR(track.level(), 0.9, 1e-12);
  EXPECT_FALSE(track.answer(true)) << "a run starts anew after a step";
  EXPECT_TRUE(track.answer(false)) << "down, then up: a reversal";
  EXPECT_NEAR(track.level(), 1.0, 1e-12);
  EXPECT_EQ(track.reversals(), 1);
}

TEST(Staircase, StepsGetSmallerAndStayWithinTheRange) {
  StaircaseRule r = rule(1, 1);
  r.kind = StepKind::ratio;
  r.steps = {2.0, 1.5, 1.1};
  r.reversals_per_step = 1;
  r.low = 0.5, r.high = 4.0;
  Staircase track(r, 1.0);
  track.answer(true);
  EXPECT_NEAR(track.level(), 0.5, 1e-12);
  track.answer(true);
  EXPECT_NEAR(track.level(), 0.5, 1e-12) << "the floor holds";
  EXPECT_TRUE(track.answer(false));
  EXPECT_NEAR(track.level(), 0.75, 1e-12);
  EXPECT_TRUE(track.answer(true));
  EXPECT_NEAR(track.level(), 0.75 / 1.1, 1e-12);
}

/// A known observer answers many tracks: the mean threshold is the level of 70.7 %.
TEST(Staircase, FindsTheLevelOf70PercentOfAKnownObserver) {
  const Psychometric known{1.0, 0.15, 0.0};
  StaircaseRule r = rule(1, 2);
  r.steps = {0.1, 0.03};
  r.reversals = 44, r.discarded = 4, r.max_trials = 2000;
  const double expected = known.pse + known.sigma * normalQuantile(targetProbability(r));
  calibration::RandomGenerator rng(11);
  constexpr int kTracks = 400;
  double sum = 0.0, squares = 0.0, said = 0.0;
  for (int n = 0; n < kTracks; ++n) {
    Staircase track(r, 1.5);
    while (!track.over()) track.answer(rng.coin(known.probability(track.level())));
    sum += track.threshold(), squares += track.threshold() * track.threshold();
    said += track.standardError() / kTracks;
  }
  const double mean = sum / kTracks, spread = std::sqrt(squares / kTracks - mean * mean);
  // Four standard errors, and the bias of a walk on steps of a fifth of sigma over a curved function.
  EXPECT_NEAR(mean, expected, 4.0 * spread / std::sqrt(kTracks) + 0.02 * known.sigma);
  EXPECT_LT(spread, 0.3 * known.sigma);
  EXPECT_GT(said, 0.3 * spread) << "the error it states is of the size of the error it makes";
  EXPECT_LT(said, 1.2 * spread);
}

TEST(Staircase, HasNoThresholdBeforeTwoReversalsAreLeft) {
  StaircaseRule r = rule(1, 1);
  r.discarded = 1;
  Staircase track(r, 1.0);
  for (const bool harder : {true, false, true}) {
    EXPECT_TRUE(std::isnan(track.threshold()));
    track.answer(harder);
  }
  track.answer(false);
  EXPECT_FALSE(std::isnan(track.threshold()));
}

}  // namespace
}  // namespace app
