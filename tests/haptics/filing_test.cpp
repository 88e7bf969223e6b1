// What a bone file takes away, with its head wholly in bone: the rate itself.
#include "haptics/servo/filing.h"

#include <gtest/gtest.h>

#include "assets/tissue.h"
#include "tests/haptics/phantom.h"

namespace haptics {
namespace {

constexpr double kTick_s = 1e-3;

struct Drawn {
  double force_N = kFilingForce_N, speed_mm_per_s = kFilingSpeed_mm_per_s;
  glm::dvec3 along{1, 0, 0};
  assets::Tissue tissue = assets::Tissue::cortical;
  bool allowed = true;
};

/// mm3 a second, over a tenth of one.
double rate(const Drawn& drawn) {
  Bodies bodies = phantom::filled(5.0, 0.25, [](const glm::dvec3&) {
                    return -1e3;
                  }).bodies(static_cast<std::uint8_t>(drawn.tissue));
  Filing filing;
  StrokeHistory strokes(bodies.bones());
  Filing::Engagement at;
  at.head = {ShapeKind::sphere, 1.0, 0.0};
  at.contact.volume_mm3 = volume_mm3(at.head);
  at.contact.normal_P.xyz = {0, 0, 1};
  at.force_P_N.xyz = {0, 0, drawn.force_N};
  double removed_mm3 = 0.0;
  const int ticks = 100;
  for (int n = 0; n <= ticks; ++n) {
    at.X_PT.translation_mm = drawn.speed_mm_per_s * kTick_s * n * drawn.along;
    removed_mm3 += filing.file(bodies, strokes, at, drawn.allowed, kTick_s, static_cast<std::uint64_t>(n)).removed_mm3;
  }
  return removed_mm3 / (ticks * kTick_s);
}

TEST(Filing, TakesItsRateWhenItIsPressedAndDrawn) {
  EXPECT_NEAR(rate({}), kFiling_mm3_per_s, 0.05 * kFiling_mm3_per_s);
}

TEST(Filing, TakesInProportionToForceAndSpeedUpToThat) {
  const double full = rate({});
  EXPECT_NEAR(rate({.force_N = 0.5 * kFilingForce_N}), 0.5 * full, 0.05 * full);
  EXPECT_NEAR(rate({.speed_mm_per_s = 0.5 * kFilingSpeed_mm_per_s}), 0.5 * full, 0.05 * full);
  EXPECT_NEAR(rate({.force_N = 4.0 * kFilingForce_N}), full, 0.05 * full);
}

TEST(Filing, TakesNothingAtRestIntoTheBoneOffItOrOfATooth) {
  EXPECT_EQ(rate({.speed_mm_per_s = 0.0}), 0.0);
  EXPECT_EQ(rate({.along = {0, 0, 1}}), 0.0);
  EXPECT_EQ(rate({.force_N = -1.0}), 0.0);
  EXPECT_EQ(rate({.tissue = assets::Tissue::enamel}), 0.0);
  EXPECT_EQ(rate({.allowed = false}), 0.0);
}

}  // namespace
}  // namespace haptics
