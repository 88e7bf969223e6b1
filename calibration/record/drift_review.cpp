#include "calibration/record/drift_review.h"

#include <algorithm>

#include <fmt/format.h>

namespace calibration {
namespace {

/// Limits for the next value.
std::optional<ControlLimits> limitsAfter(std::span<const double> before) {
  return controlLimits(before.first(std::min(before.size(), kMaxBaseline)), kMinBaseline, kMinSigma_mm);
}

std::string sentenceOf(const DriftEntry& entry, DriftQuantity quantity, ControlRule rule, const ControlLimits& limits) {
  return fmt::format("{}: {} {:.2f} mm, {} (mean {:.2f} mm, sigma {:.2f} mm)", entry.utc.substr(0, 10),
                     nameOf(quantity), valueOf_mm(entry, quantity), nameOf(rule), limits.centre, limits.sigma);
}

void review(const std::vector<DriftEntry>& history, DriftQuantity quantity, DriftReview& found) {
  std::vector<double> values_mm, sigmas;
  std::vector<ControlLimits> limits;
  for (const std::size_t entry : found.charted) {
    const double value_mm = valueOf_mm(history[entry], quantity);
    if (const auto known = limitsAfter(values_mm)) {
      limits.push_back(*known);
      sigmas.push_back((value_mm - known->centre) / known->sigma);
    }
    values_mm.push_back(value_mm);
  }
  found.limits[static_cast<std::size_t>(quantity)] = limitsAfter(values_mm);
  const std::size_t unjudged = values_mm.size() - sigmas.size();
  for (const ControlAlarm& alarm : controlAlarms(sigmas)) {
    if (quantity == DriftQuantity::rms && !alarm.above) continue;
    const std::size_t entry = found.charted[unjudged + alarm.at];
    found.alarms.push_back(
        {entry, quantity, alarm.rule, sentenceOf(history[entry], quantity, alarm.rule, limits[alarm.at])});
  }
}

std::string standing(const std::vector<DriftEntry>& history, const DriftReview& found) {
  if (found.charted.empty())
    return history.empty() ? "No check yet: make one after every homing."
                           : "No check since the last calibration: make one after every homing.";
  if (!found.limits[0])
    return std::to_string(found.charted.size()) + " of the " + std::to_string(kMinBaseline) +
           " checks needed for control limits.";
  if (!found.alarmed) return "Steady: the newest check agrees with the earlier ones.";
  return "Not steady: " + found.alarms.back().sentence +
         ". Re-zero; if the next check is the same, look whether base, mirror or stylus is loose, and calibrate.";
}

}  // namespace

std::string_view nameOf(DriftQuantity quantity) {
  constexpr std::array<std::string_view, 4> kNames = {"RMS", "bias to the right", "bias upwards",
                                                      "bias towards the viewer"};
  return kNames[static_cast<std::size_t>(quantity)];
}

double valueOf_mm(const DriftEntry& entry, DriftQuantity quantity) {
  const glm::dvec3& bias_mm = entry.bias_mm.xyz;
  return std::array{entry.rms_mm, bias_mm.x, bias_mm.y, bias_mm.z}[static_cast<std::size_t>(quantity)];
}

DriftReview reviewOf(const std::vector<DriftEntry>& history) {
  DriftReview found;
  for (std::size_t i = 0; i < history.size(); ++i) {
    if (history[i].kind == DriftKind::calibration)
      found.charted.clear();
    else
      found.charted.push_back(i);
  }
  for (const DriftQuantity quantity : kDriftQuantities) review(history, quantity, found);
  std::ranges::stable_sort(found.alarms, {}, &DriftAlarm::entry);
  found.alarmed = !found.alarms.empty() && found.alarms.back().entry == found.charted.back();
  found.sentence = standing(history, found);
  return found;
}

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
