#include "app/controls/prediction_question.h"

#include <gtest/gtest.h>

#include "app/text/usage_error.h"

namespace app {
namespace {

using render::Key;

bool press(PredictionQuestion& question, Key key) { return question.take({.key = key, .down = true}); }

TEST(PredictionQuestion, IsAnsweredByDigitsPlusMinusAndEnter) {
  PredictionQuestion question;
  EXPECT_FALSE(press(question, render::keyOf('2'))) << "nobody asked";
  question.open();
  EXPECT_TRUE(press(question, render::keyOf('3')));
  EXPECT_TRUE(press(question, render::keyOf('2')));
  EXPECT_NE(question.text().find("[moderate]"), std::string::npos) << question.text();
  press(question, render::keyOf('='));
  press(question, render::keyOf('-'));
  press(question, Key::keypad_subtract);
  EXPECT_NE(question.text().find("13 min"), std::string::npos) << question.text();
  EXPECT_FALSE(question.takeAnswer());
  EXPECT_TRUE(press(question, Key::enter));
  EXPECT_FALSE(question.isOpen());
  const auto answer = question.takeAnswer();
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->difficulty, "moderate");
  EXPECT_EQ(answer->minutes, 13);
  EXPECT_FALSE(question.takeAnswer()) << "once";
}

TEST(PredictionQuestion, EnterAloneLeavesItUnsaid) {
  PredictionQuestion question;
  question.open();
  press(question, Key::enter);
  const auto answer = question.takeAnswer();
  ASSERT_TRUE(answer);
  EXPECT_TRUE(answer->difficulty.empty());
  EXPECT_FALSE(answer->minutes);
}

TEST(PredictionQuestion, LeavesMovementPedalAndEndToTheHand) {
  PredictionQuestion question;
  question.open();
  for (const Key key : {Key::space, Key::escape, Key::left, Key::up, render::keyOf('Q')})
    EXPECT_FALSE(press(question, key));
  EXPECT_TRUE(press(question, render::keyOf('U'))) << "nothing else";
  EXPECT_TRUE(question.isOpen());
}

TEST(PredictionQuestion, MinutesStayWithinTheirLimits) {
  PredictionQuestion question;
  question.open();
  for (int n = 0; n < 40; ++n) press(question, render::keyOf('-'));
  press(question, Key::enter);
  EXPECT_EQ(question.takeAnswer()->minutes, 1);
}

TEST(PredictionQuestion, ReadsTextOrSaysWhatIsAccepted) {
  const PredictionAnswer both = predictionAnswerFrom("difficulty=difficult,minutes=25");
  EXPECT_EQ(both.difficulty, "difficult");
  EXPECT_EQ(both.minutes, 25);
  EXPECT_FALSE(predictionAnswerFrom("difficulty=easy").minutes);
  EXPECT_EQ(predictionAnswerFrom("minutes=1").minutes, 1);
  for (const char* const text : {"", "easy", "difficulty=hard", "minutes=0", "minutes=241", "minutes=1.5",
                                 "minutes=", "difficulty=easy,difficulty=easy", "minutes=3,colour=red"})
    EXPECT_THROW(predictionAnswerFrom(text), UsageError) << text;
}

}  // namespace
}  // namespace app
