#include "app/view/motion_to_photon.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

namespace app {
namespace {

constexpr double kNewest = 0.1;  ///< weight of the newest frame in the smoothed value

}  // namespace

MotionToPhoton::MotionToPhoton(double refresh_Hz, double servo_rate_Hz)
    : servo_ms_(500.0 / servo_rate_Hz), half_refresh_ms_(500.0 / refresh_Hz) {}

void MotionToPhoton::add(double pose_to_swap_s) {
  const double ms = 1000.0 * pose_to_swap_s;
  smoothed_ms_ = count_ == 0 ? ms : std::lerp(smoothed_ms_, ms, kNewest);
  ++count_;
  ++bins_[std::min(static_cast<std::size_t>(std::max(0.0, ms) / kBin_ms), bins_.size() - 1)];
}

LatencyEstimate MotionToPhoton::now() const { return with(smoothed_ms_); }

LatencyEstimate MotionToPhoton::with(double pose_to_swap_ms) const {
  return {pose_to_swap_ms, servo_ms_, half_refresh_ms_, half_refresh_ms_};
}

LatencyEstimate MotionToPhoton::percentile(double share) const {
  const double wanted = share * static_cast<double>(count_);
  std::uint64_t below = 0;
  for (std::size_t b = 0; b < bins_.size(); ++b) {
    below += bins_[b];
    if (below > 0 && static_cast<double>(below) >= wanted) return with((static_cast<double>(b) + 0.5) * kBin_ms);
  }
  return with(0.0);
}

std::string latencyText(const LatencyEstimate& e) {
  return fmt::format("motion to photon {:.0f} ms (pose to swap {:.1f}, servo {:.1f}, blank {:.1f}, scan-out {:.1f})",
                     e.total_ms(), e.pose_to_swap_ms, e.servo_ms, e.blank_ms, e.scan_out_ms);
}

}  // namespace app
