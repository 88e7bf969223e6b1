#include "calibration/record/rig_differences.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "calibration/geometry/rotation.h"
#include "calibration/geometry/units.h"

namespace calibration {
namespace {

const char* const kJoints[] = {"turret", "thigh", "shin", "gimbal 1", "gimbal 2", "gimbal 3"};

std::string written(double value, int digits) {
  const std::string text = fmt::format("{:.{}f}", value, digits);
  // No minus sign before zero.
  return text[0] == '-' && text.find_first_not_of("-0.") == std::string::npos ? text.substr(1) : text;
}

std::string written(const glm::dvec3& v, int digits) {
  return fmt::format("({}, {}, {})", written(v.x, digits), written(v.y, digits), written(v.z, digits));
}

/// Collects one line per difference in the printed values.
class Lines {
 public:
  void text(const std::string& what, const std::string& before, const std::string& after) {
    if (before != after)
      lines_.push_back(what + ": " + (before.empty() ? "none" : before) + " \u2192 " +
                       (after.empty() ? "none" : after));
  }
  void number(const std::string& what, double before, double after, int digits, const std::string& unit) {
    const std::string from = written(before, digits), to = written(after, digits);
    if (from != to) lines_.push_back(what + ": " + from + " \u2192 " + to + " " + unit);
  }
  void position(const std::string& what, const glm::dvec3& before, const glm::dvec3& after) {
    const std::string from = written(before, 2), to = written(after, 2);
    if (from != to)
      lines_.push_back(what + ": " + from + " \u2192 " + to + " mm, " + written(glm::distance(before, after), 2) +
                       " mm apart");
  }
  void rotation(const std::string& what, const glm::dquat& before, const glm::dquat& after) {
    const double angle_deg = degreesFromRad(angleBetween_rad(before, after));
    if (angle_deg >= 0.005) lines_.push_back(what + ": turned by " + written(angle_deg, 2) + "\u00b0");
  }
  std::vector<std::string> take() { return std::move(lines_); }

 private:
  std::vector<std::string> lines_;
};

template <class A, class B>
void comparePose(Lines& lines, const std::string& what, const Pose<A, B>& before, const Pose<A, B>& after) {
  lines.position(what, before.translation_mm, after.translation_mm);
  lines.rotation(what, before.rotation, after.rotation);
}

void compareSurroundings(Lines& lines, const RigRecord& before, const RigRecord& after) {
  const Rig &a = before.rig, &b = after.rig;
  const auto size = [](const glm::ivec2& px) { return std::to_string(px.x) + " x " + std::to_string(px.y) + " px"; };
  lines.text("screen", size(a.screen.px), size(b.screen.px));
  lines.position("screen, lower left", a.screen.lower_left.mm, b.screen.lower_left.mm);
  lines.position("screen, lower right", a.screen.lower_right.mm, b.screen.lower_right.mm);
  lines.position("screen, upper left", a.screen.upper_left.mm, b.screen.upper_left.mm);
  lines.text("mirror", a.mirror ? "present" : "", b.mirror ? "present" : "");
  if (a.mirror && b.mirror) {
    const double angle_rad = std::acos(std::clamp(glm::dot(a.mirror->normal, b.mirror->normal), -1.0, 1.0));
    if (angle_rad > radFromDegrees(0.005))
      lines.number("mirror, tilt against before", 0.0, degreesFromRad(angle_rad), 2, "\u00b0");
    lines.number("mirror, offset", a.mirror->offset_mm, b.mirror->offset_mm, 2, "mm");
  }
  lines.position("left eye", a.left_eye.mm, b.left_eye.mm);
  lines.position("right eye", a.right_eye.mm, b.right_eye.mm);
  lines.number("distance of the pupils", glm::distance(a.left_eye.mm, a.right_eye.mm),
               glm::distance(b.left_eye.mm, b.right_eye.mm), 1, "mm");
  lines.number("head motion, 1 sigma", before.eye_sd_mm, after.eye_sd_mm, 1, "mm");
  comparePose(lines, "patient", a.X_WP, b.X_WP);
  lines.text("position of the patient", before.patient_position, after.patient_position);
  lines.text("hand rest", before.rest ? "registered" : "", after.rest ? "registered" : "");
  if (before.rest && after.rest) {
    lines.position("hand rest", before.rest->translation_mm, after.rest->translation_mm);
    lines.rotation("hand rest", before.rest->rotation, after.rest->rotation);
  }
}

void compareArm(Lines& lines, const Rig& before, const Rig& after) {
  comparePose(lines, "device", before.X_WD, after.X_WD);
  lines.text("second device", before.second_X_WD ? "placed" : "", after.second_X_WD ? "placed" : "");
  if (before.second_X_WD && after.second_X_WD)
    comparePose(lines, "second device", *before.second_X_WD, *after.second_X_WD);
  const RigDevice none, &a_device = before.device ? *before.device : none,
                        &b_device = after.device ? *after.device : none;
  lines.text("device model", a_device.model, b_device.model);
  lines.text("device serial", a_device.serial, b_device.serial);
  lines.text("mount", a_device.mount, b_device.mount);
  lines.text("stylus tip", a_device.stylus_tip, b_device.stylus_tip);

  lines.text("arm", before.arm ? "measured" : "as its model", after.arm ? "measured" : "as its model");
  const ArmCorrection model, &a = before.arm ? *before.arm : model, &b = after.arm ? *after.arm : model;
  for (std::size_t i = 0; i < 6; ++i)
    lines.number(std::string("offset of ") + kJoints[i], degreesFromRad(a.offset_rad[i]),
                 degreesFromRad(b.offset_rad[i]), 3, "\u00b0");
  for (std::size_t i = 0; i < 6; ++i)
    lines.number(std::string("gain of ") + kJoints[i], 100.0 * a.gain[i], 100.0 * b.gain[i], 3, "%");
  for (std::size_t i = 0; i < 3; ++i)
    lines.number(std::string("quadratic term of ") + kJoints[i], a.quadratic_per_rad[i], b.quadratic_per_rad[i], 5,
                 "per rad");
  lines.number("thigh, longer by", a.thigh_delta_mm, b.thigh_delta_mm, 3, "mm");
  lines.number("shin, longer by", a.shin_delta_mm, b.shin_delta_mm, 3, "mm");
  lines.number("tilt of the shoulder", degreesFromRad(a.tilt_rad), degreesFromRad(b.tilt_rad), 3, "\u00b0");
  lines.number("reach, longer by", a.reach_delta_mm, b.reach_delta_mm, 3, "mm");
  lines.position("tip in the handle", a.tip_H_mm, b.tip_H_mm);
}

void compareKnowledge(Lines& lines, const RigRecord& before, const RigRecord& after) {
  const RigProvenance &a = before.provenance, &b = after.provenance;
  lines.text("rig", a.rig_id, b.rig_id);
  lines.text("measured", a.created_utc, b.created_utc);
  lines.text("operator", a.operator_code, b.operator_code);
  lines.text("program", a.program, b.program);
  lines.text("kind of mirror", a.mirror_kind, b.mirror_kind);
  lines.number("thickness of the plate", a.plate_mm, b.plate_mm, 2, "mm");
  const auto method = [](const RigRecord& r) { return r.procedure ? r.procedure->method : std::string(); };
  lines.text("procedure", method(before), method(after));
  if (before.procedure && after.procedure) {
    lines.text("model fitted", std::string(nameOf(before.procedure->model)),
               std::string(nameOf(after.procedure->model)));
    lines.number("touches used", before.procedure->used, after.procedure->used, 0, "touches");
    lines.number("outliers", before.procedure->outliers, after.procedure->outliers, 0, "touches");
    lines.number("cross-validated error, RMS", before.procedure->cv_rms_mm, after.procedure->cv_rms_mm, 2, "mm");
  }
  const auto verdict = [](const RigRecord& r) {
    return r.verification ? std::string(nameOf(r.verification->verdict)) : std::string();
  };
  lines.text("verdict", verdict(before), verdict(after));
  if (before.verification && after.verification) {
    lines.number("error on held-out touches, RMS", before.verification->errors.rms_mm,
                 after.verification->errors.rms_mm, 2, "mm");
    lines.number("error on held-out touches, largest", before.verification->errors.max_mm,
                 after.verification->errors.max_mm, 2, "mm");
  }
}

}  // namespace

std::vector<std::string> differences(const RigRecord& before, const RigRecord& after) {
  Lines lines;
  compareKnowledge(lines, before, after);
  compareArm(lines, before.rig, after.rig);
  compareSurroundings(lines, before, after);
  return lines.take();
}

}  // namespace calibration
