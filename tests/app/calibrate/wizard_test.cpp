#include "app/calibrate/wizard.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/app/calibrate/robot_run.h"

namespace {

using namespace app;
using calibration::Scenario;
using calibration::SyntheticRig;
using calibration::Verdict;
using End = WizardOutcome::End;

SyntheticRig rigOf(Scenario scenario, std::uint32_t seed) {
  SyntheticRig rig = calibration::syntheticRig(scenario, seed);
  rig.technician.precision = scenario == Scenario::f ? calibration::kCrossPrecision : calibration::kPitPrecision;
  return rig;
}

struct Finished {
  RobotRun run;
  WizardOutcome outcome;
  calibration::RigRecord record;
};

Finished calibrated(const SyntheticRig& rig, const WizardPlan& plan, const TechnicianSettings& habits = {},
                    const Mishap& mishap = {}, double rate_Hz = 500.0) {
  Wizard wizard(plan);
  RobotTechnician technician(rig, habits, rig.seed);
  Finished finished{runWizard(wizard, technician, rate_Hz, mishap), wizard.outcome(), {}};
  finished.record = recordOf(plan, wizard.outcome());
  return finished;
}

/// A rig that was calibrated with the jig.
calibration::RigRecord calibratedRecord(const SyntheticRig& rig) {
  return calibrated(rig, planFor(rig, CalibrationProcedure::full)).record;
}

TEST(Wizard, CalibratesTypicalArmsWithTheJigInUnderEightMinutes) {
  for (const Scenario scenario : {Scenario::a, Scenario::b, Scenario::c, Scenario::d})
    for (std::uint32_t seed = 1; seed <= 3; ++seed) {
      const SyntheticRig rig = rigOf(scenario, seed);
      const Finished done = calibrated(rig, planFor(rig, CalibrationProcedure::full));
      ASSERT_EQ(done.outcome.end, End::accepted) << static_cast<char>(scenario) << seed << done.outcome.reason;
      EXPECT_EQ(done.outcome.assessment->verdict, Verdict::green) << done.outcome.assessment->reason;
      EXPECT_LT(trueError_mm(rig, *done.outcome.arm), 0.35);
      EXPECT_LT(done.run.seconds, 480.0);
      ASSERT_TRUE(calibration::measuredArm(done.record.rig));
      EXPECT_EQ(done.record.procedure->method, "jig27");
      EXPECT_EQ(done.record.verification->errors.n, 16);
    }
}

TEST(Wizard, CallsAnArmThatNoModelExplainsUsableAtMost) {
  for (std::uint32_t seed = 1; seed <= 3; ++seed) {
    const SyntheticRig rig = rigOf(Scenario::g, seed);
    const Finished done = calibrated(rig, planFor(rig, CalibrationProcedure::full));
    ASSERT_TRUE(done.outcome.assessment);
    EXPECT_NE(done.outcome.assessment->verdict, Verdict::green) << seed;
    EXPECT_EQ(done.outcome.end, done.outcome.assessment->verdict == Verdict::amber ? End::accepted : End::refused);
  }
}

TEST(Wizard, CalibratesByEyesAloneAndSaysWhatItIsWorth) {
  for (std::uint32_t seed = 1; seed <= 3; ++seed) {
    const SyntheticRig rig = rigOf(Scenario::f, seed);
    const Finished done = calibrated(rig, planFor(rig, CalibrationProcedure::full, "visual25"));
    ASSERT_EQ(done.outcome.end, End::accepted) << done.outcome.reason;
    // Touches by eye prove no better than the eye aims.
    EXPECT_EQ(done.outcome.assessment->verdict, Verdict::amber);
    EXPECT_EQ(done.outcome.verification_kind, calibration::VerificationKind::by_eyes);
    EXPECT_LT(trueError_mm(rig, *done.outcome.arm), 0.9);
  }
}

TEST(Wizard, TakesTouchesByHoldingStillAlone) {
  TechnicianSettings habits;
  habits.presses = false;
  const SyntheticRig rig = rigOf(Scenario::d, 4);
  const Finished done = calibrated(rig, planFor(rig, CalibrationProcedure::full), habits);
  ASSERT_EQ(done.outcome.end, End::accepted) << done.outcome.reason;
  EXPECT_LT(trueError_mm(rig, *done.outcome.arm), 0.35);
}

TEST(Wizard, WorksAtTheRatesOfDevices) {
  const SyntheticRig rig = rigOf(Scenario::b, 5);
  for (const double rate_Hz : {1000.0, 4000.0})
    EXPECT_EQ(calibrated(rig, planFor(rig, CalibrationProcedure::full, "jig8"), {}, {}, rate_Hz).outcome.end,
              End::accepted);
}

TEST(Wizard, GivesTheSameOutcomeForTheSameTicks) {
  const SyntheticRig rig = rigOf(Scenario::d, 6);
  const Finished one = calibrated(rig, planFor(rig, CalibrationProcedure::full)),
                 other = calibrated(rig, planFor(rig, CalibrationProcedure::full));
  EXPECT_EQ(one.run.titles, other.run.titles);
  EXPECT_EQ(one.record.rig.X_WD.translation_mm, other.record.rig.X_WD.translation_mm);
}

TEST(Wizard, LetsThroughNoCalibrationWithTheStylusHeldOneWay) {
  const SyntheticRig rig = rigOf(Scenario::e, 1);
  const Finished done = calibrated(rig, planFor(rig, CalibrationProcedure::full));
  EXPECT_EQ(done.outcome.end, End::refused);
  EXPECT_NE(done.outcome.reason.find("held one way"), std::string::npos) << done.outcome.reason;
  EXPECT_TRUE(done.run.said("lean the handle"));
  EXPECT_FALSE(done.record.rig.arm);
}

TEST(Wizard, LetsThroughNoTouchesInTheWrongOrder) {
  TechnicianSettings habits;
  habits.reversed = true;
  for (std::uint32_t seed = 1; seed <= 3; ++seed) {
    const SyntheticRig rig = rigOf(Scenario::d, seed);
    Wizard wizard(planFor(rig, CalibrationProcedure::full));
    RobotTechnician technician(rig, habits, seed);
    const RobotRun run = runWizard(wizard, technician, 500.0, {}, 400.0);
    EXPECT_NE(wizard.outcome().end, End::accepted);
    EXPECT_TRUE(run.said("order they glow") || run.said("from the glowing") || run.said("No arm explains")) << seed;
  }
}

TEST(Wizard, RefusesEveryWrongFlipWithWhatToDo) {
  for (const char* flip :
       {"mirrored left", "mirrored top", "turned by half", "turned to the right", "turned to the left"}) {
    TechnicianSettings habits;
    habits.flip = flip;
    const SyntheticRig rig = rigOf(Scenario::a, 1);
    const Finished done = calibrated(rig, planFor(rig, CalibrationProcedure::full), habits);
    EXPECT_EQ(done.outcome.end, End::refused) << flip;
    ASSERT_TRUE(done.outcome.flip);
    EXPECT_FALSE(done.outcome.flip->isUpright());
    EXPECT_EQ(done.outcome.reason, calibration::remedyFor(*done.outcome.flip));
    EXPECT_FALSE(done.run.turnedTo("Touch the pits"));
  }
}

TEST(Wizard, CorrectsTheScreenByTheRulerAndKeepsTheEyes) {
  TechnicianSettings habits;
  habits.bar_mm = 102.0;
  habits.ipd_mm = 66.0;
  habits.distance_mm = 480.0;
  const SyntheticRig rig = rigOf(Scenario::a, 2);
  const WizardPlan plan = planFor(rig, CalibrationProcedure::full, "jig8");
  const Finished done = calibrated(rig, plan, habits);
  ASSERT_EQ(done.outcome.end, End::accepted) << done.outcome.reason;
  const auto width = [](const calibration::Rig& r) {
    return glm::length(r.screen.lower_right.mm - r.screen.lower_left.mm);
  };
  EXPECT_NEAR(width(done.record.rig) / width(plan.record.rig), 1.02, 1e-9);
  EXPECT_NEAR(glm::length(done.record.rig.right_eye.mm - done.record.rig.left_eye.mm), 66.0, 1e-9);
  EXPECT_NEAR(glm::length(done.record.rig.cyclopeanEye().mm), 480.0, 1e-9);
}

TEST(Wizard, AsksForTheWorstTouchOnceMore) {
  SyntheticRig rig = rigOf(Scenario::b, 3);
  rig.technician.outlier_share = 0.15;
  const Finished done = calibrated(rig, planFor(rig, CalibrationProcedure::full));
  EXPECT_TRUE(done.run.turnedTo("All targets touched"));
  ASSERT_EQ(done.outcome.end, End::accepted) << done.outcome.reason;
  EXPECT_LT(trueError_mm(rig, *done.outcome.arm), 0.4);
}

TEST(Wizard, GoesOnAfterASilenceOfTheDevice) {
  bool was_silent = false;
  double from_s = 0.0;
  const Mishap silence = [&](StylusSample& sample, const WizardView& view) {
    if (!was_silent && view.title == "Touch the pits" && view.count == "12 of 27") {
      was_silent = true;
      from_s = sample.t_s;
    }
    if (was_silent && sample.t_s < from_s + 3.0) sample.valid = false;
  };
  const SyntheticRig rig = rigOf(Scenario::d, 7);
  const Finished done = calibrated(rig, planFor(rig, CalibrationProcedure::full), {}, silence);
  EXPECT_EQ(done.outcome.silences, 1);
  EXPECT_TRUE(done.run.turnedTo("The device is silent"));
  EXPECT_TRUE(done.run.said("zero of the device is unchanged"));
  EXPECT_EQ(done.outcome.end, End::accepted) << done.outcome.reason;
}

TEST(Wizard, StartsTheTouchesAgainWhenTheDeviceCountsOtherwiseAfterASilence) {
  bool was_silent = false;
  double from_s = 0.0;
  const SyntheticRig rig = rigOf(Scenario::d, 7);
  const Mishap rehomed = [&](StylusSample& sample, const WizardView& view) {
    if (!was_silent && view.count == "12 of 27") {
      was_silent = true;
      from_s = sample.t_s;
    }
    if (was_silent && sample.t_s < from_s + 3.0) sample.valid = false;
    if (!was_silent) return;
    // Homed anew, elsewhere by half a degree.
    sample.raw_rad[0] += calibration::radFromDegrees(0.5);
    sample.X_DH = calibration::handlePose(rig.arm.geometry, {}, sample.raw_rad);
  };
  Wizard wizard(planFor(rig, CalibrationProcedure::full));
  RobotTechnician technician(rig, {}, 7);
  const RobotRun run = runWizard(wizard, technician, 500.0, rehomed);
  EXPECT_TRUE(run.said("has changed since it was silent"));
  ASSERT_EQ(wizard.outcome().end, End::accepted) << wizard.outcome().reason;
  EXPECT_EQ(wizard.outcome().assessment->verdict, Verdict::green);
}

TEST(Wizard, CanNotTakeWhatIsRedAndLeavesTheOldCalibration) {
  // Between the touches and their verification the base is pushed.
  SyntheticRig pushed = rigOf(Scenario::d, 8);
  pushed.X_WD.translation_mm += glm::dvec3(2.0, 0.0, 0.0);
  const SyntheticRig rig = rigOf(Scenario::d, 8);
  const WizardPlan plan = planFor(rig, CalibrationProcedure::full);
  Wizard wizard(plan);
  RobotTechnician technician(rig, {}, 8);
  bool moved = false;
  const RobotRun run = runWizard(wizard, technician, 500.0, [&](StylusSample&, const WizardView& view) {
    if (!moved && view.title == "Verify") technician.moveTo(pushed), moved = true;
  });
  EXPECT_EQ(wizard.outcome().end, End::refused);
  EXPECT_EQ(wizard.outcome().assessment->verdict, Verdict::red);
  EXPECT_NE(wizard.outcome().reason.find("old calibration stays"), std::string::npos);
  const calibration::RigRecord record = recordOf(plan, wizard.outcome());
  EXPECT_EQ(record.rig.X_WD.translation_mm, plan.record.rig.X_WD.translation_mm);
  EXPECT_FALSE(record.rig.arm);
  for (const WizardView& page : run.pages)
    for (const std::string& choice : page.choices) EXPECT_NE(choice, "take it");
}

TEST(Wizard, AsksForTheEyesAgainWhenCrossesInDepthAreSeenElsewhere) {
  // Whose pupils are wider apart than was said sees depth otherwise; here all of it a little to the right.
  SyntheticRig seen = rigOf(Scenario::a, 3);
  seen.X_WD.translation_mm += glm::dvec3(2.0, 0.0, 0.0);
  const SyntheticRig rig = rigOf(Scenario::a, 3);
  Wizard wizard(planFor(rig, CalibrationProcedure::full, "jig8"));
  RobotTechnician technician(rig, {}, 3);
  const RobotRun run = runWizard(wizard, technician, 500.0, [&](StylusSample&, const WizardView& view) {
    technician.moveTo(view.title == "Crosses in depth" ? seen : rig);
  });
  EXPECT_TRUE(run.said("measure the eyes again"));
  EXPECT_EQ(wizard.outcome().end, End::accepted) << wizard.outcome().reason;
}

TEST(Wizard, ChecksAGoodCalibrationInThirtySeconds) {
  const SyntheticRig rig = rigOf(Scenario::d, 2);
  WizardPlan plan = planFor(rig, CalibrationProcedure::check);
  plan.record = calibratedRecord(rig);
  const Finished done = calibrated(rig, plan);
  ASSERT_EQ(done.outcome.end, End::accepted) << done.outcome.reason;
  EXPECT_EQ(done.outcome.assessment->verdict, Verdict::green);
  EXPECT_FALSE(done.outcome.rezero);
  EXPECT_LT(done.run.seconds, 30.0);
  EXPECT_EQ(done.record.rig.X_WD.translation_mm, plan.record.rig.X_WD.translation_mm);
  EXPECT_EQ(done.record.verification->kind, calibration::VerificationKind::session_check);
}

TEST(Wizard, BringsADriftedCalibrationUpToDate) {
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    SyntheticRig rig = rigOf(Scenario::d, seed);
    rig.technician.outlier_share = 0.0;
    WizardPlan plan = planFor(rig, CalibrationProcedure::check);
    plan.record = calibratedRecord(rig);
    std::mt19937 rng(seed);
    const SyntheticRig today = calibration::drifted(rig, 0.3, 1.0, rng);
    const Finished done = calibrated(today, plan);
    ASSERT_EQ(done.outcome.end, End::accepted) << seed << done.outcome.reason;
    ASSERT_TRUE(done.outcome.rezero);
    EXPECT_LT(trueError_mm(today, *done.outcome.arm), 0.5) << seed;
    EXPECT_GT(trueError_mm(today, *calibration::measuredArm(plan.record.rig)), 0.5) << seed;
    EXPECT_EQ(done.record.procedure->method, "rezero5");
  }
}

TEST(Wizard, LocksAnArmThatFiveTouchesDoNotMend) {
  SyntheticRig rig = rigOf(Scenario::b, 2);
  rig.technician.outlier_share = 0.0;
  WizardPlan plan = planFor(rig, CalibrationProcedure::check);
  plan.record = calibratedRecord(rig);
  // A worn belt: gains, and the gimbal.
  SyntheticRig worn = rig;
  worn.arm.truth.gain[1] += 0.03;
  worn.arm.truth.gain[2] -= 0.03;
  worn.arm.truth.offset_rad[4] += 0.06;
  const Finished done = calibrated(worn, plan);
  EXPECT_EQ(done.outcome.end, End::refused);
  EXPECT_EQ(done.outcome.assessment->verdict, Verdict::red) << done.outcome.assessment->reason;
  EXPECT_NE(done.outcome.reason.find("calibrate it in full"), std::string::npos) << done.outcome.reason;
}

TEST(Wizard, ReZerosWhenItIsAskedFor) {
  SyntheticRig rig = rigOf(Scenario::d, 3);
  rig.technician.outlier_share = 0.0;
  WizardPlan plan = planFor(rig, CalibrationProcedure::rezero);
  plan.record = calibratedRecord(rig);
  std::mt19937 rng(3);
  const Finished done = calibrated(calibration::drifted(rig, 0.3, 1.0, rng), plan);
  EXPECT_EQ(done.outcome.end, End::accepted) << done.outcome.reason;
  EXPECT_EQ(done.outcome.zeroing.touches.size(), 5u);
  EXPECT_EQ(done.outcome.verification.touches.size(), 4u);
}

TEST(Wizard, FindsWhereTheHandRests) {
  SyntheticRig rig = rigOf(Scenario::d, 2);
  rig.technician.outlier_share = 0.0;
  WizardPlan plan = planFor(rig, CalibrationProcedure::rest);
  plan.record = calibratedRecord(rig);
  plan.rest_marks_mm = {{0, 0, 0}, {60, 0, 0}, {15, 40, 5}, {10, 35, 0}, {50, 25, 5}, {30, 10, 5}};
  // Where it was registered last: it has not moved.
  plan.record.rest = calibration::RestRegistration{{1, 0, 0, 0}, {-30, -20, 5}, 0, 0};
  const Finished done = calibrated(rig, plan);
  ASSERT_EQ(done.outcome.end, End::accepted) << done.outcome.reason;
  ASSERT_TRUE(done.record.rest);
  EXPECT_LT(done.record.rest->worst_mm, calibration::kMaxRestError_mm);
  EXPECT_LT(glm::length(done.record.rest->translation_mm - glm::dvec3(-30, -20, 5)), 2.0);
}

TEST(Wizard, BuildsShortProceduresOnTheSameDeviceAlone) {
  const SyntheticRig rig = rigOf(Scenario::a, 1);
  WizardPlan never = planFor(rig, CalibrationProcedure::check);
  EXPECT_NE(calibrated(rig, never).outcome.reason.find("never been calibrated"), std::string::npos);

  WizardPlan other = never;
  other.record = calibratedRecord(rig);
  for (std::string calibration::RigDevice::*name :
       {&calibration::RigDevice::serial, &calibration::RigDevice::mount, &calibration::RigDevice::stylus_tip}) {
    WizardPlan plan = other;
    plan.device.*name = "another";
    const Finished done = calibrated(rig, plan);
    EXPECT_EQ(done.outcome.end, End::refused);
    EXPECT_NE(done.outcome.reason.find("another"), std::string::npos) << done.outcome.reason;
  }
}

TEST(Wizard, KnowsNoMethodOrDeviceThatIsNone) {
  const SyntheticRig rig = rigOf(Scenario::a, 1);
  EXPECT_THROW(Wizard(planFor(rig, CalibrationProcedure::full, "guess")), calibration::CalibrationError);
  WizardPlan plan = planFor(rig, CalibrationProcedure::full);
  plan.device.model = "mouse";
  EXPECT_THROW(Wizard{plan}, calibration::CalibrationError);
}

TEST(Wizard, WaitsForADeviceThatIsHome) {
  const SyntheticRig rig = rigOf(Scenario::a, 1);
  Wizard wizard(planFor(rig, CalibrationProcedure::full));
  RobotTechnician technician(rig, {}, 1);
  const RobotRun run = runWizard(
      wizard, technician, 500.0, [](StylusSample& sample, const WizardView&) { sample.docked = false; }, 60.0);
  EXPECT_FALSE(wizard.isOver());
  EXPECT_EQ(run.titles.back(), "Bring the device home");
}

TEST(Wizard, SaysOnEveryPageOneThingToDoAndWhatTheButtonDoes) {
  const SyntheticRig rig = rigOf(Scenario::d, 1);
  const Finished done = calibrated(rig, planFor(rig, CalibrationProcedure::full));
  for (const WizardView& page : done.run.pages) {
    EXPECT_FALSE(page.title.empty());
    EXPECT_FALSE(page.sentence.empty()) << page.title;
    EXPECT_LT(page.sentence.size(), 160u) << page.title;
    if (page.title == "One moment" || page.title == "Taken") continue;
    EXPECT_FALSE(page.button.short_press.empty() && page.button.long_press.empty()) << page.title;
  }
  EXPECT_GE(done.run.sounds[static_cast<int>(WizardSound::ok)], 27 + 16);
  EXPECT_EQ(done.run.sounds[static_cast<int>(WizardSound::done)], 2);
}

}  // namespace
