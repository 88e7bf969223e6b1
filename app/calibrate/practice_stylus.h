// A stylus to practise the calibration on, without hardware: an untrue arm whose truth is known, in a hand that
// trembles and goes where mouse, keys or a robot want its tip. Its sensors round and are noisy, and its driver believes
// the model, as real ones do. Frame W of the hand, D of the device, mm, s. hold(), seen(): one UI thread; exchange():
// the device's thread, about 10 us, no allocation. It feels no force. A hand steadied by a pit or a rest trembles less.
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

/// How the hand wants the stylus to be.
struct PracticePose {
  calibration::Point<calibration::World> tip_W;
  calibration::Vector<calibration::World> along_W = calibration::kRestingStylus_W;  ///< from the tip to the handle
  bool button = false;
  bool steadied = false;    ///< by a pit, or a finger on the rest
  bool in_inkwell = false;  ///< wherever the tip is wanted
};

class PracticeStylus final : public haptics::SimulatedDevice {
 public:
  /// The unit of this rig. Throws haptics::DeviceError when its arm does not reach `start`.
  PracticeStylus(const calibration::SyntheticRig& rig, const PracticePose& start, double tremor_rms_mm = 0.05);
  ~PracticeStylus() override { stop(); }

  /// UI thread. What is not finite, or has no direction, is ignored.
  void hold(const PracticePose& hold);
  /// UI thread: where it truly is.
  TrueStylus seen() { return seen_.read(); }

  const haptics::DeviceCapabilities& capabilities() const override { return capabilities_; }
  haptics::HandleState exchange(const haptics::Wrench<calibration::Device>& wrench_D, double dt_s) noexcept override;

 private:
  calibration::Pose<calibration::Device, calibration::Handle> wanted(double dt_s) noexcept;

  calibration::SyntheticRig rig_;
  const haptics::PhantomMechanics& omni_;  ///< the driver's model of the unit
  haptics::Latest<PracticePose> hold_;
  haptics::Latest<TrueStylus> seen_;
  haptics::DeviceCapabilities capabilities_;
  haptics::PhantomSensors sensors_;
  haptics::Tremor tremor_;

  // Of the device's thread.
  haptics::VirtualHand hand_;  ///< of the tip, in W
  glm::dvec3 along_W_;
  double steady_ = 0.0;  ///< 0 free to 1 steadied
  calibration::PhantomJoints joints_;
  double t_s_ = 0.0;
  bool calibrated_ = false;
};

}  // namespace app
