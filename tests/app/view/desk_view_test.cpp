#include "app/view/desk_view.h"

#include <gtest/gtest.h>

#include <random>

namespace app {
namespace {

using calibration::Patient;
using calibration::Point;
using calibration::World;

calibration::Rig deskRig() {
  calibration::Rig rig = calibration::desktopRig({1280, 800}, 132.0);
  rig.X_WP = {glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, 2, 3))), {4.0, -3.0, 2.0}};
  return rig;
}

TEST(DeskView, TurnsThePatientAboutTheSite) {
  const calibration::Rig first = deskRig();
  const Point<Patient> site_P{{10.0, 20.0, -5.0}};
  const Point<World> site_W = first.X_WP * site_P;
  DeskView view(first, site_W);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> px(-300.0, 300.0);
  for (int n = 0; n < 100; ++n) {
    view.turn({px(random), px(random)});
    const calibration::Rig rig = view.rig();
    EXPECT_LT(glm::distance((rig.X_WP * site_P).mm, site_W.mm), 1e-9);
    EXPECT_EQ(rig.left_eye.mm, first.left_eye.mm);
    // A direction of the hand is seen turned as the patient is.
    const glm::dvec3 along_P{0.0, 0.0, 1.0};
    EXPECT_LT(glm::distance(rig.X_WP.rotation * along_P, view.rotation() * (first.X_WP.rotation * along_P)), 1e-9);
  }
}

TEST(DeskView, ADragToTheRightTurnsTheNearSideToTheRight) {
  const calibration::Rig first = deskRig();
  DeskView view(first, {});
  view.turn({100.0, 0.0});
  EXPECT_GT((view.rotation() * glm::dvec3(0.0, 0.0, 10.0)).x, 1.0);
  view.backToFirst();
  view.turn({0.0, 100.0});
  EXPECT_LT((view.rotation() * glm::dvec3(0.0, 0.0, 10.0)).y, -1.0) << "pixels run downwards";
}

TEST(DeskView, LoupesShowASmallerPartOfTheScreenWithinLimits) {
  const calibration::Rig first = deskRig();
  DeskView view(first, {});
  view.magnify(4);
  EXPECT_NEAR(glm::length(view.rig().screen.across_mm()), 66.0, 1e-9) << "four steps double";
  EXPECT_EQ(view.rig().screen.px, first.screen.px);
  view.magnify(100);
  EXPECT_EQ(view.magnified(), DeskView::kMostMagnified);
  view.magnify(-100);
  EXPECT_EQ(view.magnified(), DeskView::kLeastMagnified);
}

TEST(DeskView, TheFaceOpensBeforeTheSiteAsTheViewIsTurned) {
  for (const glm::dvec2 way : {glm::dvec2(1.0, 0.0), glm::dvec2(-1.0, 0.0), glm::dvec2(0.0, 1.0)}) {
    DeskView view(deskRig(), {});
    EXPECT_EQ(view.faceWindow_mm(), 0.0) << "as the mouth is open";
    double before_mm = 0.0;
    for (int px = 0; px < 300; ++px) {
      view.turn(way);
      EXPECT_GE(view.faceWindow_mm(), before_mm);
      EXPECT_LE(view.faceWindow_mm() - before_mm, 0.5) << "without a jump";
      before_mm = view.faceWindow_mm();
      if (px == 10) {
        EXPECT_EQ(before_mm, 0.0);
      }
      if (px == 100) {
        EXPECT_GT(before_mm, 6.0) << "as wide as the bared bone";
      }
    }
    view.backToFirst();
    EXPECT_EQ(view.faceWindow_mm(), 0.0);
  }
}

TEST(DeskView, ComesBackToTheFirstView) {
  const calibration::Rig first = deskRig();
  DeskView view(first, {{1.0, 2.0, 3.0}});
  view.turn({120.0, -45.0});
  view.magnify(-3);
  view.backToFirst();
  const calibration::Rig rig = view.rig();
  EXPECT_LT(glm::distance(rig.X_WP.translation_mm, first.X_WP.translation_mm), 1e-12);
  EXPECT_NEAR(std::abs(glm::dot(rig.X_WP.rotation, first.X_WP.rotation)), 1.0, 1e-12);
  EXPECT_LT(glm::distance(rig.screen.lower_left.mm, first.screen.lower_left.mm), 1e-12);
}

}  // namespace
}  // namespace app
