// Whether the picture reaches the eye the right way round: a drawn F must read right. One thread.

#include <array>
#include <string>

#include "app/calibrate/choice_menu.h"
#include "app/calibrate/steps/step.h"

namespace app {
namespace {

ChoiceMenu whether() { return ChoiceMenu({"yes, it reads right", "no"}); }
/// In the order of the choices.
constexpr std::array<calibration::ImageOrientation, 5> kWays{
    {{true, 0}, {true, 2}, {false, 2}, {false, 1}, {false, 3}}};

ChoiceMenu which() {
  return ChoiceMenu({"mirrored left to right", "mirrored top to bottom", "turned by half a turn", "turned to the right",
                     "turned to the left", "back"});
}

class FlipStep final : public WizardStep {
 public:
  using WizardStep::WizardStep;
  void begin() override {
    which_ = false;
    menu_ = whether();
  }

  StepResult update(const StylusSample&, Press press, double) override {
    const auto chosen = menu_.update(press);
    if (!chosen) return {};
    if (!which_ && *chosen == 0) {
      context_.outcome.flip = calibration::ImageOrientation{};
      return StepResult::next();
    }
    if (!which_ || *chosen == kWays.size()) {
      which_ = !which_;
      menu_ = which_ ? which() : whether();
      return {};
    }
    context_.outcome.flip = kWays[*chosen];
    return StepResult::refused(calibration::remedyFor(kWays[*chosen]));
  }

  bool needsDevice() const override { return false; }
  void show(WizardView& view) const override {
    view.title = which_ ? "How does it read?" : "Does the F read right?";
    view.sentence = std::string(context_.plan.record.rig.mirror ? "Look into the mirror" : "Look at the screen") +
                    " as for work: the letter must stand upright and read as on paper.";
    view.figure = WizardFigure::letter_f;
    menu_.show(view);
  }

 private:
  ChoiceMenu menu_{{}};
  bool which_ = false;  ///< it does not read right: asked how
};

}  // namespace

std::unique_ptr<WizardStep> flipStep(WizardContext& context) { return std::make_unique<FlipStep>(context); }

}  // namespace app
