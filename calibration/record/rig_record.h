// Everything a rig file holds: the rig, and how it is known. Blocks are independent: a re-zero changes kinematics and
// device pose and leaves the rest. Frame W, mm. Plain data; any thread. rig_file reads and writes it, rig_store keeps
// it. Nothing here may name a person: an operator is a code.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibration/fit/rest_registration.h"
#include "calibration/fit/touches.h"
#include "calibration/rig.h"
#include "calibration/verification/verdict.h"

namespace calibration {

struct RigProvenance {
  std::string rig_id;           ///< letters, digits, - and _
  std::string created_utc;      ///< "2026-11-21T08:20:00Z"
  std::string program, opencv;  ///< versions
  std::string operator_code;
  std::string mirror_kind;  ///< "half_silvered", "front_surface", "none"
  double plate_mm = 0.0;    ///< thickness of a plate that is seen through
  std::string parent;       ///< hash of the file that was in force before; empty: none
};

/// How it was measured.
struct RigProcedure {
  std::string method;  ///< "jig27", "webcam3", "visual25", "rezero5", …
  ArmModel model = ArmModel::full;
  int used = 0, outliers = 0;
  double tilt_spread_deg = 0.0, duration_s = 0.0;
  double fre_rms_mm = 0.0, cv_rms_mm = 0.0;
  TouchPrecision precision;
};

/// How good it is, on touches it has not seen.
struct RigVerification {
  TargetErrors errors;
  VerificationKind kind = VerificationKind::full;
  Verdict verdict = Verdict::red;
  std::string checked_utc{};
  std::string worst{};                ///< where it is worst, as worstErrorSentence says it
  std::vector<Residual> residuals{};  ///< of the touches that were held out
};

struct RigRecord {
  Rig rig;
  RigProvenance provenance;
  double eye_sd_mm = 5.0;  ///< how far the head wanders, one sigma an axis: tracked 2, chin rest 5, seated 15
  std::optional<RigProcedure> procedure;
  std::optional<RigVerification> verification;
  std::vector<Residual> residuals;  ///< of the fit
  std::optional<RestRegistration> rest;
  std::vector<double> sigma;  ///< of the fit's numbers, as ArmFit has them; empty: not known
  std::string hash;           ///< of the file it was read from; empty: that has none
};

}  // namespace calibration
