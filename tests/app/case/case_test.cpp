#include "app/case/case.h"

#include <gtest/gtest.h>

#include <set>

namespace app {
namespace {

TEST(Cases, HaveTheirOwnNamesAndRiseInDifficulty) {
  std::set<std::string_view> names;
  int former = 0;
  for (const Case& one : cases()) {
    EXPECT_TRUE(names.insert(one.name).second) << one.name;
    EXPECT_EQ(caseNamed(one.name), &one);
    EXPECT_GE(pedersonScore(one), former) << one.name;
    former = pedersonScore(one);
  }
  EXPECT_EQ(caseNamed("no such case"), nullptr);
}

TEST(Cases, HoldEveryAngulationBothSidesADeepOneAndATouchedCanal) {
  std::set<std::string> words;
  bool right = false, left = false, touched = false, deep = false;
  for (const Case& one : cases()) {
    words.insert(angulationText(one).substr(0, angulationText(one).find(',')));
    (one.jaw.right_side ? right : left) = true;
    touched |= one.jaw.mandibular_canal_distance_mm == 0.0;
    deep |= one.jaw.depth_mm > 10.0;
  }
  EXPECT_EQ(words, (std::set<std::string>{"disto-angular", "horizontal", "mesio-angular", "vertical"}));
  EXPECT_TRUE(right && left && touched && deep);
}

/// Pederson 1988: mesio-angular 1, C 3, class II 2.
TEST(Cases, AreClassedAsADentistWould) {
  const Case& usual = usualCase();
  EXPECT_EQ(pellGregoryPosition(usual), 'C');
  EXPECT_EQ(pedersonScore(usual), 6);
  EXPECT_EQ(difficultyText(usual), "moderate");
  EXPECT_EQ(angulationText(usual), "mesio-angular, 45°");
  EXPECT_EQ(depthText(usual), "8 mm under the occlusal plane, position C class II");
  EXPECT_EQ(canalText(usual), "canal 1 mm from the root");
  EXPECT_EQ(pellGregoryPosition({"", {.depth_mm = 0.5}, ""}), 'A');
  EXPECT_EQ(pellGregoryPosition({"", {.depth_mm = 5.0}, ""}), 'B');
}

TEST(Cases, AreListedWithNameToothAndWhatIsHard) {
  const std::string list = caseList();
  for (const Case& one : cases()) {
    EXPECT_NE(list.find(one.name), std::string::npos);
    EXPECT_NE(list.find(one.challenge), std::string::npos);
  }
  EXPECT_NE(list.find("lower left third molar"), std::string::npos);
}

}  // namespace
}  // namespace app
