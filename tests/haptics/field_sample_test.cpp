#include "haptics/contact/field_sample.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/haptics/phantom.h"

namespace haptics {
namespace {

using namespace phantom;

TEST(FieldSample, InterpolatesAlongAllThreeAxes) {
  std::mt19937 random(5);
  Phantom bone = filled(1.3, 0.2, [](const glm::dvec3&) { return 1.0; });
  for (std::uint8_t& solid : bone.solid) solid = static_cast<std::uint8_t>(random() & 255);
  const CarvedBone carved = bone.bone(3);
  const SolidField field = carved.field();
  const auto byteAt = [&](glm::ivec3 ijk) { return bone.grid.contains(ijk) ? bone.solid[bone.grid.index(ijk)] : 0; };
  std::uniform_real_distribution<double> place(-1.5, 1.5);
  const ToolSampler sampler(field, {});
  for (int trial = 0; trial < 20000; ++trial) {
    const glm::dvec3 p(place(random), place(random), place(random)), index = bone.grid.indexFromPoint(p);
    const glm::dvec3 floor = glm::floor(index), part = index - floor;
    double sum = 0.0;
    for (int n = 0; n < 8; ++n) {
      const glm::ivec3 corner(n & 1, n >> 1 & 1, n >> 2);
      const glm::dvec3 weight = glm::mix(1.0 - part, part, glm::dvec3(corner));
      sum += weight.x * weight.y * weight.z * byteAt(glm::ivec3(floor) + corner) / 255.0;
    }
    const FieldSample sample = sampler.at(p);
    ASSERT_NEAR(sample.solid, sum, 1e-12) << index.x << " " << index.y << " " << index.z;
    if (sum > 0.0) {
      ASSERT_EQ(sample.label, 3);
    }
  }
}

TEST(FieldSample, IsAirBeyondTheGridAndWhereThereIsNoNumber) {
  const Phantom bone = block(1.0, 0.2);
  const CarvedBone carved = bone.bone(1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const SolidField field = carved.field();
  const ToolSampler sampler(field, {});
  for (const glm::dvec3 p : {glm::dvec3(nan, 0, 0), glm::dvec3(0, 1e300, 0), glm::dvec3(0, 0, -1.2)})
    EXPECT_EQ(sampler.at(p).solid, 0.0);
  EXPECT_EQ(sampler.at(glm::dvec3(0.03, 0.01, -0.02)).solid, 1.0);
}

}  // namespace
}  // namespace haptics
