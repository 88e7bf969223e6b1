// What is painted on a live tooth: colours where rays meet it, what is undercut, and the way of insertion.
#include <gtest/gtest.h>

#include <array>

#include "app/procedure/preparation/deviation_colour.h"
#include "app/procedure/preparation/preparation_paint.h"
#include "tests/app/procedure/preparation/round_tooth.h"

namespace app::round_tooth {
namespace {

/// As a ray's hit reads it: trilinear, 0..1, premultiplied linear colour with its cover.
glm::dvec4 paintAt(const render::SurfacePaint& paint, const assets::VolumeGrid& volume, const glm::dvec3& p_P) {
  const glm::dvec3 at = volume.indexFromPoint(p_P) - glm::dvec3(paint.low);
  const glm::ivec3 low(glm::floor(at));
  const glm::dvec3 f = at - glm::dvec3(low);
  glm::dvec4 sum(0.0);
  for (int n = 0; n < 8; ++n) {
    const glm::ivec3 bit(n & 1, (n >> 1) & 1, n >> 2);
    const glm::dvec3 w = glm::mix(1.0 - f, f, glm::dvec3(bit));
    const std::uint32_t texel = *paint.texels.at(low + bit);
    sum += w.x * w.y * w.z * glm::dvec4(texel & 255, (texel >> 8) & 255, (texel >> 16) & 255, texel >> 24) / 255.0;
  }
  return sum;
}

/// Within a byte and a half.
void expectColour(const glm::dvec4& seen, const glm::dvec3& srgb, double within, const char* where) {
  const glm::vec3 linear = render::linearFromSrgb(glm::vec3(srgb));
  EXPECT_NEAR(seen.a, 1.0, 0.003) << where;
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], static_cast<double>(linear[c]), within) << where << ' ' << c;
}

struct Painted {
  Scene scene;
  PreparationMeasure measure{scene.crown, sharpCrown(), "--ideal"};
  BoxBytes made;
  PreparationOutcomes outcomes;
  PreparationPaint paint;

  explicit Painted(const shapes::Depth& depth)
      : scene(0.08, true),
        made(scene.made(depth)),
        outcomes(measure.outcomesOf(made)),
        paint(preparationPaint(measure, made, outcomes)) {}
  glm::dvec4 at(const PaintSpots& spots, const glm::dvec3& p) const {
    const std::array<const PaintSpots*, 1> layers{&spots};
    // The volume that is drawn is larger than the box, by whole voxels.
    assets::VolumeGrid volume = paint.box;
    volume.origin_P_mm -= volume.spacing_mm * glm::dvec3(8, 16, 8);
    volume.size += 32;
    return paintAt(paintOf(volume, paint.box, layers), volume, scene.frame.inP(p));
  }
};

TEST(ToothPaint, AParallelWallHasTheColourOfItsDistance) {
  // The ideal: 4.0 mm at the margin, 6 degrees, 5 mm high. Made: 0.2 mm square to its wall too thick, 0.3 mm too low.
  const Painted painted(stump(4.0 + 0.2 / std::cos(6.0 * kDegree), 6.0, 4.7));
  for (const double turn : {0.3, 1.9, 4.4}) {
    const double r = 4.0 + 0.2 / std::cos(6.0 * kDegree) - 2.5 * std::tan(6.0 * kDegree);
    const glm::dvec3 wall(r * std::cos(turn), r * std::sin(turn), 2.5);
    expectColour(painted.at(painted.paint.deviation, wall), deviationColour(0.2), 0.02, "wall");
    expectColour(painted.at(painted.paint.deviation, {2.0 * std::cos(turn), 2.0 * std::sin(turn), 4.7}),
                 deviationColour(-0.3), 0.02, "top");
  }
  // Beside the preparation nothing: the tooth's own wall under the margin.
  EXPECT_EQ(painted.at(painted.paint.deviation, {kRadius_mm, 0.0, -0.7}).a, 0.0);
}

TEST(ToothPaint, WallsThatConvergeAreNotUndercutAndTheWayIsTheAxis) {
  const Painted painted(stump(4.0, 6.0, 5.0));
  EXPECT_TRUE(painted.paint.undercut.empty());
  ASSERT_TRUE(painted.paint.arrow);
  const glm::dvec3 tip = painted.scene.frame.local(painted.paint.arrow->to_P.mm);
  EXPECT_NEAR(tip.z, 5.0, 0.06) << "on the stump";
  EXPECT_NEAR(glm::length(glm::dvec2(tip)), 0.0, 0.06);
  EXPECT_EQ(painted.paint.way, "way of insertion: the tooth's axis");
  EXPECT_EQ(painted.paint.hindered, "no undercut");
}

TEST(ToothPaint, AReversedWallIsUndercutUpToItsRim) {
  const Painted painted(stump(3.6, -4.0, 4.7));
  EXPECT_NE(painted.paint.hindered.find("mm³"), std::string::npos) << painted.paint.hindered;
  int undercut = 0, free = 0;
  for (int n = 0; n < 36; ++n) {
    const double turn = 10.0 * n * kDegree;
    const auto wall = [&](double z) {
      const double r = 3.6 + z * std::tan(4.0 * kDegree);
      return glm::dvec3(r * std::cos(turn), r * std::sin(turn), z);
    };
    undercut += painted.at(painted.paint.undercut, wall(2.0)).a > 0.9 ? 1 : 0;
    free += painted.at(painted.paint.undercut, {2.0 * std::cos(turn), 2.0 * std::sin(turn), 4.7}).a == 0.0 ? 1 : 0;
  }
  EXPECT_GE(undercut, 35);
  EXPECT_EQ(free, 36) << "nothing stands over the top";
}

TEST(ToothPaint, ASliverThatStandsAtANeighbourHindersNoCrown) {
  const auto whole = stump(4.0, 6.0, 5.0);
  const Painted painted([whole](const glm::dvec3& p) {
    const glm::dvec3 off = glm::abs(p - glm::dvec3(4.75, 0.0, 3.0)) - glm::dvec3(0.2, 1.0, 0.5);
    return std::max(whole(p), -std::max({off.x, off.y, off.z}));
  });
  EXPECT_EQ(painted.paint.hindered, "no undercut");
  EXPECT_LT(painted.outcomes.insertion->undercut_mm3, 0.15);
  EXPECT_GT(painted.outcomes.deviation.most_left_mm, 0.1) << "but it is left";
}

TEST(ToothPaint, BeforeTheFirstCutThereIsNoWay) {
  const Painted painted(intact_mm);
  EXPECT_TRUE(painted.paint.undercut.empty());
  EXPECT_FALSE(painted.paint.arrow);
  EXPECT_TRUE(insertionRows(painted.paint).empty());
}

}  // namespace
}  // namespace app::round_tooth
