// Draws again when the graphics card was reset meanwhile and all that lived on it is gone: everything is made anew
// first. A driver that gives up again and again is not worth another try. Render thread; costs nothing while all is
// well.
#pragma once

#include "render/gpu/gpu_error.h"

namespace app {

class ContextRecovery {
 public:
  /// `make_anew` is told what was lost. Throws ContextLost after the third time.
  template <class Draw, class MakeAnew>
  void draw(Draw draw, MakeAnew make_anew) {
    for (;;) {
      try {
        return draw();
      } catch (const render::ContextLost& lost) {
        if (times_lost_ == kMostResets) throw;
        ++times_lost_;
        make_anew(lost);
      }
    }
  }
  int timesLost() const { return times_lost_; }

 private:
  static constexpr int kMostResets = 3;
  int times_lost_ = 0;
};

}  // namespace app
