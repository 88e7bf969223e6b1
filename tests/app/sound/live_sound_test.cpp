#include "app/sound/live_sound.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <thread>
#include <vector>

namespace app {
namespace {

TEST(LiveSound, ManyTicksWithoutACardDisturbNobodyAndTheTroubleIsToldOnce) {
  std::string trouble;
  {
    LiveSound sound;
    const std::vector<haptics::Tick> ticks(5000);
    for (int n = 0; n < 20; ++n) sound.follow(ticks, {});
    sound.mute(true);
    EXPECT_TRUE(sound.isMuted());
    sound.mute(false);
    EXPECT_FALSE(sound.isMuted());
    for (int n = 0; n < 2; ++n)
      if (const std::string line = sound.takeTrouble(); !line.empty()) {
        EXPECT_TRUE(trouble.empty());
        trouble = line;
      }
  }
  if (!trouble.empty()) {
    EXPECT_TRUE(trouble.starts_with("sound: ")) << trouble;
    EXPECT_TRUE(trouble.ends_with("; the rehearsal is silent")) << trouble;
  }
}

TEST(LiveSound, LinesOfTheProgramAreKeptWhileCardsAreSearched) {
  std::string lines;
  testing::internal::CaptureStderr();
  {
    LiveSound sound;
    for (int n = 0; n < 300; ++n) {
      const std::string line = "line " + std::to_string(n) + "\n";
      std::fputs(line.c_str(), stderr);
      lines += line;
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), lines) << "and nothing else is said";
}

}  // namespace
}  // namespace app
