// Rig records from measurements: a procedure replaces the blocks it has measured, all others stay as in the base, and
// the hash of the base is stored as parent. Frame W, mm. Plain functions; start-up and between rehearsals only.
#pragma once

#include <string>

#include "calibration/fit/arm_fit.h"
#include "calibration/fit/pivot.h"
#include "calibration/fit/rezero.h"
#include "calibration/record/rig_record.h"
#include "calibration/webcam/webcam_fit.h"

namespace app {

inline constexpr const char* kBaseRigHelp = "Rig file, or one of the built-in rigs: mirrored, desktop";

/// Throws CalibrationError as readRigRecord.
calibration::RigRecord baseRig(const std::string& named);

/// The arm of the rig, or that of the model if none was measured. Throws CalibrationError if the touches are of another
/// device than the rig.
calibration::MeasuredArm armOf(const calibration::RigRecord& record, const calibration::TouchSet& touches,
                               const std::string& named);

/// Circumstances of a measurement; never a person's name.
struct MeasurementInfo {
  std::string rig_id = "rig", serial, mount = "right", stylus_tip, operator_code;
  std::string patient_position;  ///< empty: as in the rig before
};

/// Sets time, program, operator code and parent of a record measured now.
void stamp(calibration::RigRecord& record, const calibration::RigRecord& base, const MeasurementInfo& info);

/// Stores the fitted arm and its fit; removes the verification, which needs touches that were not fitted.
void putFit(calibration::RigRecord& record, const calibration::TouchSet& touches, const calibration::ArmFit& fit,
            double duration_s);
/// Stores the re-zeroed arm; tilts and cross-validation stay those of the calibration.
void putRezero(calibration::RigRecord& record, const calibration::TouchSet& touches, const calibration::Rezero& rezero,
               double duration_s);
/// Stores the tip of a new bur; `name`: of the bur, if given. Removes the verification.
void putPivot(calibration::RigRecord& record, const calibration::MeasuredArm& arm, const calibration::Pivot& pivot,
              const std::string& name);
/// Stores the arm measured by webcam, with a verification by tips that were left out in turn: their error is known
/// across the lines of sight and extended to three axes.
void putWebcamFit(calibration::RigRecord& record, const calibration::WebcamFit& fit);
/// Stores the verification by touches that were not fitted.
void putVerification(calibration::RigRecord& record, const std::vector<calibration::Residual>& held_out,
                     calibration::VerificationKind kind);

/// Of the method of a calibration: wider limits by eyes alone.
calibration::VerificationKind verificationKindOf(const std::string& method);

}  // namespace app
