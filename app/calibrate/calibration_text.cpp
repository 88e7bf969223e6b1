#include "app/calibrate/calibration_text.h"

#include <cmath>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "app/report/markup.h"

namespace app {
namespace {

using namespace calibration;
using nlohmann::ordered_json;

/// A vector of W, as the surgeon sees it.
std::string directionsText(const glm::dvec3& v) {
  return "right " + signedText(v.x, 2) + ", up " + signedText(v.y, 2) + ", near " + signedText(v.z, 2) + " mm";
}
std::array<double, 3> numbersOf(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

glm::dvec3 middleOf(const std::vector<Residual>& residuals) {
  glm::dvec3 sum{0.0};
  for (const Residual& one : residuals) sum += one.target_W.mm;
  return residuals.empty() ? sum : sum / static_cast<double>(residuals.size());
}

std::string warningsText(const std::vector<FitWarning>& warnings) {
  std::string text;
  for (const FitWarning& warning : warnings) text += "note: " + warning.line + "\n";
  return text;
}

ordered_json warningsJson(const std::vector<FitWarning>& warnings) {
  ordered_json lines = ordered_json::array();
  for (const FitWarning& warning : warnings) lines.push_back(warning.line);
  return lines;
}

}  // namespace

std::string fitText(const ArmFit& fit) {
  std::string text = fmt::format("{} touches used, {} set aside, stylus tilted over {:.0f} degrees\n", fit.used,
                                 static_cast<int>(fit.residuals.size()) - fit.used, fit.tilt_spread_deg);
  text += "model       parameters   cross-validated      residual (no accuracy)\n";
  for (const ModelScore& score : fit.scores)
    text += fmt::format("{:12} {:9} {:14.2f} mm {:21.2f} mm{}\n", score.name, score.parameters, score.cv_rms_mm,
                        score.fre_rms_mm, score.name == nameOf(fit.model) ? "   chosen" : "");
  for (const Residual& one : fit.residuals)
    if (!one.used)
      text += fmt::format("touch {} set aside: {:.1f} mm off ({})\n", one.id, glm::length(one.error_mm.xyz),
                          directionsText(one.error_mm.xyz));
  text += warningsText(fit.warnings);
  text += "mean error: " + directionsText(fit.bias_mm.xyz) + "; " +
          worstErrorSentence(fit.residuals, {middleOf(fit.residuals)}) + "\n";
  return text;
}

std::string fitJson(const ArmFit& fit) {
  ordered_json json;
  json["model"] = nameOf(fit.model);
  json["n_used"] = fit.used;
  json["n_rejected"] = static_cast<int>(fit.residuals.size()) - fit.used;
  json["fre_rms_mm"] = fit.fre_rms_mm;
  json["expected_fre_mm"] = fit.expected_fre_mm;
  json["cv_rms_mm"] = fit.cv_rms_mm;
  json["bias_mm"] = numbersOf(fit.bias_mm.xyz);
  json["tilt_spread_deg"] = fit.tilt_spread_deg;
  json["hull_mm3"] = fit.hull_mm3;
  for (const ModelScore& score : fit.scores)
    json["models"].push_back({{"name", score.name},
                              {"numbers", score.parameters},
                              {"fre_rms_mm", score.fre_rms_mm},
                              {"cv_rms_mm", score.cv_rms_mm}});
  json["outliers"] = ordered_json::array();
  for (const Residual& one : fit.residuals)
    if (!one.used) json["outliers"].push_back({{"id", one.id}, {"error_mm", numbersOf(one.error_mm.xyz)}});
  json["warnings"] = warningsJson(fit.warnings);
  return json.dump(1) + "\n";
}

std::string webcamFitText(const WebcamFit& fit) {
  std::string text = fmt::format("{} tips used, {} set aside, from {} camera positions up to {:.0f} degrees apart\n",
                                 fit.used, fit.outliers, static_cast<int>(fit.X_WC.size()), fit.baseline_deg);
  text += fmt::format("residuals: screen {:.2f} px, tips {:.2f} px; cross-validated error {:.2f} mm\n",
                      fit.screen_rms_px, fit.tip_rms_px, fit.cv_rms_mm);
  text += warningsText(fit.warnings);
  return text;
}

std::string webcamFitJson(const WebcamFit& fit) {
  ordered_json json;
  json["model"] = nameOf(fit.model);
  json["n_used"] = fit.used;
  json["n_rejected"] = fit.outliers;
  json["screen_rms_px"] = fit.screen_rms_px;
  json["tip_rms_px"] = fit.tip_rms_px;
  json["fre_rms_mm"] = fit.fre_rms_mm;
  json["cv_rms_mm"] = fit.cv_rms_mm;
  json["positions_apart_deg"] = fit.baseline_deg;
  json["tilt_spread_deg"] = fit.tilt_spread_deg;
  json["warnings"] = warningsJson(fit.warnings);
  return json.dump(1) + "\n";
}

std::string verificationText(const TargetErrors& errors, const Assessment& assessment) {
  return fmt::format(
             "{}: {:.2f} mm RMS of {} touches, mean {:.2f}, 95 of 100 within {:.2f}, largest {:.2f} mm, bias {}; ",
             nameOf(assessment.verdict), errors.rms_mm, errors.n, errors.mean_mm, errors.p95_mm, errors.max_mm,
             directionsText(errors.bias_mm.xyz)) +
         assessment.reason + "\n";
}

std::string verificationJson(const TargetErrors& errors, const Assessment& assessment) {
  ordered_json json;
  json["n"] = errors.n;
  json["tre_mean_mm"] = errors.mean_mm;
  json["tre_rms_mm"] = errors.rms_mm;
  json["tre_p95_mm"] = errors.p95_mm;
  json["tre_max_mm"] = errors.max_mm;
  json["bias_mm"] = numbersOf(errors.bias_mm.xyz);
  json["in_plane_rms_mm"] = errors.in_plane_rms_mm;
  json["along_sight_rms_mm"] = errors.along_sight_rms_mm;
  json["verdict"] = nameOf(assessment.verdict);
  json["reason"] = assessment.reason;
  return json.dump(1) + "\n";
}

std::string rezeroText(const Rezero& rezero) {
  return fmt::format("before {:.2f} mm RMS, after {:.2f} mm; base moved by {:.2f} mm and {:.2f} degrees; ",
                     rezero.before_rms_mm, rezero.after_rms_mm, rezero.moved_mm, rezero.turned_deg) +
         fmt::format("joints by {:+.2f}, {:+.2f}, {:+.2f} degrees", rezero.offset_change_deg[0],
                     rezero.offset_change_deg[1], rezero.offset_change_deg[2]) +
         (rezero.outliers > 0 ? fmt::format("; {} touches set aside", rezero.outliers) : std::string()) + "\n";
}

std::string pivotText(const Pivot& pivot, const glm::dvec3& before_H_mm) {
  return fmt::format(
      "tip in the handle ({:.2f}, {:.2f}, {:.2f}) mm, {:.2f} mm from the previous one\n"
      "uncertainty {:.2f} mm (1 sigma); residual in the pit {:.2f} mm RMS, handle directions over {:.0f} degrees\n",
      pivot.tip_H_mm.x, pivot.tip_H_mm.y, pivot.tip_H_mm.z, glm::distance(pivot.tip_H_mm, before_H_mm), pivot.sigma_mm,
      pivot.rms_mm, pivot.tilt_spread_deg);
}

std::string pivotJson(const Pivot& pivot) {
  ordered_json json;
  json["tip_H_mm"] = numbersOf(pivot.tip_H_mm);
  json["rms_mm"] = pivot.rms_mm;
  json["sigma_mm"] = pivot.sigma_mm;
  json["tilt_spread_deg"] = pivot.tilt_spread_deg;
  return json.dump(1) + "\n";
}

Verdict lensVerdict(const Intrinsics& lens) {
  if (lens.rms_px <= kGoodLens_px) return Verdict::green;
  return lens.rms_px <= kFairLens_px ? Verdict::amber : Verdict::red;
}

std::string lensText(const Intrinsics& lens, const std::vector<std::string>& refused) {
  const CameraModel& camera = lens.camera;
  std::string text;
  for (const std::string& line : refused) text += "left out: " + line + "\n";
  for (const std::string& name : lens.left_out) text += "left out: " + name + ": it does not fit the others\n";
  text += fmt::format(
      "{} views used, {} left out; corners cover {:.0f} % of the image, boards tilted up to {:.0f} degrees\n",
      static_cast<int>(lens.view_rms_px.size() - lens.left_out.size()),
      static_cast<int>(lens.left_out.size() + refused.size()), 100.0 * lens.covered_share, lens.max_slant_deg);
  text +=
      fmt::format("focal length ({:.1f}, {:.1f}) px, centre ({:.1f}, {:.1f}) px, distortion k1 {:+.4f}, k2 {:+.4f}\n",
                  camera.focal_px.x, camera.focal_px.y, camera.centre_px.x, camera.centre_px.y, camera.k1, camera.k2);
  const Verdict verdict = lensVerdict(lens);
  text += std::string(nameOf(verdict)) + fmt::format(": residual of the corners {:.2f} px RMS; ", lens.rms_px);
  if (verdict == Verdict::green) return text + "within 0.3 px\n";
  return text + (verdict == Verdict::amber ? "above 0.3 px: " : "above 0.6 px: ") +
         "hold camera and board still, lock the focus, keep the board flat\n";
}

std::string lensJson(const Intrinsics& lens, const std::vector<std::string>& refused) {
  const CameraModel& camera = lens.camera;
  ordered_json json;
  json["size_px"] = {camera.size_px.x, camera.size_px.y};
  json["focal_px"] = {camera.focal_px.x, camera.focal_px.y};
  json["centre_px"] = {camera.centre_px.x, camera.centre_px.y};
  json["distortion"] = {camera.k1, camera.k2, camera.p1, camera.p2};
  json["rms_px"] = lens.rms_px;
  json["views"] = lens.view_rms_px.size() - lens.left_out.size();
  json["left_out"] = refused;
  for (const std::string& name : lens.left_out) json["left_out"].push_back(name + ": it does not fit the others");
  json["covered_share"] = lens.covered_share;
  json["most_slant_deg"] = lens.max_slant_deg;
  json["verdict"] = nameOf(lensVerdict(lens));
  return json.dump(1) + "\n";
}

std::string recordLine(const RigRecord& record) {
  std::string line = record.provenance.created_utc.empty() ? "undated" : record.provenance.created_utc;
  if (record.procedure)
    line += "  " + record.procedure->method + ", " + std::string(nameOf(record.procedure->model)) +
            fmt::format(", cross-validated {:.2f} mm", record.procedure->cv_rms_mm);
  if (record.verification)
    line += "  " + std::string(nameOf(record.verification->verdict)) +
            fmt::format(", {:.2f} mm RMS of {}, largest {:.2f} mm", record.verification->errors.rms_mm,
                        record.verification->errors.n, record.verification->errors.max_mm);
  else
    line += "  not verified";
  return line;
}

}  // namespace app
