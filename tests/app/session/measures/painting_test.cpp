#include "app/session/measures/painting.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/app/session/measures/bur_path.h"

namespace app {
namespace {

using bur_path::kRadius_mm;

PaintingParts partsOf(const std::vector<WorkSample>& samples) {
  PaintingIndex painting;
  StrokeFinder strokes([&](const Stroke& stroke) { painting.add(stroke); });
  for (const WorkSample& sample : samples) {
    painting.add(sample);
    strokes.add(sample);
  }
  strokes.finish();
  return painting.parts();
}

TEST(Painting, AShallowRasterIsPainted) {
  const PaintingParts parts = partsOf(bur_path::raster(12, kRadius_mm / 8.0));
  EXPECT_GE(*parts.index(), 0.9);
  EXPECT_NEAR(*parts.plunge_ratio, 0.0, 1e-12);
}

TEST(Painting, ARasterAsDeepAsTheBurIsNot) {
  const PaintingParts parts = partsOf(bur_path::raster(12, kRadius_mm));
  EXPECT_EQ(*parts.shallow, 0.0);
  EXPECT_EQ(*parts.index(), 0.0);
}

TEST(Painting, AStraightPlungeIsNot) {
  const PaintingParts parts = partsOf(bur_path::along({{0, 0, 0}, {0, 0, -3}}, 5.0, 7.0));
  EXPECT_EQ(*parts.sweep, 0.0);
  EXPECT_EQ(*parts.index(), 0.0);
}

TEST(Painting, TheRatioOfASlantIsItsSlope) {
  const PaintingParts parts = partsOf(bur_path::along({{0, 0, 0}, {8, 0, -2}}, 20.0, 0.1));
  EXPECT_NEAR(*parts.plunge_ratio, 0.25, 1e-9);
}

TEST(Painting, DwellingWithTremorSweepsLittle) {
  std::mt19937 random(4);
  std::normal_distribution<double> noise(0.0, 1.0);
  std::vector<WorkSample> samples;
  for (int n = 0; n < 5000; ++n) {
    samples.push_back(bur_path::sampleAt(n * 1e-3, {0.01 * noise(random), 0.0, -0.5}));
    samples.back().velocity_P_mm_per_s = {noise(random), noise(random), 0.0};
  }
  EXPECT_LT(*partsOf(samples).sweep, 0.02);
}

TEST(Painting, UnevenPressureShows) {
  std::vector<WorkSample> samples = bur_path::raster(12, kRadius_mm / 8.0);
  for (std::size_t n = 0; n < samples.size(); ++n) samples[n].force_P_N.z = n % 2 == 0 ? 0.0 : 4.0;
  EXPECT_NEAR(*partsOf(samples).light, 0.5, 0.01) << "CV 1";
}

TEST(Painting, StrokesInTheSameGrooveOrFarApartDoNotOverlap) {
  std::vector<glm::dvec3> same, far;
  for (int n = 0; n < 8; ++n) {
    same.push_back({n % 2 == 0 ? 0.0 : 6.0, 0.0, 0.0});
    far.push_back({n % 2 == 0 ? 0.0 : 6.0, 0.0, 0.0});
    far.back().y = 2.0 * kRadius_mm * n;
  }
  EXPECT_EQ(*partsOf(bur_path::along(same, 30.0, 0.01)).overlap, 0.0);
  EXPECT_EQ(*partsOf(bur_path::along(far, 30.0, 0.01)).overlap, 0.0);
}

TEST(Painting, WithoutBoneNothingIsSaid) {
  std::vector<WorkSample> samples = bur_path::raster(4, 0.1);
  for (WorkSample& sample : samples) sample.touches = false;
  const PaintingParts parts = partsOf(samples);
  EXPECT_FALSE(parts.index());
  EXPECT_FALSE(parts.sweep);
  EXPECT_FALSE(parts.plunge_ratio);
}

TEST(Painting, OneStrokeHasNoNeighbourAndNoIndex) {
  const PaintingParts parts = partsOf(bur_path::raster(1, 0.1));
  EXPECT_FALSE(parts.overlap);
  EXPECT_FALSE(parts.index());
}

TEST(Painting, MedianOfEvenAndOddCounts) {
  EXPECT_FALSE(medianOf({}));
  EXPECT_EQ(*medianOf({3.0}), 3.0);
  EXPECT_EQ(*medianOf({5.0, 1.0}), 3.0);
  EXPECT_EQ(*medianOf({9.0, 1.0, 2.0}), 2.0);
}

}  // namespace
}  // namespace app
