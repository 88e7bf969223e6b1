#include "haptics/device/openhaptics/hd_calibration.h"

namespace haptics {
namespace {

constexpr double kChecks_Hz = 10.0;

}  // namespace

/// The style to update with now; 0: none.
hd::Enum HdCalibration::updateStyle() noexcept {
  if ((styles_ & hd::kEncoderReset) && reset_requested_.exchange(false)) return hd::kEncoderReset;
  if (state_.load(std::memory_order_relaxed) != hd::kCalibrationNeedsUpdate) return 0;
  if (styles_ & hd::kAutoCalibration) return hd::kAutoCalibration;
  return styles_ & hd::kInkwellCalibration;
}

bool HdCalibration::update(const HdFunctions& hd, double rate_Hz) noexcept {
  const bool reset_requested = reset_requested_.load(std::memory_order_relaxed);
  if (--ticks_to_check_ > 0 && !reset_requested) return true;
  state_.store(hd.check_calibration(), std::memory_order_relaxed);

  // The pose jumps with the update, so this frame's is not valid.
  ticks_to_check_ = 0;
  if (const hd::Enum style = updateStyle()) {
    hd.update_calibration(style);
    return false;
  }
  if (state_.load(std::memory_order_relaxed) != hd::kCalibrationOk) return false;
  ticks_to_check_ = static_cast<int>(rate_Hz / kChecks_Hz);
  return true;
}

std::string HdCalibration::requiredAction() const {
  const hd::Enum state = state_.load(std::memory_order_relaxed);
  if (state == hd::kCalibrationOk) return {};
  const bool by_hand = state == hd::kCalibrationNeedsManualInput;
  if (styles_ & hd::kAutoCalibration)
    return by_hand ? "move the stylus slowly through the whole of its reach, it calibrates itself"
                   : "wait a moment, it calibrates itself";
  if (styles_ & hd::kInkwellCalibration)
    return by_hand ? "put the stylus into its inkwell and leave it there for two seconds"
                   : "leave the stylus in its inkwell for a moment";
  if (styles_ & hd::kEncoderReset)
    return "hold the arm still in the reset position that its manual shows, and say that it is there";
  return "calibrate the device with the program that came with its driver";
}

}  // namespace haptics
