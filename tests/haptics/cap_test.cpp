#include "haptics/contact/cap.h"

#include <gtest/gtest.h>

#include <cmath>

#include "haptics/bone/voxel_sphere.h"

namespace haptics {
namespace {

using calibration::kPi;

TEST(Cap, HasTheVolumeOfTheBallWhenWhollyImmersed) {
  EXPECT_NEAR(capVolume_mm3(2.0, 4.0), 4.0 / 3.0 * kPi * 8.0, 1e-12);
  EXPECT_NEAR(capVolume_mm3(2.0, 2.0), 2.0 / 3.0 * kPi * 8.0, 1e-12);
  EXPECT_EQ(capVolume_mm3(2.0, -1.0), 0.0);
}

TEST(Cap, HasTheMomentOfItsSlices) {
  // The first moment by slices: integral of z * pi (R^2 - z^2) from R - h to R.
  const double R = 2.0, h = 0.7;
  double moment = 0.0;
  constexpr int kSlices = 200000;
  for (int i = 0; i < kSlices; ++i) {
    const double z = R - h + h * (i + 0.5) / kSlices;
    moment += z * kPi * (R * R - z * z) * h / kSlices;
  }
  EXPECT_NEAR(capMoment_mm4(R, h), moment, 1e-8);
}

TEST(Cap, FindsTheDepthOfAVolumeToABillionthOfTheRadius) {
  for (double R : {0.3, 1.0, 4.0})
    for (int i = 0; i <= 2000; ++i) {
      const double h = 2.0 * R * std::pow(i / 2000.0, 3.0);
      EXPECT_NEAR(capHeight_mm(R, capVolume_mm3(R, h)), h, 1e-9 * R) << "R " << R << " h " << h;
    }
}

TEST(Cap, AnswersVolumesNoBallCanHave) {
  EXPECT_EQ(capHeight_mm(2.0, -1.0), 0.0);
  EXPECT_EQ(capHeight_mm(2.0, 1e9), 4.0);
  EXPECT_EQ(capHeight_mm(2.0, std::nan("")), 0.0);
}

TEST(EquivalentDepth, TakesTheVoxelBiasAway) {
  // Where the second-order bias holds, it is the whole correction.
  const double R = 2.0, s = 0.1;
  for (double h : {0.4, 1.0, 1.9, 2.5, 3.5}) {
    const double measured = capVolume_mm3(R, h) + 0.504 * s * s * (R - h);
    EXPECT_NEAR(equivalentDepth_mm(R, measured, s), h, 1e-5);
  }
}

TEST(EquivalentDepth, KnowsWhereBetweenTwoLayersTheFaceLies) {
  // Layers of spheres under a flat face, the top one filled to a fraction: summed here slice by slice.
  const double R = 2.0, s = 0.1, h = 0.2;
  for (const double filled : {0.0, 0.25, 0.5, 0.8}) {
    double volume = 0.0, grey = 0.0;
    constexpr int kPhases = 50;
    for (int phase = 0; phase < kPhases; ++phase) {
      // The bur's lowest point at all places of the lattice; the face `h` above it, on the top layer's filled part.
      for (int layer = 0; layer < 60; ++layer) {
        const double weight = layer == 0 ? filled : 1.0;
        const double face_to_centre = layer == 0 ? filled * s - 0.5 * s : filled * s + (layer - 0.5) * s;
        const double u = h - face_to_centre;  // height of the layer's centre above the bur's lowest point
        // A layer's spheres smear their disc by variance eta^2/5.
        constexpr int kSlices = 21;
        for (int n = 0; n < kSlices; ++n) {
          const double z = (-1.0 + 2.0 * (n + 0.5) / kSlices) * kVoxelSphereRadius * s;
          const double share = (1.0 - std::pow(z / (kVoxelSphereRadius * s), 2)) * 1.5 / kSlices;
          const double disc = u + z > 0.0 ? kPi * (2.0 * R * (u + z) - (u + z) * (u + z)) : 0.0;
          volume += weight * share * disc * s / kPhases;
          grey += weight * (1.0 - weight) * share * disc * s / kPhases;
        }
      }
    }
    EXPECT_NEAR(equivalentDepth_mm(R, volume, grey, s), h, 0.004 * h) << filled;
    if (filled == 0.0) {
      EXPECT_LT(equivalentDepth_mm(R, volume, s), 0.985 * h) << "taken for one voxel soft";
    }
  }
}

TEST(EquivalentDepth, RisesFromNothingWithoutAJump) {
  const double R = 2.0, s = 0.2;
  double last = 0.0;
  EXPECT_EQ(equivalentDepth_mm(R, 0.0, s), 0.0);
  for (int i = 0; i <= 40000; ++i) {
    const double volume = i * 1e-5, depth = equivalentDepth_mm(R, volume, s);
    EXPECT_GE(depth, last);
    EXPECT_LT(depth - last, 1e-3);
    last = depth;
  }
  EXPECT_GT(last, 0.2);
  EXPECT_EQ(equivalentDepth_mm(R, 1e3, s), 2.0 * R);
}

TEST(Lens, IsTheCapWhenTheOtherSphereIsHuge) {
  // A sphere of 1e5 mm is flat to 1e-5 over a bur of 1 mm.
  const double R = 1.0, far = 1e5, h = 0.6;
  EXPECT_NEAR(lensOfSpheres(R, far, R + far - h).volume, capVolume_mm3(R, h), 1e-4);
}

/// Simpson's rule, exact for the cubics below.
template <class F>
double integral(F f, double from, double to) {
  return (to - from) / 6.0 * (f(from) + 4.0 * f(0.5 * (from + to)) + f(to));
}

TEST(Lens, IsTheSumOfItsSlices) {
  const double R = 2.0, ball = 0.062035, whole = 4.0 / 3.0 * kPi * ball * ball * ball;
  for (double d : {R - ball + 1e-4, R - 0.5 * ball, R, R + 0.5 * ball, R + ball - 1e-4}) {
    // Slices across the line of centres: of the ball up to the radical plane, of the bur beyond it.
    const double plane = (d * d + R * R - ball * ball) / (2.0 * d);
    const auto ball_slice = [&](double x) { return kPi * (ball * ball - (x - d) * (x - d)); };
    const auto bur_slice = [&](double x) { return kPi * (R * R - x * x); };
    const double volume = integral(ball_slice, d - ball, plane) + integral(bur_slice, plane, R);
    const double moment = integral([&](double x) { return x * ball_slice(x); }, d - ball, plane) +
                          integral([&](double x) { return x * bur_slice(x); }, plane, R);
    const Lens lens = lensOfSpheres(R, ball, d);
    EXPECT_NEAR(lens.volume, volume, 1e-10 * whole);
    EXPECT_NEAR(lens.moment, moment, 1e-10 * R * whole);
  }
}

TEST(Lens, IsTheSmallerSphereWhenOneHoldsTheOther) {
  const double tiny = 4.0 / 3.0 * kPi * 0.001;
  EXPECT_NEAR(lensOfSpheres(2.0, 0.1, 1.0).volume, tiny, 1e-15);
  EXPECT_NEAR(lensOfSpheres(2.0, 0.1, 1.0).moment, tiny, 1e-15);
  EXPECT_NEAR(lensOfSpheres(0.1, 2.0, 1.0).volume, tiny, 1e-15);
  EXPECT_EQ(lensOfSpheres(0.1, 2.0, 1.0).moment, 0.0);
  EXPECT_EQ(lensOfSpheres(1.0, 0.5, 1.5).volume, 0.0);
}

TEST(Lens, IsContinuousWhereItTouchesAndWhereItIsSwallowed) {
  const double R = 1.0, ball = 0.25, whole = 4.0 / 3.0 * kPi * ball * ball * ball;
  EXPECT_NEAR(lensOfSpheres(R, ball, R + ball - 1e-7).volume, 0.0, 1e-12);
  EXPECT_NEAR(lensOfSpheres(R, ball, R - ball + 1e-7).volume, whole, 1e-12);
  EXPECT_NEAR(lensOfSpheres(R, ball, R - ball + 1e-7).moment, whole * (R - ball), 1e-7 * whole);
}

}  // namespace
}  // namespace haptics
