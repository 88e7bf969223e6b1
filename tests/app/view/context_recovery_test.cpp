#include "app/view/context_recovery.h"

#include <gtest/gtest.h>

namespace app {
namespace {

/// A graphics card that is reset at some drawings.
struct Card {
  int losses = 0;
  int drawn = 0, made_anew = 0;
  void draw() {
    if (losses-- > 0) throw render::ContextLost("the graphics card was reset");
    ++drawn;
  }
};

void drawOn(Card& card, ContextRecovery& recovery) {
  recovery.draw([&] { card.draw(); }, [&](const render::ContextLost&) { ++card.made_anew; });
}

TEST(ContextRecovery, DrawsTheLostPictureAgainAfterMakingEverythingAnew) {
  ContextRecovery recovery;
  Card card{.losses = 1};
  drawOn(card, recovery);
  drawOn(card, recovery);
  EXPECT_EQ(card.drawn, 2);
  EXPECT_EQ(card.made_anew, 1);
  EXPECT_EQ(recovery.contextLosses(), 1);
}

TEST(ContextRecovery, SurvivesALossWhileItDrawsAgain) {
  ContextRecovery recovery;
  Card card{.losses = 2};
  drawOn(card, recovery);
  EXPECT_EQ(card.drawn, 1);
  EXPECT_EQ(card.made_anew, 2);
}

TEST(ContextRecovery, GivesUpAfterTheThirdReset) {
  ContextRecovery recovery;
  Card card{.losses = 4};
  EXPECT_THROW(drawOn(card, recovery), render::ContextLost);
  EXPECT_EQ(card.made_anew, 3);
}

TEST(ContextRecovery, LeavesOtherTroubleAlone) {
  ContextRecovery recovery;
  int made_anew = 0;
  EXPECT_THROW(recovery.draw([] { throw render::GpuError("out of memory"); }, [&](const auto&) { ++made_anew; }),
               render::GpuError);
  EXPECT_EQ(made_anew, 0);
}

}  // namespace
}  // namespace app
