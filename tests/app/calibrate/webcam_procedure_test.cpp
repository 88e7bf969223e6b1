#include "app/calibrate/webcam_procedure.h"

#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/calibrate/webcam_technician.h"
#include "calibration/synthetic/synthetic_rig.h"
#include "calibration/webcam/flip_check.h"

namespace app {
namespace {

using namespace calibration;

using calibration::CameraModel;
using calibration::GreyImage;
using testing::HasSubstr;

constexpr calibration::RawJoints kNoJoints{};

class WebcamProcedureAtAWorkstation : public testing::Test {
 protected:
  WebcamPlan plan(bool known_lens = true) const {
    WebcamPlan plan{.rig = rig_.nominal,
                    .places = *calibration::targetPlan("webcam27"),
                    .positions = 3,
                    .lens_views = 12,
                    .lens = {},
                    .gray_code = false,
                    .device_model = "omni",
                    .serial = "17",
                    .mount = "right"};
    plan.places.targets.resize(2);
    if (known_lens) plan.lens = technician_.lens();
    return plan;
  }
  /// Until it expects something else than what the technician just does.
  void follow(WebcamProcedure& procedure, WebcamStep until) {
    for (int i = 0; i < 400 && procedure.step() != until; ++i) technician_.act(procedure);
    EXPECT_EQ(procedure.step(), until) << procedure.sentence() << " " << procedure.answer();
  }

  calibration::SyntheticRig rig_ = calibration::syntheticRig(calibration::Scenario::d, 1);
  WebcamTechnician technician_{rig_, {1280, 720}, 5};
};

TEST_F(WebcamProcedureAtAWorkstation, GathersBoardAndTipsFromThreePlaces) {
  WebcamProcedure procedure(plan());
  EXPECT_EQ(procedure.progress(), 0.0);
  follow(procedure, WebcamStep::done);
  EXPECT_EQ(procedure.expects(), WebcamInput::nothing);
  EXPECT_EQ(procedure.progress(), 1.0);
  const calibration::WebcamObservations& all = procedure.observations();
  EXPECT_EQ(all.serial, "17");
  ASSERT_EQ(all.positions.size(), 3u);
  for (std::size_t p = 0; p < 3; ++p) {
    const calibration::CameraPosition& position = all.positions[p];
    EXPECT_EQ(position.screen.size(), 84u);
    ASSERT_EQ(position.tips.size(), 2u);
    // All lie where the truth has them.
    const auto X_CW = technician_.webcamPose(p).inverse();
    for (const calibration::ScreenObservation& place : position.screen)
      EXPECT_LT(glm::distance(technician_.lens().pixelOf(X_CW * place.position_W), place.camera_px), 0.5);
    for (const calibration::TipObservation& tip : position.tips)
      EXPECT_LT(glm::distance(technician_.lens().pixelOf(X_CW * rig_.tip_W(tip.joints_rad)), tip.camera_px), 0.7);
  }
}

TEST_F(WebcamProcedureAtAWorkstation, MeasuresTheLensOnTheShownBoard) {
  WebcamProcedure procedure(plan(false));
  follow(procedure, WebcamStep::pattern);
  ASSERT_TRUE(procedure.lens().has_value());
  const CameraModel &found = procedure.lens()->camera, truth = technician_.lens();
  EXPECT_LT(procedure.lens()->rms_px, 0.3);
  EXPECT_NEAR(found.focal_px.x / truth.focal_px.x, 1.0, 0.005);
  EXPECT_NEAR(found.centre_px.x, truth.centre_px.x, 4.0);
}

TEST_F(WebcamProcedureAtAWorkstation, TakesAGrayCodeInOnePress) {
  WebcamPlan with_code = plan();
  with_code.gray_code = true;
  WebcamProcedure procedure(with_code);
  follow(procedure, WebcamStep::tips);
  const calibration::CameraPosition& position = procedure.observations().positions.front();
  EXPECT_GT(position.screen.size(), 2000u);
  const auto X_CW = technician_.webcamPose(0).inverse();
  double worst_px = 0.0;
  for (const calibration::ScreenObservation& place : position.screen)
    worst_px = std::max(worst_px, glm::distance(technician_.lens().pixelOf(X_CW * place.position_W), place.camera_px));
  EXPECT_LT(worst_px, 1.0);
}

TEST_F(WebcamProcedureAtAWorkstation, GoesNoFurtherWhileTheScreenReadsWrong) {
  // The rig file has two corners exchanged.
  WebcamPlan wrong = plan();
  std::swap(wrong.rig.screen.lower_left, wrong.rig.screen.lower_right);
  wrong.rig.screen.upper_left.mm += wrong.rig.screen.lower_left.mm - wrong.rig.screen.lower_right.mm;
  WebcamProcedure procedure(wrong);
  technician_.act(procedure), technician_.act(procedure);
  EXPECT_EQ(procedure.step(), WebcamStep::letter);
  EXPECT_EQ(procedure.expects(), WebcamInput::press);
  EXPECT_THAT(procedure.answer(), HasSubstr("mirrored"));
}

TEST_F(WebcamProcedureAtAWorkstation, SaysWhyAPictureIsNotTaken) {
  WebcamProcedure procedure(plan());
  procedure.press();
  procedure.see({{64, 64}, std::vector<std::uint8_t>(64 * 64)}, kNoJoints);
  EXPECT_THAT(procedure.answer(), HasSubstr("64 x 64: set the webcam to 1280 x 720"));
  procedure.press();
  const GreyImage black{{1280, 720}, std::vector<std::uint8_t>(1280 * 720)};
  procedure.see(black, kNoJoints);
  EXPECT_THAT(procedure.answer(), HasSubstr("No F"));
  follow(procedure, WebcamStep::pattern);
  procedure.press();
  procedure.see(black, kNoJoints);
  EXPECT_EQ(procedure.step(), WebcamStep::pattern);
  EXPECT_THAT(procedure.answer(), testing::Not(testing::IsEmpty()));
  follow(procedure, WebcamStep::tips);
  procedure.press();
  procedure.see(black, kNoJoints);
  EXPECT_EQ(procedure.target()->id, plan().places.targets[0].id) << "not taken";
  EXPECT_THAT(procedure.answer(), testing::Not(testing::IsEmpty()));
}

TEST_F(WebcamProcedureAtAWorkstation, TakesTheLastTipAgain) {
  WebcamProcedure procedure(plan());
  follow(procedure, WebcamStep::tips);
  procedure.undo();
  const int first = procedure.target()->id;
  technician_.act(procedure), technician_.act(procedure);
  EXPECT_NE(procedure.target()->id, first) << procedure.answer();
  procedure.undo();
  EXPECT_EQ(procedure.target()->id, first);
}

TEST(WebcamProcedure, RefusesAPlanThatCanNotSucceed) {
  WebcamPlan plan;
  plan.rig = calibration::desktopRig({1920, 1080});
  EXPECT_THROW(WebcamProcedure{plan}, calibration::CalibrationError) << "no places";
  plan.places = *calibration::targetPlan("webcam27");
  EXPECT_NO_THROW(WebcamProcedure{plan});
  plan.positions = 1;
  EXPECT_THROW(WebcamProcedure{plan}, calibration::CalibrationError);
  plan.positions = 3;
  plan.rig.screen.upper_left.mm.z = 5.0;
  EXPECT_THROW(WebcamProcedure{plan}, calibration::CalibrationError) << "not W's own plane";
  plan.rig = calibration::desktopRig({64, 48});
  EXPECT_THROW(WebcamProcedure{plan}, calibration::CalibrationError);
}

}  // namespace
}  // namespace app
