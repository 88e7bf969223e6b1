#include "calibration/record/later_check.h"

#include <optional>

namespace calibration {

RigRecord withLaterCheck(RigRecord record, const std::vector<DriftEntry>& history) {
  // A re-zero or a calibration noted after it puts right what a check found.
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
  const Verdict verdict = judge(errors, ProofKind::session_check).verdict;
  if (record.proof && verdict <= record.proof->verdict) return record;
  RigProof proof;
  proof.errors = errors;
  proof.kind = ProofKind::session_check;
  proof.verdict = verdict;
  proof.checked_utc = last->utc;
  record.proof = proof;
  return record;
}

}  // namespace calibration
