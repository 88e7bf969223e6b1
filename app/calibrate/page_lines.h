// What the pages say, as lines for a terminal: for whoever assists and does not see the display. A line for each page,
// each marked choice, each target in turn and each message, once. Plain text; one thread.
#pragma once

#include <string>
#include <vector>

#include "app/calibrate/wizard_view.h"

namespace app {

class PageLines {
 public:
  /// What is new since the last view.
  std::vector<std::string> newOf(const WizardView& view);

 private:
  std::string page_, choice_, target_, message_;
};

}  // namespace app
