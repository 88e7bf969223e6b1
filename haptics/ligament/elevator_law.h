// What an elevator's blade meets tooth and bone with: steel on wet hard tissue. Plain values; any thread. All our
// defaults, reference/extraction 4.2, 4.3, 5.4.
#pragma once

namespace haptics {

struct ElevatorLaw {
  double point_N_per_mm = 200.0;  ///< of one ball along the edges
  double friction = 0.3;
  double stick_N_per_mm = 200.0;  ///< tangential, of a region that sticks
  double drag_Ns_per_mm = 0.01;   ///< of the whole blade; the lever makes it one of rotation
  double drag_lever_mm = 6.0;

  bool operator==(const ElevatorLaw&) const = default;
};

}  // namespace haptics
