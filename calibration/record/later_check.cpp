#include "calibration/record/later_check.h"

#include <optional>

namespace calibration {

RigRecord withLaterCheck(RigRecord record, const std::vector<DriftEntry>& history) {
  // A later re-zero or calibration corrects what a check found.
  std::optional<DriftEntry> last;
  for (const DriftEntry& entry : history) {
    if (entry.utc < record.provenance.created_utc) continue;
    last = entry.kind == DriftKind::check ? std::optional(entry) : std::nullopt;
  }
  if (!last) return record;

  TargetErrors errors;
  errors.n = last->n;
  errors.mean_mm = errors.rms_mm = errors.p95_mm = errors.max_mm = last->rms_mm;
  errors.bias_mm = last->bias_mm;
  const Verdict verdict = assess(errors, VerificationKind::session_check).verdict;
  if (record.verification && verdict <= record.verification->verdict) return record;
  RigVerification verification;
  verification.errors = errors;
  verification.kind = VerificationKind::session_check;
  verification.verdict = verdict;
  verification.checked_utc = last->utc;
  record.verification = verification;
  return record;
}

}  // namespace calibration
