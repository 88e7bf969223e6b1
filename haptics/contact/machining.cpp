#include "haptics/contact/machining.h"

#include <algorithm>
#include <cmath>

#include "calibration/geometry/units.h"
#include "haptics/contact/field_sample.h"
#include "haptics/contact/head_surface.h"
#include "haptics/contact/immersion.h"
#include "haptics/tool/spindle.h"

namespace haptics {
namespace {

using calibration::kPi;

/// Factor of the edge forces of a fully worn bur.
constexpr double kWornEdge = 3.0;
constexpr double kMaxVibration_N = 0.3, kMaxVibrationShare = 0.1;

/// Direction and extent of the bone as seen from the head, for a sphere's quadrature.
struct Engagement {
  glm::dvec3 towards_T{0.0, 0.0, -1.0};
  double reach_mm = 0.0;
};

Engagement engagement(const ToolInBone& at, const glm::dvec3& normal_P, double depth_mm) {
  const double length = glm::length(normal_P);
  if (length < 1e-6) return {{0.0, 0.0, -1.0}, at.head.radius_mm};
  return {glm::conjugate(at.X_PT.rotation) * (-normal_P / length), depth_mm + 1.5 * at.bodies.spacing_mm()};
}

/// Calls visit(patch, solid, label) for every patch of the head that is in bone.
template <class Visit>
void visitEngaged(const ToolInBone& at, const Engagement& where, Visit&& visit) {
  const ToolSampler sampler(at.bodies, at.X_PT);
  visitHeadSurface(at.head, where.towards_T, where.reach_mm, [&](const Patch& patch) {
    const FieldSample sample = sampler.at(patch.position_T);
    if (sample.solid > 0.0) visit(patch, sample.solid, sample.label < assets::kTissueCount ? sample.label : 0);
  });
}

/// Force and torque about T's origin, in T.
struct Load {
  glm::dvec3 force{0.0}, torque{0.0};
  void add(const glm::dvec3& position, const glm::dvec3& part) {
    force += part;
    torque += glm::cross(position, part);
  }
};

/// Weight of the cutting part; the rest is the wall.
double cuttingShare(const MachiningParameters& parameters, double spindle_rad_per_s) {
  const double rpm = rpmOf(std::abs(spindle_rad_per_s));
  const double share = parameters.slowest_cut_rpm > 0.0 ? std::clamp(rpm / parameters.slowest_cut_rpm, 0.0, 1.0)
                                                        : (rpm > 0.0 ? 1.0 : 0.0);
  return share * share * (3.0 - 2.0 * share);
}

double wallPressure_N_per_mm2(const MachiningParameters& parameters, const BurShape& head) {
  return parameters.flutes * parameters.edge_radial_N_per_mm / (2.0 * kPi * head.radius_mm);
}

/// Flute forces of a patch, averaged over a revolution.
class Flutes {
 public:
  Flutes(const MachiningParameters& parameters, const ToolInBone& at)
      : parameters_(parameters),
        edge_(1.0 + (kWornEdge - 1.0) * parameters.worn),
        sense_(at.motion.spindle_rad_per_s < 0.0 ? -1.0 : 1.0),
        per_turn_(parameters.flutes / (2.0 * kPi)) {
    const glm::dvec3 feed_T = glm::conjugate(at.X_PT.rotation) * at.motion.velocity_P_mm_per_s.xyz;
    const double teeth_per_s = std::abs(at.motion.spindle_rad_per_s) * per_turn_;
    feed_per_tooth_ = teeth_per_s > 0.0 ? feed_T / teeth_per_s : glm::dvec3(0.0);
  }

  glm::dvec3 force(const Patch& patch) const {
    const double chip =
        std::min(parameters_.thickest_chip_mm, std::max(0.0, glm::dot(feed_per_tooth_, patch.normal_T)));
    // Near the axis, where the flutes meet, the patch's size limits the arm.
    const double arm = std::sqrt(patch.position_T.x * patch.position_T.x + patch.position_T.y * patch.position_T.y);
    const double length = per_turn_ * patch.area_mm2 / std::max(arm, 0.3 * std::sqrt(patch.area_mm2));
    const glm::dvec3 motion =
        arm > 0.0 ? sense_ * glm::dvec3(-patch.position_T.y, patch.position_T.x, 0.0) / arm : glm::dvec3(0.0);
    const glm::dvec3 up = glm::cross(patch.normal_T, sense_ * motion);  // along the flute, away from the tip
    return length *
           (-(parameters_.chip_tangential_N_per_mm2 * chip + edge_ * parameters_.edge_tangential_N_per_mm) * motion -
            (parameters_.chip_radial_N_per_mm2 * chip + edge_ * parameters_.edge_radial_N_per_mm) * patch.normal_T +
            (parameters_.chip_axial_N_per_mm2 * chip + edge_ * parameters_.edge_axial_N_per_mm) * up);
  }

 private:
  const MachiningParameters& parameters_;
  double edge_, sense_, per_turn_;
  glm::dvec3 feed_per_tooth_;
};

/// dF/dh on flat bone from the rim of the contact, without the chip, whose force depends on the feed.
double rimStiffness_N_per_mm(const MachiningParameters& parameters, const ToolInBone& at, const glm::dvec3& towards_T,
                             double depth_mm, double cutting) {
  const double R = at.head.radius_mm, height = R - std::min(depth_mm, R), rim = std::sqrt(R * R - height * height);
  const double wall = wallPressure_N_per_mm2(parameters, at.head) * 2.0 * kPi * height;
  if (cutting <= 0.0) return wall;
  const double edge = (1.0 + (kWornEdge - 1.0) * parameters.worn) * parameters.edge_radial_N_per_mm;
  double turning = 0.0;
  visitRing(height * towards_T, towards_T, rim, height / R * towards_T, rim / R, 1.0, 0, [&](const Patch& patch) {
    turning += patch.area_mm2 / std::max(std::hypot(patch.position_T.x, patch.position_T.y), 0.1 * R);
  });
  return (1.0 - cutting) * wall + cutting * edge * parameters.flutes * height * turning;
}

/// Without tissue factors: those are weighted over the surface.
Contact overlapContact(const ToolInBone& at) {
  const bool ball = at.head.kind == ShapeKind::sphere;
  const Immersion immersion =
      ball ? sphereImmersion(at.bodies, {at.X_PT.translation_mm}, at.head.radius_mm) : shapeImmersion(at);
  Contact contact;
  contact.normal_P = immersion.normal_P;
  contact.depth_mm = immersion.depth_mm;
  contact.volume_mm3 = immersion.volume_mm3;
  contact.one_sided = ball && immersion.face_mm2 <= 0.0 ? 1.0 : immersion.one_sided;
  return contact;
}

}  // namespace

Contact machiningContact(const MachiningParameters& parameters, const ToolInBone& at) noexcept {
  Contact contact = overlapContact(at);
  if (contact.depth_mm <= 0.0) return contact;

  // Cutting and wall over the same patches.
  const Engagement where = engagement(at, contact.normal_P.xyz, contact.depth_mm);
  const Flutes flutes(parameters, at);
  const double cutting = cuttingShare(parameters, at.motion.spindle_rad_per_s);
  const double pressure = wallPressure_N_per_mm2(parameters, at.head);
  Load turning, wall;
  double area = 0.0, hardness = 0.0;
  visitEngaged(at, where, [&](const Patch& patch, double solid, std::uint8_t label) {
    const double hard = solid * at.tissue.factor[label];
    if (cutting > 0.0) turning.add(patch.position_T, hard * flutes.force(patch));
    if (cutting < 1.0) wall.add(patch.position_T, -hard * pressure * patch.area_mm2 * patch.normal_T);
    area += solid * patch.area_mm2;
    hardness += hard * patch.area_mm2;
  });
  const glm::dvec3 mean_N = cutting * turning.force + (1.0 - cutting) * wall.force;
  contact.force_P_N.xyz = at.X_PT.rotation * mean_N;
  contact.torque_P_Nmm.xyz = at.X_PT.rotation * (cutting * turning.torque + (1.0 - cutting) * wall.torque);
  if (at.head.kind != ShapeKind::sphere)
    contact.stiffness_N_per_mm = glm::length(mean_N) / contact.depth_mm;  // the secant: no steeper than at touch
  else if (area > 0.0)
    contact.stiffness_N_per_mm =
        hardness / area * rimStiffness_N_per_mm(parameters, at, where.towards_T, contact.depth_mm, cutting);

  // The rotating part, limited for hand and device.
  const double share = std::clamp(parameters.vibration_share, 0.0, kMaxVibrationShare);
  const double amplitude = cutting * std::min(kMaxVibration_N, share * glm::length(mean_N));
  contact.vibration_P_N.xyz = at.X_PT.rotation * (amplitude * glm::dvec3(std::cos(at.motion.vibration_phase_rad),
                                                                         std::sin(at.motion.vibration_phase_rad), 0.0));
  return contact;
}

double sweptRate_mm3_per_s(const ToolInBone& at) noexcept {
  const Contact contact = overlapContact(at);
  if (contact.depth_mm <= 0.0) return 0.0;
  const glm::dvec3 feed_T = glm::conjugate(at.X_PT.rotation) * at.motion.velocity_P_mm_per_s.xyz;
  double rate = 0.0;
  visitEngaged(at, engagement(at, contact.normal_P.xyz, contact.depth_mm),
               [&](const Patch& patch, double solid, std::uint8_t) {
                 rate += solid * std::max(0.0, glm::dot(feed_T, patch.normal_T)) * patch.area_mm2;
               });
  return rate;
}

double spindleTorque_Nmm(const Contact& contact, const ToolInBone& at) noexcept {
  if (at.motion.spindle_rad_per_s == 0.0) return 0.0;
  const glm::dvec3 axis_P = at.X_PT.rotation * glm::dvec3(0.0, 0.0, 1.0);
  const double against = -glm::dot(contact.torque_P_Nmm.xyz, axis_P);
  return std::max(0.0, at.motion.spindle_rad_per_s < 0.0 ? -against : against);
}

}  // namespace haptics
