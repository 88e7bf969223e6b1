#include "app/check_page/check_menu.h"

#include <gtest/gtest.h>

namespace app {
namespace {

using Answer = CheckMenu::Answer;
using assets::ToothEdit;

assets::JawSegmentation found() {
  assets::JawSegmentation jaw;
  for (const int fdi : {48, 47, 37}) {
    assets::FoundTooth tooth;
    tooth.fdi = fdi, tooth.volume_mm3 = 500.0, tooth.centre_P_mm = glm::dvec3(fdi, 0, 0);
    jaw.teeth.push_back(tooth);
  }
  assets::CanalProposal canal;
  for (int n = 0; n < 40; ++n) canal.line_P_mm.emplace_back(-20.0, n, -20.0);
  jaw.canals.push_back(canal);
  return jaw;
}

CheckMenu menu() {
  CheckMenu one({}, true, {});
  one.showRows(checkRows(found(), one.edits(), 48));
  return one;
}

Answer press(CheckMenu& menu, render::Key key, bool control = false) {
  return menu.take({.key = key, .down = true, .control = control});
}

const assets::ToothClick& lastTooth(const CheckMenu& menu) {
  return std::get<assets::ToothClick>(*menu.edits().last());
}

TEST(CheckMenu, BeginsAtTheOperatedTooth) {
  const CheckMenu one = menu();
  ASSERT_EQ(one.rows().size(), 5u);
  EXPECT_EQ(one.rows()[one.selected()].fdi, 48);
  EXPECT_EQ(one.cursor_P_mm().x, 48.0);
  EXPECT_EQ(one.rows()[3].light, Light::open);
  EXPECT_EQ(one.rows()[4].beside, "not found");
  EXPECT_FALSE(one.isChanged());
}

TEST(CheckMenu, OfAScanOfOneSideTheOtherSidesCanalIsNotMissed) {
  assets::JawSegmentation jaw = found();
  std::erase_if(jaw.teeth, [](const assets::FoundTooth& tooth) { return tooth.fdi == 37; });
  const std::vector<CheckRow> rows = checkRows(jaw, {}, 48);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_TRUE(rows.back().is_there);
  // Where it was clicked it is there.
  assets::CanalProposal left = jaw.canals.front();
  left.is_right = false;
  jaw.canals.push_back(left);
  EXPECT_EQ(checkRows(jaw, {}, 48).size(), 4u);
}

TEST(CheckMenu, ToolsMakeTheClicksOfAFile) {
  CheckMenu one = menu();
  one.type(U'8');
  one.clickAt({-30, 0, 0}, true);
  EXPECT_EQ(lastTooth(one).fdi, 48);
  one.clickAt({30, 0, 0}, false);
  EXPECT_EQ(lastTooth(one).fdi, 38);
  one.type(U'n');
  one.clickAt({1, 0, 0}, true);
  EXPECT_TRUE(one.isTrouble()) << "no number was typed";
  one.type(U'4'), one.type(U'6');
  one.clickAt({1, 0, 0}, true);
  EXPECT_EQ(lastTooth(one).fdi, 46);
  one.type(U'=');
  one.clickAt({1, 0, 0}, true);
  EXPECT_EQ(one.edits().done(), 3u);
  one.clickAt({2, 0, 0}, true);
  EXPECT_EQ(lastTooth(one).edit, ToothEdit::same_tooth);
  EXPECT_EQ(lastTooth(one).at_P_mm[1].x, 2.0);
  one.type(U'-');
  one.clickAt({3, 0, 0}, true);
  EXPECT_EQ(lastTooth(one).edit, ToothEdit::no_tooth);
  one.type(U'R');
  one.clickAt({4, 0, 0}, true);
  EXPECT_EQ(lastTooth(one).edit, ToothEdit::root_tip);
  one.type(U'/');
  one.clickAt({5, 0, 0}, true), one.clickAt({6, 0, 0}, true);
  EXPECT_EQ(lastTooth(one).edit, ToothEdit::two_teeth);
  EXPECT_EQ(one.edits().done(), 7u);
}

TEST(CheckMenu, ACanalIsTwoClicksAndFurtherOnesPullIt) {
  CheckMenu one = menu();
  one.type(U'c');
  one.clickAt({-20, 0, -20}, true);
  EXPECT_EQ(one.edits().done(), 0u);
  one.clickAt({-20, 40, -20}, true);
  ASSERT_EQ(one.edits().done(), 1u);
  one.clickAt({-21, 20, -20}, true);
  const auto& canal = std::get<CanalClicks>(*one.edits().last());
  ASSERT_EQ(canal.at_P_mm.size(), 3u);
  EXPECT_EQ(canal.at_P_mm[1].x, -21.0);
  // Pressed again, it begins anew.
  one.type(U'c');
  one.clickAt({-20, 0, -20}, true), one.clickAt({-20, 40, -20}, true);
  EXPECT_EQ(std::get<CanalClicks>(*one.edits().last()).at_P_mm.size(), 2u);
}

TEST(CheckMenu, NumberKeysSayWhatTheBrushPaints) {
  CheckMenu one = menu();
  one.type(U'b');
  EXPECT_EQ(one.brush().as, 48) << "the tooth that is looked at";
  one.type(U'7');
  EXPECT_EQ(one.brush().as, 47);
  one.setSide(false);
  one.type(U'8');
  EXPECT_EQ(one.brush().as, 38);
  EXPECT_EQ(one.tool(), CheckTool::brush);
  one.type(U'9');
  EXPECT_EQ(one.brush().as, assets::kPaintBone);
  one.type(U'0');
  EXPECT_EQ(one.brush().as, assets::kPaintNothing);
  for (int n = 0; n < 20; ++n) one.type(U']');
  EXPECT_EQ(one.brush().radius_mm, assets::kMostBrush_mm);
  for (int n = 0; n < 20; ++n) one.type(U'[');
  EXPECT_EQ(one.brush().radius_mm, assets::kLeastBrush_mm);
  const bool was = one.brush().only_like_here;
  one.type(U'g');
  EXPECT_NE(one.brush().only_like_here, was);
  one.type(U'x');
  one.clickAt({0, 0, 0}, true), one.clickAt({9, 0, 0}, true);
  EXPECT_EQ(one.edits().done(), 0u);
  one.clickAt({0, 0, 4}, true);
  EXPECT_EQ(std::get<assets::JawCut>(*one.edits().last()).beyond_P_mm.z, 4.0);
}

TEST(CheckMenu, ConfirmsAndRefusesWhatIsChosen) {
  CheckMenu one = menu();
  press(one, render::Key::enter);
  EXPECT_EQ(lastTooth(one).fdi, 48);
  one.select(3);
  press(one, render::Key::enter);
  EXPECT_TRUE(std::get<CanalWord>(*one.edits().last()).is_good);
  one.showRows(checkRows(found(), one.edits(), 48));
  EXPECT_EQ(one.rows()[3].light, Light::confirmed);
  press(one, render::Key::erase);
  one.showRows(checkRows(found(), one.edits(), 48));
  EXPECT_EQ(one.rows()[3].light, Light::refused);
  one.select(4);
  press(one, render::Key::enter);
  EXPECT_TRUE(one.isTrouble()) << "there is none";
  one.select(1);
  press(one, render::Key::erase);
  EXPECT_EQ(lastTooth(one).edit, ToothEdit::no_tooth);
}

TEST(CheckMenu, EnterAndDeletePressedManyTimesSayItOnce) {
  CheckMenu one = menu();
  for (int n = 0; n < 5; ++n) press(one, render::Key::enter);
  EXPECT_EQ(one.edits().done(), 1u);
  EXPECT_EQ(one.message(), "it is said already");
  // Not shown yet, with another in between.
  one.setBusy(true);
  one.select(1);
  press(one, render::Key::enter);
  one.select(0);
  press(one, render::Key::enter);
  EXPECT_EQ(one.edits().done(), 2u);
  one.select(3);
  for (int n = 0; n < 3; ++n) press(one, render::Key::enter);
  for (int n = 0; n < 3; ++n) press(one, render::Key::erase);
  EXPECT_EQ(one.edits().done(), 4u) << "a canal's word can be taken back by another";
  // Undone, it can be said again.
  press(one, render::keyOf('Z'), true);
  press(one, render::Key::erase);
  EXPECT_EQ(one.edits().done(), 4u);
}

TEST(CheckMenu, EscAsksBeforeAnythingIsLeftUnsaved) {
  CheckMenu one = menu();
  EXPECT_EQ(press(one, render::Key::escape), Answer::leave);
  one.type(U'8');
  one.clickAt({-30, 0, 0}, true);
  EXPECT_EQ(press(one, render::Key::escape), Answer::none) << "puts the tool away";
  EXPECT_EQ(press(one, render::Key::escape), Answer::none);
  EXPECT_TRUE(one.asks());
  one.type(U'q');
  EXPECT_FALSE(one.asks());
  press(one, render::Key::escape);
  EXPECT_EQ(press(one, render::Key::escape), Answer::leave);
  EXPECT_EQ(press(one, render::keyOf('S'), true), Answer::save);
  one.saved();
  EXPECT_EQ(press(one, render::Key::escape), Answer::leave);
  // Undone is a change of what was saved; redone is none.
  press(one, render::keyOf('Z'), true);
  EXPECT_TRUE(one.isChanged());
  press(one, render::keyOf('Y'), true);
  EXPECT_FALSE(one.isChanged());
}

TEST(CheckMenu, WhatDoesNotFitIsTakenBackForGood) {
  CheckMenu one = menu();
  one.type(U'-');
  one.clickAt({0, 0, 90}, true);
  one.refuseLast("no tooth was found within 1.5 mm of it");
  EXPECT_EQ(one.edits().done() + one.edits().undone(), 0u);
  EXPECT_TRUE(one.isTrouble());
}

TEST(CheckMenu, LabelsOfAnotherAreOnlyLookedAt) {
  CheckMenu one({}, false, {});
  one.showRows(checkRows(found(), one.edits(), 48));
  press(one, render::Key::enter);
  EXPECT_EQ(one.edits().done(), 0u);
  EXPECT_EQ(press(one, render::keyOf('S'), true), Answer::none);
}

}  // namespace
}  // namespace app
