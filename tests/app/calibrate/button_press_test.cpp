#include "app/calibrate/button_press.h"

#include <gtest/gtest.h>

#include <vector>

namespace {

using app::ButtonPress;
using app::Press;

/// What is told while the button goes as `down(t)`, at `rate_Hz`, without the ticks that tell nothing.
template <class Down>
std::vector<Press> told(ButtonPress& button, double seconds, double rate_Hz, Down down, double from_s = 0.0) {
  std::vector<Press> presses;
  for (int i = 0; i < static_cast<int>(seconds * rate_Hz); ++i) {
    const double t_s = from_s + i / rate_Hz;
    const Press press = button.update(t_s, down(t_s));
    if (press != Press::none) presses.push_back(press);
  }
  return presses;
}

TEST(ButtonPress, TellsShortFromLongAtEveryRate) {
  for (double rate_Hz : {120.0, 500.0, 1000.0, 10000.0}) {
    ButtonPress one, other;
    EXPECT_EQ(told(one, 2.0, rate_Hz, [](double t_s) { return t_s > 0.5 && t_s < 1.2; }),
              (std::vector{Press::down, Press::short_press}))
        << rate_Hz;
    EXPECT_EQ(told(other, 2.0, rate_Hz, [](double t_s) { return t_s > 0.5 && t_s < 1.4; }),
              (std::vector{Press::down, Press::long_press}))
        << rate_Hz;
  }
}

TEST(ButtonPress, TellsALongPressWhileItIsStillDownAndAgainWhileItStays) {
  ButtonPress button;
  EXPECT_EQ(told(button, 1.35, 1000.0, [](double t_s) { return t_s >= 0.1; }),
            (std::vector{Press::down, Press::long_press, Press::repeated, Press::repeated}));
}

TEST(ButtonPress, TakesABouncingContactForOnePress) {
  ButtonPress button;
  const auto bouncing = [](double t_s) {
    const bool edge = (t_s > 0.1 && t_s < 0.115) || (t_s > 0.4 && t_s < 0.415);
    return edge ? static_cast<int>(t_s * 1000.0) % 4 < 2 : t_s >= 0.115 && t_s <= 0.4;
  };
  EXPECT_EQ(told(button, 1.0, 1000.0, bouncing), (std::vector{Press::down, Press::short_press}));
}

TEST(ButtonPress, HearsNothingOfASpike) {
  ButtonPress button;
  EXPECT_TRUE(told(button, 1.0, 1000.0, [](double t_s) { return t_s > 0.5 && t_s < 0.515; }).empty());
}

TEST(ButtonPress, SaysWhenItWentDown) {
  ButtonPress button;
  told(button, 0.6, 1000.0, [](double t_s) { return t_s > 0.4995; });
  EXPECT_NEAR(button.downAt_s(), 0.5, 1e-9);
}

TEST(ButtonPress, ForgetsWhatWasHeldThroughASilence) {
  ButtonPress button;
  told(button, 0.3, 1000.0, [](double t_s) { return t_s > 0.1; });
  button.forget();
  EXPECT_TRUE(told(
                  button, 2.0, 1000.0, [](double t_s) { return t_s < 1.5; }, 0.3)
                  .empty());
  EXPECT_EQ(told(
                button, 1.0, 1000.0, [](double t_s) { return t_s > 2.5 && t_s < 2.7; }, 2.3),
            (std::vector{Press::down, Press::short_press}));
}

}  // namespace
