// Recognises short and long presses (0.8 s, reported while held) of one button, and repeats while it is held. A change
// counts after 20 ms. Times in s of any steady clock, ascending. Plain values; one thread; no allocation.
#pragma once

namespace app {

enum class Press {
  none,
  down,         ///< pressed; short or long is not known yet
  short_press,  ///< released before 0.8 s
  long_press,
  repeated,  ///< still held, five times a second
};

class ButtonPress {
 public:
  static constexpr double kBounce_s = 0.02, kLong_s = 0.8, kRepeat_s = 0.2;

  Press update(double t_s, bool button);

  /// The time of the press, before debouncing.
  double downAt_s() const { return down_at_s_; }
  /// Ignores the current press, after a silence of the device.
  void forget();

 private:
  bool read_ = false, down_ = false, spent_ = true;
  double changed_s_ = 0.0, down_at_s_ = 0.0, next_s_ = 0.0;
};

}  // namespace app
