// The rig that a calibration starts from or is proved with, as people name it, and a rig file's content from what was
// measured: the blocks that a procedure found out are new, all others stay as the
// base has them, and the chain to the base is written down. Frame W, mm. Plain functions; start-up and between
// rehearsals only.
#pragma once

#include <string>

#include "calibration/fit/arm_fit.h"
#include "calibration/fit/pivot.h"
#include "calibration/fit/rezero.h"
#include "calibration/record/rig_record.h"
#include "calibration/webcam/webcam_fit.h"

namespace app {

inline constexpr const char* kBaseRigHelp = "Rig file, or mirrored or desktop as they come with the program";

/// Throws CalibrationError as readRigRecord.
calibration::RigRecord baseRig(const std::string& named);

/// The arm of the rig, or the model's own where none was measured. Throws CalibrationError when the touches are of
/// another device than the rig's.
calibration::MeasuredArm armOf(const calibration::RigRecord& record, const calibration::TouchSet& touches,
                               const std::string& named);

/// Who measures, and where; nothing that names a person.
struct MeasurementInfo {
  std::string rig_id = "rig", serial, mount = "right", stylus_tip, operator_code;
};

/// `record`, measured now by these people and this program, as what comes after `base`.
void stamp(calibration::RigRecord& record, const calibration::RigRecord& base, const MeasurementInfo& info);

/// The fitted arm and how it was found. A verification is no longer one: that takes touches it has not seen.
void putFit(calibration::RigRecord& record, const calibration::TouchSet& touches, const calibration::ArmFit& fit,
            double duration_s);
/// The arm brought up to date. Tilts and cross-validation stay those of the calibration it comes of.
void putRezero(calibration::RigRecord& record, const calibration::TouchSet& touches, const calibration::Rezero& rezero,
               double duration_s);
/// Another bur in its handle, as `arm` measured it; `name`: which, where it was said. Nothing is proved any more.
void putPivot(calibration::RigRecord& record, const calibration::MeasuredArm& arm, const calibration::Pivot& pivot,
              const std::string& name);
/// The arm as a webcam measured it, proved by tips that were left out in turn: how far these lie off is known across
/// the lines of sight, and taken up to three axes.
void putWebcamFit(calibration::RigRecord& record, const calibration::WebcamFit& fit);
/// What touches it has not seen say of it.
void putProof(calibration::RigRecord& record, const std::vector<calibration::Residual>& held_out,
              calibration::VerificationKind kind);

/// By the method a rig was measured with: eyes alone are held to wider limits.
calibration::VerificationKind proofKindOf(const std::string& method);

}  // namespace app
