#include "app/calibrate/report/report_views.h"

#include <algorithm>
#include <cmath>

#include "app/report/markup.h"
#include "calibration/fit/fit_warnings.h"
#include "calibration/fit/rest_registration.h"
#include "calibration/record/rig_store.h"

namespace app {
namespace {

using calibration::RigRecord;
using calibration::VerificationLimit;

std::string mm(double value_mm) { return fixedText(value_mm, 2) + " mm"; }

/// A row of escaped texts.
std::string row(std::initializer_list<std::string> cells) {
  std::string text = "<tr>";
  for (const std::string& cell : cells) text += "<td>" + cell + "</td>";
  return text + "</tr>\n";
}

std::string head(std::initializer_list<const char*> cells) {
  std::string text = "<tr>";
  for (const char* const cell : cells) text += std::string("<th>") + cell + "</th>";
  return text + "</tr>\n";
}

/// Word and shape: colours alone are lost in print.
std::string standing(double value_mm, const VerificationLimit& limit) {
  if (value_mm <= limit.green_mm) return "<span class=\"green\">\u25cf green</span>";
  if (value_mm <= limit.amber_mm) return "<span class=\"amber\">\u25b2 amber</span>";
  return "<span class=\"red\">\u25a0 red</span>";
}

std::string limited(const char* what, const std::string& value, double judged_mm, const VerificationLimit& limit) {
  return row({what, value, "\u2264 " + mm(limit.green_mm), "\u2264 " + mm(limit.amber_mm), standing(judged_mm, limit)});
}

std::string plain(const char* what, const std::string& value, const char* meaning = "") {
  return row({what, value, "", "", meaning});
}

std::string verificationRows(const calibration::RigVerification& verification) {
  const calibration::TargetErrors& errors = verification.errors;
  const calibration::VerificationLimits& limits = calibration::limitsOf(verification.kind);
  const calibration::Assessment judged = calibration::assess(errors, verification.kind);
  const glm::dvec3 bias_mm = errors.bias_mm.xyz;
  const double worst_bias_mm = std::max({std::abs(bias_mm.x), std::abs(bias_mm.y), std::abs(bias_mm.z)});
  std::string rows = plain("Touches held out (never fitted)", std::to_string(errors.n));
  rows += plain("Error there (TRE), mean", mm(errors.mean_mm));
  rows += plain("&emsp;RMS", mm(errors.rms_mm));
  rows += limited("&emsp;RMS, upper 95 % confidence limit", mm(judged.rms_upper_bound_mm), judged.rms_upper_bound_mm,
                  limits.rms);
  rows += limited("&emsp;95 of 100 are within", mm(errors.p95_mm), errors.p95_mm, limits.p95);
  rows += limited("&emsp;largest", mm(errors.max_mm), errors.max_mm, limits.max);
  rows += limited("Bias: right, up, towards the viewer",
                  fixedText(bias_mm.x, 2) + ", " + fixedText(bias_mm.y, 2) + ", " + mm(bias_mm.z), worst_bias_mm,
                  limits.bias);
  rows += plain("In the plane of the screen, in depth; RMS",
                fixedText(errors.in_plane_rms_mm, 2) + ", " + mm(errors.along_sight_rms_mm));
  return rows;
}

std::string described(const std::string& value) { return value.empty() ? "not known" : escaped(value); }

}  // namespace

std::string figuresTable(const RigRecord& record) {
  std::string table = "<table>\n" + head({"figure", "value", "green", "amber", ""});
  if (record.verification) table += verificationRows(*record.verification);
  if (record.procedure) {
    const calibration::RigProcedure& procedure = *record.procedure;
    table += plain("Cross-validation error (CV), RMS", mm(procedure.cv_rms_mm));
    table += plain("Residual of the fit (FRE), RMS", mm(procedure.fre_rms_mm), "plausibility, no accuracy");
    table +=
        plain("Touches used, set aside", std::to_string(procedure.used) + ", " + std::to_string(procedure.outliers));
    table += plain("Range of stylus tilts", fixedText(procedure.tilt_spread_deg, 0) + "\u00b0",
                   procedure.tilt_spread_deg < calibration::kMinTilt_deg ? "too small: gimbal errors stay hidden" : "");
    table += plain("Time taken", fixedText(procedure.duration_s / 60.0, 1) + " min");
  }
  if (record.rest)
    table +=
        plain("Hand rest, residual and largest held-out error",
              fixedText(record.rest->fre_rms_mm, 2) + ", " + mm(record.rest->worst_mm),
              record.rest->worst_mm > calibration::kMaxRestError_mm ? "more than 2 mm off: register it again" : "");
  return table + "</table>\n";
}

std::string outliersTable(const RigRecord& record) {
  std::string rows;
  for (const calibration::Residual& one : record.residuals)
    if (!one.used)
      rows += row({std::to_string(one.id),
                   fixedText(one.target_W.mm.x, 1) + ", " + fixedText(one.target_W.mm.y, 1) + ", " +
                       fixedText(one.target_W.mm.z, 1) + " mm",
                   mm(glm::length(one.error_mm.xyz))});
  if (rows.empty()) return "<p>None: every touch was used.</p>\n";
  return "<table>\n" + head({"touch", "position in W (x, y, z)", "error"}) + rows + "</table>\n";
}

std::string originTable(const RigRecord& record, const std::string& now_utc) {
  const calibration::RigProvenance& from = record.provenance;
  std::string mirror = from.mirror_kind;
  std::ranges::replace(mirror, '_', ' ');
  std::string table = "<table>\n";
  table += row({"Rig", described(from.rig_id)});
  if (record.rig.device) {
    table += row({"Device", described(record.rig.device->model) + ", serial " + described(record.rig.device->serial)});
    table += row(
        {"Mount, stylus tip", described(record.rig.device->mount) + ", " + described(record.rig.device->stylus_tip)});
  }
  const auto age = calibration::age_days(record, now_utc);
  table += row({"Measured", described(timeText(from.created_utc)) +
                                (age ? ", " + fixedText(std::max(*age, 0.0), 0) + " days ago" : std::string()) +
                                (age && *age > calibration::kOldRig_days ? " <b>(old: calibrate again)</b>" : "")});
  if (record.verification) table += row({"Verified", described(timeText(record.verification->checked_utc))});
  table += row({"Operator", described(from.operator_code)});
  if (record.procedure) table += row({"Procedure", described(record.procedure->method)});
  table += row({"Mirror", described(mirror) + (from.plate_mm > 0.0 ? ", plate " + mm(from.plate_mm) : "")});
  table += row({"Pupil distance", fixedText(glm::distance(record.rig.left_eye.mm, record.rig.right_eye.mm), 1) +
                                      " mm; head moves by " + fixedText(record.eye_sd_mm, 0) + " mm (1 \u03c3)"});
  table += row({"Program, OpenCV", described(from.program) + ", " + described(from.opencv)});
  table +=
      row({"This file", record.hash.empty() ? "edited by hand, no hash" : "<code>" + escaped(record.hash) + "</code>"});
  table += row({"Parent", from.parent.empty() ? "none" : "<code>" + escaped(from.parent) + "</code>"});
  return table + "</table>\n";
}

}  // namespace app
