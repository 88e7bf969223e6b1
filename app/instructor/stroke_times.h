// When each stroke that can be undone or redone was made, from the ticks of a rehearsal in order: for the time line on
// which the instructor jumps to a stroke. A stroke that is dropped from the servo's memory leaves it, too. s. Pure; any
// one thread; some nanoseconds a tick.
#pragma once

#include <span>
#include <vector>

#include "app/controls/control.h"
#include "haptics/servo/tick.h"

namespace app {

class StrokeTimes {
 public:
  void follow(std::span<const haptics::Tick> ticks);

  /// The oldest first; those that can be redone come last, the first to be redone first.
  const std::vector<double>& begun_s() const { return begun_s_; }
  /// Of these, that can be undone.
  std::size_t done() const { return done_; }

 private:
  std::vector<double> begun_s_;
  std::size_t done_ = 0;
  double restored_mm3_ = 0.0;
};

/// What brings the bone to where the first `wanted` of the strokes are done: undo or redo, each as often as needed.
std::vector<ControlRequest> requestsForStrokes(std::size_t done, std::size_t wanted);

}  // namespace app
