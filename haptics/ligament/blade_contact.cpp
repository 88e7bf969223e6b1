#include "haptics/ligament/blade_contact.h"

#include <algorithm>

namespace haptics {
namespace {

constexpr double kFieldBand_mm = 1.55;  // of the fields of a site, where they still tell

}  // namespace

using calibration::Patient;
using calibration::Piece;
using calibration::Point;
using calibration::Tool;

/// Beyond the grid as at the nearest place in it.
BladeContacts::Around BladeContacts::around(const DistanceField& field, const glm::dvec3& p_mm) noexcept {
  const glm::dvec3 index = field.grid().indexFromPoint(p_mm), last(field.grid().size - 1);
  const DistanceField::Sample near = field.at(glm::vec3(index));
  glm::dvec3 out(near.gradient);
  for (int axis = 0; axis < 3; ++axis)
    if (index[axis] <= 0.0 || index[axis] >= last[axis]) out[axis] = 0.0;
  return {static_cast<double>(near.distance_mm), out};
}

glm::dvec3 BladeContacts::sample_Q_mm(std::size_t n) const noexcept {
  const PieceSamples& s = *samples_;
  return s.centre_Q_mm + glm::dvec3(s.place_mm[0][n], s.place_mm[1][n], s.place_mm[2][n]);
}

bool BladeContacts::isOnTeeth(const glm::dvec3& p_P_mm, double obstacle_mm) const noexcept {
  if (scene_.teeth == nullptr) return false;
  return around(*scene_.teeth, p_P_mm).mm < obstacle_mm + 0.5 * scene_.teeth->grid().spacing_mm;
}

void BladeContacts::find(const ElevatorShape& shape, const ElevatorScene& scene, const PieceSamples* samples,
                         double contact_N_per_mm3, const ToolPose& X_PT, const PiecePose& X_PQ) noexcept {
  shape_ = &shape;
  scene_ = scene;
  samples_ = samples;
  contact_N_per_mm3_ = contact_N_per_mm3;
  against_obstacles_.count = against_piece_.count = near_samples_.count = 0;

  const calibration::Pose<Piece, Patient> X_QP = X_PQ.inverse();
  const auto is_near = [&](const DistanceField* field, double radius_mm, const glm::dvec3& p_mm) {
    if (field == nullptr) return false;
    const double near_mm = std::min(radius_mm + kNear_mm + field->grid().spacing_mm, kFieldBand_mm);
    return static_cast<double>(field->near(glm::vec3(field->grid().indexFromPoint(p_mm)))) < near_mm;
  };
  for (std::size_t n = 0; n < static_cast<std::size_t>(shape.points); ++n) {
    const Point<Patient> p_P = X_PT * Point<Tool>{shape.point_T_mm[n]};
    if (is_near(scene.obstacles, shape.point_radius_mm[n], p_P.mm)) against_obstacles_.add(n);
    if (is_near(scene.piece, shape.point_radius_mm[n], (X_QP * p_P).mm)) against_piece_.add(n);
  }

  if (samples == nullptr) return;
  const calibration::Pose<Tool, Piece> X_TQ = X_PT.inverse() * X_PQ;
  const double reach_mm = shape.reach_mm + kNear_mm, shank_mm = shape.shank_radius_mm + kNear_mm;
  for (std::size_t n = 0; n < samples->size(); ++n) {
    if (samples->area_mm2[n] == 0.0F) continue;
    const glm::dvec3 p_T_mm = (X_TQ * Point<Piece>{sample_Q_mm(n)}).mm, arm_mm = p_T_mm - shape.middle_T_mm;
    const bool by_blade = glm::dot(arm_mm, arm_mm) < reach_mm * reach_mm;
    const bool by_shank = p_T_mm.x * p_T_mm.x + p_T_mm.y * p_T_mm.y < shank_mm * shank_mm &&
                          p_T_mm.z > shape.shank_from_mm - shank_mm && p_T_mm.z < shape.shank_to_mm + shank_mm;
    if ((by_blade || by_shank) && shape.distanceAt(p_T_mm).mm < kNear_mm) near_samples_.add(n);
  }
}

double BladeContacts::add(const ToolPose& X_PT, const PiecePose& X_PQ, PairBalance& balance) const noexcept {
  const glm::dvec3 middle_P_mm = (X_PT * Point<Tool>{shape_->middle_T_mm}).mm;
  const glm::dvec3 centre_P_mm =
      samples_ == nullptr ? glm::dvec3(0.0) : (X_PQ * Point<Piece>{samples_->centre_Q_mm}).mm;
  double stored_Nmm = 0.0;
  forEach(X_PT, X_PQ, [&](const BladeContact& contact) {
    const bool on_piece = contact.on == BladeContact::On::piece;
    const Twelve way = wayAlong(contact.out_P, contact.at_P_mm - middle_P_mm, contact.at_P_mm - centre_P_mm, on_piece);
    const double push_N = contact.N_per_mm * contact.depth_mm;
    stored_Nmm += 0.5 * push_N * contact.depth_mm;
    balance.addAlong(way, -push_N, contact.N_per_mm, on_piece ? 2 : 1);
  });
  balance.energy_Nmm += stored_Nmm;
  return stored_Nmm;
}

}  // namespace haptics
