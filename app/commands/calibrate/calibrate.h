// `molar calibrate …`: the parts of the technician's command, each adding itself. Exit 0 green, 1 amber or red, 2 bad
// input (design, commands).
#pragma once

#include <optional>
#include <string>

#include "app/calibrate/calibrated_rig.h"
#include "app/commands/calibrate/wizard_option.h"
#include "app/commands/command.h"
#include "calibration/record/drift_history.h"
#include "calibration/record/rig_store.h"

namespace app {

void addCalibrateSimulate(CommandLine& calibrate);
void addCalibrateCollect(CommandLine& calibrate);
void addCalibrateFit(CommandLine& calibrate);
void addCalibrateVerification(CommandLine& calibrate);  ///< verify, check
void addCalibrateRezero(CommandLine& calibrate);
void addCalibratePivot(CommandLine& calibrate);
void addCalibrateLens(CommandLine& calibrate);
void addCalibrateReport(CommandLine& calibrate);
void addCalibrateStore(CommandLine& calibrate);  ///< list, diff, rollback

/// --store: where calibrations are kept.
void addStore(CommandLine& command, std::string& store);
/// Empty: the default folder.
calibration::RigStore storeAt(const std::string& folder);

/// Where a result goes: a file, the store, or nowhere.
class KeepOption {
 public:
  void addTo(CommandLine& command);

  calibration::RigStore rigs() const { return storeAt(store); }
  calibration::RigLocation placeOf(const calibration::RigRecord& record) const;
  /// Claims the output before any work. Throws LoadError.
  void refuseUnlessWritable() const;
  /// Into the file and, if asked, the store, where it comes into force unless its verification is missing or red. Says
  /// so.
  void keep(const calibration::RigRecord& record, const std::string& touches_text) const;

  /// What was found, into the history of the place; only with --keep. Calibrations and re-zeros make up for what checks
  /// have found, so only those that come into force are noted.
  void note(const calibration::RigRecord& record, calibration::DriftKind kind,
            const calibration::TargetErrors& errors) const;

  std::string out, store;
  bool into_store = false, force = false;
};

/// Options of the circumstances of a measurement.
void addMeasurementInfo(CommandLine& command, MeasurementInfo& info);

/// Reports and stores the outcome of a guided procedure; returns the exit status.
int conclude(const WizardOption::GuidedOutcome& led, const KeepOption& keep);
/// The same of a rig fitted to what a webcam saw; `before`: what it comes after, `verification`: touches held out, if
/// any.
int conclude(const calibration::WebcamObservations& seen, const calibration::WebcamFit& fit,
             const calibration::RigRecord& before, const MeasurementInfo& info, const KeepOption& keep,
             const std::vector<calibration::Residual>& verification = {});

/// Exit status of a verdict.
int statusOf(calibration::Verdict verdict);

}  // namespace app
