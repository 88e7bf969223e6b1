// A rig file's content from what was measured: the blocks that a procedure found out are new, all others stay as the
// base has them, and the chain to the base is written down. Frame W, mm. Plain functions; start-up and between
// rehearsals only.
#pragma once

#include <string>

#include "calibration/fit/arm_fit.h"
#include "calibration/fit/rezero.h"
#include "calibration/record/rig_record.h"

namespace app {

/// Who measures, where and when; nothing that names a person.
struct Measuring {
  std::string rig_id = "rig", serial, mount = "right", stylus_tip, operator_code, method;
  double duration_s = 0.0;  ///< 0: not known
};

/// "2026-11-21T08:20:00Z", now.
std::string utcNow();

/// `base` with the fitted arm. Without a proof: that takes touches it has not seen.
calibration::RigRecord fittedRig(const calibration::RigRecord& base, const calibration::TouchSet& touches,
                                 const calibration::ArmFit& fit, const Measuring& measuring);

/// `base` brought up to date; its proof is no longer one.
calibration::RigRecord rezeroedRig(const calibration::RigRecord& base, const calibration::Rezero& rezero,
                                   const Measuring& measuring);

/// With what `held_out` touches say of it.
void prove(calibration::RigRecord& record, const std::vector<calibration::Residual>& held_out,
           calibration::ProofKind kind);

/// By the method a rig was measured with: eyes alone are held to wider limits.
calibration::ProofKind proofKindOf(const std::string& method);

}  // namespace app
