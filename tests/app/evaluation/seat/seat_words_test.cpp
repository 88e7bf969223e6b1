#include "app/evaluation/seat/seat_words.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace app {
namespace {

using Kind = SeatWord::Kind;

SeatWord word(Kind kind, std::uint64_t tick, std::uint64_t number = 0, double value = 0.0) {
  return {.kind = kind, .tick = tick, .number = number, .value = value};
}

TEST(SeatWords, AValueHoldsFromItsTickOnUntilTheNext) {
  SeatBook book({"O2.plan", "O5.count"});
  ASSERT_TRUE(
      book.take(std::vector{word(Kind::value, 3, 0, 0.5), word(Kind::value, 7, 1, 2.0), word(Kind::value, 9, 0, 0.75),
                            word(Kind::no_value, 12, 0), word(Kind::through, 14)},
                20));
  EXPECT_EQ(book.followed(), 15u);
  EXPECT_FALSE(book.value("O2.plan", 2));
  EXPECT_EQ(book.value("O2.plan", 3), 0.5);
  EXPECT_EQ(book.value("O2.plan", 8), 0.5);
  EXPECT_FALSE(book.value("O5.count", 6));
  EXPECT_EQ(book.value("O5.count", 8), 2.0);
  EXPECT_EQ(book.value("O2.plan", 11), 0.75);
  EXPECT_FALSE(book.value("O2.plan", 12));
  EXPECT_FALSE(book.value("O3.over", 12));
}

TEST(SeatWords, WhatIsSaidAgainAfterADeathChangesNothing) {
  SeatBook book({"O2.plan"});
  ASSERT_TRUE(book.take(std::vector{word(Kind::began, 0), word(Kind::value, 3, 0, 0.5), word(Kind::through, 5),
                                    word(Kind::value, 7, 0, 0.6)},
                        20));
  // Another process goes on from tick 2, and says all again.
  ASSERT_TRUE(book.take(std::vector{word(Kind::began, 2, 1), word(Kind::value, 3, 0, 0.5), word(Kind::value, 7, 0, 0.6),
                                    word(Kind::value, 8, 0, 0.7), word(Kind::through, 9)},
                        20));
  EXPECT_EQ(book.begun(), 1u);
  EXPECT_EQ(book.takenOver(), 1u);
  EXPECT_EQ(book.value("O2.plan", 6), 0.5);
  EXPECT_EQ(book.value("O2.plan", 7), 0.6);
  EXPECT_EQ(book.value("O2.plan", 9), 0.7);
}

TEST(SeatWords, FromADeviationOnNothingHasAValue) {
  SeatBook book({"O2.plan"});
  ASSERT_TRUE(
      book.take(std::vector{word(Kind::value, 0, 0, 0.5), word(Kind::deviates, 6), word(Kind::through, 9)}, 20));
  EXPECT_EQ(book.value("O2.plan", 5), 0.5);
  EXPECT_FALSE(book.value("O2.plan", 6));
  EXPECT_EQ(book.deviates(), 6u);
}

TEST(SeatWords, OfWhatCannotBeNothingIsTaken) {
  SeatBook book({"O2.plan"});
  EXPECT_FALSE(book.take(std::vector{word(Kind::value, 3, 0, 0.5), word(Kind::through, 20)}, 20)) << "not made yet";
  EXPECT_FALSE(book.take(std::vector{word(Kind::value, 3, 1, 0.5)}, 20)) << "no such measure";
  EXPECT_EQ(book.followed(), 0u);
  EXPECT_FALSE(book.value("O2.plan", 3));
}

TEST(SeatWords, AHundredThousandDatagramsOfNonsenseAreSurvived) {
  SeatBook book({"O2.plan", "O5.count"});
  std::mt19937_64 random(20261128);
  std::size_t read = 0, taken = 0;
  std::vector<std::byte> datagram;
  for (int n = 0; n < 100'000; ++n) {
    std::vector<SeatWord> words(random() % 4 + (random() % 50 == 0 ? kMostSeatWords : 0));
    for (SeatWord& one : words)
      one = word(Kind{static_cast<std::uint32_t>(random() % 6)}, random() % 64, random() % 3,
                 static_cast<double>(random() % 9));
    datagram.resize(words.size() * sizeof(SeatWord) + (random() % 20 == 0 ? random() % 31 : 0));
    std::memcpy(datagram.data(), words.data(), std::min(datagram.size(), words.size() * sizeof(SeatWord)));
    for (std::size_t change = random() % 3; change > 0 && !datagram.empty(); --change)
      datagram[random() % datagram.size()] = static_cast<std::byte>(random());
    const auto found = seatWordsFrom(datagram);
    if (!found) continue;
    ++read;
    ASSERT_LE(found->size(), kMostSeatWords);
    const std::uint64_t before = book.followed();
    taken += book.take(*found, 50) ? 1 : 0;
    ASSERT_GE(book.followed(), before);
    ASSERT_LE(book.followed(), 50u);
    const auto value = book.value("O2.plan", book.followed());
    ASSERT_TRUE(!value || std::isfinite(*value));
  }
  EXPECT_GT(read, 1000u);
  EXPECT_GT(taken, 100u);
  EXPECT_LT(read, 100'000u);
}

TEST(SeatWords, ANumberThatIsNoneIsNotRead) {
  const SeatWord bad = word(Kind::value, 1, 0, std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(seatWordsFrom(std::as_bytes(std::span(&bad, 1))));
}

}  // namespace
}  // namespace app
