#include "app/options/jaw_clicks_file.h"

#include <gtest/gtest.h>

#include "app/text/usage_error.h"
#include "tests/refusal.h"

namespace app {
namespace {

std::string refusalOf(const std::string& clicks) {
  return tests::refusalOf<UsageError>([&] { jawClicksFrom(R"({"clicks": [)" + clicks + "]}", "c.json"); });
}

TEST(JawClicksFile, ReadsEveryEdit) {
  const assets::JawClicks clicks = jawClicksFrom(
      R"({"clicks": [{"edit": "number", "fdi": 48, "at_P_mm": [[1, -2.5, 3e1]]},
                     {"edit": "canal", "at_P_mm": [[0, 1, 2], [3, 4, 5], [6, 7, 8]]},
                     {"edit": "same-tooth", "at_P_mm": [[0, 1, 2], [3, 4, 5]]},
                     {"edit": "two-teeth", "at_P_mm": [[0, 1, 2], [3, 4, 5]]},
                     {"edit": "no-tooth", "at_P_mm": [[0, 1, 2]]},
                     {"edit": "root-tip", "at_P_mm": [[9, 1, 2]]}]})",
      "c.json");
  ASSERT_EQ(clicks.teeth.size(), 5u);
  EXPECT_EQ(clicks.teeth[0].edit, assets::ToothEdit::number);
  EXPECT_EQ(clicks.teeth[0].fdi, 48);
  EXPECT_EQ(clicks.teeth[0].at_P_mm[0], glm::dvec3(1.0, -2.5, 30.0));
  EXPECT_EQ(clicks.teeth[1].edit, assets::ToothEdit::same_tooth);
  EXPECT_EQ(clicks.teeth[1].at_P_mm[1], glm::dvec3(3.0, 4.0, 5.0));
  EXPECT_EQ(clicks.teeth[4].edit, assets::ToothEdit::root_tip);
  ASSERT_EQ(clicks.canals.size(), 1u);
  EXPECT_EQ(clicks.canals[0].size(), 3u);
}

TEST(JawClicksFile, ReadsBrushAndCutAndWritesThemAsTheyWere) {
  const assets::JawClicks clicks = jawClicksFrom(
      R"({"clicks": [{"edit": "brush", "at_P_mm": [[0, 1, 2], [0, 1, 3]], "radius_mm": 1.5, "as": 48,
                      "grey_hu": [900, 1400]},
                     {"edit": "cut", "at_P_mm": [[0, 1, 2], [3, 4, 5], [0, 0, 9]]},
                     {"edit": "brush", "at_P_mm": [[0, 1, 2]], "radius_mm": 5, "as": "bone"},
                     {"edit": "brush", "at_P_mm": [[0, 1, 2]], "radius_mm": 0.5, "as": "nothing"}]})",
      "c.json");
  ASSERT_EQ(clicks.voxels.size(), 4u);
  const auto& stroke = std::get<assets::BrushStroke>(clicks.voxels[0]);
  EXPECT_EQ(stroke.way_P_mm.size(), 2u);
  EXPECT_EQ(stroke.as, 48);
  EXPECT_EQ(stroke.low_hu, 900.0);
  EXPECT_EQ(std::get<assets::JawCut>(clicks.voxels[1]).beyond_P_mm, glm::dvec3(0, 0, 9));
  EXPECT_EQ(std::get<assets::BrushStroke>(clicks.voxels[2]).as, assets::kPaintBone);
  EXPECT_EQ(std::get<assets::BrushStroke>(clicks.voxels[3]).as, assets::kPaintNothing);
  EXPECT_TRUE(jawClicksFrom(jawClicksText(clicks), "c") == clicks);

  EXPECT_EQ(refusalOf(R"({"edit": "cut", "at_P_mm": [[0, 1, 2]]})"),
            "--clicks c.json, click 1: cut needs 3 points: both ends of a line, and one of what goes");
  EXPECT_EQ(refusalOf(R"({"edit": "brush", "at_P_mm": [[0, 1, 2]], "radius_mm": 6, "as": 48})"),
            "--clicks c.json, click 1: 'radius_mm' is missing, give 0.5 to 5");
  for (const char* as : {"18", "49", "\"skin\"", "300", "-1", "null", "[]"})
    EXPECT_EQ(
        refusalOf(R"({"edit": "brush", "at_P_mm": [[0, 1, 2]], "radius_mm": 1, "as": )" + std::string(as) + "}"),
        "--clicks c.json, click 1: 'as' is missing, give a tooth of the lower jaw as 48, \"bone\" or \"nothing\"");
  EXPECT_EQ(refusalOf(R"({"edit": "brush", "at_P_mm": [[0, 1, 2]], "radius_mm": 1, "as": 48, "grey_hu": [2, 1]})"),
            "--clicks c.json, click 1: 'grey_hu' is not [low, high] in HU");
  EXPECT_EQ(refusalOf(R"({"edit": "brush", "fdi": 48, "at_P_mm": [[0, 1, 2]], "radius_mm": 1, "as": 48})"),
            "--clicks c.json, click 1: a key is not edit, at_P_mm, radius_mm, as or grey_hu, remove it");
}

TEST(JawClicksFile, RefusesInOneLineWithTheClicksNumber) {
  EXPECT_EQ(refusalOf(R"({"edit": "number", "at_P_mm": [[0, 1, 2]]})"),
            "--clicks c.json, click 1: 'fdi' is missing, give the tooth's number as 48");
  EXPECT_EQ(refusalOf(R"({"edit": "number", "fdi": 18, "at_P_mm": [[0, 1, 2]]})"),
            "--clicks c.json, click 1: 'fdi' is no tooth of the lower jaw, give 31 to 38 or 41 to 48");
  EXPECT_EQ(refusalOf(R"({"edit": "no-tooth", "at_P_mm": [[0, 1, 2]]}, {"edit": "canal", "at_P_mm": [[0, 1, 2]]})"),
            "--clicks c.json, click 2: a canal has 2 to 6 points, from one end to the other");
  EXPECT_EQ(
      refusalOf(R"({"edit": "scratch", "at_P_mm": [[0, 1, 2]]})"),
      "--clicks c.json, click 1: 'edit' is unknown, give same-tooth, two-teeth, number, no-tooth, root-tip, canal, "
      "brush or cut");
  EXPECT_EQ(refusalOf(R"({"edit": "two-teeth", "at_P_mm": [[0, 1, 2]]})"),
            "--clicks c.json, click 1: two-teeth needs 2 points");
  EXPECT_EQ(refusalOf(R"({"edit": "root-tip", "fdi": 48, "at_P_mm": [[0, 1, 2]]})"),
            "--clicks c.json, click 1: 'fdi' belongs to number alone, remove it");
  EXPECT_EQ(refusalOf(R"({"edit": "root-tip", "at_P_mm": [[0, 1]]})"),
            "--clicks c.json, click 1: a point of 'at_P_mm' is not three numbers");
  EXPECT_EQ(refusalOf(R"({"edit": "root-tip", "at_P_mm": [[0, 1, 1e7]]})"),
            "--clicks c.json, click 1: a point of 'at_P_mm' is not three numbers in mm");
  EXPECT_EQ(refusalOf(R"({"edit": "root-tip", "at_P_mm": [[0, 1, 2]], "name": 1})"),
            "--clicks c.json, click 1: a key is not edit, fdi or at_P_mm, remove it");
  for (const char* text : {"", "[]", "{}", "{\"clicks\": 1}", "{\"clicks\": [], \"more\": 1}"})
    EXPECT_NE(tests::refusalOf<UsageError>([&] { jawClicksFrom(text, "c.json"); }).find("c.json: it is not {"),
              std::string::npos);
}

}  // namespace
}  // namespace app
