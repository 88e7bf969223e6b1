#include "calibration/record/rig_differences.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibration/geometry/units.h"
#include "tests/calibration/record/full_record.h"

namespace calibration {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(Differences, AreEmptyForEqualRigs) {
  EXPECT_TRUE(differences(fullRecord(), fullRecord()).empty());
  EXPECT_TRUE(differences(RigRecord{}, RigRecord{}).empty());
}

TEST(Differences, StateBothValuesWithUnit) {
  const RigRecord before = fullRecord();
  RigRecord after = before;
  after.rig.X_WD.translation_mm += glm::dvec3(0.3, 0.0, 0.4);
  after.rig.X_WD.rotation = after.rig.X_WD.rotation * glm::angleAxis(radFromDegrees(0.25), glm::dvec3(0, 1, 0));
  after.rig.arm->offset_rad[1] = 0.0;
  after.rig.arm->offset_rad[1] = radFromDegrees(1.5);
  after.verification->verdict = Verdict::amber;
  after.verification->errors.rms_mm = 0.61;
  const auto lines = differences(before, after);
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_EQ(lines[0], "verdict: green \u2192 amber");
  EXPECT_EQ(lines[1], "error on held-out touches, RMS: 0.24 \u2192 0.61 mm");
  EXPECT_THAT(lines[2], HasSubstr("mm, 0.50 mm apart"));
  EXPECT_EQ(lines[3], "device: turned by 0.25\u00b0");
  EXPECT_THAT(lines[4], HasSubstr("offset of thigh: "));
  EXPECT_THAT(lines[4], HasSubstr("\u2192 1.500 \u00b0"));
}

TEST(Differences, StateWhatOnlyOneHas) {
  const RigRecord full = fullRecord();
  RigRecord bare;
  bare.rig = full.rig;
  bare.rig.mirror.reset();
  bare.rig.arm.reset();
  const auto lines = differences(bare, full);
  EXPECT_THAT(lines, Contains("mirror: none \u2192 present"));
  EXPECT_THAT(lines, Contains("arm: as its model \u2192 measured"));
  EXPECT_THAT(lines, Contains("verdict: none \u2192 green"));
  EXPECT_THAT(lines, Contains("hand rest: none \u2192 registered"));
}

TEST(Differences, OmitImmeasurableDifferences) {
  RigRecord after = fullRecord();
  after.rig.X_WD.translation_mm += 1e-7;
  after.rig.arm->gain[0] += 1e-9;
  EXPECT_TRUE(differences(fullRecord(), after).empty());
}

}  // namespace
}  // namespace calibration
