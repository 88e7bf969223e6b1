#include "app/controls/end_question.h"

#include <gtest/gtest.h>

namespace app {
namespace {

using render::Key;
using Answer = EndQuestion::Answer;

Answer press(EndQuestion& question, Key key) { return question.take({.key = key, .down = true}); }

TEST(EndQuestion, EndsAfterASecondEscOrEnterOnly) {
  for (const Key second : {Key::escape, Key::enter}) {
    EndQuestion question;
    EXPECT_EQ(press(question, Key::escape), Answer::taken);
    EXPECT_TRUE(question.isOpen());
    EXPECT_EQ(press(question, second), Answer::end);
    EXPECT_FALSE(question.isOpen());
  }
}

TEST(EndQuestion, AnyOtherKeyGoesOnAndDoesNothingElse) {
  EndQuestion question;
  press(question, Key::escape);
  EXPECT_EQ(press(question, render::keyOf('U')), Answer::taken);
  EXPECT_FALSE(question.isOpen());
  EXPECT_EQ(press(question, render::keyOf('U')), Answer::not_concerned) << "then it undoes again";
  EXPECT_EQ(press(question, Key::enter), Answer::not_concerned);
}

TEST(EndQuestion, AHeldEscNeitherEndsNorAsksTwice) {
  EndQuestion question;
  press(question, Key::escape);
  for (int n = 0; n < 20; ++n)
    EXPECT_EQ(question.take({.key = Key::escape, .down = true, .repeated = true}), Answer::taken);
  EXPECT_EQ(question.take({.key = Key::escape, .down = false}), Answer::taken);
  EXPECT_TRUE(question.isOpen());
}

TEST(EndQuestion, LetsThePedalGoAndModifiersBePressed) {
  EndQuestion question;
  press(question, Key::escape);
  EXPECT_EQ(question.take({.key = Key::space, .down = false}), Answer::not_concerned);
  EXPECT_EQ(press(question, Key::left_shift), Answer::taken);
  EXPECT_TRUE(question.isOpen());
}

}  // namespace
}  // namespace app
