// Draws again when the graphics card was reset meanwhile and all that lived on it is gone: everything is made anew
// first. A driver that gives up again and again is not worth another try. Render thread; costs nothing while all is
// well.
#pragma once

#include "render/gpu/gpu_error.h"

namespace app {

class ContextRecovery {
 public:
  /// `recreate` is told what was lost. Throws ContextLost after the third time.
  template <class Draw, class MakeAnew>
  void draw(Draw draw, MakeAnew recreate) {
    for (;;) {
      try {
        return draw();
      } catch (const render::ContextLost& lost) {
        if (context_losses_ == kMaxResets) throw;
        ++context_losses_;
        recreate(lost);
      }
    }
  }
  int contextLosses() const { return context_losses_; }

 private:
  static constexpr int kMaxResets = 3;
  int context_losses_ = 0;
};

}  // namespace app
