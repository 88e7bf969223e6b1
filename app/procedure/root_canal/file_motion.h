// How a file is moved against the wall of its canal, by name: from roll and way of its handle in windows of 0.25 s
// (reference/sisters 2.3). A window of turning waits for its turn to end, whose size and direction name it:
//   filing          in and out along the canal, hardly turned
//   reaming         a quarter turn or more clockwise, then out
//   watch-winding   to and fro by 60 degrees to either side at most
//   balanced force  clockwise, then counter-clockwise by 125 degrees or more
// Names are for teaching; wear obeys one law in all of them. Clockwise as the hand sees it, looking to the tip. rad,
// mm, s. Any one thread; O(1) a tick, no clock.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace app {

enum class FileMotion : std::size_t { filing, reaming, watch_winding, balanced_force };
inline constexpr std::size_t kFileMotions = 4;
std::string_view nameOf(FileMotion motion);
/// For files: "watch_winding".
std::string_view keyOf(FileMotion motion);

inline constexpr double kMotionWindow_s = 0.25;

class MotionNames {
 public:
  /// In order of time. `roll_rad` clockwise and `in_mm` towards the tip, both of the handle, from anywhere.
  void add(double dt_s, double roll_rad, double in_mm);
  /// Off the wall, or another file: what comes next is no motion from there.
  void lift();

  /// Against the wall and moved so; what is still turning is not yet counted.
  double seconds(FileMotion motion) const { return seconds_[static_cast<std::size_t>(motion)]; }
  /// Held still, or a turn that was given no name.
  double other_s() const { return other_s_; }
  /// The last one, while it goes on.
  std::optional<FileMotion> now() const { return now_; }

 private:
  void endWindow();
  void endTurn(bool goes_back);
  void settle(std::optional<FileMotion> motion);

  std::array<double, kFileMotions> seconds_{};
  double other_s_ = 0.0;
  std::optional<FileMotion> now_;

  bool has_last_ = false;
  double last_roll_rad_ = 0.0, last_in_mm_ = 0.0;
  double window_s_ = 0.0, turned_rad_ = 0.0, slid_mm_ = 0.0,
         gone_mm_ = 0.0;                             ///< of the window, ways without sign but the last
  double from_roll_rad_ = 0.0, far_roll_rad_ = 0.0;  ///< where this turn began, and the farthest it came
  double waiting_s_ = 0.0;                           ///< of turns that have no name yet
  double cw_rad_ = 0.0, ccw_rad_ = 0.0;  ///< a clockwise turn that waits for what follows, the last one back
  bool after_ream_ = false;              ///< reamed: drawn out belongs to it
};

}  // namespace app
