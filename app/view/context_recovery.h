// Repeats a drawing after a reset of the graphics card, in which all its objects were lost. Render thread; no cost
// without a reset.
#pragma once

#include "render/gpu/gpu_error.h"

namespace app {

class ContextRecovery {
 public:
  /// `recreate` makes all objects again and receives the error. Throws ContextLost at the fourth reset.
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
