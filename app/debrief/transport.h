// Where a recorded session stands while it is played: position, speed, direction, as a video recorder's. Has no clock:
// wall time is passed in. s. Pure; any one thread.
#pragma once

#include <array>
#include <span>
#include <string>

namespace app {

class Transport {
 public:
  explicit Transport(double length_s = 0.0) : length_s_(length_s) {}

  /// Keeps the position, within the new length.
  void setLength(double length_s);
  double length_s() const { return length_s_; }
  double position_s() const { return position_s_; }
  bool isPlaying() const { return direction_ != 0; }
  bool isBackwards() const { return direction_ < 0; }
  /// Seconds of the session in a second, without direction.
  double speed() const;

  /// Wall time has passed. Playing ends at either end.
  void advance(double wall_s);

  /// At the end it plays from the beginning.
  void playOrPause();
  void pause() { direction_ = 0; }
  /// +1 or -1: plays that way; again, at twice the speed. The other way, at normal speed.
  void shuttle(int direction);
  /// Twice as fast a step, within kSpeeds.
  void changeSpeed(int steps);
  /// To the nearest of kSpeeds.
  void setSpeed(double speed);

  void goTo(double t_s);
  void jump(double by_s) { goTo(position_s_ + by_s); }
  /// To the next of `times_s`, which are in order, or the one before (direction -1); else stays.
  void goToNext(std::span<const double> times_s, int direction);

  /// "1/4 x", "2 x".
  std::string speedText() const;

  static constexpr std::array kSpeeds{0.125, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0};

 private:
  static constexpr int kNormal = 3;

  double length_s_, position_s_ = 0.0;
  int direction_ = 0, speed_ = kNormal;
};

}  // namespace app
