#include "app/device/check/dialogue.h"

#include <cmath>
#include <random>
#include <sstream>

#include <gtest/gtest.h>

namespace app {
namespace {

TEST(Dialogue, AsksAgainUntilThereIsAnAnswer) {
  std::istringstream answers("x\n\n u\n1e9\nabc\n 30,6 \n");
  std::ostringstream words;
  Dialogue dialogue(answers, words);
  EXPECT_EQ(dialogue.choice("Which way?", "rlud"), 'u');
  EXPECT_EQ(dialogue.number("How much?", -2000.0, 2000.0), 30.6);
  EXPECT_NE(words.str().find("Give a number from -2000 to 2000"), std::string::npos) << words.str();
  EXPECT_FALSE(dialogue.isOver());
}

TEST(Dialogue, IsOverWithQAndStaysOver) {
  std::istringstream answers("\nq\n5\n5\n");
  std::ostringstream words;
  Dialogue dialogue(answers, words);
  EXPECT_TRUE(dialogue.confirm("Do it."));
  EXPECT_FALSE(dialogue.confirm("Do it."));
  EXPECT_TRUE(dialogue.isOver());
  EXPECT_FALSE(dialogue.number("How much?", 0.0, 10.0));
  EXPECT_FALSE(dialogue.choice("Which?", "5"));
}

TEST(Dialogue, IsOverAtTheEndOfTheInput) {
  std::istringstream answers("garbage");
  std::ostringstream words;
  Dialogue dialogue(answers, words);
  EXPECT_FALSE(dialogue.number("How much?", 0.0, 10.0));
  EXPECT_TRUE(dialogue.isOver());
}

TEST(Dialogue, AcceptsOnlyNumbersInRange) {
  std::istringstream answers("nan\ninf\n-inf\n0x10\n1 2 3x\n\n--1\n7\n");
  std::ostringstream words;
  EXPECT_EQ(Dialogue(answers, words).number("How much?", -2000.0, 2000.0), 7.0);
}

TEST(Dialogue, SurvivesAnyBytes) {
  std::mt19937 random(1);
  std::string bytes(20'000, ' ');
  for (char& c : bytes) c = static_cast<char>(std::uniform_int_distribution(0, 255)(random));
  std::istringstream answers(bytes);
  std::ostringstream words;
  Dialogue dialogue(answers, words);
  while (!dialogue.isOver()) ASSERT_LE(std::abs(dialogue.number("?", -5.0, 5.0).value_or(0.0)), 5.0);
}

}  // namespace
}  // namespace app
