#include "calibration/webcam/ring_image.h"

#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/calibration/synthetic/glass_formulas.h"
#include "tests/calibration/synthetic/mirrored_workstation.h"
#include "tests/calibration/webcam/ring_check.h"

namespace calibration {
namespace {

using testing::HasSubstr;

/// A mirrored workstation and a webcam at its eye; the ring is drawn at the arm's tip.
class RingCheckAtAWebcam : public testing::Test {
 protected:
  RingCheckAtAWebcam() {
    rig_.screen = hangingMonitor();
    rig_.mirror = slantedMirror();
    rig_.left_eye = {{-31.5, 0, 450}}, rig_.right_eye = {{31.5, 0, 450}};
    webcam_ = webcamAtEye({1280, 720});
    look(0.0);
  }
  void look(double plate_mm) {
    view_.emplace(WebcamScene{.panel = rig_.screen, .mirror = rig_.mirror, .plate_mm = plate_mm, .ghost = 0.05},
                  webcam_);
  }
  RingDetection detection(const glm::dvec3& believed_W, const LitTip& tip, std::uint64_t seed = 1) {
    const GreyImage ring = ringImage(rig_, {webcam_.X_WC.translation_mm}, {believed_W});
    const GreyImage seen = view_->image(&ring, tip, seed);
    keepPicture("ring", seen);
    return detectRing(view_->image(nullptr, {}, seed + 1000), seen);
  }
  Vector<Camera> offset_mm(const RingDetection& detection, const glm::dvec3& tip_W) const {
    return ringOffset_mm(webcam_.model, detection, (webcam_.X_WC.inverse() * Point<World>{tip_W}).mm.z);
  }

  Rig rig_ = desktopRig({1920, 1080});
  Webcam webcam_;
  std::optional<WebcamRenderer> view_;
};

TEST_F(RingCheckAtAWebcam, FindsATipInItsRing) {
  for (const glm::dvec3 tip : {glm::dvec3(0, 0, 0), glm::dvec3(50, 30, 25), glm::dvec3(-55, -35, -30)}) {
    const RingDetection both = detection(tip, {.middle_W = {tip}});
    EXPECT_EQ(both.line, "");
    EXPECT_LT(glm::length(offset_mm(both, tip).xyz), 0.05);
  }
}

TEST_F(RingCheckAtAWebcam, MeasuresTheirDistance) {
  std::mt19937 rng(4);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  std::vector<Vector<Camera>> offsets;
  double mean_mm = 0.0;
  for (int i = 0; i < kRingPlaces; ++i) {
    const glm::dvec3 believed(50 * any(rng), 30 * any(rng), 25 * any(rng));
    const glm::dvec3 tip = believed + glm::dvec3(2.0 * any(rng), 2.0 * any(rng), 0.0);
    offsets.push_back(offset_mm(detection(believed, {.middle_W = {tip}}, 10u + static_cast<unsigned>(i)), tip));
    // C has x as W, y and z against it.
    EXPECT_NEAR(offsets.back().xyz.x, tip.x - believed.x, 0.06);
    EXPECT_NEAR(offsets.back().xyz.y, believed.y - tip.y, 0.06);
    mean_mm += glm::distance(tip, believed) / kRingPlaces;
  }
  EXPECT_NEAR(judgedRing(offsets).mean_mm, mean_mm, 0.05);
}

TEST_F(RingCheckAtAWebcam, SeesTheShiftOfTheGlass) {
  look(3.0);
  const glm::dvec3 tip(0, 0, 0);
  const double shift_mm = plateShift_mm({*rig_.mirror, 3.0}, std::acos(std::sqrt(0.5)));
  EXPECT_NEAR(glm::length(offset_mm(detection(tip, {.middle_W = {tip}}), tip).xyz), shift_mm, 0.05);
}

TEST_F(RingCheckAtAWebcam, ReportsWhatIsMissing) {
  const glm::dvec3 tip(0, 0, 0);
  const GreyImage dark = view_->image(nullptr, {}, 1);
  const GreyImage ring = ringImage(rig_, {webcam_.X_WC.translation_mm}, {tip});
  EXPECT_THAT(detectRing(dark, dark).line, HasSubstr("neither"));
  EXPECT_THAT(detectRing(dark, view_->image(nullptr, LitTip{.middle_W = {tip}}, 2)).line, HasSubstr("no whole ring"));
  EXPECT_THAT(detectRing(dark, view_->image(&ring, {}, 2)).line, HasSubstr("tip is not"));
  EXPECT_THAT(detection({262, 0, 0}, {.middle_W = {{255, 0, 0}}}).line, testing::Not(testing::IsEmpty()));
  EXPECT_THROW(detectRing(dark, GreyImage{{2, 2}, std::vector<std::uint8_t>(4)}), CalibrationError);
}

TEST(RingCheck, PassesUpToAMillimetreOnAverage) {
  std::vector<Vector<Camera>> offsets(8, {{0.9, 0.0, 0.0}});
  offsets[5].xyz.y = 1.2;
  const RingCheck check = judgedRing(offsets);
  EXPECT_TRUE(check.passed);
  EXPECT_EQ(check.worst, 5);
  EXPECT_NEAR(check.max_mm, 1.5, 1e-9);
  EXPECT_THAT(check.line, HasSubstr("1.5 mm at the worst place (6)"));
  offsets[0].xyz.x = offsets[1].xyz.x = 1.4;
  EXPECT_FALSE(judgedRing(offsets).passed);
  offsets.pop_back();
  EXPECT_THROW(judgedRing(offsets), CalibrationError);
}

}  // namespace
}  // namespace calibration
