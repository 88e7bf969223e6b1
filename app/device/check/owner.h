// Who holds the device while it is checked. A person needs no more than the words they read; a simulated hand is
// perform here what to do.
#pragma once

namespace app {

enum class OwnerTask { rest, hold, first_button, second_button, let_go, upper_corner, lower_corner };

class Owner {
 public:
  virtual ~Owner() = default;
  virtual void perform(OwnerTask /*task*/) {}
};

}  // namespace app
