#include "app/evaluation/task_watch.h"

#include <gtest/gtest.h>

namespace app {
namespace {

constexpr double kDt_s = 0.001;

TaskTemplate taskWith(const std::string& success, const std::string& fail = "", double hold_s = 0.0) {
  TaskTemplate task;
  task.id = "task", task.time_box_s = 0.5, task.hold_s = hold_s;
  task.success = Rule::from(success, ruleMeasures());
  if (!fail.empty()) task.fail = Rule::from(fail, ruleMeasures());
  return task;
}

/// Ticks from 100 on; `removed` says what each of them removes.
template <class Removed>
std::vector<RuleFired> firedBy(const TaskTemplate& task, int ticks, const Removed& removed) {
  static const assets::RiskStructures kNone;
  TaskWatch watch(task, kNone);
  std::vector<RuleFired> fired;
  for (int n = 0; n < ticks; ++n) {
    haptics::Tick tick;
    tick.index = 100 + static_cast<std::uint64_t>(n);
    tick.t_s = kDt_s * static_cast<double>(tick.index), tick.dt_s = kDt_s;
    tick.removed_mm3 = removed(n);
    if (const auto rule = watch.add(tick, {})) fired.push_back(*rule);
  }
  return fired;
}

TEST(TaskWatch, FiresAtTheTickThatMakesARuleTrue) {
  // 0.1 mm3 a tick: 2 mm3 after twenty, the rounding of their sum aside.
  const auto fired = firedBy(taskWith("O1.removed > 1.95 mm3"), 100, [](int) { return 0.1; });
  ASSERT_EQ(fired.size(), 1u);
  EXPECT_EQ(fired[0].verdict, RuleVerdict::success);
  EXPECT_EQ(fired[0].tick, 119u);
  EXPECT_EQ(fired[0].told_at, 119u);
  EXPECT_NEAR(fired[0].time_s, 0.020, 1e-12);
}

TEST(TaskWatch, ARuleHasToHoldAndTellsItsFirstTick) {
  // True in ticks 10 to 14 and again from 30 on.
  const auto removed = [](int n) { return n == 10 ? 1.0 : n == 15 ? -1.0 : n == 30 ? 1.0 : 0.0; };
  const auto fired = firedBy(taskWith("O1.removed > 0.5 mm3", "", 0.010), 100, removed);
  ASSERT_EQ(fired.size(), 1u);
  EXPECT_EQ(fired[0].tick, 130u);
  EXPECT_EQ(fired[0].told_at, 140u);
}

TEST(TaskWatch, FailureWinsOverSuccess) {
  const auto fired = firedBy(taskWith("time > 0.01 s", "time > 0.01 s"), 50, [](int) { return 0.0; });
  ASSERT_EQ(fired.size(), 1u);
  EXPECT_EQ(fired[0].verdict, RuleVerdict::failed);
}

TEST(TaskWatch, TheTimeBoxEndsOnceAndRulesGoOn) {
  const auto fired = firedBy(taskWith("time > 0.6 s"), 1000, [](int) { return 0.0; });
  ASSERT_EQ(fired.size(), 2u);
  EXPECT_EQ(fired[0].verdict, RuleVerdict::time_box);
  EXPECT_EQ(fired[0].tick, 100u + 499u);
  EXPECT_EQ(fired[1].verdict, RuleVerdict::success);
}

TEST(TaskWatch, EveryMeasureOfARuleCanBeAsked) {
  for (const RuleMeasure& one : ruleMeasures()) {
    const std::string text = std::string(one.id) + " >= 0" + (one.unit.empty() ? "" : " " + std::string(one.unit));
    EXPECT_NO_THROW(Rule::from(text, ruleMeasures())) << text;
    EXPECT_FALSE(firedBy(taskWith("time > 0.1 s or " + text), 200, [](int) { return 0.0; }).empty()) << text;
  }
}

}  // namespace
}  // namespace app
