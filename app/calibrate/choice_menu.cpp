#include "app/calibrate/choice_menu.h"

#include <algorithm>

#include "app/calibrate/number_text.h"

namespace app {

std::optional<std::size_t> ChoiceMenu::update(Press press, bool repeats) {
  if (press == Press::short_press && !choices_.empty()) marked_ = (marked_ + 1) % choices_.size();
  if (press == Press::long_press || (repeats && press == Press::repeated)) return marked_;
  return std::nullopt;
}

void ChoiceMenu::show(WizardView& view) const {
  view.choices = choices_;
  view.marked = marked_;
  view.button = {choices_.size() > 1 ? "next choice" : "", "choose", ""};
}

bool NumberDial::update(Press press) {
  const auto chosen = menu_.update(press, true);
  // A held button changes the number but does not confirm it.
  if (chosen == 2) return press == Press::long_press;
  if (chosen) value_ = std::clamp(value_ + (*chosen == 0 ? step_ : -step_), min_, max_);
  return false;
}

void NumberDial::show(WizardView& view, const char* unit) const {
  menu_.show(view);
  view.button.long_press = "choose; hold to repeat";
  view.value = fixedText(value_, step_ < 1.0 ? 1 : 0) + " " + unit;
}

}  // namespace app
