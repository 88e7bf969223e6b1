// The person who holds the device while it is checked. A person follows the displayed text; a simulated owner is called
// here.
#pragma once

namespace app {

enum class OwnerTask { rest, hold, first_button, second_button, let_go, upper_corner, lower_corner };

class Owner {
 public:
  virtual ~Owner() = default;
  virtual void perform(OwnerTask /*task*/) {}
};

}  // namespace app
