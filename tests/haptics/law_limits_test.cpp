#include "haptics/contact/law_limits.h"

#include <gtest/gtest.h>

#include "calibration/geometry/units.h"
#include "haptics/contact/law.h"
#include "tests/haptics/phantom.h"

namespace haptics {
namespace {

using namespace phantom;
using calibration::kPi;

/// A law in bone of one tissue, of factor 1.
LawSettings plain(LawKind kind) {
  LawSettings law;
  law.kind = kind;
  law.tissue.factor.fill(1.0);
  return law;
}

TEST(LawLimits, KnowTheSteepestSlopeOfABall) {
  const BurShape ball{ShapeKind::sphere, 2.0, 0.0};
  EXPECT_NEAR(stiffestSlope_N_per_mm(plain(LawKind::agus), ball), 0.8, 1e-12);
  EXPECT_NEAR(stiffestSlope_N_per_mm(plain(LawKind::forssim), ball), kPi * 0.8 / 2.0, 1e-9);
  EXPECT_NEAR(stiffestSlope_N_per_mm(plain(LawKind::hertz), ball), 1.5 * 2.0 * std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(stiffestSlope_N_per_mm(plain(LawKind::shell), ball), 2.0 * kPi * 2.0 * 0.064, 1e-6);
  EXPECT_NEAR(stiffestSlope_N_per_mm(plain(LawKind::harmonic), ball), 0.8, 1e-12);
  // The published bur of 0.3 mm is outside what 1 N s/m holds at 1 kHz; from 1.26 mm on it is inside.
  const double most = passiveStiffness_N_per_mm(1e-3, 0.0, 1e-3);
  EXPECT_NEAR(most, 2.0, 1e-12);
  EXPECT_GT(stiffestSlope_N_per_mm(plain(LawKind::forssim), {ShapeKind::sphere, 0.3, 0.0}), most);
  EXPECT_LT(stiffestSlope_N_per_mm(plain(LawKind::forssim), {ShapeKind::sphere, 1.26, 0.0}), most);
}

TEST(LawLimits, CountTheHardestTissue) {
  const LawSettings law;
  EXPECT_NEAR(stiffestSlope_N_per_mm(law, {}), 0.8 * law.tissue.factor[4], 1e-12);
}

TEST(LawLimits, AnswerAsTheLawItselfInFlatBone) {
  const Phantom phantom = halfSpace(4.0, 0.1);
  for (LawKind kind :
       {LawKind::agus, LawKind::forssim, LawKind::hertz, LawKind::shell, LawKind::points, LawKind::harmonic})
    for (double depth : {0.5, 1.0}) {
      const LawSettings law = plain(kind);
      const ToolInBone at{
          phantom.field(), {}, {glm::dquat(1.0, 0.0, 0.0, 0.0), {0.0, 0.0, 2.0 - depth}}, law.tissue, {}};
      const Contact contact = contactOf(law, at);
      const FlatResponse flat = flatResponse(law, {}, depth, 1.0);
      EXPECT_NEAR(contact.force_P_N.xyz.z / flat.force_N, 1.0, 0.02) << int(kind);
      EXPECT_NEAR(contact.stiffness_N_per_mm / flat.slope_N_per_mm, 1.0, 0.02) << int(kind);
    }
}

TEST(LawLimits, RefuseWhatADeviceCannotHoldAndNameWhatItCan) {
  for (const LawName& name : kLaws)
    for (ShapeKind shape :
         {ShapeKind::sphere, ShapeKind::capsule, ShapeKind::cylinder, ShapeKind::cone, ShapeKind::revolved}) {
      LawSettings law;
      law.kind = name.kind;
      const BurShape head{shape, 1.0, shape == ShapeKind::sphere ? 0.0 : 2.0};
      const Admission refused = admissible(law, head, 0.05);
      if (!supports(name.kind, shape)) {
        EXPECT_EQ(refused.answer, Admission::Answer::no_such_head);
        continue;
      }
      ASSERT_EQ(refused.answer, Admission::Answer::too_stiff) << name.key;
      ASSERT_NE(refused.lower, nullptr);
      refused.lower->of(law) = refused.nearest * (1.0 - 1e-9);
      EXPECT_EQ(admissible(law, head, 0.05).answer, Admission::Answer::yes) << name.key;
      refused.lower->of(law) = refused.nearest * 1.01;
      EXPECT_EQ(admissible(law, head, 0.05).answer, Admission::Answer::too_stiff) << name.key;
    }
  LawSettings held;
  held.kind = LawKind::forssim;
  held.forssim.hold_N_per_mm = 3.0;
  EXPECT_EQ(admissible(held, {}, 2.0).lower->key, "hold_N_per_mm");
  EXPECT_EQ(admissible(held, {}, 2.0).nearest, 2.0);
}

}  // namespace
}  // namespace haptics
