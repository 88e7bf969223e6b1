#include "app/check_page/import_stages.h"

#include <gtest/gtest.h>

#include <random>

#include "app/check_page/import_page.h"

namespace app {
namespace {

using State = ImportStage::State;

/// 2 s, 6 s and 2 s.
ImportStages three() {
  return ImportStages(
      {{.name = "files", .usual_s = 2.0}, {.name = "teeth", .usual_s = 6.0}, {.name = "writing", .usual_s = 2.0}});
}

TEST(ImportStages, SharesAreThoseOfUsualSeconds) {
  ImportStages stages = three();
  EXPECT_EQ(stages.share(5.0), 0.0);
  stages.begin("files", 10.0);
  EXPECT_DOUBLE_EQ(stages.share(11.0), 0.1) << "one second of ten";
  stages.begin("teeth", 14.0);
  EXPECT_DOUBLE_EQ(stages.all()[0].took_s, 4.0);
  // Files took twice as long as usual: so will teeth.
  EXPECT_DOUBLE_EQ(stages.share(14.0), 0.2);
  EXPECT_DOUBLE_EQ(stages.shareOf(stages.all()[1], 20.0), 0.5);
  EXPECT_DOUBLE_EQ(stages.share(20.0), 0.5);
  EXPECT_EQ(stages.running()->name, "teeth");
  stages.begin("writing", 26.0);
  stages.end(30.0);
  EXPECT_DOUBLE_EQ(stages.share(30.0), 1.0);
  EXPECT_EQ(stages.running(), nullptr);
  EXPECT_DOUBLE_EQ(stages.secondsOf(stages.all()[2], 99.0), 4.0);
}

TEST(ImportStages, OneThatTakesLongerIsNeverFull) {
  ImportStages stages = three();
  stages.begin("files", 0.0);
  double before = 0.0;
  for (double at_s = 0.0; at_s < 8.0; at_s += 0.1) {
    const double share = stages.shareOf(stages.all()[0], at_s);
    EXPECT_GE(share, before);
    EXPECT_LT(share, 1.0);
    before = share;
  }
  EXPECT_GT(before, 0.98);
}

TEST(ImportStages, ThoseThatDoNotComeAreLeftOutAndOthersComeNext) {
  ImportStages stages = three();
  stages.begin("outside program", 0.0);
  ASSERT_EQ(stages.all().size(), 4u);
  EXPECT_EQ(stages.all()[0].name, "outside program");
  stages.begin("writing", 3.0);
  ASSERT_EQ(stages.all().size(), 2u);
  EXPECT_EQ(stages.all()[1].state, State::runs);
  stages.begin("files", 4.0);
  ASSERT_EQ(stages.all().size(), 3u) << "out of order: it comes once more";
  EXPECT_EQ(stages.all()[2].name, "files");
}

TEST(ImportStages, TheWholeDoesNotFallOnItsWay) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> took_s(0.0, 12.0);
  for (int round = 0; round < 200; ++round) {
    ImportStages stages(expectedImportStages());
    double at_s = 0.0, before = 0.0;
    for (const ImportStage& stage : expectedImportStages()) {
      if (random() % 4 == 0) continue;
      stages.begin(stage.name, at_s);
      const double until_s = at_s + took_s(random);
      for (; at_s < until_s; at_s += 0.4) {
        const double share = stages.share(at_s);
        EXPECT_GE(share, before - 1e-9);
        EXPECT_LE(share, 1.0);
        before = share;
      }
    }
  }
}

TEST(ImportPage, ItsButtonIsInThePictureInWindowsOfAnySize) {
  for (const glm::ivec2 px : {glm::ivec2(1280, 800), glm::ivec2(800, 500), glm::ivec2(2560, 1440)}) {
    int cancel_px = 0;
    for (int y = 0; y < px.y; y += 2)
      for (int x = 0; x < px.x; x += 2) cancel_px += isCancelAt({x, y}, px) ? 1 : 0;
    EXPECT_EQ(cancel_px, 75 * 19) << px.x;
    const render::Image picture = importPage(ImportStages(expectedImportStages()), 1.0, {"Importing", "", true}, px);
    EXPECT_EQ(picture.w, px.x);
  }
}

}  // namespace
}  // namespace app
