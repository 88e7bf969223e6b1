#include "render/volume/bone_gap.h"

#include <gtest/gtest.h>

#include "render/volume/volume_fields.h"
#include "tests/render/ball_volume.h"

namespace render {
namespace {

using testing::Ball;
using testing::Random;

// The head's outline in the half-plane of radius and axis, in steps of a hundredth of its size.
std::vector<glm::dvec2> outlineOf(const Frame& frame) {
  const double R = frame.bur_radius_mm, half = 0.5 * frame.bur_length_mm;
  std::vector<glm::dvec2> outline;
  for (int n = 0; n <= 200; ++n) {
    const double part = n / 200.0, turn = part * 3.14159265358979;
    switch (frame.bur_form) {
      case assets::BurForm::round:
        outline.emplace_back(R * std::sin(turn), -R * std::cos(turn));
        break;
      case assets::BurForm::capsule:
        outline.emplace_back(R * std::sin(turn), (turn < 1.5707963 ? -half : half) - R * std::cos(turn));
        outline.emplace_back(R, half * (2.0 * part - 1.0));
        break;
      case assets::BurForm::cylinder:
        outline.emplace_back(R, half * (2.0 * part - 1.0));
        outline.emplace_back(R * part, half);
        outline.emplace_back(R * part, -half);
        break;
      case assets::BurForm::cone:
        outline.emplace_back(R * part, half * (2.0 * part - 1.0));
        outline.emplace_back(R * part, half);
        break;
      case assets::BurForm::revolved:
        break;  // tested with its own profiles
    }
  }
  return outline;
}

// Slow and obvious: the smallest distance between the head's outline and points of the surface of the balls.
double bruteGap_mm(const Frame& frame, const std::vector<glm::dvec3>& surface) {
  const std::vector<glm::dvec2> outline = outlineOf(frame);
  const glm::dvec3 axis = frame.X_PT.rotation * glm::dvec3(0.0, 0.0, 1.0);
  const double enclosing_mm = frame.bur_radius_mm + 0.5 * frame.bur_length_mm;
  double best_mm = 1e9;
  for (const glm::dvec3& p : surface) {
    const glm::dvec3 offset = p - frame.X_PT.translation_mm;
    if (glm::length(offset) > best_mm + enclosing_mm) continue;
    const double z = glm::dot(offset, axis), rho = glm::length(offset - z * axis);
    for (const glm::dvec2& q : outline) best_mm = std::min(best_mm, glm::distance(q, {rho, z}));
  }
  return best_mm;
}

// Points of the trilinear surface of a volume, on a lattice eight times as fine as the voxels.
std::vector<glm::dvec3> surfaceOf(const assets::CtVolume& ct) {
  const BorderedField<std::uint8_t> solid = testing::borderedSolid(ct);
  const auto value = [&](const glm::dvec3& index) {
    const glm::ivec3 low(glm::floor(index));
    const glm::dvec3 f = index - glm::dvec3(low);
    double sum = 0.0;
    for (int n = 0; n < 8; ++n) {
      const glm::ivec3 bit(n & 1, (n >> 1) & 1, n >> 2);
      const glm::dvec3 w = glm::mix(1.0 - f, f, glm::dvec3(bit));
      sum += w.x * w.y * w.z * *solid.at(low + bit);
    }
    return sum - 127.5;
  };
  constexpr int kFine = 8;
  std::vector<glm::dvec3> points;
  forEachIn({glm::ivec3(0), kFine * (ct.grid.size - 1)}, [&](glm::ivec3 at) {
    const glm::dvec3 index = glm::dvec3(at) / double{kFine};
    // Only cells with surface are worth the eightfold sums.
    const glm::ivec3 cell(index);
    bool air = false, matter = false;
    for (int n = 0; n < 8; ++n) (*solid.at(cell + glm::ivec3(n & 1, (n >> 1) & 1, n >> 2)) > 127 ? matter : air) = true;
    if (!air || !matter) return;
    const double here = value(index);
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 next = index;
      next[axis] += 1.0 / kFine;
      const double there = value(next);
      if ((here < 0.0) == (there < 0.0)) continue;
      glm::dvec3 p = index;
      p[axis] += here / (here - there) / kFine;
      points.push_back(ct.grid.origin_P_mm + ct.grid.spacing_mm * p);
    }
  });
  return points;
}

Frame randomBur(Random& random, double half_cube_mm) {
  Frame frame;
  frame.bur_form = static_cast<assets::BurForm>(static_cast<int>(random.between(0.0, 3.999)));
  frame.bur_radius_mm = random.between(0.4, 2.5);
  frame.bur_length_mm = frame.bur_form == assets::BurForm::round ? 0.0 : random.between(0.5, 6.0);
  frame.X_PT = {glm::angleAxis(random.between(0.0, 6.2), random.direction()), random.inCube(half_cube_mm)};
  return frame;
}

TEST(BoneGap, IsThatOfBruteForceForEveryHeadAtAThousandRandomPoses) {
  const assets::CtVolume ct =
      testing::ballVolume(testing::smallGrid(glm::ivec3(40), 0.4),
                          {{{-2.0, 1.0, 0.5}, 2.6}, {{2.5, -1.5, 1.0}, 1.7}, {{0.5, 2.5, -3.0}, 1.2}});
  const std::vector<glm::dvec3> surface = surfaceOf(ct);
  ASSERT_GT(surface.size(), 10000u);
  std::vector<glm::dvec3> sparse;  // every fourth point is dense enough for a fifth of a voxel
  for (std::size_t n = 0; n < surface.size(); n += 4) sparse.push_back(surface[n]);
  const BorderedField<std::uint8_t> solid = testing::borderedSolid(ct);
  GapFinder finder(ct.grid, solid);
  Random random(5);
  int seen = 0, far = 0, touching = 0;
  double worst = 0.0;
  for (int n = 0; n < 1000; ++n) {
    const Frame frame = randomBur(random, n < 900 ? 7.0 : 20.0);
    const double expected_mm = bruteGap_mm(frame, sparse);
    const auto found = finder.find(frame);
    if (!found) {
      ++far;
      EXPECT_GT(expected_mm, kMaxGap_mm - 0.2) << n;
    } else if (found->mm == 0.0) {
      ++touching;  // the outline's distance is not signed
    } else {
      ++seen;
      worst = std::max(worst, std::abs(found->mm - expected_mm));
    }
  }
  EXPECT_LT(worst, 0.5 * ct.grid.spacing_mm);
  EXPECT_GT(seen, 500);
  EXPECT_GT(far, 20);
  EXPECT_GT(touching, 50);
}

TEST(BoneGap, OfABallInFrontOfABallIsTheDistanceOfTheirSurfaces) {
  const assets::CtVolume ct = testing::ballVolume(testing::smallGrid(glm::ivec3(64), 0.3), {{{0, 0, 0}, 4.0}});
  const BorderedField<std::uint8_t> solid = testing::borderedSolid(ct);
  GapFinder finder(ct.grid, solid);
  Random random(3);
  for (int n = 0; n < 200; ++n) {
    Frame frame;
    frame.bur_radius_mm = random.between(0.5, 2.0);
    const double gap_mm = random.between(0.0, 9.5);
    const glm::dvec3 way = random.direction();
    frame.X_PT.translation_mm = (4.0 + frame.bur_radius_mm + gap_mm) * way;
    const auto found = finder.find(frame);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->mm, gap_mm, 0.03);
    EXPECT_GT(glm::dot(glm::normalize(found->nearest_P.mm), way), gap_mm < 0.1 ? 0.95 : 0.99);
  }
}

TEST(BoneGap, IsZeroInContactAndInsideAndNoneFarAway) {
  const assets::CtVolume ct = testing::ballVolume(testing::smallGrid(glm::ivec3(48), 0.3), {{{0, 0, 0}, 5.0}});
  const BorderedField<std::uint8_t> solid = testing::borderedSolid(ct);
  GapFinder finder(ct.grid, solid);
  Frame frame;
  frame.bur_radius_mm = 1.0;
  for (const double z : {0.0, 3.0, 4.5, 5.9}) {
    frame.X_PT.translation_mm = {0, 0, z};
    ASSERT_TRUE(finder.find(frame)) << z;
    EXPECT_EQ(finder.find(frame)->mm, 0.0) << z;
  }
  for (const double z : {17.0, 1000.0, std::numeric_limits<double>::quiet_NaN()}) {
    frame.X_PT.translation_mm = {0, 0, z};
    EXPECT_FALSE(finder.find(frame)) << z;
  }
}

TEST(BoneGap, FollowsCarvedBricks) {
  // Bricks that were solid throughout have surface afterwards.
  const assets::VolumeGrid grid = testing::smallGrid(glm::ivec3(64), 0.3);
  const assets::CtVolume whole = testing::ballVolume(grid, {{{0, 0, 0}, 8.0}});
  const assets::CtVolume carved = testing::ballVolume(grid, {{{0, 0, 0}, 2.0}});
  BorderedField<std::uint8_t> solid = testing::borderedSolid(whole);
  GapFinder finder(grid, solid);
  Frame frame;
  frame.bur_radius_mm = 1.0;
  frame.X_PT.translation_mm = {0.3, 0.2, 10.0};
  ASSERT_TRUE(finder.find(frame));
  EXPECT_NEAR(finder.find(frame)->mm, glm::length(frame.X_PT.translation_mm) - 9.0, 0.05);
  solid = testing::borderedSolid(carved);
  forEachIn({glm::ivec3(0), grid.bricks()}, [&](glm::ivec3 brick) { finder.touch(brick); });
  ASSERT_TRUE(finder.find(frame));
  EXPECT_NEAR(finder.find(frame)->mm, glm::length(frame.X_PT.translation_mm) - 3.0, 0.05);
}

}  // namespace
}  // namespace render
