#include "calibration/arm/phantom_models.h"
#include "calibration/record/rig_block_reader.h"
#include "calibration/record/rig_file.h"
#include "calibration/record/sha256.h"
#include "calibration/yaml_writer.h"

namespace calibration {
namespace {

/// `exact`: also the quaternion, which the matrix cannot restore to the last bit.
void writePose(YamlWriter& yaml, const std::string& key, const glm::dquat& rotation, const glm::dvec3& translation_mm,
               bool exact) {
  yaml.matrix(key, Pose<World, World>{rotation, translation_mm}.matrix());
  if (exact) yaml.put(key + "_wxyz", std::array{rotation.w, rotation.x, rotation.y, rotation.z});
}

void writeRig(YamlWriter& yaml, const Rig& rig, bool exact, const double* eye_sd_mm) {
  yaml.map("screen", {{"px", rig.screen.px},
                      {"lower_left_mm", rig.screen.lower_left.mm},
                      {"lower_right_mm", rig.screen.lower_right.mm},
                      {"upper_left_mm", rig.screen.upper_left.mm}});
  const Plane<World> mirror = rig.mirror.value_or(Plane<World>{{0.0, 1.0, 0.0}, 0.0});
  yaml.map("mirror", {{"present", rig.mirror ? 1 : 0}, {"normal", mirror.normal}, {"offset_mm", mirror.offset_mm}});
  yaml.openMap("eyes");
  yaml.put({{"left_mm", rig.left_eye.mm}, {"right_mm", rig.right_eye.mm}});
  if (eye_sd_mm != nullptr)
    yaml.put({{"ipd_mm", glm::distance(rig.left_eye.mm, rig.right_eye.mm)}, {"sd_mm", *eye_sd_mm}});
  yaml.close();
  writePose(yaml, "X_WP", rig.X_WP.rotation, rig.X_WP.translation_mm, exact);
  writePose(yaml, "X_WD", rig.X_WD.rotation, rig.X_WD.translation_mm, exact);
  if (rig.second_X_WD) writePose(yaml, "X_WD2", rig.second_X_WD->rotation, rig.second_X_WD->translation_mm, exact);
}

void writeKinematics(YamlWriter& yaml, const ArmCorrection& arm, const PhantomGeometry& geometry,
                     const std::vector<double>& sigma) {
  std::array<double, 6> k = arm.gain;
  for (double& v : k) v += 1.0;
  yaml.openMap("kinematics");
  yaml.put({{"model", kKinematicsKind},
            {"l", glm::dvec2(geometry.thigh_mm + arm.thigh_delta_mm, geometry.shin_mm + arm.shin_delta_mm)},
            {"more_mm", glm::dvec2(arm.thigh_delta_mm, arm.shin_delta_mm)},
            {"m", arm.offset_rad},
            {"k", k},
            {"gain", arm.gain},
            {"q", arm.quadratic_per_rad},
            {"tilt", arm.tilt_rad},
            {"a1", arm.reach_delta_mm},
            {"tip", arm.tip_H_mm}});
  if (!sigma.empty()) yaml.put("sigma", sigma);
  yaml.close();
}

void writeProvenance(YamlWriter& yaml, const RigProvenance& from) {
  if (!from.created_utc.empty()) yaml.put("created_utc", from.created_utc);
  yaml.map("software", {{"app", from.program}, {"opencv", from.opencv}});
  yaml.put("operator", from.operator_code);
  yaml.map("rig", {{"id", from.rig_id}, {"mirror", from.mirror_kind}, {"plate_mm", from.plate_mm}});
}

void writeProcedure(YamlWriter& yaml, const RigProcedure& procedure) {
  yaml.map("procedure",
           {{"method", procedure.method},
            {"n_used", procedure.used},
            {"n_rejected", procedure.outliers},
            {"tilt_spread_deg", procedure.tilt_spread_deg},
            {"duration_s", procedure.duration_s},
            {"precision_mm", glm::dvec2(procedure.precision.in_plane_mm, procedure.precision.along_sight_mm)}});
  yaml.map("fit",
           {{"model", nameOf(procedure.model)}, {"fre_rms", procedure.fre_rms_mm}, {"cv_rms", procedure.cv_rms_mm}});
}

void writeResiduals(YamlWriter& yaml, const std::vector<Residual>& residuals) {
  if (residuals.empty()) return;
  yaml.openList("residuals");
  for (const Residual& one : residuals)
    yaml.entry({{"id", one.id}, {"p_W", one.target_W.mm}, {"e", one.error_mm.xyz}, {"used", one.used ? 1 : 0}});
  yaml.close();
}

void writeVerification(YamlWriter& yaml, const RigVerification& verification) {
  const TargetErrors& errors = verification.errors;
  yaml.openMap("verify");
  yaml.put({{"n", errors.n},
            {"tre_mean", errors.mean_mm},
            {"tre_rms", errors.rms_mm},
            {"tre_p95", errors.p95_mm},
            {"tre_max", errors.max_mm},
            {"bias", errors.bias_mm.xyz},
            {"in_plane_rms", errors.in_plane_rms_mm},
            {"along_sight_rms", errors.along_sight_rms_mm},
            {"kind", nameOf(verification.kind)},
            {"verdict", nameOf(verification.verdict)}});
  if (!verification.checked_utc.empty()) yaml.put("checked_utc", verification.checked_utc);
  if (!verification.worst.empty()) yaml.put("worst", verification.worst);
  writeResiduals(yaml, verification.residuals);
  yaml.close();
}

}  // namespace

std::string rigRecordText(const RigRecord& record) {
  YamlWriter yaml;
  yaml.put({{"schema", 1}, {"kind", "molar_rig"}, {"sealed", 1}});
  writeProvenance(yaml, record.provenance);
  if (const auto& device = record.rig.device)
    yaml.map("device", {{"model", device->model},
                        {"serial", device->serial},
                        {"mount", device->mount},
                        {"stylus_tip", device->stylus_tip}});
  writeRig(yaml, record.rig, true, &record.eye_sd_mm);
  if (record.rig.arm) {
    const PhantomModel* const model = record.rig.device ? findPhantomModel(record.rig.device->model) : nullptr;
    if (model == nullptr)
      throw CalibrationError("rig file: a measured arm of no known Phantom, name one of " + phantomModelKeys());
    writeKinematics(yaml, *record.rig.arm, model->geometry, record.sigma);
  }
  if (record.procedure) writeProcedure(yaml, *record.procedure);
  if (record.verification) writeVerification(yaml, *record.verification);
  writeResiduals(yaml, record.residuals);
  if (record.rest) {
    yaml.openMap("rest");
    writePose(yaml, "X_W_rest", record.rest->rotation, record.rest->translation_mm, true);
    yaml.put({{"fre_rms_mm", record.rest->fre_rms_mm}, {"worst_mm", record.rest->worst_mm}});
    yaml.close();
  }
  if (!record.patient_position.empty()) yaml.map("patient", {{"position", record.patient_position}});
  if (!record.provenance.parent.empty()) yaml.put("parent", record.provenance.parent);
  const std::string text = yaml.text();
  return text + "sha256: \"" + sha256Of(text) + "\"\n";
}

std::string rigText(const Rig& rig) {
  YamlWriter yaml;
  yaml.put({{"schema", 1}, {"kind", "molar_rig"}});
  writeRig(yaml, rig, false, nullptr);
  return yaml.text();
}

}  // namespace calibration
