// Reads a handle through the vendor's library: pose, velocity, angles, buttons, switches, heat. Frame D is HDAPI's: x
// right, y up, z to the user; mm, rad. Joint angles are the raw ones of calibration/arm: turret left +, thigh up +,
// shin up + against the horizontal, not the thigh (reference/devices 4.1). Properties that a device lacks are detected
// in the first frame and not read again. Inside a frame, on the scheduler's thread: six to eight library calls, no
// allocation. A reading that is not finite or no rotation is dropped: the last pose stands, not fresh.
#pragma once

#include <array>
#include <atomic>
#include <optional>
#include <string_view>

#include "calibration/arm/phantom_kinematics.h"
#include "haptics/device/haptic_device.h"
#include "haptics/device/openhaptics/hd_error.h"
#include "haptics/device/openhaptics/inkwell.h"

namespace haptics {

/// Elements of a buffer that the library writes into: no property of HDAPI is longer.
inline constexpr std::size_t kHdBufferSize = 32;

/// Facts that only the model's name gives.
struct HdModel {
  bool is_omni = false;  ///< Omni, or Touch, its successor
  bool has_inkwell = false, has_deadman = false;
  const calibration::PhantomGeometry* geometry = nullptr;  ///< null: not public
  std::string_view arm_model;                              ///< key of phantom_models, the nearest of them; empty: none
};

HdModel modelNamed(std::string_view name);

class HdHandle {
 public:
  HdHandle(const HdFunctions& hd, HdErrors& errors, const HdModel& model, bool has_orientation,
           std::optional<bool> docked_value, std::uint32_t pedal_buttons);

  HandleState read(bool calibrated, double rate_Hz) noexcept;
  const Inkwell& inkwell() const { return inkwell_; }

 private:
  enum Part : unsigned { velocity, arm, wrist, buttons, safety_switch, inkwell_switch, heat, part_count };

  template <class Read>
  bool readPart(Part part, Read&& read) noexcept;
  void readPose(HandleState& state) noexcept;
  void readSwitches(HandleState& state, bool sure) noexcept;
  void readHeat(double rate_Hz) noexcept;

  const HdFunctions& hd_;
  HdErrors& errors_;
  HdModel model_;
  bool has_orientation_;  ///< false: X_DH does not rotate
  Inkwell inkwell_;
  std::uint32_t pedal_buttons_;

  bool first_ = true;
  std::array<bool, part_count> has_{};
  calibration::Pose<calibration::Device, calibration::Handle> X_DH_;
  double heat_ = 0.0;
  int ticks_to_check_ = 0;
};

}  // namespace haptics
