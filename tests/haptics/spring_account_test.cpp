#include "haptics/servo/spring_account.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace haptics {
namespace {

constexpr double kStiffness_N_per_mm = 0.25, kMax_N = 0.8;

/// A hand on a line and a spring from `end_mm` to it; the force on the hand is that of covered_mm.
class Line {
 public:
  /// The force felt. A positive deflection pushes the hand to greater x.
  double tick(double hand_mm, double end_mm) {
    const double drawn_mm = end_mm - hand_mm, along = drawn_mm < 0.0 ? -1.0 : 1.0;
    const double moved_mm = hand_mm - hand_mm_;
    const double last_work_Nmm = force_N_ * moved_mm;
    const double covered_mm = account_.covered_mm(std::abs(drawn_mm), last_work_Nmm, along * moved_mm);
    share_ = drawn_mm == 0.0 ? 1.0 : covered_mm / std::abs(drawn_mm);
    const double force_N = along * account_.force_N(covered_mm);
    const double work_Nmm = 0.5 * (last_work_Nmm + force_N * moved_mm);
    account_.close(work_Nmm, std::abs(drawn_mm));
    put_in_Nmm_ -= work_Nmm;
    hand_mm_ = hand_mm, force_N_ = force_N;
    return force_N;
  }
  double put_in_Nmm() const { return put_in_Nmm_; }
  double share() const { return share_; }
  const SpringAccount& account() const { return account_; }

 private:
  SpringAccount account_{kStiffness_N_per_mm, kMax_N};
  double hand_mm_ = 0.0, force_N_ = 0.0, put_in_Nmm_ = 0.0, share_ = 1.0;
};

TEST(SpringAccount, ForceIsTheSlopeOfWhatIsStored) {
  const SpringAccount spring(kStiffness_N_per_mm, kMax_N);
  EXPECT_EQ(spring.force_N(0.0), 0.0);
  EXPECT_EQ(spring.stored_Nmm(0.0), 0.0);
  EXPECT_NEAR(spring.force_N(0.01), 0.01 * kStiffness_N_per_mm, 1e-5);
  EXPECT_NEAR(spring.force_N(100.0), kMax_N, 1e-9);
  for (double d_mm = 0.1; d_mm < 20.0; d_mm += 0.7)
    EXPECT_NEAR((spring.stored_Nmm(d_mm + 1e-4) - spring.stored_Nmm(d_mm - 1e-4)) / 2e-4, spring.force_N(d_mm), 1e-7);
}

TEST(SpringAccount, LeavesASpringWithAFixedEndAlone) {
  Line line;
  for (int press = 0; press < 3; ++press)
    for (const double way : {-1.0, 1.0})
      for (int n = 0; n <= 200; ++n) {
        line.tick(way < 0.0 ? -0.05 * n : -0.05 * (200 - n), 0.0);
        ASSERT_EQ(line.share(), 1.0) << press << " " << way << " " << n;
      }
}

/// The end runs away while the hand rests: nobody put anything in.
TEST(SpringAccount, GivesNothingForAnEndThatMovesByItself) {
  Line line;
  for (int n = 0; n < 100; ++n) line.tick(0.0, 0.05 * n);
  for (int n = 0; n < 400; ++n) line.tick(0.01 * n, 5.0);
  EXPECT_GE(line.put_in_Nmm(), -1.01 * SpringAccount::kTolerance_Nmm);
}

TEST(SpringAccount, GivesBackWhatWasPutInThoughTheEndMovesOn) {
  Line line;
  for (int n = 0; n <= 100; ++n) line.tick(-0.02 * n, 0.0);
  const double put_in_Nmm = line.put_in_Nmm();
  EXPECT_NEAR(put_in_Nmm, SpringAccount(kStiffness_N_per_mm, kMax_N).stored_Nmm(2.0), 1e-3);
  // A moving belt: the end keeps its distance from a hand that goes along with the force.
  for (int n = 0; n < 3000; ++n) line.tick(-2.0 + 0.02 * n, 0.02 * n);
  EXPECT_NEAR(line.put_in_Nmm(), 0.0, 0.005) << "all of it, and no more";
}

TEST(SpringAccount, AnyWalkOfHandAndEndGivesNoMoreThanWasPutInAndOneTick) {
  for (std::uint32_t seed = 1; seed <= 50; ++seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    Line line;
    double hand_mm = 0.0, end_mm = 0.0, most_mm = 0.0;
    for (int n = 0; n < 5000; ++n) {
      const double by_mm = 0.05 * normal(random);
      hand_mm += by_mm, end_mm += 0.05 * normal(random);
      most_mm = std::max(most_mm, std::abs(by_mm));
      const double force_N = line.tick(hand_mm, end_mm);
      ASSERT_LE(std::abs(force_N), kMax_N);
      ASSERT_GE(line.put_in_Nmm(), -SpringAccount::kTolerance_Nmm - 0.5 * kMax_N * most_mm) << seed << " " << n;
      ASSERT_LE(line.account().balance_Nmm(), line.put_in_Nmm() + 1e-9) << "what was lost is no credit";
    }
  }
}

}  // namespace
}  // namespace haptics
