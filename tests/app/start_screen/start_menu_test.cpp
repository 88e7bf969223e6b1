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
      {"Operation",
       {choice("Third molar", {}), choice("Root canal", {"--task", "root-canal"}),
        choice("Crown", {"--task", "preparation"})},
       0},
      {"Tooth", {choice("Point at it", {}), choice("46", {"--tooth", "46"}), choice("36", {"--tooth", "36"})}, 1},
      {"Hand", {choice("Mouse", {"--device", "mouse"}), choice("Touch", {"--device", "openhaptics"})}, 0},
      {"Calibration", {choice("Usual", {})}, 0},
      {"Patient", {choice("Seated", {}), choice("Behind", {"--position", "behind"})}, 0},
      {"Mouth opens", {choice("37 mm", {}), choice("25 mm", {"--opening", "25"})}, 0},
      {"Go on with", {choice("A new rehearsal", {}), choice("Monday", {"--continue", "monday.molar"})}, 0},
  };
  lists[1].choices[1].task = StartTask::root_canal, lists[1].choices[2].task = StartTask::preparation;
  lists[2].choices[1].fdi = 46, lists[2].choices[2].fdi = 36;
  lists[3].choices[1].why_not = "install its driver";
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
  lists[7].choices[1].is_imported = true;
  StartMenu menu(lists);
  EXPECT_FALSE(menu.startsCheck());
  menu.choose(0, 0);
  EXPECT_TRUE(menu.startsCheck());
  EXPECT_EQ(menu.arguments(), Words({"check", "/p/mine"}));
  // A session of it that goes on is a rehearsal.
  menu.choose(7, 1);
  EXPECT_EQ(menu.arguments().front(), "rehearse");
  menu.choose(7, 0);
  menu.rehearseAsItIs("/p/another");
  EXPECT_TRUE(menu.startsCheck());
  menu.rehearseAsItIs("/p/mine");
  EXPECT_FALSE(menu.startsCheck());
  EXPECT_EQ(menu.arguments(), Words({"rehearse", "/p/mine", "--device", "mouse"}));
}

TEST(StartMenu, TabGoesRoundAllListsAndBack) {
  StartMenu menu = smallMenu();
  for (const std::size_t list : {0, 1, 3, 4, 5, 6, 7}) {
    EXPECT_EQ(menu.focus(), list) << "a third molar is removed: no tooth is to be chosen";
    press(menu, Key::tab);
  }
  EXPECT_EQ(menu.focus(), 0u);
  press(menu, Key::tab, true);
  EXPECT_EQ(menu.focus(), kStartLists - 1);
}

TEST(StartMenu, ASessionToGoOnWithBringsItsOwnCase) {
  StartMenu menu = smallMenu();
  menu.choose(7, 1);
  EXPECT_TRUE(menu.isOverruled(0));
  EXPECT_EQ(menu.arguments(), Words({"rehearse", "--device", "mouse", "--continue", "monday.molar"}));
  press(menu, Key::tab);
  EXPECT_EQ(menu.focus(), 3u) << "the list of cases is passed over";
  menu.choose(0, 0);
  EXPECT_FALSE(menu.isOverruled(0)) << "pointing at a case means a new rehearsal";
  EXPECT_EQ(menu.arguments(), Words({"rehearse", "--case", "shallow", "--device", "mouse"}));
}

TEST(StartMenu, ASessionOfAnImportedPatientGoesOnWithThatPatient) {
  StartLists lists = smallMenu().lists();
  lists[0].choices.push_back({.words = "mine", .beside = "", .about = "", .arguments = {"/mine"}, .is_imported = true});
  lists[7].choices[1].is_imported = true;
  StartMenu menu(lists);
  menu.choose(7, 1);
  EXPECT_FALSE(menu.isOverruled(0));
  EXPECT_EQ(press(menu, Key::enter), Answer::none) << "a built-in case is chosen";
  EXPECT_TRUE(menu.isTrouble());
  menu.choose(0, 2);
  EXPECT_EQ(menu.lists()[7].chosen, 1u);
  EXPECT_EQ(press(menu, Key::enter), Answer::start);
  EXPECT_EQ(menu.arguments(), Words({"rehearse", "/mine", "--device", "mouse", "--continue", "monday.molar"}));
}

/// A scan's mouth is as it was scanned, and a session's as it was.
TEST(StartMenu, TheMouthOpensOfABuiltInPatientThatIsNewAlone) {
  StartLists lists = smallMenu().lists();
  lists[0].choices.push_back({.words = "mine", .beside = "", .about = "", .arguments = {"/mine"}, .is_imported = true});
  StartMenu menu(lists);
  menu.choose(6, 1);
  EXPECT_EQ(menu.arguments(), Words({"rehearse", "--case", "deep", "--device", "mouse", "--opening", "25"}));
  menu.choose(0, 2);
  EXPECT_TRUE(menu.isOverruled(6));
  EXPECT_EQ(menu.arguments(), Words({"rehearse", "/mine", "--device", "mouse"}));
  menu.choose(6, 0);
  EXPECT_EQ(menu.lists()[0].chosen, 2u) << "pointing at it does not change the patient";
  EXPECT_NE(menu.focus(), 6u);
  menu.choose(0, 0), menu.choose(7, 1);
  EXPECT_TRUE(menu.isOverruled(6));
  menu.choose(6, 1);
  EXPECT_EQ(menu.arguments(), Words({"rehearse", "--case", "shallow", "--device", "mouse", "--opening", "25"}))
      << "whoever points at it means a new rehearsal";
}

TEST(StartMenu, TheWheelMovesTheChoiceOfTheListUnderIt) {
  StartMenu menu = smallMenu();
  menu.scroll(5, 1);
  EXPECT_EQ(menu.focus(), 5u);
  EXPECT_EQ(menu.lists()[5].chosen, 1u);
  menu.scroll(5, 5), menu.scroll(9, 1);
  EXPECT_EQ(menu.lists()[5].chosen, 1u) << "the last one";
  menu.scroll(7, 1);
  menu.scroll(0, -1);
  EXPECT_EQ(menu.lists()[0].chosen, 1u) << "overruled by the session";
  EXPECT_EQ(menu.lists()[7].chosen, 1u);
}

TEST(StartMenu, ATaskOfOneToothAsksWhichOne) {
  StartMenu menu = smallMenu();
  menu.choose(2, 2);
  EXPECT_EQ(menu.lists()[2].chosen, 1u) << "no tooth counts while a third molar is removed";
  menu.choose(1, 1);
  EXPECT_FALSE(menu.isOverruled(2));
  press(menu, Key::tab);
  EXPECT_EQ(menu.focus(), 2u);
  EXPECT_EQ(menu.arguments(),
            Words({"rehearse", "--case", "deep", "--task", "root-canal", "--tooth", "46", "--device", "mouse"}));
  press(menu, Key::up);
  EXPECT_EQ(menu.arguments(), Words({"rehearse", "--case", "deep", "--task", "root-canal", "--device", "mouse"}));
  EXPECT_EQ(press(menu, Key::enter), Answer::start) << "the tooth is pointed at";
  menu.choose(1, 2);
  EXPECT_EQ(press(menu, Key::enter), Answer::none);
  EXPECT_NE(menu.message().find("Choose the tooth"), std::string::npos) << menu.message();
  menu.choose(2, 2);
  EXPECT_EQ(press(menu, Key::enter), Answer::start);
  // A session to go on with has its own.
  menu.choose(7, 1);
  EXPECT_TRUE(menu.isOverruled(1) && menu.isOverruled(2));
  EXPECT_EQ(menu.arguments(), Words({"rehearse", "--device", "mouse", "--continue", "monday.molar"}));
  menu.choose(2, 1);
  EXPECT_FALSE(menu.isOverruled(2)) << "pointing at a tooth means a new treatment";
}

TEST(StartMenu, TheCaseFollowsTheSideOfTheToothAndTheToothThatOfTheCase) {
  StartLists lists = smallMenu().lists();
  lists[0].choices[0].fdi = 38, lists[0].choices[1].fdi = 48;
  lists[2].choices.push_back({.words = "37", .beside = "", .about = "", .arguments = {"--tooth", "37"}, .fdi = 37});
  StartMenu menu(lists);
  menu.choose(1, 1);
  menu.choose(2, 3);
  EXPECT_EQ(menu.lists()[0].chosen, 0u) << "37 is of a left jaw";
  menu.choose(2, 1);
  EXPECT_EQ(menu.lists()[0].chosen, 1u);
  menu.choose(0, 0);
  EXPECT_EQ(menu.lists()[2].choice().words, "36") << "the same tooth of the other side";
  press(menu, Key::down);
  EXPECT_EQ(menu.lists()[2].choice().words, "46");
  menu.choose(2, 0);
  menu.choose(0, 0);
  EXPECT_EQ(menu.lists()[2].chosen, 0u) << "one that is pointed at is of any side";
}

TEST(StartMenu, SaysWhatDoesNotGoTogether) {
  StartLists lists = smallMenu().lists();
  lists[0].choices[0].has_mouth = false;
  lists[3].choices.push_back(
      {.words = "All of it", .beside = "", .about = "", .arguments = {}, .is_of_extraction = true});
  const auto said = [&](std::size_t of_case, std::size_t task, std::size_t hand) {
    StartMenu menu(lists);
    menu.choose(0, of_case), menu.choose(1, task), menu.choose(3, hand);
    return press(menu, Key::enter) == Answer::start ? std::string("started") : menu.message();
  };
  EXPECT_EQ(said(1, 0, 2), "started");
  EXPECT_EQ(said(0, 0, 2), "started");
  EXPECT_EQ(said(1, 1, 0), "started");
  EXPECT_NE(said(0, 1, 0).find("has no tooth"), std::string::npos);
  EXPECT_NE(said(1, 1, 2).find("removes a third molar"), std::string::npos);
  EXPECT_NE(said(1, 2, 2).find("removes a third molar"), std::string::npos);
}

TEST(StartMenu, SaysWhyAChoiceCannotBeStarted) {
  StartMenu menu = smallMenu();
  menu.choose(3, 1);
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
  former.choose(5, 1);
  former.choose(7, 1);
  StartMenu menu = smallMenu();
  menu.chooseAsIn(former.chosenWords());
  EXPECT_EQ(menu.lists()[0].chosen, 0u);
  EXPECT_EQ(menu.lists()[5].chosen, 1u);
  EXPECT_EQ(menu.lists()[7].chosen, 0u) << "a session is gone on with once";
}

/// Whatever is pressed and clicked: one choice in each list, never a list that does not count under the keys.
TEST(StartMenu, StaysWithinItsListsWhateverIsPressed) {
  std::mt19937 random(3);
  StartMenu menu = smallMenu();
  constexpr Key kKeys[] = {Key::tab, Key::left, Key::right, Key::up, Key::down, Key::home, Key::end, Key::space};
  for (int n = 0; n < 5000; ++n) {
    if (random() % 4 == 0)
      menu.choose(random() % 10, random() % 4);
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
