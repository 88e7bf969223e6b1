#include "app/check_page/check_edits.h"

#include <gtest/gtest.h>

#include <random>

#include "app/options/jaw_clicks_file.h"
#include "app/text/usage_error.h"

namespace app {
namespace {

using assets::ToothEdit;

CheckEdit anyEdit(std::mt19937& random) {
  std::uniform_real_distribution<double> place(-60.0, 60.0);
  const auto p = [&] { return glm::dvec3(place(random), place(random), place(random)); };
  switch (random() % 6) {
    case 3:
      return assets::BrushStroke{{p(), p()}, 1.5, 48, 100.0, 600.0};
    case 4:
      return assets::JawCut{p(), p(), p()};
    case 0:
      return CanalClicks{random() % 2 == 0, {p(), p(), p()}};
    case 1:
      return CanalWord{random() % 2 == 0, random() % 2 == 0, place(random)};
    case 2:
      return assets::ToothClick{ToothEdit::number, {p(), {}}, 46};
    default:
      return assets::ToothClick{ToothEdit::same_tooth, {p(), p()}, 0};
  }
}

// 1,000 edits, undos and redos: always those of a list that is only cut and lengthened.
TEST(CheckEdits, AreThoseOfAPlainListAfterAnyUndoAndRedo) {
  std::mt19937 random(7);
  CheckEdits edits;
  std::vector<CheckEdit> twin, ahead;
  for (int n = 0; n < 1000; ++n) {
    const auto what = random() % 5;
    if (what < 2 && !twin.empty()) {
      EXPECT_TRUE(edits.undo());
      ahead.push_back(twin.back()), twin.pop_back();
    } else if (what == 2) {
      EXPECT_EQ(edits.redo(), !ahead.empty());
      if (!ahead.empty()) twin.push_back(ahead.back()), ahead.pop_back();
    } else {
      const CheckEdit edit = anyEdit(random);
      if (edits.add(edit)) twin.push_back(edit), ahead.clear();
    }
    CheckEdits plain;
    for (const CheckEdit& edit : twin) plain.add(edit);
    ASSERT_EQ(edits.inForce().text(), plain.text());
    ASSERT_EQ(edits.undone(), ahead.size());
    if (n % 25 == 0) {
      ASSERT_EQ(CheckEdits::fromText(edits.text(), "log").text(), edits.text());
    }
  }
}

TEST(CheckEdits, AllOfThemCanBeUndoneAndRedone) {
  CheckEdits edits;
  for (std::size_t n = 0; n < CheckEdits::kMost; ++n)
    EXPECT_TRUE(edits.add(assets::ToothClick{ToothEdit::no_tooth, {glm::dvec3(static_cast<double>(n)), {}}, 0}));
  EXPECT_FALSE(edits.add(CanalWord{}));
  const std::string all = edits.text();
  for (std::size_t n = 0; n < CheckEdits::kMost; ++n) EXPECT_TRUE(edits.undo());
  EXPECT_FALSE(edits.undo());
  EXPECT_TRUE(edits.clicks().isEmpty());
  for (std::size_t n = 0; n < CheckEdits::kMost; ++n) EXPECT_TRUE(edits.redo());
  EXPECT_EQ(edits.text(), all);
  EXPECT_EQ(jawClicksText(jawClicksFrom(jawClicksText(edits.clicks()), "c")), jawClicksText(edits.clicks()));
}

TEST(CheckEdits, ACanalTakesThePlaceOfAnEarlierOneOfItsSide) {
  CheckEdits edits;
  edits.add(CanalClicks{true, {{1, 0, 0}, {2, 0, 0}}});
  edits.add(CanalClicks{false, {{3, 0, 0}, {4, 0, 0}}});
  edits.add(CanalClicks{true, {{5, 0, 0}, {6, 0, 0}}});
  ASSERT_EQ(edits.clicks().canals.size(), 2u);
  EXPECT_EQ(edits.clicks().canals[0][0].x, 5.0);
  EXPECT_EQ(edits.clicks().canals[1][0].x, 3.0);
}

TEST(CheckEdits, AWordHoldsForTheCanalThatWasShown) {
  CheckEdits edits;
  edits.add(CanalWord{true, true, 62.5});
  EXPECT_EQ(edits.wordOn(true, 62.5), std::optional(true));
  EXPECT_EQ(edits.wordOn(true, 60.0), std::nullopt);
  EXPECT_EQ(edits.wordOn(false, 62.5), std::nullopt);
  edits.add(CanalWord{true, false, 62.5});
  EXPECT_EQ(edits.wordOn(true, 62.5), std::optional(false));
}

TEST(CheckEdits, RefuseAForeignOrDamagedLog) {
  for (const char* text : {"", "[]", "{}", R"({"edits": [], "done": 1})", R"({"edits": [{}], "done": 0})",
                           R"({"edits": [{"edit": "confirm-canal", "side": "up", "length_mm": 3}], "done": 0})",
                           R"({"edits": [{"edit": "canal", "at_P_mm": [[0, 0, 0], [1, 1, 1]]}], "done": 0})",
                           R"({"edits": [{"edit": "number", "fdi": 99, "at_P_mm": [[0, 0, 0]]}], "done": 0})"})
    EXPECT_THROW(CheckEdits::fromText(text, "log"), UsageError) << text;
}

TEST(CheckEdits, AFurtherPointOfACanalGoesBetweenThoseItLiesBetween) {
  const std::vector<glm::dvec3> line = withPoint({{0, 0, 0}, {10, 0, 0}, {20, 0, 0}}, {13, 1, 0});
  ASSERT_EQ(line.size(), 4u);
  EXPECT_EQ(line[2].x, 13.0);
}

}  // namespace
}  // namespace app
