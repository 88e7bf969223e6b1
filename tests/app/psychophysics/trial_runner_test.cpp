#include "app/psychophysics/trial_runner.h"

#include <gtest/gtest.h>

namespace app {
namespace {

/// A person at the window: feels, answers, waits. Bone is flat at z = 0, the bur a sphere of 2 mm.
class AtTheDesk : public testing::Test {
 protected:
  AtTheDesk() {
    protocol_.parameter = "stiffness_N_per_mm";
    protocol_.levels = {0.5, 1.2};
    protocol_.trials = 2;
    experiment_.emplace(protocol_, 3);
    desk_.emplace(*experiment_, ProbeSite{}, 1.0, [this](const TrialRecord& r) { records_.push_back(r); });
  }
  std::optional<haptics::Command> at(double t_s, double depth_mm = -1.0, double force_N = 0.0) {
    haptics::Tick tick;
    tick.t_s = t_s;
    tick.command_serial = serial_;
    tick.hand.X_PT.translation_mm = {0.0, 0.0, 2.0 - depth_mm};
    tick.commanded_force_P_N = {{0.0, 0.0, force_N}};
    const auto wanted = desk_->follow({&tick, 1});
    if (wanted) ++serial_;
    return wanted;
  }
  /// Presses once into what is felt now, at `stiffness`.
  void feel(double t_s, double stiffness_N_per_mm) {
    for (int n = 0; n <= 10; ++n) at(t_s + 0.01 * n, 0.1 * n, 0.1 * n * stiffness_N_per_mm);
  }

  Protocol protocol_;
  std::optional<Experiment> experiment_;
  std::optional<TrialRunner> desk_;
  std::vector<TrialRecord> records_;
  std::uint64_t serial_ = 0;
};

TEST_F(AtTheDesk, EachKeyPutsItsStimulusIntoTheHand) {
  const auto first = at(0.0);
  ASSERT_TRUE(first);
  EXPECT_FALSE(first->drill_enabled) << "the bone stays as it is";
  EXPECT_FALSE(at(0.1)) << "nothing new until a key";
  EXPECT_TRUE(desk_->takeKey('2'));
  const auto second = at(0.2);
  ASSERT_TRUE(second);
  EXPECT_NE(first->law.agus.stiffness_N_per_mm, second->law.agus.stiffness_N_per_mm);
  EXPECT_FALSE(desk_->takeKey('Q')) << "turning the handpiece is not the desk's";
}

TEST_F(AtTheDesk, TakesAnAnswerOnlyOnceBothWereFelt) {
  at(0.0);
  feel(0.1, 0.5);
  EXPECT_TRUE(desk_->takeKey('A'));
  EXPECT_TRUE(records_.empty());
  EXPECT_NE(desk_->messages().to_surgeon.find("feel both first"), std::string::npos);
  desk_->takeKey('2');
  at(0.4);
  feel(0.5, 1.0);
  EXPECT_TRUE(desk_->takeKey('B'));
  ASSERT_EQ(records_.size(), 1u);
  const TrialRecord& r = records_[0];
  EXPECT_EQ(r.comparison_harder, !r.comparison_first) << "B is the second";
  const ProbeMeasures& second = r.comparison_first ? r.standard_measures : r.comparison_measures;
  EXPECT_NEAR(second.stiffness_N_per_mm, 1.0, 1e-9);
  EXPECT_GT(*r.response_s, 0.5);
}

TEST_F(AtTheDesk, PausesBetweenTrialsAndEndsAfterTheLast) {
  double t_s = 0.0;
  for (int trial = 1; trial <= 4; ++trial) {
    ASSERT_FALSE(desk_->isOver());
    ASSERT_TRUE(at(t_s += 1.1)) << "the next trial begins with its first stimulus";
    feel(t_s += 0.1, 1.0);
    desk_->takeKey('2');
    at(t_s += 0.2);
    feel(t_s += 0.1, 1.0);
    desk_->takeKey('A');
    EXPECT_EQ(records_.size(), static_cast<std::size_t>(trial));
    if (trial == 4) break;
    EXPECT_FALSE(at(t_s += 0.5));
    desk_->takeKey('2');
    EXPECT_FALSE(at(t_s += 0.2)) << "no stimulus during the pause";
  }
  EXPECT_TRUE(desk_->isOver());
  EXPECT_FALSE(at(t_s + 5.0));
}

TEST_F(AtTheDesk, KeepsWhatIsFeltToItselfAndLeavesTheRest) {
  for (const char* felt : {"law:agus", "drill", "tool", "irrigation", "undo"})
    EXPECT_TRUE(desk_->take(requestFrom(felt))) << felt;
  for (const char* else_wished : {"end", "stop", "arm", "snapshot", "layer:slices"})
    EXPECT_FALSE(desk_->take(requestFrom(else_wished))) << else_wished;
}

TEST_F(AtTheDesk, MissesNoTickOfThoseItIsShown) {
  at(0.0);
  std::vector<haptics::Tick> ticks(10);
  for (std::size_t n = 0; n < ticks.size(); ++n) {
    ticks[n].t_s = 0.1 + 0.001 * static_cast<double>(n);
    ticks[n].command_serial = serial_;
    ticks[n].commanded_force_P_N = {{0.0, 0.0, n == 4 ? 1.0 : 0.0}};
  }
  EXPECT_EQ(desk_->messages().to_instructor, "trial 1, felt: none");
  EXPECT_FALSE(desk_->follow(ticks));
  EXPECT_EQ(desk_->messages().to_instructor, "trial 1, felt: A") << "touched in between only";
}

TEST_F(AtTheDesk, CountsNothingFeltUnderTheCommandBefore) {
  haptics::Tick late;
  late.commanded_force_P_N = {{0.0, 0.0, 1.0}};
  const std::vector<haptics::Tick> before(5, late);
  ASSERT_TRUE(desk_->follow(before));
  EXPECT_FALSE(desk_->follow(before));
  EXPECT_EQ(desk_->messages().to_instructor, "trial 1, felt: none");
}

TEST_F(AtTheDesk, TellsNothingOfWhatIsFelt) {
  at(0.0);
  feel(0.1, 1.0);
  for (const char* telling : {"agus", "0.8", "0.5", "1.2", "N", "standard", "comparison"})
    for (const std::string& line : {desk_->messages().to_surgeon, desk_->messages().to_instructor})
      EXPECT_EQ(line.find(telling), std::string::npos) << line;
}

}  // namespace
}  // namespace app
