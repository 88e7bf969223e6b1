#include "app/calibrate/steps/flip_step.h"

#include <array>

namespace app {
namespace {

ChoiceMenu whether() { return ChoiceMenu({"yes, it reads right", "no"}); }
/// In the order of the choices.
constexpr std::array<calibration::Reading, 5> kWays{{{true, 0}, {true, 2}, {false, 2}, {false, 1}, {false, 3}}};

ChoiceMenu which() {
  return ChoiceMenu({"mirrored left to right", "mirrored top to bottom", "turned by half a turn", "turned to the right",
                     "turned to the left", "back"});
}

}  // namespace

void FlipStep::begin() {
  which_ = false;
  menu_ = whether();
}

StepAnswer FlipStep::feel(const StylusSample&, Press press, double) {
  const auto chosen = menu_.feel(press);
  if (!chosen) return {};
  if (!which_ && *chosen == 0) {
    book_.outcome.flip = calibration::Reading{};
    return StepAnswer::next();
  }
  if (!which_ || *chosen == kWays.size()) {
    which_ = !which_;
    menu_ = which_ ? which() : whether();
    return {};
  }
  book_.outcome.flip = kWays[*chosen];
  return StepAnswer::refused(calibration::remedyFor(kWays[*chosen]));
}

void FlipStep::show(WizardView& view) const {
  view.title = which_ ? "How does it read?" : "Does the F read right?";
  view.sentence = "Look into the mirror as for work: the letter must stand upright and read as on paper.";
  view.figure = WizardFigure::letter_f;
  menu_.show(view);
}

}  // namespace app
