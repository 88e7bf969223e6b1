#include "app/evaluation/task_order.h"

#include <map>
#include <set>

#include <gtest/gtest.h>

namespace app {
namespace {

TEST(TaskOrder, WilliamsSquareIsBalanced) {
  for (std::size_t n = 1; n <= 9; ++n) {
    const auto rows = williamsSquare(n);
    ASSERT_EQ(rows.size(), n % 2 == 0 || n == 1 ? n : 2 * n);
    std::map<std::pair<std::size_t, std::size_t>, int> at_place, follows;
    for (const auto& row : rows) {
      EXPECT_EQ(std::set(row.begin(), row.end()).size(), n);
      for (std::size_t place = 0; place < n; ++place) {
        ++at_place[{place, row[place]}];
        if (place > 0) ++follows[{row[place - 1], row[place]}];
      }
    }
    const int times = static_cast<int>(rows.size() / n);
    EXPECT_EQ(at_place.size(), n * n);
    EXPECT_EQ(follows.size(), n * (n - 1));
    for (const auto& [key, count] : at_place) EXPECT_EQ(count, times) << n;
    for (const auto& [key, count] : follows) EXPECT_EQ(count, times) << n;
  }
}

TEST(TaskOrder, IsThatOfSeedAndParticipant) {
  EXPECT_EQ(taskOrder(OrderKind::as_written, 3, 9, 5), (std::vector<std::size_t>{0, 1, 2}));
  std::set<std::vector<std::size_t>> rows;
  for (std::uint64_t participant = 1; participant <= 6; ++participant) {
    rows.insert(taskOrder(OrderKind::latin_square, 3, 1, participant));
    EXPECT_EQ(taskOrder(OrderKind::latin_square, 3, 1, participant),
              taskOrder(OrderKind::latin_square, 3, 1, participant + 6));
    EXPECT_EQ(taskOrder(OrderKind::shuffled, 6, 1, participant), taskOrder(OrderKind::shuffled, 6, 1, participant));
  }
  EXPECT_EQ(rows.size(), 6u);
  EXPECT_NE(taskOrder(OrderKind::shuffled, 6, 1, 1), taskOrder(OrderKind::shuffled, 6, 2, 1));
}

TEST(TaskOrder, CountsACodeByItsDigits) {
  EXPECT_EQ(numberOfCode("P07"), 7u);
  EXPECT_EQ(numberOfCode("AB-120"), 120u);
}

}  // namespace
}  // namespace app
