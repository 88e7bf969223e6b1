// One button, told apart by how long it is held: short, long (0.8 s, told while it is still down), and then again and
// again while it stays down. A change counts once it has lasted 20 ms. s of any steady clock, in order. Plain values;
// one thread; no allocation.
#pragma once

namespace app {

enum class Press {
  none,
  down,         ///< it was pressed: short or long is not known yet
  short_press,  ///< it was let go before 0.8 s
  long_press,
  repeated,  ///< held on, five times a second
};

class ButtonPress {
 public:
  static constexpr double kBounce_s = 0.02, kLong_s = 0.8, kRepeat_s = 0.2;

  Press update(double t_s, bool button);

  /// When it went down, before the bounce was waited for.
  double downAt_s() const { return down_at_s_; }
  /// What is held now counts no more; after a silence of the device.
  void forget();

 private:
  bool read_ = false, down_ = false, spent_ = true;
  double changed_s_ = 0.0, down_at_s_ = 0.0, next_s_ = 0.0;
};

}  // namespace app
