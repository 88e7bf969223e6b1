#include "app/controls/held_press.h"

namespace app {

HeldPress::Seen HeldPress::look(std::uint32_t presses, bool down, double t_s) {
  Seen seen;
  std::uint32_t begun = presses - presses_.value_or(presses);
  presses_ = presses;
  // The press of before has ended if another one began since.
  if (held_ && (begun > 0 || !down)) seen.ended = true, held_ = false;
  if (down_since_s_ && (begun > 0 || !down)) ++seen.taps, down_since_s_.reset();
  if (begun > 0) {
    seen.taps += down ? begun - 1 : begun;
    if (down) down_since_s_ = t_s;
  }
  if (down_since_s_ && t_s - *down_since_s_ >= kHeldFor_s) {
    down_since_s_.reset();
    seen.began = held_ = true;
  }
  return seen;
}

}  // namespace app
