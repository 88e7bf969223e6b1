#include <opencv2/core.hpp>

#include "calibration/arm/phantom_models.h"
#include "calibration/record/rig_block_reader.h"
#include "calibration/record/rig_file.h"
#include "calibration/record/sha256.h"

namespace calibration {
namespace {

/// YAML as FileStorage writes it: doubles to the last bit.
class RigYaml {
 public:
  template <class Value>
  void put(const std::string& key, const Value& value) {
    out_ << key << value;
  }
  /// Not by <<, which takes a text like "[1, 2]" for the beginning of a list.
  void put(const std::string& key, const std::string& value) { cv::write(out_, key, value); }
  void word(const std::string& key, std::string_view value) { put(key, std::string(value)); }
  template <class List>
  void list(const std::string& key, const List& values) {
    out_ << key << "[:";
    for (const double v : values) out_ << v;
    out_ << "]";
  }
  void vector(const std::string& key, const glm::dvec3& v) { list(key, std::array{v.x, v.y, v.z}); }
  void open(const std::string& key) { out_ << key << "{"; }
  void close() { out_ << "}"; }
  void pose(const std::string& key, const glm::dquat& rotation, const glm::dvec3& translation_mm, bool exact) {
    const glm::dmat4 m = Pose<World, World>{rotation, translation_mm}.matrix();
    cv::Mat rows(4, 4, CV_64F);
    for (int r = 0; r < 4; ++r)
      for (int c = 0; c < 4; ++c) rows.at<double>(r, c) = m[c][r];
    out_ << key << rows;
    // A matrix can not give back every bit of the quaternion it was made from.
    if (exact) list(key + "_wxyz", std::array{rotation.w, rotation.x, rotation.y, rotation.z});
  }
  cv::FileStorage& raw() { return out_; }
  std::string text() { return out_.releaseAndGetString(); }

 private:
  cv::FileStorage out_{"rig.yaml", cv::FileStorage::WRITE | cv::FileStorage::MEMORY | cv::FileStorage::FORMAT_YAML};
};

void writeRig(RigYaml& yaml, const Rig& rig, bool exact, const double* eye_sd_mm) {
  yaml.open("screen");
  yaml.raw() << "px"
             << "[:" << rig.screen.px.x << rig.screen.px.y << "]";
  yaml.vector("lower_left_mm", rig.screen.lower_left.mm);
  yaml.vector("lower_right_mm", rig.screen.lower_right.mm);
  yaml.vector("upper_left_mm", rig.screen.upper_left.mm);
  yaml.close();
  yaml.open("mirror");
  yaml.put("present", rig.mirror ? 1 : 0);
  yaml.vector("normal", rig.mirror ? rig.mirror->normal : glm::dvec3(0, 1, 0));
  yaml.put("offset_mm", rig.mirror ? rig.mirror->offset_mm : 0.0);
  yaml.close();
  yaml.open("eyes");
  yaml.vector("left_mm", rig.left_eye.mm);
  yaml.vector("right_mm", rig.right_eye.mm);
  if (eye_sd_mm != nullptr) {
    yaml.put("ipd_mm", glm::distance(rig.left_eye.mm, rig.right_eye.mm));
    yaml.put("sd_mm", *eye_sd_mm);
  }
  yaml.close();
  yaml.pose("X_WP", rig.X_WP.rotation, rig.X_WP.translation_mm, exact);
  yaml.pose("X_WD", rig.X_WD.rotation, rig.X_WD.translation_mm, exact);
  if (rig.second_X_WD) yaml.pose("X_WD2", rig.second_X_WD->rotation, rig.second_X_WD->translation_mm, exact);
}

void writeDevice(RigYaml& yaml, const RigDevice& device) {
  yaml.open("device");
  yaml.put("model", device.model);
  yaml.put("serial", device.serial);
  yaml.put("mount", device.mount);
  yaml.put("stylus_tip", device.stylus_tip);
  yaml.close();
}

void writeKinematics(RigYaml& yaml, const ArmCorrection& arm, const PhantomGeometry& geometry,
                     const std::vector<double>& sigma) {
  std::array<double, 6> k = arm.gain;
  for (double& v : k) v += 1.0;
  yaml.open("kinematics");
  yaml.word("model", kKinematicsKind);
  yaml.list("l", std::array{geometry.thigh_mm + arm.thigh_delta_mm, geometry.shin_mm + arm.shin_delta_mm});
  yaml.list("more_mm", std::array{arm.thigh_delta_mm, arm.shin_delta_mm});
  yaml.list("m", arm.offset_rad);
  yaml.list("k", k);
  yaml.list("gain", arm.gain);
  yaml.list("q", arm.quadratic_per_rad);
  yaml.put("tilt", arm.tilt_rad);
  yaml.put("a1", arm.reach_delta_mm);
  yaml.vector("tip", arm.tip_H_mm);
  if (!sigma.empty()) yaml.list("sigma", sigma);
  yaml.close();
}

void writeProvenance(RigYaml& yaml, const RigProvenance& from) {
  if (!from.created_utc.empty()) yaml.put("created_utc", from.created_utc);
  yaml.open("software");
  yaml.put("app", from.program);
  yaml.put("opencv", from.opencv);
  yaml.close();
  yaml.put("operator", from.operator_code);
  yaml.open("rig");
  yaml.put("id", from.rig_id);
  yaml.put("mirror", from.mirror_kind);
  yaml.put("plate_mm", from.plate_mm);
  yaml.close();
}

void writeProcedure(RigYaml& yaml, const RigProcedure& procedure) {
  yaml.open("procedure");
  yaml.put("method", procedure.method);
  yaml.put("n_used", procedure.used);
  yaml.put("n_rejected", procedure.outliers);
  yaml.put("tilt_spread_deg", procedure.tilt_spread_deg);
  yaml.put("duration_s", procedure.duration_s);
  yaml.list("precision_mm", std::array{procedure.precision.in_plane_mm, procedure.precision.along_sight_mm});
  yaml.close();
  yaml.open("fit");
  yaml.word("model", nameOf(procedure.model));
  yaml.put("fre_rms", procedure.fre_rms_mm);
  yaml.put("cv_rms", procedure.cv_rms_mm);
  yaml.close();
}

void writeResiduals(RigYaml& yaml, const std::vector<Residual>& residuals) {
  yaml.raw() << "residuals"
             << "[";
  for (const Residual& one : residuals) {
    yaml.raw() << "{:";
    yaml.put("id", one.id);
    yaml.vector("p_W", one.target_W.mm);
    yaml.vector("e", one.error_mm.xyz);
    yaml.put("used", one.used ? 1 : 0);
    yaml.raw() << "}";
  }
  yaml.raw() << "]";
}

void writeProof(RigYaml& yaml, const RigVerification& verification) {
  yaml.open("verify");
  yaml.put("n", verification.errors.n);
  yaml.put("tre_mean", verification.errors.mean_mm);
  yaml.put("tre_rms", verification.errors.rms_mm);
  yaml.put("tre_p95", verification.errors.p95_mm);
  yaml.put("tre_max", verification.errors.max_mm);
  yaml.vector("bias", verification.errors.bias_mm.xyz);
  yaml.put("in_plane_rms", verification.errors.in_plane_rms_mm);
  yaml.put("along_sight_rms", verification.errors.along_sight_rms_mm);
  yaml.word("kind", nameOf(verification.kind));
  yaml.word("verdict", nameOf(verification.verdict));
  if (!verification.checked_utc.empty()) yaml.put("checked_utc", verification.checked_utc);
  if (!verification.worst.empty()) yaml.put("worst", verification.worst);
  if (!verification.residuals.empty()) writeResiduals(yaml, verification.residuals);
  yaml.close();
}

void writeKind(RigYaml& yaml) {
  yaml.put("schema", 1);
  yaml.word("kind", "molar_rig");
}

}  // namespace

std::string rigRecordText(const RigRecord& record) {
  RigYaml yaml;
  writeKind(yaml);
  yaml.put("sealed", 1);
  writeProvenance(yaml, record.provenance);
  if (record.rig.device) writeDevice(yaml, *record.rig.device);
  writeRig(yaml, record.rig, true, &record.eye_sd_mm);
  const PhantomModel* const model = record.rig.device ? findPhantomModel(record.rig.device->model) : nullptr;
  if (record.rig.arm) {
    if (model == nullptr)
      throw CalibrationError("rig file: a measured arm of no known Phantom, name omni, touch, desktop or premium");
    writeKinematics(yaml, *record.rig.arm, model->geometry, record.sigma);
  }
  if (record.procedure) writeProcedure(yaml, *record.procedure);
  if (record.verification) writeProof(yaml, *record.verification);
  if (!record.residuals.empty()) writeResiduals(yaml, record.residuals);
  if (record.rest) {
    yaml.open("rest");
    yaml.pose("X_W_rest", record.rest->rotation, record.rest->translation_mm, true);
    yaml.put("fre_rms_mm", record.rest->fre_rms_mm);
    yaml.put("worst_mm", record.rest->worst_mm);
    yaml.close();
  }
  if (!record.provenance.parent.empty()) yaml.put("parent", record.provenance.parent);
  const std::string text = yaml.text();
  return text + "sha256: \"" + sha256Of(text) + "\"\n";
}

std::string rigText(const Rig& rig) {
  RigYaml yaml;
  writeKind(yaml);
  writeRig(yaml, rig, false, nullptr);
  return yaml.text();
}

}  // namespace calibration
