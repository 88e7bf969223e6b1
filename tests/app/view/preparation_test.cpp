#include "app/view/preparation.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace app {
namespace {

const calibration::Rig kDesk = calibration::desktopRig({640, 400});

Preparation withoutWindow() {
  return Preparation({.headless = true, .needs_window = false}, kDesk, "Preparing", [](const std::string&) {});
}

/// Pixels of the page that are clearly blue: the bar's filled part.
int bluePixels(double share) {
  const render::Image page = preparationPage(kDesk, {.screen_px = {640, 400}}, "Preparing", share);
  int count = 0;
  for (std::size_t n = 0; n < page.rgba.size(); n += 4)
    if (page.rgba[n + 2] > page.rgba[n] + 60) ++count;
  return count;
}

TEST(Preparation, ReturnsWhatTheWorkReturns) {
  const std::optional<int> result = withoutWindow().run<int>([](const assets::ReportProgress& report) {
    for (int n = 0; n <= 100; ++n) report(0.01 * n);
    return 7;
  });
  EXPECT_EQ(result, 7);
}

TEST(Preparation, PassesTheFailureOn) {
  EXPECT_THROW((void)withoutWindow().run<int>(
                   [](const assets::ReportProgress&) -> int { throw std::runtime_error("no such patient"); }),
               std::runtime_error);
}

TEST(Preparation, TheBarGrowsWithTheShare) {
  const int half = bluePixels(0.5), whole = bluePixels(1.0);
  EXPECT_EQ(bluePixels(0.0), 0);
  EXPECT_GT(half, 100);
  EXPECT_NEAR(half, 0.5 * whole, 0.03 * whole);
  EXPECT_EQ(bluePixels(7.0), whole) << "never beyond its track";
}

}  // namespace
}  // namespace app
