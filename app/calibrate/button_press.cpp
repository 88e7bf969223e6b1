#include "app/calibrate/button_press.h"

namespace app {

Press ButtonPress::update(double t_s, bool button) {
  if (button != read_) {
    read_ = button;
    changed_s_ = t_s;
  }
  // Debounced change.
  if (read_ != down_ && t_s - changed_s_ >= kBounce_s) {
    down_ = read_;
    if (down_) {
      spent_ = false;
      down_at_s_ = changed_s_;
      next_s_ = changed_s_ + kLong_s;
      return Press::down;
    }
    return spent_ ? Press::none : Press::short_press;
  }

  // Still held.
  if (!down_ || !read_ || t_s < next_s_) return Press::none;
  const bool first = !spent_;
  if (spent_ && next_s_ == 0.0) return Press::none;
  spent_ = true;
  next_s_ = t_s + kRepeat_s;
  return first ? Press::long_press : Press::repeated;
}

void ButtonPress::forget() {
  spent_ = true;
  next_s_ = 0.0;
}

}  // namespace app
