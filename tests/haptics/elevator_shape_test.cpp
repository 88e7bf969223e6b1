#include "haptics/ligament/elevator_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>
#include <vector>

#include "assets/instruction_set.h"
#include "haptics/ligament/blade_contact.h"
#include "haptics/ligament/blade_kernels.h"

namespace haptics {
namespace {

constexpr std::array kKinds = {ElevatorKind::straight_301, ElevatorKind::straight_34s, ElevatorKind::cryer_left,
                               ElevatorKind::cryer_right};

glm::dvec3 somewhere(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  return {10.0 * unit(random), 4.0 * unit(random), 8.0 + 10.0 * unit(random)};
}

TEST(ElevatorShape, StraightBladesAreAsWideAndAsThickAsSaid) {
  for (const auto& [kind, width, thick, length] :
       {std::tuple{ElevatorKind::straight_301, 3.0, 1.0, 8.0}, std::tuple{ElevatorKind::straight_34s, 4.0, 1.3, 9.0}}) {
    const ElevatorShape shape = elevatorShape(kind);
    EXPECT_NEAR(shape.distanceAt({0.5 * width, 0.0, 0.5 * length}).mm, 0.0, 1e-9);
    EXPECT_NEAR(shape.distanceAt({0.0, 0.0, 0.0}).mm, 0.0, 1e-9) << "the tip is the origin";
    EXPECT_NEAR(shape.distanceAt({0.0, 0.0, -2.0}).mm, 2.0, 1e-9);
    EXPECT_NEAR(shape.distanceAt({0.0, 0.25, 0.15}).mm, 0.0, 0.01) << "half a millimetre thick at the tip";
    EXPECT_NEAR(shape.distanceAt({0.0, 0.5 * thick, length - 0.15}).mm, 0.0, 0.01);
    EXPECT_NEAR(shape.distanceAt({0.0, 0.0, length + 20.0}).mm, -1.2, 1e-9) << "shank";
  }
}

TEST(ElevatorShape, CryersAreMirrorImagesAt100Degrees) {
  const ElevatorShape left = elevatorShape(ElevatorKind::cryer_left), right = elevatorShape(ElevatorKind::cryer_right);
  std::mt19937 random(1);
  for (int n = 0; n < 1000; ++n) {
    const glm::dvec3 p = somewhere(random);
    EXPECT_NEAR(left.distanceAt(p).mm, right.distanceAt({-p.x, p.y, p.z}).mm, 1e-9);
  }
  // The tip lies at sin 100 degrees times 9 mm beside the shaft, level with the origin.
  EXPECT_NEAR(left.distanceAt({-8.8633, 0.0, 0.0}).mm, 0.0, 1e-3);
  EXPECT_NEAR(left.distanceAt({-4.0, 0.6, 0.7}).mm, 0.0, 1e-3) << "1.2 mm thick";
}

TEST(ElevatorShape, DistanceHasItsGradientAndReachesThatFar) {
  std::mt19937 random(2);
  for (const ElevatorKind kind : kKinds) {
    const ElevatorShape shape = elevatorShape(kind);
    int kinks = 0;
    for (int n = 0; n < 1000; ++n) {
      const glm::dvec3 p = somewhere(random);
      const auto [mm, out] = shape.distanceAt(p);
      EXPECT_NEAR(glm::length(out), 1.0, 1e-9);
      glm::dvec3 slope;
      for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 more = p, less = p;
        more[axis] += 1e-6;
        less[axis] -= 1e-6;
        slope[axis] = (shape.distanceAt(more).mm - shape.distanceAt(less).mm) / 2e-6;
      }
      kinks += glm::distance(slope, out) > 1e-4 ? 1 : 0;
      // Nothing of it is nearer than it says, and the surface lies where it says.
      EXPECT_TRUE(mm <= 0.0 || std::abs(shape.distanceAt(p - mm * out).mm) < 1e-6);
    }
    EXPECT_LT(kinks, 3);
    for (int n = 0; n < shape.points; ++n) {
      const auto at = static_cast<std::size_t>(n);
      EXPECT_LE(shape.distanceAt(shape.point_T_mm[at]).mm, -shape.point_radius_mm[at] + 1e-9) << "a ball lies within";
    }
  }
}

/// A blade's outline as the servo hands it to its kernels, and samples about it.
struct KernelInput {
  static constexpr int kCount = 256;
  PieceSamples samples;
  ElevatorShape shape;
  ToolPose X_PT;
  PiecePose X_PQ;

  KernelInput(ElevatorKind kind, unsigned seed) : shape(elevatorShape(kind)) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    std::vector<SamplePoint> points;
    for (int n = 0; n < kCount; ++n)
      points.push_back(
          {.p_Q_mm = {12.0 * unit(random), 4.0 * unit(random), 8.0 + 12.0 * unit(random)}, .area_mm2 = 0.25});
    samples = arranged(points);
    X_PT = {glm::normalize(glm::dquat(1.0, 0.2 * unit(random), 0.2 * unit(random), 0.2 * unit(random))),
            {unit(random), unit(random), unit(random)}};
    X_PQ.translation_mm = {0.3 * unit(random), 0.3 * unit(random), 0.3 * unit(random)};
  }
  BladeOutline outline() const { return outlineOf(shape); }
  BladePlace place() const { return placeOf(shape, X_PT, X_PQ, samples.centre_Q_mm); }
  BladeSamples view() const {
    return {samples.place_mm[0].data(), samples.place_mm[1].data(), samples.place_mm[2].data(), kCount};
  }
};

/// Gaps, then what is near, as bytes.
template <class Gaps, class Near>
std::vector<float> said(const KernelInput& input, Gaps gaps, Near near) {
  constexpr std::size_t kCount = KernelInput::kCount;
  std::vector<float> values(4 * kCount);
  gaps(input.outline(), input.place(), input.view(),
       {&values[0], &values[kCount], &values[2 * kCount], &values[3 * kCount]});
  std::vector<std::uint16_t> index(100);
  const int found = near(input.outline(), input.place(), input.view(), 0.8F, index.data(), 100);
  for (int n = 0; n < found; ++n) values.push_back(static_cast<float>(index[static_cast<std::size_t>(n)]));
  return values;
}

TEST(BladeKernels, EveryInstructionSetHasTheSameBits) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const KernelInput input(kKinds[seed % kKinds.size()], seed);
    const std::vector<float> values = said(input, &portable::bladeGaps, &portable::nearBlade);
    EXPECT_GT(values.size(), 4U * KernelInput::kCount + 10U);
    const auto same = [&](const std::vector<float>& other) {
      return other.size() == values.size() && std::memcmp(other.data(), values.data(), 4 * values.size()) == 0;
    };
#if defined(__x86_64__)
    if (assets::available(assets::InstructionSet::avx2)) {
      EXPECT_TRUE(same(said(input, &avx2::bladeGaps, &avx2::nearBlade))) << seed;
    }
    if (assets::available(assets::InstructionSet::avx512)) {
      EXPECT_TRUE(same(said(input, &avx512::bladeGaps, &avx512::nearBlade))) << seed;
    }
#endif
  }
}

TEST(BladeKernels, AreTheirSlowTwin) {
  constexpr std::size_t kCount = KernelInput::kCount;
  for (unsigned seed = 0; seed < 20; ++seed) {
    const KernelInput input(kKinds[seed % kKinds.size()], seed);
    const std::vector<float> values = said(input, &portable::bladeGaps, &portable::nearBlade);
    const auto is_found = [&](std::size_t n) {
      return std::find(values.begin() + 4 * kCount, values.end(), static_cast<float>(n)) != values.end();
    };
    for (std::size_t n = 0; n < kCount; ++n) {
      const glm::dvec3 p_Q_mm =
          input.samples.centre_Q_mm +
          glm::dvec3(input.samples.place_mm[0][n], input.samples.place_mm[1][n], input.samples.place_mm[2][n]);
      const glm::dvec3 p_T_mm =
          (input.X_PT.inverse() * (input.X_PQ * calibration::Point<calibration::Piece>{p_Q_mm})).mm;
      const ElevatorShape::Distance slow = input.shape.distanceAt(p_T_mm);
      EXPECT_NEAR(static_cast<double>(values[n]), slow.mm, 1e-5);
      const glm::dvec3 uvs(values[kCount + n], values[2 * kCount + n], values[3 * kCount + n]);
      EXPECT_LT(glm::distance(fromOutline(input.shape, uvs), slow.out), 1e-3) << seed << ' ' << n;
      EXPECT_TRUE(slow.mm > 0.79 || is_found(n)) << "what is near is found";
    }
  }
}

}  // namespace
}  // namespace haptics
