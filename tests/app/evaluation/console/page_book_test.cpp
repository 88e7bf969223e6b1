#include "app/evaluation/console/page_book.h"

#include <gtest/gtest.h>

namespace app {
namespace {

using Safe = std::vector<std::pair<std::string, std::uint64_t>>;

TEST(PageBook, WhatIsSentTwiceIsTakenOnceAndToldOnceItIsSafe) {
  PageBook book;
  EXPECT_EQ(book.known("a", 1), PageBook::Known::no);
  book.begin("a", 1);
  EXPECT_EQ(book.known("a", 1), PageBook::Known::waiting);
  book.accept("a", 1, 10);
  book.accept("b", 1, 12);
  EXPECT_EQ(book.known("a", 1), PageBook::Known::waiting);
  EXPECT_EQ(book.known("a", 2), PageBook::Known::no);
  EXPECT_TRUE(book.takeSafe([](std::size_t events) { return events <= 9; }).empty());
  EXPECT_EQ(book.takeSafe([](std::size_t events) { return events <= 11; }), (Safe{{"a", 1}}));
  EXPECT_EQ(book.known("a", 1), PageBook::Known::safe);
  EXPECT_EQ(book.known("b", 1), PageBook::Known::waiting);
  EXPECT_TRUE(book.waits());
  EXPECT_EQ(book.takeSafe([](std::size_t) { return true; }), (Safe{{"b", 1}}));
  EXPECT_FALSE(book.waits());
}

TEST(PageBook, ARefusalStaysWithItsReason) {
  PageBook book;
  book.refuse("a", 7, "there are no tasks now");
  EXPECT_EQ(book.known("a", 7), PageBook::Known::refused);
  EXPECT_EQ(book.why("a", 7), "there are no tasks now");
  EXPECT_EQ(book.why("a", 8), "");
}

TEST(PageBook, AfterTooMuchNothingNewIsTaken) {
  PageBook book;
  for (std::uint64_t n = 1; n <= PageBook::kMostTaken; ++n) book.refuse("a", n, "");
  EXPECT_EQ(book.known("b", 1), PageBook::Known::too_many);
  EXPECT_EQ(book.known("a", 1), PageBook::Known::refused);
}

}  // namespace
}  // namespace app
