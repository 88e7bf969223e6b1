#include "render/quality_ladder.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>

namespace render {
namespace {

constexpr double kBudget_s = 1.0 / 60.0;

// A machine that draws the worst step in `worst_s`, and better ones with the relative costs of the table.
double machine_s(int step, double worst_s) {
  double time_s = worst_s;
  for (int s = static_cast<int>(kQualitySteps.size()) - 1; s > step; --s)
    time_s *= kQualitySteps[static_cast<std::size_t>(s)].climb_cost;
  return time_s;
}

struct Trace {
  int changes = 0;
  double seconds = 0.0;
};

Trace drive(
    QualityLadder& ladder, double for_s, const std::function<double(int)>& frame_s,
    const std::function<bool(double)>& may_change = [](double) { return true; }) {
  Trace trace;
  while (trace.seconds < for_s) {
    const double took_s = frame_s(ladder.step());
    trace.seconds += std::max(took_s, kBudget_s);
    trace.changes += ladder.add(took_s, may_change(trace.seconds)) ? 1 : 0;
  }
  return trace;
}

TEST(QualityLadder, AFastMachineStaysAtTheTop) {
  QualityLadder ladder(kBudget_s);
  EXPECT_EQ(drive(ladder, 60.0, [](int) { return 0.004; }).changes, 0);
  EXPECT_EQ(ladder.step(), 0);
}

TEST(QualityLadder, ASlowMachineEndsAtTheBestStepWithinItsBudget) {
  for (const double worst_s : {0.0004, 0.001, 0.002, 0.004, 0.008, 0.016, 0.1}) {
    QualityLadder ladder(kBudget_s);
    drive(ladder, 30.0, [&](int step) { return machine_s(step, worst_s); });
    const int last = static_cast<int>(kQualitySteps.size()) - 1;
    EXPECT_TRUE(ladder.step() == last || machine_s(ladder.step(), worst_s) <= 1.05 * kBudget_s) << worst_s;
    EXPECT_TRUE(ladder.step() == 0 || machine_s(ladder.step() - 1, worst_s) > 0.85 * kBudget_s) << worst_s;
  }
}

TEST(QualityLadder, GoesDownWithinAFewFramesAndClimbsAfterSeconds) {
  QualityLadder ladder(kBudget_s);
  int frames = 0;
  while (!ladder.add(0.030, true)) ++frames;
  EXPECT_LE(frames, 10);
  EXPECT_EQ(ladder.step(), 1);
  double waited_s = 0.0;
  while (!ladder.add(0.002, true)) waited_s += kBudget_s;
  EXPECT_EQ(ladder.step(), 0);
  EXPECT_GT(waited_s, 1.5);
  EXPECT_LT(waited_s, 4.0);
}

// Without a graphics card the first frames take 0.1 s and more: nine of them would be too long to wait.
TEST(QualityLadder, GoesDownSeveralStepsAfterThreeVeryLateFrames) {
  QualityLadder ladder(kBudget_s);
  int frames = 1;
  while (!ladder.add(1.0, true)) ++frames;
  EXPECT_EQ(frames, 3);
  EXPECT_EQ(ladder.step(), static_cast<int>(kQualitySteps.size()) - 1);
}

TEST(QualityLadder, OneSlowFrameChangesNothing) {
  QualityLadder ladder(kBudget_s);
  int n = 0;
  EXPECT_EQ(drive(ladder, 30.0, [&](int) { return ++n % 20 == 0 ? 0.5 : 0.008; }).changes, 0);
}

// Between two steps it must not oscillate: the waits double.
TEST(QualityLadder, DoesNotOscillateBetweenTwoSteps) {
  QualityLadder ladder(kBudget_s);
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, 0.1);
  // The better step costs more than the table says: every climb fails.
  const auto frame_s = [&](int step) { return (step == 0 ? 0.020 : 0.008) * (1.0 + noise(random)); };
  const int first_minute = drive(ladder, 60.0, frame_s).changes, later = drive(ladder, 240.0, frame_s).changes;
  EXPECT_LE(first_minute, 13);
  EXPECT_LE(later, 10);
}

// Without a graphics card a frame has a large part that no step saves. The table's costs alone forbade the way back.
TEST(QualityLadder, ClimbsAgainAfterABusyMomentWhereStepsSaveLittle) {
  for (const double load : {1.6, 2.0, 4.0}) {
    QualityLadder ladder(kBudget_s);
    const auto calm_s = [](int step) { return 0.0135 - 0.0004 * step; };
    drive(ladder, 5.0, [&](int step) { return load * calm_s(step); });
    EXPECT_EQ(ladder.step(), static_cast<int>(kQualitySteps.size()) - 1) << "busy";
    drive(ladder, 60.0, calm_s);
    EXPECT_EQ(ladder.step(), 0) << load;
  }
}

// Learning never makes a step seem dearer than the table, and a machine as the table has it behaves as before.
TEST(QualityLadder, ForgetsNothingOfTheTableOnAMachineThatOnlyDraws) {
  QualityLadder ladder(kBudget_s);
  drive(ladder, 5.0, [](int step) { return machine_s(step, 0.01); });
  const int settled = ladder.step();
  EXPECT_EQ(drive(ladder, 120.0, [](int step) { return machine_s(step, 0.01); }).changes, 0);
  EXPECT_EQ(ladder.step(), settled);
}

TEST(QualityLadder, NeverChangesDuringAStrokeAndChangesRightAfterIt) {
  QualityLadder ladder(kBudget_s);
  const Trace stroke = drive(
      ladder, 20.0, [](int) { return 0.050; }, [](double) { return false; });
  EXPECT_EQ(stroke.changes, 0);
  EXPECT_EQ(ladder.step(), 0);
  EXPECT_TRUE(ladder.add(0.050, true)) << "the stroke is over";
  // The same upwards.
  QualityLadder low(kBudget_s, 3);
  EXPECT_EQ(drive(
                low, 20.0, [](int) { return 0.001; }, [](double) { return false; })
                .changes,
            0);
  EXPECT_TRUE(low.add(0.001, true));
}

TEST(QualityLadder, EveryStepIsCheaperThanTheOneAbove) {
  for (std::size_t s = 1; s < kQualitySteps.size(); ++s) {
    EXPECT_GT(kQualitySteps[s].climb_cost, 1.0);
    const Quality &above = kQualitySteps[s - 1].quality, &here = kQualitySteps[s].quality;
    EXPECT_TRUE(here.step_voxels > above.step_voxels || here.pixel_edge > above.pixel_edge ||
                here.antialias < above.antialias || here.ambient_occlusion < above.ambient_occlusion ||
                here.lamp_shadow < above.lamp_shadow);
  }
}

}  // namespace
}  // namespace render
