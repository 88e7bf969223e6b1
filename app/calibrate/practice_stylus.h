// A simulated stylus for practice: an arm with known errors, held by a hand with tremor that follows mouse, keys or a
// robot. Sensors are quantised and noisy, and its driver uses the nominal model, as with real devices. Frames W (hand)
// and D (device), mm, s. setPose(), seen(): one UI thread; exchange(): the device thread, about 10 us, no allocation.
// Ignores forces. A pit or a rest reduces the tremor.
#pragma once

#include "app/calibrate/page_scene.h"
#include "calibration/synthetic/synthetic_rig.h"
#include "haptics/device/simulated/phantom_mechanics.h"
#include "haptics/device/simulated/phantom_sensors.h"
#include "haptics/device/simulated/tremor.h"
#include "haptics/device/simulated/virtual_hand.h"
#include "haptics/device/simulated_device.h"
#include "haptics/latest.h"

namespace app {

/// The pose requested from the hand.
struct PracticePose {
  calibration::Point<calibration::World> tip_W;
  calibration::Vector<calibration::World> along_W = calibration::kRestingStylus_W;  ///< from the tip to the handle
  bool button = false;
  bool steadied = false;    ///< by a pit or the hand rest
  bool in_inkwell = false;  ///< overrides the position
};

class PracticeStylus final : public haptics::SimulatedDevice {
 public:
  /// Throws haptics::DeviceError if the arm does not reach `start`.
  PracticeStylus(const calibration::SyntheticRig& rig, const PracticePose& start, double tremor_rms_mm = 0.05);
  ~PracticeStylus() override { stop(); }

  /// UI thread. Ignores a pose that is not finite or has no direction.
  void setPose(const PracticePose& pose);
  /// UI thread. The true pose.
  TrueStylus seen() { return seen_.read(); }

  const haptics::DeviceCapabilities& capabilities() const override { return capabilities_; }
  haptics::HandleState exchange(const haptics::Wrench<calibration::Device>& wrench_D, double dt_s) noexcept override;

 private:
  calibration::Pose<calibration::Device, calibration::Handle> advanced(double dt_s) noexcept;

  calibration::SyntheticRig rig_;
  const haptics::PhantomMechanics& omni_;  ///< the driver's model of the unit
  haptics::Latest<PracticePose> pose_;
  haptics::Latest<TrueStylus> seen_;
  haptics::DeviceCapabilities capabilities_;
  haptics::PhantomSensors sensors_;
  haptics::Tremor tremor_;

  // Used by the device thread only.
  haptics::VirtualHand hand_;  ///< at the tip, in W
  glm::dvec3 along_W_;
  double steady_ = 0.0;  ///< 0 free to 1 steadied
  calibration::PhantomJoints joints_;
  double t_s_ = 0.0;
  bool calibrated_ = false;
};

}  // namespace app
