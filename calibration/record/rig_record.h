// Contents of a rig file: the rig and how it was measured. Blocks are independent: a re-zero changes kinematics and
// device pose only. Frame W, mm. Plain data; any thread. rig_file reads and writes it, rig_store keeps it. No personal
// names: the operator is a code.
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
  double plate_mm = 0.0;    ///< thickness of a plate in the optical path
  std::string parent;       ///< hash of the previously current file; empty: none
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

/// How good it is, on held-out touches.
struct RigVerification {
  TargetErrors errors;
  VerificationKind kind = VerificationKind::full;
  Verdict verdict = Verdict::red;
  std::string checked_utc{};
  std::string worst{};                ///< as worstErrorSentence
  std::vector<Residual> residuals{};  ///< of the held-out touches
};

struct RigRecord {
  Rig rig;
  RigProvenance provenance;
  double eye_sd_mm = 5.0;  ///< head motion, one sigma an axis: tracked 2, chin rest 5, seated 15
  std::optional<RigProcedure> procedure;
  std::optional<RigVerification> verification;
  std::vector<Residual> residuals;  ///< of the fit
  std::optional<RestRegistration> rest;
  std::string patient_position;  ///< that hand rest and head are set up for, as in --position; empty: not stated
  std::vector<double> sigma;     ///< of the fitted parameters, as in ArmFit; empty: not known
  std::string hash;              ///< of the file it was read from; empty: none
};

}  // namespace calibration
