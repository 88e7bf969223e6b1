#include "app/start_screen/start_lists.h"

#include <gtest/gtest.h>

#include <array>

#include "app/case/case.h"
#include "app/commands/rehearse_options.h"
#include "app/procedure/preparation/ideal_rule.h"
#include "app/text/command_line.h"
#include "assets/synthetic/practice_block.h"
#include "assets/synthetic/preparation_block.h"

namespace app {
namespace {

constexpr std::size_t kBlocks = assets::kPracticeTasks.size() + assets::kPreparationBlocks.size();

std::vector<haptics::FoundDevice> foundDevices() {
  return {{.name = "Touch",
           .address = "openhaptics",
           .location = "OpenHaptics, default device",
           .driver = "OpenHaptics",
           .advice = ""},
          {.name = "Touch X", .address = "", .location = "USB 1-3", .driver = "", .advice = "install OpenHaptics"}};
}

std::vector<SessionListing> foundSessions() {
  std::vector<SessionListing> sessions;
  for (int n = 0; n < 20; ++n) {
    SessionListing one;
    one.path = "/data/" + std::to_string(n) + ".molar";
    one.case_title = "lower right third molar";
    one.length_s = 61.0;
    one.verdict = n == 1 ? SessionVerdict::damaged : n == 2 ? SessionVerdict::recording : SessionVerdict::complete;
    sessions.push_back(one);
  }
  return sessions;
}

std::size_t at(StartListName list) { return static_cast<std::size_t>(list); }

/// A first molar and one that is impacted.
std::vector<CanalTooth> someTeeth() {
  CanalTooth molar{46, assets::ToothCanals(), ""}, buried{48, assets::ToothCanals(), "impacted"};
  for (const char* name : {"mesiobuccal", "distal"}) {
    assets::ToothCanal canal;
    canal.name = name;
    canal.places = {{{0.0, 0.0, 0.0}, 0.0, 0.3, 0.3}, {{0.0, 0.0, -12.0}, 12.0, 0.2, 0.2}};
    molar.canals->canals.push_back(canal);
  }
  buried.canals = molar.canals;
  return {molar, buried};
}

StartLists someLists(std::size_t patients = 0) {
  StartFindings found{.patients = {},
                      .devices = foundDevices(),
                      .calibrations = {{"rig-02", "SIM-D7", "right"}},
                      .sessions = foundSessions(),
                      .teeth = someTeeth()};
  for (std::size_t n = 0; n < patients; ++n)
    found.patients.push_back({"/data/patients/mine " + std::to_string(n), "mine " + std::to_string(n),
                              "imported scan, lower left third molar (38)"});
  return startLists(found);
}

/// What the parser of `molar rehearse` makes of them.
RehearseOptions parsed(const std::vector<std::string>& arguments) {
  RehearseOptions options;
  CommandLine molar("test", "");
  CommandLine& rehearse = molar.command("rehearse", "test");
  addRehearseOptions(rehearse, options);
  rehearse.does([] { return 0; });
  std::vector<const char*> words{"molar"};
  for (const std::string& argument : arguments) words.push_back(argument.c_str());
  EXPECT_EQ(molar.run(static_cast<int>(words.size()), words.data()), 0);
  return options;
}

TEST(StartLists, EveryCaseIsOfferedTheUsualOneFirstChosen) {
  const StartList list = someLists()[0];
  ASSERT_EQ(list.choices.size(), cases().size() + kBlocks);
  EXPECT_EQ(list.choices.back().arguments, std::vector<std::string>({"--case", "block-stump"}));
  for (std::size_t n = 0; n < cases().size(); ++n)
    EXPECT_EQ(list.choices[n].arguments, std::vector<std::string>({"--case", std::string(cases()[n].name)}));
  EXPECT_EQ(list.choice().arguments[1], usualCase().name);
}

TEST(StartLists, ImportedPatientsAreOfferedBeforeTheCases) {
  const StartList list = someLists(20)[0];
  ASSERT_EQ(list.choices.size(), kPatientsOffered + cases().size() + kBlocks);
  EXPECT_EQ(list.choices[1].words, "mine 1");
  EXPECT_EQ(list.choices[1].arguments, std::vector<std::string>({"/data/patients/mine 1"}));
  EXPECT_EQ(list.choice().arguments[1], usualCase().name) << "the usual case is chosen at first";
  StartMenu menu(someLists(20));
  menu.choose(0, 1);
  const RehearseOptions options = parsed(menu.arguments());
  EXPECT_EQ(options.patient, "/data/patients/mine 1");
  EXPECT_EQ(options.case_name, "");
}

TEST(StartLists, APatientThatNobodyConfirmedIsToBeChecked) {
  StartFindings found{.patients = {{"/p/a", "a", "imported scan", true}, {"/p/b", "b", "imported scan", false}},
                      .devices = {},
                      .calibrations = {},
                      .sessions = {},
                      .teeth = {}};
  StartMenu menu(startLists(found));
  menu.choose(0, 0);
  EXPECT_EQ(menu.lists()[0].choice().beside, "to be checked");
  EXPECT_EQ(menu.arguments(), std::vector<std::string>({"check", "/p/a"}));
  menu.choose(0, 1);
  EXPECT_EQ(menu.lists()[0].choice().beside, "imported");
  EXPECT_EQ(menu.arguments().front(), "rehearse");
}

TEST(StartLists, EveryChoiceIsAcceptedByTheCommandLine) {
  const StartLists lists = someLists();
  for (std::size_t list = 0; list < lists.size(); ++list)
    for (std::size_t choice = 0; choice < lists[list].choices.size(); ++choice) {
      StartMenu menu(lists);
      if (list == at(StartListName::teeth)) menu.choose(at(StartListName::tasks), 1);
      menu.choose(list, choice);
      if (!lists[list].choices[choice].why_not.empty()) continue;
      const RehearseOptions options = parsed(menu.arguments());
      EXPECT_EQ(options.case_name.empty(), menu.isOverruled(0));
      if (list == at(StartListName::position) && choice == 4) {
        EXPECT_EQ(options.position, "behind");
      }
      if (list == at(StartListName::hand) && choice == 1) {
        EXPECT_EQ(options.plan.device, "openhaptics");
      }
      if (list == at(StartListName::calibration) && choice > 0) {
        EXPECT_TRUE(options.rig.isGiven());
      }
      if (list == at(StartListName::opening)) {
        EXPECT_EQ(options.opening_mm.value_or(37.0), (std::array{37.0, 50.0, 30.0, 25.0}.at(choice)));
      }
      if (list == at(StartListName::sessions)) {
        EXPECT_EQ(options.assess, choice == 1);
      }
      if (list == at(StartListName::sessions) && choice == 2) {
        EXPECT_EQ(options.continued, "/data/0.molar");
      }
    }
}

TEST(StartLists, TeethAreOfferedByNumberWithTheirCanalsOnBothSides) {
  const StartList list = someLists()[at(StartListName::teeth)];
  ASSERT_EQ(list.choices.size(), 3u) << "pointed at, 46, 36; no impacted one";
  EXPECT_TRUE(list.choices[0].arguments.empty());
  EXPECT_EQ(list.choice().words, "46") << "chosen at first";
  EXPECT_EQ(list.choice().beside, "2 canals");
  EXPECT_NE(list.choice().about.find("mesiobuccal"), std::string::npos);
  EXPECT_EQ(list.choices[2].words, "36");
  EXPECT_NE(list.choices[2].about.find("Lower left first molar"), std::string::npos) << list.choices[2].about;
}

TEST(StartLists, EveryIdealIsOfferedAsTheCommandLineHasIt) {
  const StartList list = someLists()[at(StartListName::tasks)];
  ASSERT_EQ(list.choices.size(), 3 + idealRules().size());
  for (std::size_t n = 0; n < idealRules().size(); ++n) {
    StartMenu menu(someLists());
    menu.choose(at(StartListName::tasks), 3 + n);
    const RehearseOptions options = parsed(menu.arguments());
    EXPECT_EQ(options.task, "preparation");
    EXPECT_EQ(options.ideal, idealRules()[n].name);
    EXPECT_EQ(options.tooth, std::optional<int>(46));
  }
  StartMenu menu(someLists());
  menu.choose(at(StartListName::tasks), 2);
  menu.choose(at(StartListName::teeth), 2);
  const RehearseOptions options = parsed(menu.arguments());
  EXPECT_EQ(options.task, "root-canal");
  EXPECT_EQ(options.access, "open");
  EXPECT_EQ(options.tooth, std::optional<int>(36));
  EXPECT_EQ(caseNamed(options.case_name)->fdi(), 38) << "of a left jaw";
}

TEST(StartLists, AUnitThatIsNotReadyTellsItsNextStep) {
  const StartList hand = someLists()[at(StartListName::hand)];
  ASSERT_EQ(hand.choices.size(), 5u) << "mouse, two units, two demonstrations";
  EXPECT_EQ(hand.choices[1].why_not, "");
  EXPECT_EQ(hand.choices[2].why_not, "install OpenHaptics");
}

TEST(StartLists, SessionsThatCannotBeGoneOnWithAreLeftOut) {
  const StartList list = someLists()[at(StartListName::sessions)];
  ASSERT_EQ(list.choices.size(), 2 + kSessionsOffered);
  EXPECT_EQ(list.choices[2].arguments[1], "/data/0.molar");
  EXPECT_EQ(list.choices[3].arguments[1], "/data/3.molar");
  EXPECT_EQ(list.choices[2].beside, "1:01");
}

}  // namespace
}  // namespace app
