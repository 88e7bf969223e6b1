#include "app/evaluation/voice/speech_judge.h"

namespace app {
namespace {

constexpr std::int64_t kFrame_ns = 10'000'000, kSecond_ns = 1'000'000'000;

TEST(SpeechJudge, ThirtyPercentOfHalfASecondAreSpeech) {
  SpeechJudge judge;
  std::int64_t t_ns = 0;
  // Fourteen of fifty frames are not.
  for (int n = 0; n < 500; ++n) EXPECT_FALSE(judge.add(n % 50 < 14, t_ns += kFrame_ns)) << n;
  EXPECT_FALSE(judge.speaks());
  // Fifteen are, with the fifteenth.
  std::optional<SpeechChange> change;
  int frames = 0;
  while (!change && frames < 100) change = judge.add(true, t_ns += kFrame_ns), ++frames;
  ASSERT_TRUE(change);
  EXPECT_TRUE(change->speaks);
  EXPECT_EQ(change->t_ns, t_ns);
  EXPECT_LE(frames, 15);
}

TEST(SpeechJudge, APauseOfASecondEndsItFromWhereItBegan) {
  SpeechJudge judge;
  std::int64_t t_ns = 0;
  for (int n = 0; n < 100; ++n) judge.add(true, t_ns += kFrame_ns);
  ASSERT_TRUE(judge.speaks());
  // A window of half a second still holds enough for 35 frames.
  const std::int64_t last_ns = t_ns + 35 * kFrame_ns;
  std::optional<SpeechChange> change;
  for (int n = 0; n < 1000 && !change; ++n) change = judge.add(false, t_ns += kFrame_ns);
  ASSERT_TRUE(change);
  EXPECT_FALSE(change->speaks);
  EXPECT_EQ(change->t_ns, last_ns);
  EXPECT_EQ(t_ns, last_ns + kSecond_ns);
}

TEST(QuietWatch, RemindsOnceAfterTwentySecondsAndAgainAfterSixty) {
  QuietWatch watch(20.0);
  watch.begin(0);
  watch.follow({0, true});
  std::vector<double> due_s;
  for (std::int64_t t_ns = 0; t_ns < 200 * kSecond_ns; t_ns += kFrame_ns) {
    if (t_ns == 10 * kSecond_ns) watch.follow({t_ns, false});
    if (watch.isDue(t_ns)) due_s.push_back(static_cast<double>(t_ns) * 1e-9);
  }
  ASSERT_EQ(due_s.size(), 3u);
  EXPECT_DOUBLE_EQ(due_s[0], 30.0);
  EXPECT_DOUBLE_EQ(due_s[1], 90.0);
  EXPECT_DOUBLE_EQ(due_s[2], 150.0);
}

TEST(QuietWatch, SpeechBeginsItAnew) {
  QuietWatch watch(20.0);
  watch.begin(0);
  EXPECT_FALSE(watch.isDue(19 * kSecond_ns));
  EXPECT_TRUE(watch.isDue(20 * kSecond_ns));
  EXPECT_TRUE(watch.isReminding());
  watch.follow({25 * kSecond_ns, true});
  EXPECT_FALSE(watch.isReminding());
  EXPECT_DOUBLE_EQ(watch.quiet_s(400 * kSecond_ns), 0.0);
  EXPECT_FALSE(watch.isDue(400 * kSecond_ns));
  watch.follow({400 * kSecond_ns, false});
  EXPECT_FALSE(watch.isDue(419 * kSecond_ns));
  EXPECT_TRUE(watch.isDue(420 * kSecond_ns));
  // A new task does, too.
  watch.begin(430 * kSecond_ns);
  EXPECT_FALSE(watch.isDue(449 * kSecond_ns));
  EXPECT_TRUE(watch.isDue(450 * kSecond_ns));
}

}  // namespace
}  // namespace app
