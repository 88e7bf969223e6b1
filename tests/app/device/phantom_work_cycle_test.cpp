#include "app/device/phantom_work_cycle.h"

#include <gtest/gtest.h>

#include "app/case/gutter_plan.h"
#include "app/case/patient_placement.h"
#include "app/case/patient_source.h"
#include "app/device/pose_source.h"
#include "app/text/usage_error.h"
#include "assets/solid_sample.h"
#include "assets/synthetic/face.h"

namespace app {
namespace {

struct Scene {
  assets::Patient patient;
  calibration::Rig rig = calibration::desktopRig({640, 400});
  std::optional<assets::PlannedCut> cut;
  haptics::CuttingMotion manner;

  Scene() {
    setenv("XDG_CACHE_HOME", MOLAR_TEST_CACHE, 1);
    assets::JawParameters jaw;
    jaw.spacing_mm = 0.6;
    patient = builtInPatient(jaw);
    rig.X_WP = placePatient({patient.focus_P_mm()}, {assets::surgeonEyeDirection(patient.operatedTooth())},
                            {assets::kFaceAxes_PF.rotation * glm::dvec3(0.0, 1.0, 0.0)});
    cut = planGutter(patient, 1.5);
    manner.shaft_P = glm::conjugate(rig.X_WP.rotation) * restingTool().rotation * glm::dvec3(0.0, 0.0, 1.0);
  }
};

TEST(PhantomWorkCycle, AvoidsTheJawWithEveryPhantom) {
  const Scene scene;
  ASSERT_TRUE(scene.cut);
  const auto X_PD = scene.rig.X_WP.inverse() * scene.rig.X_WD;
  for (const haptics::PhantomMechanics& mechanics : haptics::simulatedPhantoms()) {
    const haptics::WorkCycle round = workCycleFor(mechanics, *scene.cut, scene.manner, scene.rig);
    double works_s = 0.0, deepest = 0.0;
    for (double t_s = 0.0; t_s < round.duration_s(); t_s += 0.01) {
      const haptics::HandTarget target = round.at(t_s);
      const calibration::Point<calibration::Patient> place_P =
          X_PD * calibration::Point<calibration::Device>{target.position_mm};
      works_s += target.pedal ? 0.01 : 0.0;
      if (glm::distance(place_P.mm, assets::middleOf_P_mm(*scene.cut)) > 10.0)
        deepest = std::max(deepest, assets::solidAt(scene.patient.ct, place_P.mm));
    }
    EXPECT_GT(works_s, 10.0) << mechanics.key;
    EXPECT_LT(deepest, 0.1) << mechanics.key;
    EXPECT_LT(glm::distance(round.at(0.0).position_mm, mechanics.rest_D.mm), 1e-9) << mechanics.key;
    EXPECT_LT(glm::distance(round.at(round.duration_s()).position_mm, mechanics.rest_D.mm), 1e-9) << mechanics.key;
  }
}

TEST(PhantomWorkCycle, RefusesARigWhoseDeviceStandsTooFar) {
  Scene scene;
  scene.rig.X_WD.translation_mm = {0.0, 0.0, 300.0};
  try {
    workCycleFor(*haptics::findSimulatedPhantom("omni"), *scene.cut, scene.manner, scene.rig);
    FAIL() << "accepted";
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("change X_WD"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace app
