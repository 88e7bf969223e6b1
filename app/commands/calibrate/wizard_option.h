// Which stylus, display, webcam and base rig a technician is led with, as people name them, and the wizard run with it.
// For collect, and for check and rezero with a device instead of a file. Start-up and main thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/calibrate/calibrated_rig.h"
#include "app/calibrate/wizard_outcome.h"
#include "app/options/display_option.h"
#include "calibration/record/rig_store.h"
#include "calibration/synthetic/synthetic_rig.h"
#include "calibration/webcam/webcam_file.h"
#include "haptics/device/opened_device.h"

namespace app {

class CommandLine;
class Option;
struct GuidedRun;

class WizardOption {
 public:
  /// Adds --device and everything that goes with it; returns --device.
  Option addTo(CommandLine& command);
  /// Adds --camera and what goes with it.
  void addCameraTo(CommandLine& command);

  bool isGiven() const { return !device_.empty(); }

  struct GuidedOutcome {
    WizardPlan plan;
    WizardOutcome outcome;
    MeasurementInfo info;  ///< with what the device says of itself
  };
  /// Leads through touches. `rig`: named by the user, or empty: the current one of this device in the store, else the
  /// mirrored workstation, or for a practice stylus a plain monitor. Throws as runWizard, readRigRecord.
  GuidedOutcome guide(CalibrationProcedure procedure, const std::string& method, const std::string& rig,
                      const calibration::RigStore& store, MeasurementInfo info) const;

  struct Seen {
    calibration::RigRecord before;
    std::optional<calibration::WebcamObservations> observations;  ///< none: somebody left
    MeasurementInfo info;
  };
  /// The same through a webcam.
  Seen guideWebcam(const std::string& rig, const calibration::RigStore& store, MeasurementInfo info) const;

  calibration::JigPose jig;
  std::vector<glm::dvec3> rest_marks_mm;

 private:
  struct Stylus {
    haptics::OpenedDevice opened;  ///< not started; no device: practice
    std::optional<calibration::SyntheticRig> practice;
    std::string model;  ///< key of phantom_models
  };
  Stylus stylus(MeasurementInfo& info) const;
  /// What both ways of leading need; borrows the stylus.
  void prepare(GuidedRun& run, const Stylus& held) const;
  calibration::RigRecord before(const Stylus& stylus, const std::string& rig, const calibration::RigStore& store,
                                const MeasurementInfo& info) const;

  std::string device_, pages_, camera_, lens_, camera_size_ = "1920x1080";
  DisplayOption display_;
  std::optional<int> monitor_;
  bool robot_ = false, hurried_ = false, headless_ = false, windowed_ = false, quiet_ = false, gray_code_ = false,
       tells_ = false;
};

}  // namespace app
