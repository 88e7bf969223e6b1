#include "app/psychophysics/experiment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "app/psychophysics/probed_bone.h"
#include "app/psychophysics/summary.h"

namespace app {
namespace {

Protocol stiffnessProtocol() {
  Protocol protocol;
  protocol.participant = "T1";
  protocol.parameter = "stiffness_N_per_mm";
  protocol.unit = "N/mm";
  protocol.levels = {0.6, 0.7, 0.8, 0.9, 1.0};
  protocol.trials = 20;
  protocol.bone.voxel_mm = 0.25;
  protocol.tool.head.radius_mm = 1.5;
  protocol.probe.duration_s = 0.15;
  protocol.probe.reach_mm = 1.0;
  return protocol;
}

TEST(TrialOrder, HoldsEveryLevelInBothOrdersEquallyOften) {
  const Protocol protocol = stiffnessProtocol();
  TrialOrder order(protocol, 3);
  std::map<std::pair<double, bool>, int> seen;
  int in_block = 0, comparison_first = 0;
  while (const auto trial = order.next()) {
    ++seen[{trial->level, trial->comparison_first}];
    comparison_first += trial->comparison_first;
    // Balanced along the way too, not only at the end.
    if (++in_block % 10 == 0) {
      EXPECT_EQ(2 * comparison_first, in_block);
    }
    order.answer(true);
  }
  EXPECT_EQ(in_block, 100);
  EXPECT_EQ(order.most(), 100);
  ASSERT_EQ(seen.size(), 10u);
  for (const auto& [what, times] : seen) EXPECT_EQ(times, 10) << what.first;
}

TEST(TrialOrder, SharesOutAnOddRepetition) {
  Protocol protocol = stiffnessProtocol();
  protocol.trials = 3;
  TrialOrder order(protocol, 9);
  int first = 0, all = 0;
  while (const auto trial = order.next()) first += trial->comparison_first, ++all;
  EXPECT_EQ(all, 15);
  EXPECT_NEAR(first, 7.5, 0.6);
}

TEST(TrialOrder, IsTheSeedsAndNoOthers) {
  const Protocol protocol = stiffnessProtocol();
  const auto levels = [&](std::uint64_t seed) {
    TrialOrder order(protocol, seed);
    std::vector<double> list;
    while (const auto trial = order.next()) list.push_back(trial->level + (trial->comparison_first ? 10.0 : 0.0));
    return list;
  };
  EXPECT_EQ(levels(4), levels(4));
  EXPECT_NE(levels(4), levels(5));
}

TEST(TrialOrder, MixesTracksUntilEachIsOver) {
  Protocol protocol = stiffnessProtocol();
  protocol.method = Method::staircase;
  protocol.levels = {1.3, 1.2, 0.9};
  protocol.staircase.low = 0.0, protocol.staircase.high = 5.0;
  TrialOrder order(protocol, 2);
  calibration::RandomGenerator rng(1);
  int trials = 0, first = 0, switches = 0;
  std::size_t last = 0;
  while (const auto trial = order.next()) {
    first += trial->comparison_first;
    switches += trial->track != last;
    last = trial->track;
    order.answer(rng.coin(0.7));
    if (++trials % 8 == 0) {
      EXPECT_EQ(2 * first, trials);
    }
  }
  for (const Staircase& track : order.tracks()) EXPECT_TRUE(track.over());
  EXPECT_GT(switches, trials / 3);
}

TEST(ProbeMeasures, StiffnessIsTheSlopeAndWorkTheArea) {
  // In and out along F = 0.8 h, 1 mm deep; nothing above the surface.
  std::vector<ProbeSample> samples;
  for (int i = -100; i <= 100; ++i) {
    const double depth_mm = 1.0 - std::abs(i) * 0.015;
    samples.push_back({depth_mm, 0.8 * std::max(0.0, depth_mm)});
  }
  const ProbeMeasures felt = measuresOf(samples);
  EXPECT_NEAR(felt.stiffness_N_per_mm, 0.8, 1e-12);
  EXPECT_NEAR(felt.peak_force_N, 0.8, 1e-12);
  EXPECT_NEAR(felt.depth_mm, 1.0, 1e-12);
  EXPECT_NEAR(felt.work_Nmm, 0.0, 1e-12) << "what goes in comes out";
  EXPECT_EQ(measuresOf({}).stiffness_N_per_mm, 0.0);
}

TEST(Probe, FeelsTheStiffnessOfTheLawOnFlatBone) {
  Protocol protocol = stiffnessProtocol();
  protocol.bone.voxel_mm = 0.15;
  for (const Motion motion : {Motion::tap, Motion::press, Motion::stroke, Motion::free}) {
    protocol.probe.motion = motion;
    protocol.probe.duration_s = 0.3;
    const ProbedBone bone = probedBone(protocol);
    haptics::Bodies live(bone.patient.ct.grid, bone.patient.ct.solid, bone.patient.ct.label);
    const std::uint64_t before = live.digest();
    haptics::Command command;
    command.tool = protocol.tool;
    command.law = protocol.comparisonAt(0.6);
    calibration::RandomGenerator hand(5);
    const ProbeMeasures felt = measuresOf(probe(live, bone.site, command, protocol.probe, hand));
    EXPECT_NEAR(felt.stiffness_N_per_mm, 0.6, 0.015) << static_cast<int>(motion);
    EXPECT_GT(felt.depth_mm, 0.2);
    EXPECT_EQ(live.digest(), before) << "probing does not drill";
  }
}

TEST(Observer, HasTheWeberFractionItIsGiven) {
  ObserverSettings settings;
  settings.lapse_rate = 0.0;
  SimulatedObserver observer(settings, 1);
  constexpr int kTrials = 40000;
  int harder = 0;
  ProbeMeasures standard, comparison;
  standard.stiffness_N_per_mm = 1.0, comparison.stiffness_N_per_mm = 1.0 + settings.weber_fraction;
  for (int n = 0; n < kTrials; ++n) harder += observer.secondHarder(standard, comparison);
  // Both intervals are noisy in proportion, so the larger is a little noisier than the standard: 73.5 %, not 75 %.
  const double nu = noiseShare(settings), d = settings.weber_fraction;
  const double expected = normalCdf(d / (nu * std::sqrt(1.0 + (1.0 + d) * (1.0 + d))));
  EXPECT_NEAR(expected, 0.735, 0.002);
  EXPECT_NEAR(static_cast<double>(harder) / kTrials, expected, 0.009);
}

TEST(Observer, LapsesAreCoinsAndShiftNothing) {
  ObserverSettings settings;
  settings.weber_fraction = 0.0;
  settings.lapse_rate = 0.2;
  SimulatedObserver observer(settings, 1);
  ProbeMeasures soft, hard;
  soft.stiffness_N_per_mm = 0.5, hard.stiffness_N_per_mm = 1.0;
  int wrong = 0;
  for (int n = 0; n < 20000; ++n) wrong += observer.secondHarder(hard, soft);
  EXPECT_NEAR(wrong / 20000.0, 0.1, 0.01);
}

/// End to end: servo, hand, observer, order, fit. An observer of Weber fraction 0.15 is found to have one.
TEST(Experiment, FindsTheWeberFractionOfItsObserver) {
  Protocol protocol = stiffnessProtocol();
  protocol.levels = {0.6, 0.7, 0.8, 0.9, 1.0};
  protocol.trials = 80;
  protocol.observer.lapse_rate = 0.0;
  protocol.probe.wander_mm = 0.0;
  const ProbedBone bone = probedBone(protocol);
  haptics::Bodies live(bone.patient.ct.grid, bone.patient.ct.solid, bone.patient.ct.label);
  std::vector<TrialRecord> trials;
  const Experiment experiment = runSimulated(protocol, live, bone.site, 21,
                                             [&](const TrialRecord& t, const Experiment&) { trials.push_back(t); });
  const Outcome outcome = outcomeOf(protocol, experiment, trials, true, 1);
  ASSERT_TRUE(outcome.fit);
  const PsychometricFit& fit = *outcome.fit;
  EXPECT_LE(fit.jnd_95.low, 0.15 * 0.8);
  EXPECT_GE(fit.jnd_95.high, 0.15 * 0.8);
  EXPECT_NEAR(*weberFraction(protocol, outcome), 0.15, 0.04);
  EXPECT_NEAR(fit.function.pse, 0.8, 0.05);
  for (const TrialRecord& t : trials)
    EXPECT_EQ(t.correct.has_value(), t.comparison != t.standard) << "equal stimuli have no right answer";
}

/// Tracks of 1 up 2 down settle at 70.7 %; with the standard in the middle that is a JND too.
TEST(Experiment, FindsTheWeberFractionByStaircases) {
  Protocol protocol = stiffnessProtocol();
  protocol.method = Method::staircase;
  protocol.levels = {1.1, 1.0, 1.1, 1.0};
  protocol.staircase.low = 0.0, protocol.staircase.high = 5.0;
  protocol.staircase.steps = {0.08, 0.04};
  protocol.staircase.reversals = 24;
  protocol.observer.lapse_rate = 0.0;
  protocol.probe.wander_mm = 0.0;
  const ProbedBone bone = probedBone(protocol);
  haptics::Bodies live(bone.patient.ct.grid, bone.patient.ct.solid, bone.patient.ct.label);
  std::vector<TrialRecord> trials;
  const Experiment experiment =
      runSimulated(protocol, live, bone.site, 4, [&](const TrialRecord& t, const Experiment&) { trials.push_back(t); });
  const Outcome outcome = outcomeOf(protocol, experiment, trials, true, 1);
  ASSERT_TRUE(outcome.threshold);
  EXPECT_NEAR(*weberFraction(protocol, outcome), 0.15, 0.06);
}

}  // namespace
}  // namespace app
