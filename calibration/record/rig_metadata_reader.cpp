#include <algorithm>
#include <array>

#include <opencv2/core.hpp>

#include "calibration/record/rig_block_reader.h"
#include "calibration/record/utc.h"

namespace calibration {
namespace {

constexpr int kMaxTouches = 10000, kMaxNumbers = 64;
constexpr std::array kModels = {ArmModel::rigid, ArmModel::joint_gains, ArmModel::full};
constexpr std::array kVerdicts = {Verdict::green, Verdict::amber, Verdict::red};
constexpr std::array kVerificationKinds = {VerificationKind::full, VerificationKind::by_eyes,
                                           VerificationKind::session_check};
constexpr std::size_t kLongestCode = 32;
constexpr double kMaxError_mm = 1000.0, kMaxDuration_s = 1e5;

/// Letters, digits, dot, - and _: excludes a personal name with a space.
bool isCode(const std::string& text) {
  return text.size() <= kLongestCode && std::ranges::all_of(text, [](char c) {
           return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '.' || c == '-' ||
                  c == '_';
         });
}

bool isHash(const std::string& text) {
  return text.size() == 64 &&
         std::ranges::all_of(text, [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); });
}

std::string textIf(const CheckedYaml& yaml, const cv::FileNode& parent, const char* key) {
  return yaml.has(parent, key) ? yaml.text(parent, key) : std::string();
}

std::string codeIf(const CheckedYaml& yaml, const cv::FileNode& parent, const char* key) {
  const std::string code = textIf(yaml, parent, key);
  if (!isCode(code))
    yaml.refuse(std::string("'") + key + "' is not a code", "give up to 32 letters, digits, dot, - and _, and no name");
  return code;
}

std::string utcIf(const CheckedYaml& yaml, const cv::FileNode& parent, const char* key) {
  const std::string utc = textIf(yaml, parent, key);
  if (!utc.empty() && !secondsOfUtc(utc))
    yaml.refuse(std::string("'") + key + "' is not a time", "write it as \"2026-11-21T08:20:00Z\"");
  return utc;
}

double within(const CheckedYaml& yaml, const cv::FileNode& parent, const char* key, double least, double most) {
  const double value = yaml.number(parent, key);
  if (value < least || value > most) yaml.refuse(std::string("'") + key + "' is out of range", "correct it");
  return value;
}

double error_mm(const CheckedYaml& yaml, const cv::FileNode& parent, const char* key) {
  return within(yaml, parent, key, 0.0, kMaxError_mm);
}

double errorIf_mm(const CheckedYaml& yaml, const cv::FileNode& parent, const char* key) {
  return yaml.has(parent, key) ? error_mm(yaml, parent, key) : 0.0;
}

/// The enumerator whose name is the text.
template <class Value, std::size_t n>
Value named(const CheckedYaml& yaml, const cv::FileNode& parent, const char* key, const std::array<Value, n>& values) {
  const std::string text = yaml.text(parent, key);
  std::string known;
  for (const Value value : values) {
    if (text == nameOf(value)) return value;
    known += (known.empty() ? "" : ", ") + std::string(nameOf(value));
  }
  yaml.refuse(std::string("'") + key + "' is not known", "give one of " + known);
}

RigProvenance provenanceIn(const CheckedYaml& yaml) {
  const cv::FileNode root = yaml.root();
  RigProvenance from;
  from.created_utc = utcIf(yaml, root, "created_utc");
  from.operator_code = codeIf(yaml, root, "operator");
  if (yaml.has(root, "software")) {
    const cv::FileNode software = yaml.map(root, "software");
    from.program = textIf(yaml, software, "app");
    from.opencv = textIf(yaml, software, "opencv");
  }
  if (yaml.has(root, "rig")) {
    const cv::FileNode rig = yaml.map(root, "rig");
    from.rig_id = codeIf(yaml, rig, "id");
    from.mirror_kind = codeIf(yaml, rig, "mirror");
    if (yaml.has(rig, "plate_mm")) from.plate_mm = within(yaml, rig, "plate_mm", 0.0, 50.0);
  }
  from.parent = textIf(yaml, root, "parent");
  if (!from.parent.empty() && !isHash(from.parent))
    yaml.refuse("'parent' is not a SHA-256", "give 64 hexadecimal digits or remove it");
  return from;
}

RigProcedure procedureIn(const CheckedYaml& yaml) {
  const cv::FileNode node = yaml.map(yaml.root(), "procedure");
  RigProcedure procedure;
  procedure.method = codeIf(yaml, node, "method");
  procedure.used = yaml.integer(node, "n_used", 0, kMaxTouches);
  procedure.outliers = yaml.integer(node, "n_rejected", 0, kMaxTouches);
  procedure.tilt_spread_deg = within(yaml, node, "tilt_spread_deg", 0.0, 180.0);
  procedure.duration_s = within(yaml, node, "duration_s", 0.0, kMaxDuration_s);
  if (yaml.has(node, "precision_mm")) {
    const auto precision = yaml.numbers(node["precision_mm"], "precision_mm", 2);
    if (std::ranges::any_of(precision, [](double v) { return v <= 0.0 || v > 100.0; }))
      yaml.refuse("'precision_mm' is out of range", "give mm in the plane and along the sight");
    procedure.precision = {precision[0], precision[1]};
  }
  if (yaml.has(yaml.root(), "fit")) {
    const cv::FileNode fit = yaml.map(yaml.root(), "fit");
    if (yaml.has(fit, "model")) procedure.model = named(yaml, fit, "model", kModels);
    procedure.fre_rms_mm = error_mm(yaml, fit, "fre_rms");
    procedure.cv_rms_mm = error_mm(yaml, fit, "cv_rms");
  }
  return procedure;
}

std::vector<Residual> residualsIn(const CheckedYaml& yaml, const cv::FileNode& parent) {
  const cv::FileNode list = parent["residuals"];
  if (!list.isSeq() || list.size() > kMaxTouches)
    yaml.refuse("'residuals' is not a list of touches", "remove it or calibrate again");
  std::vector<Residual> residuals;
  for (const cv::FileNode& node : list) {
    if (!node.isMap()) yaml.refuse("'residuals' holds an entry that is not a touch", "remove it or calibrate again");
    residuals.push_back({yaml.integer(node, "id", -1000000, 1000000),
                         {yaml.vector(node, "p_W")},
                         {yaml.vector(node, "e")},
                         yaml.integer(node, "used", 0, 1) == 1});
  }
  return residuals;
}

RigVerification verificationIn(const CheckedYaml& yaml) {
  const cv::FileNode node = yaml.map(yaml.root(), "verify");
  RigVerification verification;
  verification.errors.n = yaml.integer(node, "n", 0, kMaxTouches);
  verification.errors.mean_mm = error_mm(yaml, node, "tre_mean");
  verification.errors.rms_mm = error_mm(yaml, node, "tre_rms");
  verification.errors.p95_mm = error_mm(yaml, node, "tre_p95");
  verification.errors.max_mm = error_mm(yaml, node, "tre_max");
  verification.errors.bias_mm = {yaml.vector(node, "bias")};
  verification.errors.in_plane_rms_mm = errorIf_mm(yaml, node, "in_plane_rms");
  verification.errors.along_sight_rms_mm = errorIf_mm(yaml, node, "along_sight_rms");
  if (yaml.has(node, "kind")) verification.kind = named(yaml, node, "kind", kVerificationKinds);
  verification.verdict = named(yaml, node, "verdict", kVerdicts);
  verification.checked_utc = utcIf(yaml, node, "checked_utc");
  verification.worst = textIf(yaml, node, "worst");
  if (yaml.has(node, "residuals")) verification.residuals = residualsIn(yaml, node);
  return verification;
}

RestRegistration restIn(const CheckedYaml& yaml, double rotation_tolerance) {
  const cv::FileNode node = yaml.map(yaml.root(), "rest");
  const CheckedYaml::Rigid X_W_rest = exactPose(yaml, node, "X_W_rest", rotation_tolerance);
  return {X_W_rest.rotation, X_W_rest.translation_mm, error_mm(yaml, node, "fre_rms_mm"),
          error_mm(yaml, node, "worst_mm")};
}

std::vector<double> sigmaIn(const CheckedYaml& yaml, const cv::FileNode& kinematics) {
  const cv::FileNode list = kinematics["sigma"];
  if (!list.isSeq() || list.size() > kMaxNumbers)
    yaml.refuse("'kinematics.sigma' is not a list of at most 64 numbers", "remove it");
  const auto sigma = yaml.numbers(list, "sigma", list.size());
  if (std::ranges::any_of(sigma, [](double v) { return v < 0.0; }))
    yaml.refuse("'kinematics.sigma' holds a number below 0", "remove it");
  return sigma;
}

}  // namespace

void readMetadata(const CheckedYaml& yaml, double rotation_tolerance, RigRecord& record) {
  const cv::FileNode root = yaml.root(), eyes = yaml.map(root, "eyes");
  record.provenance = provenanceIn(yaml);
  if (yaml.has(eyes, "sd_mm")) record.eye_sd_mm = within(yaml, eyes, "sd_mm", 0.0, 200.0);
  if (yaml.has(root, "procedure")) record.procedure = procedureIn(yaml);
  if (yaml.has(root, "verify")) record.verification = verificationIn(yaml);
  if (yaml.has(root, "residuals")) record.residuals = residualsIn(yaml, root);
  if (yaml.has(root, "rest")) record.rest = restIn(yaml, rotation_tolerance);
  if (yaml.has(root, "patient")) record.patient_position = codeIf(yaml, yaml.map(root, "patient"), "position");
  if (yaml.has(root, "kinematics") && yaml.has(root["kinematics"], "sigma"))
    record.sigma = sigmaIn(yaml, root["kinematics"]);
}

}  // namespace calibration
