// Which stylus, display and base rig a technician is led with, as people name them, and the wizard run with it. For
// collect, and for check and rezero with a device instead of a file. Start-up and main thread.
#pragma once

#include <optional>
#include <string>

#include "app/calibrate/calibrated_rig.h"
#include "app/calibrate/wizard_outcome.h"
#include "app/display_option.h"
#include "calibration/record/rig_store.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace app {

class WizardOption {
 public:
  /// Adds --device and everything that goes with it; returns --device.
  CLI::Option* addTo(CLI::App& command);

  bool isGiven() const { return !device_.empty(); }
  /// Leads through it. `rig`: named by the user, or empty: the current one of this device in the store, else the
  /// mirrored workstation. Fills `measuring` with what the device says of itself. Throws as runWizard and
  /// readRigRecord.
  struct Led {
    WizardPlan plan;
    WizardOutcome outcome;
  };
  Led run(Procedure procedure, const std::string& method, const std::string& rig, const calibration::RigStore& store,
          Measuring& measuring) const;

  calibration::JigPose jig;
  std::vector<glm::dvec3> rest_marks_mm;

 private:
  std::string device_, pages_;
  DisplayOption display_;
  std::optional<int> monitor_;
  bool robot_ = false, hurried_ = false, headless_ = false, windowed_ = false, quiet_ = false;
};

}  // namespace app
