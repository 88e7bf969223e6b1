#include "app/calibrate/steps/length_step.h"

namespace app {
namespace {

constexpr double kBar_mm = 100.0, kStep_mm = 0.5;

NumberDial dial() { return NumberDial(kBar_mm, 0.7 * kBar_mm, 1.3 * kBar_mm, kStep_mm); }

}  // namespace

void LengthStep::begin() {
  dial_ = dial();
  across_mm_.reset();
  book_.outcome.screen.reset();
}

StepAnswer LengthStep::feel(const StylusSample&, Press press, double) {
  if (!dial_.feel(press)) return {};
  if (!across_mm_) {
    across_mm_ = dial_.value();
    dial_ = dial();
    return {};
  }

  const calibration::MeasuredBars bars{kBar_mm, *across_mm_, dial_.value()};
  try {
    const calibration::SizeCheck check = calibration::checkedSize(book_.plan.record.rig.screen, bars);
    book_.outcome.bars = bars;
    if (!check.agrees) book_.outcome.screen = check.corners;
    book_.voice.say(check.line);
    return StepAnswer::next();
  } catch (const calibration::CalibrationError& error) {
    book_.voice.refuse(error.what());
    begin();
    return {};
  }
}

void LengthStep::show(WizardView& view) const {
  view.title = across_mm_ ? "How long is the upright bar?" : "How long is the bar?";
  view.sentence = "Lay a ruler on the screen itself, from end mark to end mark, and set what it says.";
  view.figure = across_mm_ ? WizardFigure::upright_length_bar : WizardFigure::length_bar;
  view.bar_mm = kBar_mm;
  dial_.show(view, "mm");
}

}  // namespace app
