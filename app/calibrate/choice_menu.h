// A menu under one button: a short press marks the next choice, a long press chooses. Plain values; one thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/calibrate/button_press.h"
#include "app/calibrate/wizard_view.h"

namespace app {

class ChoiceMenu {
 public:
  explicit ChoiceMenu(std::vector<std::string> choices, std::size_t marked = 0)
      : choices_(std::move(choices)), marked_(marked) {}

  /// The choice made, if any. `repeats`: a held button chooses repeatedly.
  std::optional<std::size_t> update(Press press, bool repeats = false);
  void show(WizardView& view) const;

 private:
  std::vector<std::string> choices_;
  std::size_t marked_ = 0;
};

/// A number set by presses.
class NumberDial {
 public:
  NumberDial(double value, double min, double max, double step) : value_(value), min_(min), max_(max), step_(step) {}

  /// True when the number is confirmed.
  bool update(Press press);
  void show(WizardView& view, const char* unit) const;
  double value() const { return value_; }

 private:
  double value_, min_, max_, step_;
  ChoiceMenu menu_{{"more", "less", "confirm"}};
};

}  // namespace app
