// How long a movement of the hand takes to reach the eye. Measured: from the moment the newest pose is read until the
// picture with it is handed to the display (buffers swapped, the graphics card done). Added, not measured: half a servo
// period, which the pose was old when read; half a refresh until the next one begins; half a refresh to scan the panel
// out down to its middle, where the site is. Not included: the device's own sampling and transport, and what the panel
// does with the signal. Milliseconds. Main thread; constant time, bounded memory.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace app {

struct LatencyEstimate {
  double pose_to_swap_ms = 0.0;  ///< measured
  double servo_ms = 0.0, blank_ms = 0.0, scan_out_ms = 0.0;
  double total_ms() const { return pose_to_swap_ms + servo_ms + blank_ms + scan_out_ms; }
};

class MotionToPhoton {
 public:
  MotionToPhoton(double refresh_Hz, double servo_rate_Hz);

  void add(double pose_to_swap_s);

  std::uint64_t pictures() const { return count_; }
  /// Of the newest pictures, smoothed.
  LatencyEstimate now() const;
  /// Of all so far: half, or all but a twentieth of the pictures were faster.
  LatencyEstimate median() const { return percentile(0.5); }
  LatencyEstimate slow() const { return percentile(0.95); }

 private:
  LatencyEstimate with(double pose_to_swap_ms) const;
  LatencyEstimate percentile(double share) const;

  static constexpr double kBin_ms = 0.25;
  std::array<std::uint32_t, 8000> bins_{};  ///< the last holds everything longer than 2 s
  std::uint64_t count_ = 0;
  double smoothed_ms_ = 0.0, servo_ms_, half_refresh_ms_;
};

/// "motion to photon 31 ms (pose to swap 14.2, servo 0.5, blank 8.3, scan-out 8.3)".
std::string latencyText(const LatencyEstimate& estimate);

}  // namespace app
