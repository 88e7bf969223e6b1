// A few choices under one button: a short press marks the next, a long one chooses. Plain values; one thread.
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

  /// The choice that was made, if one was. `again`: held on, the marked one is chosen again and again.
  std::optional<std::size_t> update(Press press, bool again = false);
  void show(WizardView& view) const;

 private:
  std::vector<std::string> choices_;
  std::size_t marked_ = 0;
};

/// A number set by presses: more, less, that is it.
class NumberDial {
 public:
  NumberDial(double value, double least, double most, double step)
      : value_(value), least_(least), most_(most), step_(step) {}

  /// True once it was taken.
  bool update(Press press);
  void show(WizardView& view, const char* unit) const;
  double value() const { return value_; }

 private:
  double value_, least_, most_, step_;
  ChoiceMenu menu_{{"more", "less", "that is it"}};
};

}  // namespace app
