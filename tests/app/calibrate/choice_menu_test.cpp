#include "app/calibrate/choice_menu.h"

#include <gtest/gtest.h>

#include "app/calibrate/tilt_text.h"

namespace {

using namespace app;

TEST(ChoiceMenu, MarksTheNextByAShortPressAndChoosesByALongOne) {
  ChoiceMenu menu({"yes", "no", "back"});
  EXPECT_FALSE(menu.update(Press::short_press));
  EXPECT_EQ(menu.update(Press::long_press), 1u);
  EXPECT_FALSE(menu.update(Press::repeated));
  menu.update(Press::short_press);
  menu.update(Press::short_press);
  EXPECT_EQ(menu.update(Press::long_press), 0u);
}

TEST(NumberDial, IsTurnedByAHeldButtonAndTakenByALongPressAlone) {
  NumberDial dial(63.0, 50.0, 66.0, 1.0);
  EXPECT_FALSE(dial.update(Press::long_press));
  EXPECT_FALSE(dial.update(Press::repeated));
  EXPECT_EQ(dial.value(), 65.0);
  dial.update(Press::repeated);
  dial.update(Press::repeated);
  EXPECT_EQ(dial.value(), 66.0) << "its most";
  dial.update(Press::short_press);
  dial.update(Press::long_press);
  EXPECT_EQ(dial.value(), 65.0);
  dial.update(Press::short_press);
  EXPECT_FALSE(dial.update(Press::repeated));
  EXPECT_TRUE(dial.update(Press::long_press));
  WizardView view;
  dial.show(view, "mm");
  EXPECT_EQ(view.value, "65 mm");
}

TEST(TiltWords, SayWhereTheHandleHasToGo) {
  const auto towards = [](double x, double y, double z) {
    return calibration::Vector<calibration::World>{glm::normalize(glm::dvec3(x, y, z))};
  };
  EXPECT_EQ(tiltText(towards(0, 0, 1), towards(1, 0, 1)), "lean the handle 45° to the right");
  EXPECT_EQ(tiltText(towards(1, 0, 1), towards(0, 0, 1)), "lean the handle 45° to the left");
  EXPECT_EQ(tiltText(towards(0, 1, 1), towards(0, 0, 1)), "lean the handle 45° down");
  EXPECT_EQ(tiltText(towards(0, 0, 1), towards(0.01, 0.01, 1)), "");
}

}  // namespace
