#include "app/debrief/film.h"

#include <gtest/gtest.h>

namespace app {
namespace {

TEST(Film, ShowsTheNewestUntilThen) {
  Film<int> film(10, 0.5);
  EXPECT_EQ(film.at(5.0), nullptr);
  film.keep(1.0, 7);
  film.keep(2.0, 8);
  EXPECT_EQ(film.at(0.9), nullptr);
  EXPECT_EQ(film.at(1.0)->content, 7);
  EXPECT_EQ(film.at(1.99)->content, 7);
  EXPECT_EQ(film.at(99.0)->content, 8);
  EXPECT_NE(film.at(1.0)->serial, film.at(2.0)->serial);
  EXPECT_FALSE(film.isDue(2.4));
  EXPECT_TRUE(film.isDue(2.5));
}

TEST(Film, KeepsABoundedNumberFromTheBeginningToTheEnd) {
  Film<int> film(100, 0.1);
  for (int n = 0; n < 100'000; ++n)
    if (film.isDue(0.05 * n)) film.keep(0.05 * n, n);
  EXPECT_LE(film.size(), 100U);
  EXPECT_GE(film.size(), 25U);
  EXPECT_EQ(film.at(0.0)->content, 0) << "the first is never dropped";
  EXPECT_GT(film.at(5000.0)->content, 95'000);
  for (double t_s = 0.0; t_s < 5000.0; t_s += 13.0)
    EXPECT_NEAR(0.05 * film.at(t_s)->content, t_s, 250.0) << "evenly thinned";
}

}  // namespace
}  // namespace app
