#include "app/instructor/stroke_times.h"

#include <random>

#include <gtest/gtest.h>

namespace app {
namespace {

/// A stack of strokes as the servo's, told by ticks.
class StrokeTimesTest : public testing::Test {
 protected:
  void tell(bool works, double restored_mm3 = 0.0) {
    haptics::Tick tick;
    tick.t_s = 0.001 * static_cast<double>(++ticks_);
    tick.strokes = static_cast<std::uint8_t>(done_.size());
    tick.undone_strokes = static_cast<std::uint8_t>(undone_.size());
    tick.removed_mm3 = works ? 0.01 : -restored_mm3;
    restored_mm3_ += restored_mm3;
    tick.restored_total_mm3 = restored_mm3_;
    times_.follow(std::span(&tick, 1));
  }
  void cut() {
    undone_.clear();
    done_.push_back(0.001 * static_cast<double>(ticks_ + 1));
    if (done_.size() > kMost) done_.erase(done_.begin());
    tell(true);
  }
  void undo() {
    if (done_.empty()) return;
    undone_.push_back(done_.back());
    done_.pop_back();
    tell(false, 0.5);
  }
  void redo() {
    if (undone_.empty()) return;
    done_.push_back(undone_.back());
    undone_.pop_back();
    tell(false, -0.5);
  }
  std::vector<double> expected() const {
    std::vector<double> all = done_;
    all.insert(all.end(), undone_.rbegin(), undone_.rend());
    return all;
  }

  static constexpr std::size_t kMost = 1000;
  StrokeTimes times_;
  std::vector<double> done_, undone_;
  std::uint64_t ticks_ = 0;
  double restored_mm3_ = 0.0;
};

TEST_F(StrokeTimesTest, FollowTheServosStack) {
  std::mt19937 random(4);
  for (int n = 0; n < 1500; ++n) {
    const unsigned kind = random() % 8;
    if (kind < 3 && done_.size() < 200)
      cut();
    else if (kind < 6)
      undo();
    else
      redo();
    tell(false);
    ASSERT_EQ(times_.done(), done_.size());
    ASSERT_EQ(times_.begun_s(), expected());
  }
}

TEST_F(StrokeTimesTest, ForgetWhatTheServoHasDropped) {
  for (int n = 0; n < 5; ++n) cut();
  done_.erase(done_.begin(), done_.begin() + 2);
  tell(false);
  EXPECT_EQ(times_.begun_s(), expected());
  EXPECT_EQ(times_.done(), 3u);
}

TEST(RequestsForStrokes, AreAsManyAsLieBetween) {
  EXPECT_TRUE(requestsForStrokes(3, 3).empty());
  EXPECT_EQ(requestsForStrokes(5, 3), (std::vector<ControlRequest>(2, {Control::undo, kNoValue})));
  EXPECT_EQ(requestsForStrokes(0, 4), (std::vector<ControlRequest>(4, {Control::redo, kNoValue})));
}

}  // namespace
}  // namespace app
