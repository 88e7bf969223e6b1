// Tells a short press of a button from one that is held, from the number of presses so far and whether it is down now:
// a late reader misses none. Pure values; main thread, once a frame.
#pragma once

#include <cstdint>
#include <optional>

namespace app {

class HeldPress {
 public:
  /// As long as that it is held.
  static constexpr double kHeldFor_s = 0.3;

  struct Seen {
    std::uint32_t taps = 0;  ///< short presses that ended
    bool began = false;      ///< it is held from now on
    bool ended = false;      ///< what was held is let go
  };
  /// The first call counts no press.
  Seen look(std::uint32_t presses, bool down, double t_s);

 private:
  std::optional<std::uint32_t> presses_;
  std::optional<double> down_since_s_;  ///< of a press that may become a hold
  bool held_ = false;
};

}  // namespace app
