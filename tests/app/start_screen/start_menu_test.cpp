#include "app/start_screen/start_menu.h"

#include <gtest/gtest.h>

#include <random>

namespace app {
namespace {

using Answer = StartMenu::Answer;
using render::Key;
using Words = std::vector<std::string>;

StartMenu smallMenu() {
  const auto choice = [](const char* words, Words arguments) {
    return StartChoice{.words = words, .beside = "", .about = "", .arguments = std::move(arguments)};
  };
  StartLists lists{
      {"Case", {choice("easy", {"--case", "shallow"}), choice("hard", {"--case", "deep"})}, 1},
      {"Hand", {choice("Mouse", {"--device", "mouse"}), choice("Touch", {"--device", "openhaptics"})}, 0},
      {"Calibration", {choice("Usual", {})}, 0},
      {"Patient", {choice("Seated", {}), choice("Behind", {"--position", "behind"})}, 0},
      {"Mouth opens", {choice("37 mm", {}), choice("25 mm", {"--opening", "25"})}, 0},
      {"Go on with", {choice("A new rehearsal", {}), choice("Monday", {"--continue", "monday.molar"})}, 0},
  };
  lists[1].choices[1].why_not = "install its driver";
  return StartMenu(lists);
}

Answer press(StartMenu& menu, Key key, bool shift = false) {
  return menu.take({.key = key, .down = true, .repeated = false, .shift = shift, .control = false});
}

TEST(StartMenu, EnterStartsWhatIsChosenAsArgumentsOfRehearse) {
  StartMenu menu = smallMenu();
  EXPECT_EQ(menu.arguments(), Words({"rehearse", "--case", "deep", "--device", "mouse"}));
  EXPECT_EQ(press(menu, Key::up), Answer::none);
  EXPECT_EQ(press(menu, Key::left), Answer::none) << "to the last list, around the corner";
  press(menu, Key::left), press(menu, Key::left);
  EXPECT_EQ(press(menu, Key::down), Answer::none);
  EXPECT_EQ(press(menu, Key::enter), Answer::start);
  EXPECT_EQ(menu.arguments(), Words({"rehearse", "--case", "shallow", "--device", "mouse", "--position", "behind"}));
}

TEST(StartMenu, APatientToBeCheckedIsLookedAtBeforeItsFirstRehearsal) {
  StartLists lists = smallMenu().lists();
  lists[0].choices[0] = {
      .words = "mine", .beside = "", .about = "", .arguments = {"/p/mine"}, .is_imported = true, .is_to_check = true};
  lists[5].choices[1].is_imported = true;
  StartMenu menu(lists);
  EXPECT_FALSE(menu.startsCheck());
  menu.choose(0, 0);
  EXPECT_TRUE(menu.startsCheck());
  EXPECT_EQ(menu.arguments(), Words({"check", "/p/mine"}));
  // A session of it that goes on is a rehearsal.
  menu.choose(5, 1);
  EXPECT_EQ(menu.arguments().front(), "rehearse");
  menu.choose(5, 0);
  menu.rehearseAsItIs("/p/another");
  EXPECT_TRUE(menu.startsCheck());
  menu.rehearseAsItIs("/p/mine");
  EXPECT_FALSE(menu.startsCheck());
  EXPECT_EQ(menu.arguments(), Words({"rehearse", "/p/mine", "--device", "mouse"}));
}

TEST(StartMenu, TabGoesRoundAllListsAndBack) {
  StartMenu menu = smallMenu();
  for (std::size_t n = 0; n < kStartLists; ++n) {
    EXPECT_EQ(menu.focus(), n);
    press(menu, Key::tab);
  }
  EXPECT_EQ(menu.focus(), 0u);
  press(menu, Key::tab, true);
  EXPECT_EQ(menu.focus(), kStartLists - 1);
}

TEST(StartMenu, ASessionToGoOnWithBringsItsOwnCase) {
  StartMenu menu = smallMenu();
  menu.choose(5, 1);
  EXPECT_TRUE(menu.isOverruled(0));
  EXPECT_EQ(menu.arguments(), Words({"rehearse", "--device", "mouse", "--continue", "monday.molar"}));
  press(menu, Key::tab);
  EXPECT_EQ(menu.focus(), 1u) << "the list of cases is passed over";
  menu.choose(0, 0);
  EXPECT_FALSE(menu.isOverruled(0)) << "pointing at a case means a new rehearsal";
  EXPECT_EQ(menu.arguments(), Words({"rehearse", "--case", "shallow", "--device", "mouse"}));
}

TEST(StartMenu, ASessionOfAnImportedPatientGoesOnWithThatPatient) {
  StartLists lists = smallMenu().lists();
  lists[0].choices.push_back({.words = "mine", .beside = "", .about = "", .arguments = {"/mine"}, .is_imported = true});
  lists[5].choices[1].is_imported = true;
  StartMenu menu(lists);
  menu.choose(5, 1);
  EXPECT_FALSE(menu.isOverruled(0));
  EXPECT_EQ(press(menu, Key::enter), Answer::none) << "a built-in case is chosen";
  EXPECT_TRUE(menu.isTrouble());
  menu.choose(0, 2);
  EXPECT_EQ(menu.lists()[5].chosen, 1u);
  EXPECT_EQ(press(menu, Key::enter), Answer::start);
  EXPECT_EQ(menu.arguments(), Words({"rehearse", "/mine", "--device", "mouse", "--continue", "monday.molar"}));
}

/// A scan's mouth is as it was scanned, and a session's as it was.
TEST(StartMenu, TheMouthOpensOfABuiltInPatientThatIsNewAlone) {
  StartLists lists = smallMenu().lists();
  lists[0].choices.push_back({.words = "mine", .beside = "", .about = "", .arguments = {"/mine"}, .is_imported = true});
  StartMenu menu(lists);
  menu.choose(4, 1);
  EXPECT_EQ(menu.arguments(), Words({"rehearse", "--case", "deep", "--device", "mouse", "--opening", "25"}));
  menu.choose(0, 2);
  EXPECT_TRUE(menu.isOverruled(4));
  EXPECT_EQ(menu.arguments(), Words({"rehearse", "/mine", "--device", "mouse"}));
  menu.choose(4, 0);
  EXPECT_EQ(menu.lists()[0].chosen, 2u) << "pointing at it does not change the patient";
  EXPECT_NE(menu.focus(), 4u);
  menu.choose(0, 0), menu.choose(5, 1);
  EXPECT_TRUE(menu.isOverruled(4));
  menu.choose(4, 1);
  EXPECT_EQ(menu.arguments(), Words({"rehearse", "--case", "shallow", "--device", "mouse", "--opening", "25"}))
      << "whoever points at it means a new rehearsal";
}

TEST(StartMenu, TheWheelMovesTheChoiceOfTheListUnderIt) {
  StartMenu menu = smallMenu();
  menu.scroll(3, 1);
  EXPECT_EQ(menu.focus(), 3u);
  EXPECT_EQ(menu.lists()[3].chosen, 1u);
  menu.scroll(3, 5), menu.scroll(7, 1);
  EXPECT_EQ(menu.lists()[3].chosen, 1u) << "the last one";
  menu.scroll(5, 1);
  menu.scroll(0, -1);
  EXPECT_EQ(menu.lists()[0].chosen, 1u) << "overruled by the session";
  EXPECT_EQ(menu.lists()[5].chosen, 1u);
}

TEST(StartMenu, SaysWhyAChoiceCannotBeStarted) {
  StartMenu menu = smallMenu();
  menu.choose(1, 1);
  EXPECT_EQ(press(menu, Key::enter), Answer::none);
  EXPECT_EQ(menu.message(), "Touch: install its driver");
  press(menu, Key::up);
  EXPECT_EQ(menu.message(), "") << "until the next key";
  EXPECT_EQ(press(menu, Key::enter), Answer::start);
}

TEST(StartMenu, EscLeavesAndHeldOrReleasedKeysNeitherStartNorLeave) {
  StartMenu menu = smallMenu();
  for (const Key key : {Key::enter, Key::escape}) {
    EXPECT_EQ(menu.take({.key = key, .down = true, .repeated = true, .shift = false, .control = false}), Answer::none);
    EXPECT_EQ(menu.take({.key = key, .down = false, .repeated = false, .shift = false, .control = false}),
              Answer::none);
  }
  EXPECT_EQ(press(menu, Key::escape), Answer::leave);
}

TEST(StartMenu, AfterARehearsalTheChoicesAreAsBefore) {
  StartMenu former = smallMenu();
  former.choose(0, 0);
  former.choose(3, 1);
  former.choose(5, 1);
  StartMenu menu = smallMenu();
  menu.chooseAsIn(former.chosenWords());
  EXPECT_EQ(menu.lists()[0].chosen, 0u);
  EXPECT_EQ(menu.lists()[3].chosen, 1u);
  EXPECT_EQ(menu.lists()[5].chosen, 0u) << "a session is gone on with once";
}

/// Whatever is pressed and clicked: one choice in each list, never a list that does not count under the keys.
TEST(StartMenu, StaysWithinItsListsWhateverIsPressed) {
  std::mt19937 random(3);
  StartMenu menu = smallMenu();
  constexpr Key kKeys[] = {Key::tab, Key::left, Key::right, Key::up, Key::down, Key::home, Key::end, Key::space};
  for (int n = 0; n < 5000; ++n) {
    if (random() % 4 == 0)
      menu.choose(random() % 8, random() % 4);
    else
      press(menu, kKeys[random() % std::size(kKeys)], random() % 2 == 0);
    ASSERT_LT(menu.focus(), kStartLists);
    ASSERT_FALSE(menu.isOverruled(menu.focus()));
    for (const StartList& list : menu.lists()) ASSERT_LT(list.chosen, list.choices.size());
    ASSERT_EQ(menu.arguments()[0], "rehearse");
  }
}

}  // namespace
}  // namespace app
