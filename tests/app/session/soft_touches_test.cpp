#include "app/session/soft_touches.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace app {
namespace {

using assets::SoftTissue;

/// 1 kHz; a tissue touched in each of the given spans of ticks.
class Touching {
 public:
  void touch(SoftTissue tissue, int ticks, bool cut = false) {
    for (int n = 0; n < ticks; ++n) {
      haptics::Tick tick = next();
      tick.soft.tissue = tissue;
      tick.soft.tissues = assets::bitOf(tissue);
      if (cut) tick.soft.bur_cuts = tissue;
      counter.add(tick);
    }
  }
  void wait(int ticks) {
    for (int n = 0; n < ticks; ++n) counter.add(next());
  }

  SoftTouchCounter counter;

 private:
  haptics::Tick next() {
    haptics::Tick tick;
    tick.dt_s = 1e-3;
    tick.t_s = 1e-3 * index_++;
    return tick;
  }
  int index_ = 0;
};

TEST(SoftTouches, CountTimesAndSeconds) {
  Touching lip;
  lip.touch(SoftTissue::lip, 1000);
  lip.wait(400);
  lip.touch(SoftTissue::lip, 600);
  lip.wait(100);  // less than a touch's end
  lip.touch(SoftTissue::lip, 500);
  lip.touch(SoftTissue::cheek, 1);
  EXPECT_EQ(softTouchesText(lip.counter.counts().touched), "lip 2 times, 2.1 s; cheek once, 0.0 s");
  EXPECT_EQ(softTouchesText(lip.counter.counts().cut), "");
}

TEST(SoftTouches, ATurningBurInTissueIsAnError) {
  Touching tongue;
  tongue.touch(SoftTissue::tongue, 300, true);
  EXPECT_EQ(softTouchesText(tongue.counter.counts().cut), "tongue once, 0.3 s");
  EXPECT_THAT(tongue.counter.takeEvents(), testing::ElementsAre("tongue touched at 0.0 s", "bur on tongue at 0.0 s"));
  EXPECT_TRUE(tongue.counter.takeEvents().empty());
}

TEST(SoftTouches, AreNoneWhereNothingIsTouched) {
  Touching air;
  air.wait(100);
  EXPECT_EQ(softTouchesText(air.counter.counts().touched) + softTouchesText(air.counter.counts().cut), "");
}

}  // namespace
}  // namespace app
