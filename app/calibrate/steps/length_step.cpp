// How large the screen's pixels are: a bar of 100 mm across and one upright, measured with a ruler. One thread.

#include "app/calibrate/choice_menu.h"
#include "app/calibrate/steps/step.h"

namespace app {
namespace {

constexpr double kBar_mm = 100.0, kStep_mm = 0.5;

NumberDial dial() { return NumberDial(kBar_mm, 0.7 * kBar_mm, 1.3 * kBar_mm, kStep_mm); }

class LengthStep final : public WizardStep {
 public:
  using WizardStep::WizardStep;
  void begin() override {
    dial_ = dial();
    across_mm_.reset();
    context_.outcome.screen.reset();
  }

  StepResult update(const StylusSample&, Press press, double) override {
    if (!dial_.update(press)) return {};
    if (!across_mm_) {
      across_mm_ = dial_.value();
      dial_ = dial();
      return {};
    }

    const calibration::MeasuredBars bars{kBar_mm, *across_mm_, dial_.value()};
    try {
      const calibration::SizeCheck check = calibration::checkedSize(context_.plan.record.rig.screen, bars);
      context_.outcome.bars = bars;
      if (!check.agrees) context_.outcome.screen = check.corners;
      context_.announcements.say(check.line);
      return StepResult::next();
    } catch (const calibration::CalibrationError& error) {
      context_.announcements.refuse(error.what());
      begin();
      return {};
    }
  }

  bool needsDevice() const override { return false; }
  void show(WizardView& view) const override {
    view.title = across_mm_ ? "How long is the upright bar?" : "How long is the bar?";
    view.sentence = "Lay a ruler on the screen itself, from end mark to end mark, and set what it says.";
    view.figure = across_mm_ ? WizardFigure::upright_length_bar : WizardFigure::length_bar;
    view.bar_mm = kBar_mm;
    dial_.show(view, "mm");
  }

 private:
  NumberDial dial_{100.0, 70.0, 130.0, 0.5};
  std::optional<double> across_mm_;
};

}  // namespace

std::unique_ptr<WizardStep> lengthStep(WizardContext& context) { return std::make_unique<LengthStep>(context); }

}  // namespace app
