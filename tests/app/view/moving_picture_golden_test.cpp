// The picture as it is drawn on the processor while it moves, a third of the resolution enlarged: the site at work
// scale against a stored crop, looked at by eye. After an intended change:
//   MOLAR_WRITE_GOLDEN=1 build/release/tests/app/view/app_view_test --gtest_filter="MovingPicture*"
#include <gtest/gtest.h>

#include <cstdlib>

#include "app/case/patient_placement.h"
#include "app/case/patient_source.h"
#include "app/view/patient_renderer.h"
#include "render/quality_ladder.h"
#include "tests/app/view/golden_image.h"

namespace app {
namespace {

constexpr glm::ivec2 kPicture{900, 560}, kCrop{300, 220};

/// The middle of the picture.
render::Image cropOf(const render::Image& picture) {
  render::Image crop{kCrop.x, kCrop.y, {}};
  const glm::ivec2 first = (kPicture - kCrop) / 2;
  for (int y = 0; y < kCrop.y; ++y) {
    const auto row = picture.rgba.begin() + 4 * ((y + first.y) * picture.w + first.x);
    crop.rgba.insert(crop.rgba.end(), row, row + 4 * kCrop.x);
  }
  return crop;
}

TEST(MovingPicture, AThirdOfTheResolutionHasSmoothEdges) {
  setenv("XDG_CACHE_HOME", MOLAR_TEST_CACHE, 1);
  assets::JawParameters jaw;
  jaw.spacing_mm = 0.5;
  const assets::Patient patient = builtInPatient(jaw);
  const auto renderer = patientRenderer(patient, {}, {}, patient.ct.solid, {.backend = render::Backend::cpu});
  render::Frame frame;
  frame.rig = calibration::desktopRig(kPicture, calibration::kDeskMonitorWidth_mm / 4.0);
  frame.rig.X_WP = placePatientAtSite(patient, assets::kFaceAxes_PF);
  frame.site_P = {patient.focus_P_mm()};
  frame.X_PT = {glm::dquat(1, 0, 0, 0), patient.focus_P_mm() + glm::dvec3(0.0, 0.0, 10.0)};
  frame.quality = render::kQualitySteps.back().quality;
  renderer->render(frame);
  // Other processors round a few pixels of silhouettes otherwise.
  test::expectGolden(cropOf(renderer->readImage()), "moving_third_resolution.png", 0.1);
}

}  // namespace
}  // namespace app
