// Latency from a movement of the hand to the light of the display. Measured: from reading the newest pose until its
// frame is presented (buffers swapped, GPU done). Added: half a servo period, the mean age of the pose; half a refresh
// until the next one begins; half a refresh of scan-out down to the middle of the panel, where the site is. Not
// included: sampling and transport of the device, response of the panel. Milliseconds. Main thread; constant time and
// memory.
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

  std::uint64_t frames() const { return count_; }
  /// Of the newest frames, smoothed.
  LatencyEstimate now() const;
  /// 50th and 95th percentile of all frames.
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
