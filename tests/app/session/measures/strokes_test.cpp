#include "app/session/measures/strokes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/app/session/measures/bur_path.h"

namespace app {
namespace {

using bur_path::sampleAt;

std::vector<Stroke> strokesOf(const std::vector<WorkSample>& samples) {
  std::vector<Stroke> found;
  StrokeFinder finder([&](const Stroke& stroke) { found.push_back(stroke); });
  for (const WorkSample& sample : samples) finder.add(sample);
  finder.finish();
  return found;
}

/// 10 mm to and fro at 1 Hz along x, smoothly.
std::vector<WorkSample> toAndFro(double seconds) {
  std::vector<WorkSample> samples;
  for (int n = 0; n < static_cast<int>(seconds * 1e3); ++n) {
    const double phase = 2.0 * std::numbers::pi * n * 1e-3;
    samples.push_back(sampleAt(n * 1e-3, {-5.0 * std::cos(phase), 0.0, 0.0}));
    samples.back().velocity_P_mm_per_s = {10.0 * std::numbers::pi * std::sin(phase), 0.0, 0.0};
  }
  return samples;
}

TEST(Strokes, TenMillimetresToAndFroAtOneHertzAreTwoStraightStrokesASecond) {
  const std::vector<Stroke> strokes = strokesOf(toAndFro(10.0));
  ASSERT_EQ(strokes.size(), 20U);
  for (std::size_t n = 1; n + 1 < strokes.size(); ++n) {
    EXPECT_NEAR(strokes[n].length_mm, 10.0, 0.02);
    EXPECT_NEAR(strokes[n].duration_s, 0.5, 0.002);
    EXPECT_NEAR(strokes[n].straightness, 1.0, 1e-6);
    EXPECT_NEAR(strokes[n].mean_speed_mm_per_s, 20.0, 0.1);
    EXPECT_NEAR(strokes[n].mean_normal_force_N, 2.0, 1e-9);
  }
}

TEST(Strokes, AStreamFindsWhatALookAtTheWholeFinds) {
  // A wandering hand; the twin takes cosines over the whole run and cuts at the lowest of each negative run.
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, 4.0);
  std::vector<WorkSample> samples;
  glm::dvec3 p(0.0), v(0.0);
  for (int n = 0; n < 4000; ++n) {
    v += 0.05 * (glm::dvec3(noise(random), noise(random), 0.1 * noise(random)) * 8.0 - v);
    p += 1e-3 * v;
    samples.push_back(sampleAt(n * 1e-3, p));
  }
  constexpr std::size_t kArm = 25;
  std::vector<double> ends_s;
  double lowest = 0.0;
  std::size_t turn = 0, turn_to = 0, begin = 0;
  const auto length = [&](std::size_t from, std::size_t to) {
    double sum = 0.0;
    for (std::size_t k = from + 1; k <= to; ++k) sum += glm::distance(samples[k].bur_P_mm, samples[k - 1].bur_P_mm);
    return sum;
  };
  for (std::size_t k = kArm; k + kArm < samples.size(); ++k) {
    const glm::dvec3 a = samples[k].bur_P_mm - samples[k - kArm].bur_P_mm;
    const glm::dvec3 b = samples[k + kArm].bur_P_mm - samples[k].bur_P_mm;
    const double lengths = glm::length(a) * glm::length(b);
    const double cosine = lengths > 4e-4 ? glm::dot(a, b) / lengths : 1.0;
    if (cosine < 0.0) {
      if (lowest == 0.0 || cosine < lowest - 0.01) turn = k;
      if (lowest == 0.0 || cosine < lowest + 0.01) turn_to = k;
      lowest = std::min(lowest, cosine);
    } else if (lowest < 0.0) {
      turn = (turn + turn_to) / 2;
      if (length(begin, turn) >= StrokeFinder::kShortest_mm) ends_s.push_back(samples[turn].t_s);
      begin = turn;
      lowest = 0.0;
    }
  }
  std::vector<double> found_s;
  for (const Stroke& stroke : strokesOf(samples)) found_s.push_back(stroke.begin_s + stroke.duration_s);
  ASSERT_GT(ends_s.size(), 10U);
  ASSERT_GE(found_s.size(), ends_s.size());
  ASSERT_LE(found_s.size(), ends_s.size() + 1) << "and what is left at the end";
  for (std::size_t n = 0; n < ends_s.size(); ++n) EXPECT_NEAR(found_s[n], ends_s[n], 1e-9) << n;
}

TEST(Strokes, APauseEndsAStrokeAndIsNotPartOfIt) {
  std::vector<WorkSample> samples = bur_path::along({{0, 0, 0}, {6, 0, 0}}, 20.0, 0.0);
  const double t_s = samples.back().t_s;
  for (int n = 1; n <= 400; ++n) {
    samples.push_back(sampleAt(t_s + n * 1e-3, {6.0, 0.0, 0.01 * n}));
    samples.back().touches = false;
  }
  const std::vector<Stroke> strokes = strokesOf(samples);
  ASSERT_EQ(strokes.size(), 1U);
  EXPECT_NEAR(strokes[0].length_mm, 6.0, 0.05);
  EXPECT_NEAR(strokes[0].duration_s, 0.3, 0.002);
}

TEST(Strokes, AHandAtRestMakesNone) {
  std::vector<WorkSample> samples;
  std::mt19937 random(2);
  std::normal_distribution<double> noise(0.0, 0.002);
  for (int n = 0; n < 12'000; ++n) samples.push_back(sampleAt(n * 1e-3, {noise(random), 0.0, noise(random)}));
  for (const Stroke& stroke : strokesOf(samples)) EXPECT_LT(stroke.straightness, 0.1);
  EXPECT_LE(strokesOf(samples).size(), 3U) << "of 5 s each, of noise alone";
}

TEST(Strokes, InvalidTicksEndAStroke) {
  std::vector<WorkSample> samples = bur_path::along({{0, 0, 0}, {6, 0, 0}}, 20.0, 0.0);
  samples[150].valid = false;
  samples[150].bur_P_mm = glm::dvec3(std::nan(""));
  const std::vector<Stroke> strokes = strokesOf(samples);
  ASSERT_EQ(strokes.size(), 2U);
  EXPECT_NEAR(strokes[0].length_mm + strokes[1].length_mm, 6.0, 0.1);
}

TEST(Strokes, TheDepthOfAGrooveIsThatOfItsSection) {
  for (const double h : {0.05, 0.3, 0.9, 1.5}) {
    const double R = 1.5, section = R * R * std::acos(1.0 - h / R) - (R - h) * std::sqrt(h * (2.0 * R - h));
    EXPECT_NEAR(grooveDepth_mm(section, R), h, 1e-5);
  }
  // R = 1, 0.5 deep: 0.614 mm2 (reference/product O7).
  EXPECT_NEAR(grooveDepth_mm(0.614, 1.0), 0.5, 1e-3);
  const double R = 1.5, half = 0.5 * std::numbers::pi * R * R;
  EXPECT_NEAR(grooveDepth_mm(half + 2.0 * R * 0.7, R), R + 0.7, 1e-9) << "a slot with parallel walls";
  EXPECT_EQ(grooveDepth_mm(0.0, R), 0.0);
  EXPECT_EQ(grooveDepth_mm(std::nan(""), R), 0.0);
  EXPECT_EQ(grooveDepth_mm(1e9, R), 4.0 * R);
}

}  // namespace
}  // namespace app
