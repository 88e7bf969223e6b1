#include "app/check_page/check_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>

#include "assets/patient/scan_origin_toml.h"
#include "assets/patient/statement_file.h"
#include "tests/app/check_page/phantom_patient.h"

namespace app {
namespace {

using render::Key;

constexpr glm::ivec2 kWindow_px{1280, 800};

/// A page and a hand on it.
class CheckRunTest : public testing::Test {
 protected:
  static const tests::ArchPhantom& phantom() {
    static const tests::ArchPhantom one = tests::archPhantom({.spacing_mm = 0.8});
    return one;
  }
  static const assets::Patient& patient() {
    static const assets::Patient one = tests::phantomPatient(phantom());
    return one;
  }
  static std::unique_ptr<CheckRun> open(const std::string& folder) {
    auto run = std::make_unique<CheckRun>(folder, [](const std::string&) {});
    run->finish();
    return run;
  }
  static void type(CheckRun& run, char32_t letter) { run.handle(render::LetterTyped{letter}, kWindow_px); }
  static bool press(CheckRun& run, Key key, bool control = false) {
    return run.handle(render::KeyPressed{.key = key, .down = true, .control = control}, kWindow_px);
  }
  static void clickOn(CheckRun& run, const glm::dvec2& px) {
    run.handle(render::PointerMoved{px, {}, render::MouseButton::none}, kWindow_px);
    run.handle(render::ButtonPressed{render::MouseButton::left, true}, kWindow_px);
    run.handle(render::ButtonPressed{render::MouseButton::left, false}, kWindow_px);
  }
  static void drag(CheckRun& run, const glm::dvec2& from_px, const glm::dvec2& to_px) {
    run.handle(render::PointerMoved{from_px, {}, render::MouseButton::none}, kWindow_px);
    run.handle(render::ButtonPressed{render::MouseButton::left, true}, kWindow_px);
    for (int n = 1; n <= 5; ++n)
      run.handle(render::PointerMoved{glm::mix(from_px, to_px, n / 5.0), {}, render::MouseButton::left}, kWindow_px);
    run.handle(render::ButtonPressed{render::MouseButton::left, false}, kWindow_px);
  }
  static std::size_t voxelsOf(const CheckRun& run, int fdi) {
    return static_cast<std::size_t>(std::ranges::count(run.found().tooth, static_cast<std::uint8_t>(fdi)));
  }
  /// Looks at the place, then clicks it in the slice with the tool in hand.
  static void clickTooth(CheckRun& run, int fdi) {
    const auto row = std::ranges::find(run.menu().rows(), fdi, &CheckRow::fdi);
    ASSERT_NE(row, run.menu().rows().end());
    const glm::dvec3 p = row->at_P_mm;
    for (int n = 0; n < 30; ++n) press(run, Key::up);
    for (auto n = row - run.menu().rows().begin(); n > 0; --n) press(run, Key::down);
    clickOn(run, run.placeOf(JawView::axial, p, kWindow_px));
  }

  tests::PhantomFolder folder_{"molar_check_page_", patient()};
};

TEST_F(CheckRunTest, ShowsWhatTheImportFound) {
  const auto run = open(folder_.path());
  EXPECT_EQ(run->found().teeth.size(), 16u);
  EXPECT_FALSE(run->menu().isChanged());
  EXPECT_EQ(run->menu().rows()[run->menu().selected()].fdi, 48);
  const render::Image picture = run->picture(kWindow_px);
  EXPECT_EQ(picture.w, kWindow_px.x);
  EXPECT_EQ(picture.h, kWindow_px.y);
}

TEST_F(CheckRunTest, BeforeTheJawIsFoundAgainTheOtherSidesCanalIsLookedFor) {
  const auto left = [](const CheckRun& run) {
    return *std::ranges::find_if(
        run.menu().rows(), [](const CheckRow& row) { return row.kind == CheckRow::Kind::canal && !row.is_right; });
  };
  const CheckRun run(folder_.path(), [](const std::string&) {});
  EXPECT_EQ(left(run).beside, "is looked for");
  EXPECT_EQ(left(run).light, Light::open);
  EXPECT_THAT(left(*open(folder_.path())).beside, testing::Not(testing::HasSubstr("looked for")));
}

TEST_F(CheckRunTest, ClicksMakeThePatientThatTheSameClicksMakeAtImport) {
  const auto run = open(folder_.path());
  press(*run, Key::enter);
  type(*run, U'-');
  clickTooth(*run, 37);
  ASSERT_EQ(run->menu().edits().done(), 2u) << run->menu().message();
  run->finish();
  EXPECT_EQ(run->found().teeth.size(), 15u);
  const assets::JawClicks clicks = run->menu().edits().clicks();
  press(*run, render::keyOf('S'), true);
  run->finish();
  EXPECT_EQ(run->menu().message(), "saved");
  const assets::Patient saved = assets::loadPatient(folder_.path());
  const assets::Patient imported = tests::phantomPatient(phantom(), clicks);
  EXPECT_TRUE(saved.ct.label == imported.ct.label);
  EXPECT_TRUE(saved.ct.tooth == imported.ct.tooth);
  EXPECT_TRUE(saved.ct.hounsfield == imported.ct.hounsfield);
  ASSERT_TRUE(saved.found);
  EXPECT_TRUE(saved.found->tooth);
  EXPECT_FALSE(saved.found->canal);
  // It opens as it was saved, and can be undone then.
  const auto again = open(folder_.path());
  EXPECT_FALSE(again->menu().isChanged());
  EXPECT_EQ(again->found().teeth.size(), 15u);
  press(*again, render::keyOf('Z'), true);
  again->finish();
  EXPECT_EQ(again->found().teeth.size(), 16u);
}

TEST_F(CheckRunTest, StrokesAndCutsMakeThePatientThatTheSameFileMakesAtImport) {
  const auto run = open(folder_.path());
  const std::size_t before = voxelsOf(*run, 48);
  const glm::dvec2 at = run->placeOf(JawView::axial, run->menu().cursor_P_mm(), kWindow_px);
  type(*run, U'b'), type(*run, U'g'), type(*run, U'0');
  drag(*run, at, at + glm::dvec2(20.0, 0.0));
  EXPECT_LT(voxelsOf(*run, 48), before);
  EXPECT_FALSE(run->isBusy()) << "a stroke is shown at once";
  type(*run, U'7'), type(*run, U']');
  drag(*run, at, at + glm::dvec2(-15.0, 8.0));
  type(*run, U'x');
  clickOn(*run, at + glm::dvec2(-30.0, 0.0)), clickOn(*run, at + glm::dvec2(30.0, 0.0));
  clickOn(*run, at + glm::dvec2(0.0, 30.0));
  ASSERT_EQ(run->menu().edits().done(), 3u) << run->menu().message();
  // A click on a tooth in between: strokes lie on what it makes.
  type(*run, U'-');
  clickTooth(*run, 37);
  run->finish();
  const assets::JawClicks clicks = run->menu().edits().clicks();
  ASSERT_EQ(clicks.voxels.size(), 3u);
  press(*run, render::keyOf('S'), true);
  run->finish();
  EXPECT_EQ(run->menu().message(), "saved");
  const assets::Patient saved = assets::loadPatient(folder_.path());
  const assets::Patient imported = tests::phantomPatient(phantom(), clicks);
  EXPECT_TRUE(saved.ct.label == imported.ct.label);
  EXPECT_TRUE(saved.ct.tooth == imported.ct.tooth);
  const auto again = open(folder_.path());
  EXPECT_FALSE(again->menu().isChanged());
  EXPECT_TRUE(again->found().tooth == run->found().tooth);
  for (int n = 0; n < 4; ++n) press(*again, render::keyOf('Z'), true);
  again->finish();
  EXPECT_EQ(voxelsOf(*again, 48), before);
}

/// What differs is drawn over the picture before: the same pixels as a page that is drawn whole.
TEST_F(CheckRunTest, WhatChangedIsDrawnAsAWholePageIs) {
  const auto run = open(folder_.path());
  const auto expect_whole = [&](const char* after) {
    const render::Image changed = run->picture(kWindow_px);
    run->picture({1000, 700});
    EXPECT_TRUE(changed.rgba == run->picture(kWindow_px).rgba) << after;
  };
  run->picture(kWindow_px);
  const glm::dvec2 at = run->placeOf(JawView::axial, run->menu().cursor_P_mm(), kWindow_px);
  type(*run, U'b'), type(*run, U'g'), type(*run, U'0');
  run->handle(render::PointerMoved{at, {}, render::MouseButton::none}, kWindow_px);
  run->handle(render::ButtonPressed{render::MouseButton::left, true}, kWindow_px);
  for (int n = 1; n < 6; ++n) {
    run->handle(render::PointerMoved{at + glm::dvec2(4.0 * n, 0.0), {}, render::MouseButton::left}, kWindow_px);
    run->picture(kWindow_px);
  }
  run->handle(render::ButtonPressed{render::MouseButton::left, false}, kWindow_px);
  expect_whole("a stroke");
  press(*run, render::keyOf('Z'), true);
  expect_whole("taking it back");
  type(*run, U'-');
  clickTooth(*run, 37);
  run->finish();
  expect_whole("a click");
  press(*run, Key::down);
  expect_whole("a row");
  run->handle(render::WheelTurned{3.0}, kWindow_px);
  expect_whole("another slice");
}

TEST_F(CheckRunTest, ACanalsEndIsDraggedAPointInsertedAndRemoved) {
  const auto run = open(folder_.path());
  while (run->menu().rows()[run->menu().selected()].kind != CheckRow::Kind::canal) press(*run, Key::down);
  const bool is_right = run->menu().rows()[run->menu().selected()].is_right;
  const auto canal = std::ranges::find(run->found().canals, is_right, &assets::CanalProposal::is_right);
  ASSERT_NE(canal, run->found().canals.end());
  const glm::dvec3 end = canal->line_P_mm.front(), middle = canal->line_P_mm[canal->line_P_mm.size() / 2];
  const auto look_at = [&](const glm::dvec3& p) {
    clickOn(*run, run->placeOf(JawView::axial, p, kWindow_px));
    const double off_mm = run->views().planeOf(JawView::axial, run->menu().cursor_P_mm(), {}, {100, 100}).of(p).z;
    run->handle(render::WheelTurned{std::round(off_mm / run->views().grid().spacing_mm)}, kWindow_px);
  };
  look_at(end);
  type(*run, U'c');
  const glm::dvec2 at = run->placeOf(JawView::axial, end, kWindow_px);
  drag(*run, at, at + glm::dvec2(6.0, 4.0));
  ASSERT_EQ(run->menu().edits().done(), 1u) << run->menu().message();
  const CanalClicks* clicked = run->menu().edits().canalOn(is_right);
  ASSERT_NE(clicked, nullptr);
  ASSERT_EQ(clicked->at_P_mm.size(), 2u);
  EXPECT_GT(glm::distance(clicked->at_P_mm.front(), end), 0.5);
  EXPECT_LT(glm::distance(clicked->at_P_mm.front(), end), 4.0);
  run->finish();
  type(*run, U'l');
  look_at(middle);
  const auto moved = std::ranges::find(run->found().canals, is_right, &assets::CanalProposal::is_right);
  ASSERT_NE(moved, run->found().canals.end());
  ASSERT_TRUE(moved->is_confirmed) << run->menu().message();
  glm::dvec3 on = moved->line_P_mm.front();
  for (const glm::dvec3& p : moved->line_P_mm)
    if (glm::distance(p, middle) < glm::distance(on, middle)) on = p;
  look_at(on);
  type(*run, U'c');
  const glm::dvec2 on_px = run->placeOf(JawView::axial, on, kWindow_px);
  drag(*run, on_px, on_px + glm::dvec2(0.0, 5.0));
  ASSERT_EQ(run->menu().edits().done(), 2u) << run->menu().message();
  ASSERT_EQ(run->menu().edits().canalOn(is_right)->at_P_mm.size(), 3u);
  run->finish();
  ASSERT_EQ(run->menu().edits().done(), 2u) << run->menu().message();
  run->handle(render::PointerMoved{on_px + glm::dvec2(0.0, 5.0), {}, render::MouseButton::none}, kWindow_px);
  press(*run, Key::erase);
  EXPECT_EQ(run->menu().edits().canalOn(is_right)->at_P_mm.size(), 2u);
  run->finish();
}

TEST_F(CheckRunTest, AClickOnAProposalsEndTakesThatEnd) {
  const auto run = open(folder_.path());
  const auto canal = std::ranges::find(run->found().canals, true, &assets::CanalProposal::is_right);
  ASSERT_NE(canal, run->found().canals.end());
  ASSERT_FALSE(canal->is_confirmed);
  const std::array ends{canal->line_P_mm.front(), canal->line_P_mm.back()};
  const auto click_end = [&](const glm::dvec3& end) {
    const double off_mm = run->views().planeOf(JawView::axial, run->menu().cursor_P_mm(), {}, {100, 100}).of(end).z;
    run->handle(render::PointerMoved{run->placeOf(JawView::axial, end, kWindow_px), {}, render::MouseButton::none},
                kWindow_px);
    run->handle(render::WheelTurned{std::round(off_mm / run->views().grid().spacing_mm)}, kWindow_px);
    clickOn(*run, run->placeOf(JawView::axial, end, kWindow_px));
  };
  type(*run, U'c');
  click_end(ends[0]);
  ASSERT_EQ(run->menu().pending().size(), 1u) << run->menu().message();
  EXPECT_EQ(run->menu().pending().front(), ends[0]);
  click_end(ends[1]);
  const CanalClicks* const clicked = run->menu().edits().canalOn(true);
  ASSERT_NE(clicked, nullptr) << run->menu().message();
  EXPECT_EQ(clicked->at_P_mm, std::vector(ends.begin(), ends.end()));
  run->finish();
  EXPECT_EQ(run->menu().edits().done(), 1u) << run->menu().message();
  // Its points are there to be dragged from now on: a click on one changes nothing and says so.
  click_end(ends[0]);
  EXPECT_EQ(run->menu().edits().done(), 1u);
  EXPECT_THAT(run->menu().message(), testing::HasSubstr("drag it"));
}

TEST_F(CheckRunTest, AToothThatIsClickedIsChosenInTheListAndPaintedByTheBrush) {
  const auto run = open(folder_.path());
  EXPECT_EQ(run->menu().rows()[run->menu().selected()].fdi, 48);
  const auto row = std::ranges::find(run->menu().rows(), 36, &CheckRow::fdi);
  ASSERT_NE(row, run->menu().rows().end());
  const glm::dvec2 at = run->placeOf(JawView::panoramic, row->at_P_mm, kWindow_px);
  ASSERT_TRUE(std::isfinite(at.x));
  clickOn(*run, at);
  EXPECT_EQ(run->menu().rows()[run->menu().selected()].fdi, 36);
  type(*run, U'b');
  EXPECT_EQ(run->menu().brush().as, 36);
}

TEST_F(CheckRunTest, ThatEndIsTakenInThePanoramicViewToo) {
  const auto run = open(folder_.path());
  const auto canal = std::ranges::find(run->found().canals, true, &assets::CanalProposal::is_right);
  ASSERT_NE(canal, run->found().canals.end());
  const glm::dvec3 end = canal->line_P_mm.back();
  const glm::dvec2 at = run->placeOf(JawView::panoramic, end, kWindow_px);
  ASSERT_TRUE(std::isfinite(at.x)) << "beyond the panoramic view";
  type(*run, U'c');
  clickOn(*run, at);
  ASSERT_EQ(run->menu().pending().size(), 1u) << run->menu().message();
  EXPECT_EQ(run->menu().pending().front(), end);
}

TEST_F(CheckRunTest, WhileItIsSavedToolsAreTakenAndEditsWait) {
  const auto run = open(folder_.path());
  press(*run, Key::enter);
  run->finish();
  press(*run, render::keyOf('S'), true);
  ASSERT_TRUE(run->isBusy());
  type(*run, U'c');
  EXPECT_EQ(run->menu().tool(), CheckTool::canal);
  press(*run, Key::down);
  press(*run, Key::enter);
  press(*run, render::keyOf('Z'), true);
  clickOn(*run, run->placeOf(JawView::axial, run->menu().cursor_P_mm(), kWindow_px));
  EXPECT_EQ(run->menu().edits().done(), 1u);
  EXPECT_TRUE(run->menu().pending().empty());
  EXPECT_THAT(run->menu().message(), testing::HasSubstr("one moment"));
  run->finish();
  EXPECT_EQ(run->menu().message(), "saved");
  EXPECT_FALSE(run->menu().isChanged());
  press(*run, Key::enter);
  EXPECT_EQ(run->menu().edits().done(), 2u) << run->menu().message();
}

TEST_F(CheckRunTest, TheTitleSaysWhetherToothAndCanalAreConfirmed) {
  const auto run = open(folder_.path());
  EXPECT_THAT(run->title(), testing::EndsWith("not confirmed"));
  press(*run, Key::enter);
  run->finish();
  EXPECT_THAT(run->title(), testing::EndsWith("not confirmed")) << "the canal is open";
  while (run->menu().rows()[run->menu().selected()].kind != CheckRow::Kind::canal ||
         !run->menu().rows()[run->menu().selected()].is_right)
    press(*run, Key::down);
  press(*run, Key::enter);
  EXPECT_THAT(run->title(), testing::Not(testing::EndsWith("not confirmed")));
  press(*run, render::keyOf('Z'), true);
  EXPECT_THAT(run->title(), testing::EndsWith("not confirmed"));
}

TEST_F(CheckRunTest, EnterPressedWhileItIsComputedSaysItOnce) {
  const auto run = open(folder_.path());
  for (int n = 0; n < 6; ++n) press(*run, Key::enter);
  EXPECT_EQ(run->menu().edits().done(), 1u);
  run->finish();
  for (int n = 0; n < 6; ++n) press(*run, Key::enter);
  EXPECT_EQ(run->menu().edits().done(), 1u);
  EXPECT_EQ(run->menu().rows()[run->menu().selected()].light, Light::confirmed);
}

TEST_F(CheckRunTest, AConfirmedCanalIsSaved) {
  const auto run = open(folder_.path());
  const auto canal = std::ranges::find_if(run->menu().rows(), [](const CheckRow& row) {
    return row.kind == CheckRow::Kind::canal && row.is_right && row.is_there;
  });
  ASSERT_NE(canal, run->menu().rows().end());
  for (auto n = canal - run->menu().rows().begin() - static_cast<long>(run->menu().selected()); n > 0; --n)
    press(*run, Key::down);
  press(*run, Key::enter);
  press(*run, render::keyOf('S'), true);
  run->finish();
  const assets::Patient saved = assets::loadPatient(folder_.path());
  EXPECT_TRUE(saved.found->canal);
  EXPECT_EQ(saved.mandibular_canal_P_mm, patient().mandibular_canal_P_mm);
  EXPECT_FALSE(open(folder_.path())->menu().isChanged());
}

TEST_F(CheckRunTest, ARefusedCanalLeavesNothingBehind) {
  const auto run = open(folder_.path());
  while (run->menu().rows()[run->menu().selected()].kind != CheckRow::Kind::canal) press(*run, Key::down);
  press(*run, Key::erase);
  press(*run, render::keyOf('S'), true);
  run->finish();
  const assets::Patient saved = assets::loadPatient(folder_.path());
  EXPECT_TRUE(saved.mandibular_canal_P_mm.empty());
  EXPECT_FALSE(saved.isProposed() && saved.found->tooth);
}

// As a kill leaves it: the page is gone without a word.
TEST_F(CheckRunTest, NothingIsLostByAKill) {
  {
    const auto run = open(folder_.path());
    type(*run, U'-');
    clickTooth(*run, 37);
    type(*run, U'8');
    clickTooth(*run, 48);
  }
  const auto run = open(folder_.path());
  EXPECT_TRUE(run->menu().isChanged());
  EXPECT_EQ(run->menu().edits().done(), 2u);
  EXPECT_EQ(run->found().teeth.size(), 15u);
  EXPECT_TRUE(press(*run, Key::escape)) << "asks first";
  EXPECT_TRUE(run->menu().asks());
  EXPECT_FALSE(press(*run, Key::escape));
}

TEST_F(CheckRunTest, AClickThatDoesNotFitIsTakenBackAndSaid) {
  const auto run = open(folder_.path());
  type(*run, U'-');
  clickOn(*run, run->placeOf(JawView::axial, run->views().middle_P_mm() + glm::dvec3(0, 12, 0), kWindow_px));
  ASSERT_EQ(run->menu().edits().done(), 1u);
  run->finish();
  EXPECT_EQ(run->menu().edits().done(), 0u);
  EXPECT_THAT(run->menu().message(), testing::StartsWith("no tooth was found within 1.5 mm of it"));
  EXPECT_TRUE(std::ranges::none_of(
      run->menu().rows(), [](const CheckRow& row) { return row.kind == CheckRow::Kind::tooth && !row.is_there; }));
  EXPECT_EQ(run->found().teeth.size(), 16u);
}

TEST_F(CheckRunTest, EscStopsWhatIsBeingComputed) {
  const auto run = open(folder_.path());
  type(*run, U'-');
  clickTooth(*run, 37);
  if (!run->isBusy()) GTEST_SKIP() << "it was faster than the key";
  press(*run, Key::escape);
  EXPECT_FALSE(run->isBusy());
  EXPECT_EQ(run->menu().edits().done(), 0u);
  EXPECT_EQ(run->found().teeth.size(), 16u);
}

TEST_F(CheckRunTest, AFolderThatCannotBeReplacedStaysAsItWas) {
  const auto run = open(folder_.path());
  press(*run, Key::enter);
  run->finish();
  std::ofstream(folder_.path() + "/notes.txt") << "mine";
  press(*run, render::keyOf('S'), true);
  run->finish();
  EXPECT_TRUE(run->menu().isTrouble()) << run->menu().message();
  EXPECT_TRUE(run->menu().isChanged());
  EXPECT_TRUE(std::filesystem::exists(folder_.path() + "/notes.txt"));
  EXPECT_FALSE(assets::loadPatient(folder_.path()).found->tooth);
}

TEST_F(CheckRunTest, ThePicturesAreReviewedByAButtonThatAsksFirst) {
  // The machine's key lies in the test's folder.
  const std::string config = folder_.path() + "_config", statement = folder_.path() + "/deidentified.toml";
  setenv("XDG_CONFIG_HOME", config.c_str(), 1);
  const std::string digest = assets::digestOfFile(folder_.path() + "/volume.vdb");
  std::ofstream(statement) << assets::sealedStatement(assets::deidentificationStatement({}, digest));
  const auto run = open(folder_.path());
  // The last of the buttons, right of Save.
  const glm::dvec2 button(220.0, kWindow_px.y - 47.0);
  const auto is_reviewed = [&] { return assets::statementIn(folder_.path())->is_reviewed; };
  clickOn(*run, button);
  EXPECT_TRUE(run->menu().isTrouble()) << run->menu().message();
  EXPECT_FALSE(is_reviewed());
  // A key between is no second press.
  press(*run, Key::down);
  clickOn(*run, button);
  EXPECT_FALSE(is_reviewed());
  clickOn(*run, button);
  EXPECT_TRUE(is_reviewed()) << run->menu().message();
  EXPECT_FALSE(run->menu().isTrouble());
  // One that was changed is refused in words; so is one without its signature.
  std::ofstream(statement, std::ios::app) << "# more\n";
  clickOn(*run, button), clickOn(*run, button);
  EXPECT_TRUE(run->menu().isTrouble());
  EXPECT_NE(run->menu().message().find("was changed"), std::string::npos) << run->menu().message();
  std::ofstream(statement) << assets::deidentificationStatement({}, digest);
  clickOn(*run, button), clickOn(*run, button);
  EXPECT_TRUE(run->menu().isTrouble());
  EXPECT_NE(run->menu().message().find("no signature"), std::string::npos) << run->menu().message();
  unsetenv("XDG_CONFIG_HOME");
}

/// A statement of the folder's volume, signed with a key in the test's folder.
class SavedStatement : public CheckRunTest {
 protected:
  void SetUp() override {
    setenv("XDG_CONFIG_HOME", (folder_.path() + "_config").c_str(), 1);
    write();
    std::ofstream(folder_.path() + "/patient.toml", std::ios::app) << "\n[scan]\nmodality = \"CT\"\n";
  }
  void TearDown() override { unsetenv("XDG_CONFIG_HOME"); }

  void write() const {
    const std::string digest = assets::digestOfFile(folder_.path() + "/volume.vdb");
    std::ofstream(statement_) << assets::sealedStatement(assets::deidentificationStatement({}, digest));
  }
  /// What the page says of it.
  std::string confirmAndSave() const { return saveAfter(Key::enter, false); }
  std::string saveAfter(Key key, bool control) const {
    const auto run = open(folder_.path());
    press(*run, key, control);
    run->finish();
    press(*run, render::keyOf('S'), true);
    run->finish();
    EXPECT_FALSE(run->menu().isTrouble());
    return run->menu().message();
  }
  assets::StatementFacts facts() const { return *assets::statementIn(folder_.path()); }
  static std::string read(const std::string& path) {
    std::ifstream file(path);
    return std::string(std::istreambuf_iterator<char>(file), {});
  }

  const std::string statement_ = folder_.path() + "/deidentified.toml";
};

TEST_F(SavedStatement, FollowsItsVolume) {
  EXPECT_EQ(confirmAndSave(), "saved");
  EXPECT_TRUE(facts().is_of_volume);
  EXPECT_EQ(facts().seal, assets::Seal::of_this_machine);
  EXPECT_FALSE(facts().is_reviewed);
  EXPECT_THAT(read(folder_.path() + "/patient.toml"), testing::HasSubstr("[scan]\nmodality = \"CT\""));
}

TEST_F(SavedStatement, IsNotReviewedAnyMoreOnceSomethingElseIsSaved) {
  const std::string before = read(statement_);
  assets::reviewStatement(folder_.path());
  ASSERT_TRUE(facts().is_reviewed);
  EXPECT_THAT(confirmAndSave(), testing::StartsWith("saved; its pictures count as not reviewed again"));
  EXPECT_FALSE(facts().is_reviewed);
  EXPECT_TRUE(facts().is_of_volume);
  EXPECT_EQ(facts().seal, assets::Seal::of_this_machine);
  EXPECT_THAT(read(statement_), testing::StartsWith(before.substr(0, before.find("volume_sha256"))));
  // And can be reviewed again.
  assets::reviewStatement(folder_.path());
  EXPECT_TRUE(facts().is_reviewed);
}

TEST_F(SavedStatement, ThatWasChangedIsNotSignedAgain) {
  using Change = std::function<void(std::string&)>;
  const std::array<Change, 3> changes{
      [](std::string& text) { text.replace(text.find("kept = false"), 12, "kept = true "); },
      [](std::string& text) { text += "# more\n"; }, [](std::string& text) { text.erase(text.find("\n[signature]")); }};
  bool is_confirmed = false;
  for (const Change& change : changes) {
    write();
    assets::reviewStatement(folder_.path());
    std::string doubtful = read(statement_);
    change(doubtful);
    std::ofstream(statement_) << doubtful;
    EXPECT_FALSE(facts().is_reviewed);
    // Confirmed, taken back, and confirmed.
    const std::string said = is_confirmed ? saveAfter(render::keyOf('Z'), true) : confirmAndSave();
    is_confirmed = !is_confirmed;
    EXPECT_THAT(said, testing::HasSubstr("is not signed again"));
    EXPECT_EQ(read(statement_), doubtful);
    EXPECT_FALSE(facts().is_reviewed);
    EXPECT_FALSE(facts().is_of_volume);
  }
}

TEST_F(SavedStatement, IsReviewedOfWhatIsSaved) {
  const auto run = open(folder_.path());
  press(*run, Key::enter);
  run->finish();
  const glm::dvec2 button(220.0, kWindow_px.y - 47.0);
  clickOn(*run, button), clickOn(*run, button);
  EXPECT_THAT(run->menu().message(), testing::HasSubstr("save first"));
  EXPECT_FALSE(facts().is_reviewed);
}

}  // namespace
}  // namespace app
