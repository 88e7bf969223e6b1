#include "app/rehearsal/ruler.h"

#include <gtest/gtest.h>

namespace app {
namespace {

using calibration::Patient;
using calibration::Point;

TEST(Ruler, MeasuresFromTheFirstMarkToTheSecondAndIsPutAwayByTheThird) {
  std::optional<render::RulerLine> ruler = rulerAfterMark({}, Point<Patient>{{1.0, 2.0, 3.0}});
  ASSERT_TRUE(ruler);
  EXPECT_FALSE(ruler->to_P);
  EXPECT_EQ(rulerText(ruler), "ruler: 2nd point");
  EXPECT_EQ(rulerEvent(ruler), "first point (1.00, 2.00, 3.00) mm");
  ruler = rulerAfterMark(ruler, Point<Patient>{{4.0, 6.0, 15.0}});
  ASSERT_TRUE(ruler);
  EXPECT_DOUBLE_EQ(ruler->length_mm(), 13.0);
  EXPECT_EQ(rulerText(ruler), "ruler 13.0 mm");
  EXPECT_EQ(rulerEvent(ruler), "13.00 mm from (1.00, 2.00, 3.00) to (4.00, 6.00, 15.00) mm");
  ruler = rulerAfterMark(ruler, Point<Patient>{{0.0, 0.0, 0.0}});
  EXPECT_FALSE(ruler);
  EXPECT_EQ(rulerText(ruler), "");
  EXPECT_EQ(rulerEvent(ruler), "cleared");
}

TEST(Ruler, MarksTheBoneNearestToTheBurElseTheTip) {
  const haptics::BurShape fissure{haptics::ShapeKind::cylinder, 0.8, 6.0};
  render::Frame frame;
  // A quarter turn about y: the shaft points along x.
  frame.X_PT = {glm::angleAxis(M_PI / 2.0, glm::dvec3(0.0, 1.0, 0.0)), {10.0, 20.0, 30.0}};
  const glm::dvec3 tip = markedPoint(frame, fissure).mm;
  EXPECT_LT(glm::distance(tip, glm::dvec3(7.0, 20.0, 30.0)), 1e-12) << "half its length before the middle of the head";
  frame.gap = render::BoneGap{4.0, {{1.0, 2.0, 3.0}}};
  EXPECT_EQ(markedPoint(frame, fissure).mm, glm::dvec3(1.0, 2.0, 3.0));
}

}  // namespace
}  // namespace app
