// Who leads a session instead of its plan: takes keys first, says what is to be felt now, and what the title says.
// For experiments (psychophysics/trial_desk). Main thread, once a frame.
#pragma once

#include <optional>
#include <string>

#include "haptics/servo/command.h"
#include "haptics/servo/tick.h"

namespace app {

class SessionGuide {
 public:
  virtual ~SessionGuide() = default;
  /// A key as its upper-case letter; true: it was the guide's, nobody else gets it.
  virtual bool press(char key) = 0;
  /// What is to be felt from now on; none: as it is.
  virtual std::optional<haptics::Command> follow(const haptics::Tick& tick) = 0;
  virtual std::string words() const = 0;
  virtual bool isOver() const = 0;
};

}  // namespace app
