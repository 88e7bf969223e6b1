#include "app/calibrate/steps/eyes_step.h"

#include <cmath>

namespace app {

calibration::Rig rigSoFar(const calibration::Rig& rig, const WizardOutcome& outcome) {
  calibration::Rig known = rig;
  if (outcome.screen) known.screen = *outcome.screen;
  if (!outcome.ipd_mm && !outcome.eye_distance_mm) return known;

  // The head looks as before, from further or nearer, its pupils further or less apart.
  const glm::dvec3 between_mm = rig.right_eye.mm - rig.left_eye.mm;
  const glm::dvec3 middle_mm = rig.cyclopeanEye().mm;
  if (glm::length(between_mm) == 0.0 || glm::length(middle_mm) == 0.0) return known;
  const double ipd_mm = outcome.ipd_mm.value_or(glm::length(between_mm));
  const double distance_mm = outcome.eye_distance_mm.value_or(glm::length(middle_mm));
  const glm::dvec3 head_mm = distance_mm * glm::normalize(middle_mm);
  known.left_eye.mm = head_mm - 0.5 * ipd_mm * glm::normalize(between_mm);
  known.right_eye.mm = head_mm + 0.5 * ipd_mm * glm::normalize(between_mm);
  return known;
}

void EyesStep::begin() {
  const calibration::Rig rig = rigSoFar(book_.plan.record.rig, book_.outcome);
  pupils_ = NumberDial(std::round(glm::length(rig.right_eye.mm - rig.left_eye.mm)), 50.0, 76.0, 1.0);
  distance_ = NumberDial(5.0 * std::round(glm::length(rig.cyclopeanEye().mm) / 5.0), 250.0, 900.0, 5.0);
  has_pupils_ = false;
}

StepAnswer EyesStep::feel(const StylusSample&, Press press, double) {
  if (!has_pupils_) {
    if (pupils_.feel(press)) {
      book_.outcome.ipd_mm = pupils_.value();
      has_pupils_ = true;
    }
    return {};
  }
  if (!distance_.feel(press)) return {};
  book_.outcome.eye_distance_mm = distance_.value();
  // Measured again after the crosses: they are looked at again.
  return book_.outcome.arm ? StepAnswer::goTo(StepName::eye_check) : StepAnswer::next();
}

void EyesStep::show(WizardView& view) const {
  if (!has_pupils_) {
    view.title = "How far apart are the pupils?";
    view.sentence = "Of who will look: a ruler held at the brow, eyes looking far away.";
    pupils_.show(view, "mm");
    return;
  }
  view.title = "How far is the eye from the picture?";
  view.sentence = "With a tape, head in the rest: from the eye to the mirror, and on from the mirror to the screen.";
  distance_.show(view, "mm");
}

}  // namespace app
