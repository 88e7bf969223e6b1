#include "app/calibrate/still_capture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

namespace {

using app::StillCapture;
using app::StylusSample;

constexpr double kFullTurn = 2.0 * std::numbers::pi;

/// A stylus whose wrist goes as `place_mm(t)`; its sensors read 0.01 rad a mm.
struct Hand {
  std::function<glm::dvec3(double)> place_mm;

  StylusSample at(double t_s) const {
    StylusSample sample;
    sample.t_s = t_s;
    sample.valid = true;
    sample.X_DH.translation_mm = place_mm(t_s);
    for (int i = 0; i < 3; ++i) sample.raw_rad[static_cast<std::size_t>(i)] = 0.01 * sample.X_DH.translation_mm[i];
    return sample;
  }
};

/// Comes from 60 mm away within 0.3 s, is as `there` from then on. When it was taken; negative: never.
double takenAfter_s(const Hand& there, double rate_Hz, double seconds = 3.0,
                    const app::StillLimits& limits = app::kPitStillness) {
  StillCapture capture(limits);
  for (int i = 0; i < static_cast<int>(seconds * rate_Hz); ++i) {
    const double t_s = i / rate_Hz;
    StylusSample sample = there.at(t_s);
    if (t_s < 0.3) sample.X_DH.translation_mm.x += 200.0 * (0.3 - t_s);
    capture.update(sample);
    if (capture.heldStill()) return t_s;
  }
  return -1.0;
}

Hand trembling(double amplitude_mm, double frequency_Hz, double step_mm = 0.0) {
  return {[=](double t_s) {
    glm::dvec3 place(20.0 + amplitude_mm * std::sin(kFullTurn * frequency_Hz * t_s), -3.0, 4.0);
    if (step_mm > 0.0) place = glm::round(place / step_mm) * step_mm;
    return place;
  }};
}

TEST(StillCapture, TakesAStillStylusAfter400MillisecondsAtEveryRate) {
  for (double rate_Hz : {500.0, 1000.0, 3000.0, 10000.0})
    EXPECT_NEAR(takenAfter_s(trembling(0.0, 1.0), rate_Hz), 0.7, 0.03) << rate_Hz;
}

TEST(StillCapture, GivesTheMedianOfUpTo200Samples) {
  for (double rate_Hz : {500.0, 1000.0, 10000.0}) {
    StillCapture capture;
    std::mt19937 rng(3);
    std::normal_distribution<double> noise(0.0, 0.01);
    const Hand hand{[&](double) { return glm::dvec3(1.0 + noise(rng), 2.0, 3.0); }};
    // One sample in fifty is wild: a median does not mind.
    for (int i = 0; i < static_cast<int>(rate_Hz); ++i) {
      StylusSample sample = hand.at(i / rate_Hz);
      if (i % 50 == 7) sample.raw_rad[0] = 1.0;
      capture.update(sample);
    }
    std::string why;
    const auto take = capture.before(0.99, why);
    ASSERT_TRUE(take) << why;
    EXPECT_NEAR(take->samples, std::min(200.0, 0.2 * rate_Hz), 2.0);
    EXPECT_NEAR(take->raw_rad[0], 0.01, 3e-5);
    EXPECT_NEAR(take->raw_rad[2], 0.03, 1e-12);
  }
}

TEST(StillCapture, DoesNotTakeAStylusThatDriftsAtAMillimetreASecond) {
  const Hand drifting{[](double t_s) { return glm::dvec3(1.0 * t_s, 0.0, 0.0); }};
  EXPECT_LT(takenAfter_s(drifting, 1000.0), 0.0);
}

TEST(StillCapture, TakesWhatDriftsSlowerThanTheSensorsTell) {
  const Hand slow{[](double t_s) { return glm::dvec3(0.1 * t_s, 0.0, 0.0); }};
  EXPECT_GT(takenAfter_s(slow, 1000.0), 0.0);
}

TEST(StillCapture, BearsATremorOfATwentiethOfAMillimetre) {
  for (double frequency_Hz : {8.0, 9.0, 10.0, 11.0, 12.0})
    for (double rate_Hz : {500.0, 1000.0, 10000.0})
      EXPECT_GT(takenAfter_s(trembling(0.05, frequency_Hz), rate_Hz), 0.0) << frequency_Hz << " " << rate_Hz;
}

TEST(StillCapture, BearsTheStepsOfAnEncoderUnderATremor) {
  for (double frequency_Hz : {8.0, 10.0, 12.0})
    EXPECT_GT(takenAfter_s(trembling(0.05, frequency_Hz, 0.055), 1000.0), 0.0) << frequency_Hz;
}

TEST(StillCapture, DoesNotTakeAHandThatSwaysOrShakes) {
  EXPECT_LT(takenAfter_s(trembling(0.3, 1.0), 1000.0), 0.0);   // sways slowly
  EXPECT_LT(takenAfter_s(trembling(1.0, 10.0), 1000.0), 0.0);  // shakes
}

/// For the record: how large a tremor is borne, by frequency.
TEST(StillCapture, SaysHowMuchTremorItBears) {
  for (double frequency_Hz : {4.0, 6.0, 8.0, 10.0, 12.0}) {
    double pit_mm = 0.0, cross_mm = 0.0;
    for (double mm = 0.01; mm < 1.5; mm += 0.01) {
      if (takenAfter_s(trembling(mm, frequency_Hz), 500.0, 2.0) > 0.0) pit_mm = mm;
      if (takenAfter_s(trembling(mm, frequency_Hz), 500.0, 2.0, app::kCrossStillness) > 0.0) cross_mm = mm;
    }
    std::printf("tremor of %2.0f Hz: borne up to %.2f mm in a pit, %.2f mm at a cross\n", frequency_Hz, pit_mm,
                cross_mm);
    EXPECT_GT(cross_mm, pit_mm);
    EXPECT_GE(pit_mm, frequency_Hz >= 8.0 ? 0.1 : 0.04);
  }
}

TEST(StillCapture, TakesThe200MillisecondsBeforeAPress) {
  // The press itself shoves the stylus by a millimetre.
  const Hand pressing{[](double t_s) { return glm::dvec3(t_s < 0.5 ? 7.0 : 8.0, 0.0, 0.0); }};
  StillCapture capture;
  for (int i = 0; i < 600; ++i) capture.update(pressing.at(i / 1000.0));
  std::string why;
  const auto take = capture.before(0.499, why);
  ASSERT_TRUE(take) << why;
  EXPECT_NEAR(take->raw_rad[0], 0.07, 1e-12);
}

TEST(StillCapture, SaysWhyAPressWasNotTaken) {
  std::string why;
  StillCapture moving;
  for (int i = 0; i < 600; ++i)
    moving.update(Hand{[](double t_s) { return glm::dvec3(30.0 * t_s, 0.0, 0.0); }}.at(i / 1000.0));
  EXPECT_FALSE(moving.before(0.599, why));
  EXPECT_NE(why.find("moving at 30 mm/s"), std::string::npos) << why;

  StillCapture swaying;
  for (int i = 0; i < 600; ++i)
    swaying.update(
        Hand{[](double t_s) { return glm::dvec3(0.15 * std::sin(kFullTurn * 2.0 * t_s), 0, 0); }}.at(i / 1e3));
  EXPECT_FALSE(swaying.before(0.599, why));
  EXPECT_NE(why.find("moving"), std::string::npos) << why;

  StillCapture silent;
  silent.update(trembling(0.0, 1.0).at(0.0));
  EXPECT_FALSE(silent.before(0.1, why));
  EXPECT_NE(why.find("too little"), std::string::npos) << why;
}

TEST(StillCapture, TakesAPlaceOnlyOnceUntilItIsLeft) {
  StillCapture capture;
  int taken = 0;
  const auto goThrough = [&](double from_s, double x_mm) {
    for (int i = 0; i < 1500; ++i) {
      capture.update(Hand{[=](double) { return glm::dvec3(x_mm, 0, 0); }}.at(from_s + i / 1000.0));
      if (!capture.heldStill()) continue;
      ++taken;
      capture.waitForMove();
    }
  };
  goThrough(0.0, 0.0);  // where it was when it began does not count
  EXPECT_EQ(taken, 0);
  goThrough(1.5, 30.0);
  EXPECT_EQ(taken, 1);
  goThrough(3.0, 33.0);  // not far enough
  EXPECT_EQ(taken, 1);
  goThrough(4.5, 36.0);
  EXPECT_EQ(taken, 2);
}

TEST(StillCapture, CountsATurnInAPitAsLeaving) {
  StillCapture capture;
  bool taken = false;
  for (int i = 0; i < 2000; ++i) {
    StylusSample sample = Hand{[](double) { return glm::dvec3(0.0); }}.at(i / 1000.0);
    if (i > 1000) sample.X_DH.rotation = glm::angleAxis(0.2, glm::dvec3(1, 0, 0));
    capture.update(sample);
    taken = taken || capture.heldStill().has_value();
  }
  EXPECT_TRUE(taken);
}

TEST(StillCapture, BelievesNoStillnessAcrossASilence) {
  StillCapture capture;
  for (int i = 0; i < 300; ++i) capture.update(trembling(0.0, 1.0).at(i / 1000.0));
  for (int i = 0; i < 150; ++i) capture.update(trembling(0.0, 1.0).at(1.0 + i / 1000.0));
  std::string why;
  EXPECT_FALSE(capture.before(1.149, why));
  EXPECT_FALSE(capture.heldStill());
}

}  // namespace
