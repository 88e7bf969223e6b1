#include "haptics/ligament/piece_drive.h"

#include <cmath>

#include "haptics/ligament/series.h"

namespace haptics {
namespace {

/// The turn from `from` to `to`, the shorter way round: sine of half the angle along its axis, and its cosine.
struct HalfTurn {
  glm::dvec3 sine;
  double cosine;
};

HalfTurn halfTurn(const glm::dquat& from, const glm::dquat& to) noexcept {
  const glm::dquat turn = to * glm::conjugate(from);
  const double sign = turn.w < 0.0 ? -1.0 : 1.0;
  return {sign * glm::dvec3(turn.x, turn.y, turn.z), sign * turn.w};
}

/// 4 K (1 - cos(angle / 2)), without cancellation.
double turnEnergy(double stiffness, const HalfTurn& turn) noexcept {
  return 4.0 * stiffness * glm::dot(turn.sine, turn.sine) / (1.0 + turn.cosine);
}

glm::dmat3 acrossOf(const glm::dvec3& unit) noexcept { return glm::dmat3(1.0) - glm::outerProduct(unit, unit); }

void addTurn(const glm::dvec3& slope_Nmm, const glm::dmat3& stiffness_Nmm, Balance& balance) noexcept {
  for (std::size_t row = 0; row < 3; ++row) {
    balance.gradient[3 + row] += slope_Nmm[static_cast<int>(row)];
    for (std::size_t column = row; column < 3; ++column)
      balance.hessian(3 + row, 3 + column) += stiffness_Nmm[static_cast<int>(column)][static_cast<int>(row)];
  }
}

glm::dvec3 springTorque_Nmm(const PieceSpring& spring, const HalfTurn& turn, Balance& balance) noexcept {
  const double k = spring.stiffness_Nmm_per_rad, most = spring.most_torque_Nmm, sine = glm::length(turn.sine);
  if (2.0 * k * sine <= most) {
    balance.energy_Nmm += turnEnergy(k, turn);
    addTurn(-2.0 * k * turn.sine, glm::dmat3(k * turn.cosine), balance);
    return 2.0 * k * turn.sine;
  }
  // Beyond the bound the torque stays, so its energy grows with the angle.
  const double bound = 0.5 * most / k, bound_cosine = std::sqrt(std::fmax(0.0, 1.0 - bound * bound));
  const double at_bound = 4.0 * k * bound * bound / (1.0 + bound_cosine);
  const glm::dvec3 axis = turn.sine / sine;
  balance.energy_Nmm += at_bound + 2.0 * most * (arcSineOf(std::fmin(1.0, sine)) - arcSineOf(bound));
  addTurn(-most * axis, 0.5 * most * turn.cosine / sine * acrossOf(axis), balance);
  return most * axis;
}

template <class Body>
void addDragOf(const calibration::Pose<calibration::Patient, Body>& start,
               const calibration::Pose<calibration::Patient, Body>& now, const glm::dvec3& centre_mm, double N_per_mm,
               double lever_mm, Balance& balance) noexcept {
  const calibration::Point<Body> centre{centre_mm};
  const glm::dvec3 way_mm = (now * centre).mm - (start * centre).mm;
  balance.energy_Nmm += 0.5 * N_per_mm * glm::dot(way_mm, way_mm);
  balance.addForce(glm::dvec3(0.0), N_per_mm * way_mm, glm::dmat3(N_per_mm));

  const HalfTurn turn = halfTurn(start.rotation, now.rotation);
  const double turn_Nmm_per_rad = N_per_mm * lever_mm * lever_mm;
  balance.energy_Nmm += turnEnergy(turn_Nmm_per_rad, turn);
  addTurn(2.0 * turn_Nmm_per_rad * turn.sine, glm::dmat3(turn_Nmm_per_rad * turn.cosine), balance);
}

bool isFinite(const PiecePose& pose) noexcept {
  const glm::dquat& q = pose.rotation;
  return calibration::isFinite(pose.translation_mm) && std::isfinite(q.w + q.x + q.y + q.z) &&
         std::fabs(glm::dot(q, q) - 1.0) < 1e-6;
}

}  // namespace

void Balance::addForce(const glm::dvec3& arm_mm, const glm::dvec3& slope_N,
                       const glm::dmat3& stiffness_N_per_mm) noexcept {
  const glm::dvec3 turn = glm::cross(arm_mm, slope_N), r = arm_mm;
  // -[r]x by columns, then K -[r]x and its transpose's product.
  const glm::dmat3 lever(glm::dvec3(0.0, -r.z, r.y), glm::dvec3(r.z, 0.0, -r.x), glm::dvec3(-r.y, r.x, 0.0));
  const glm::dmat3 mixed = stiffness_N_per_mm * lever, turned = glm::transpose(lever) * mixed;
  for (std::size_t row = 0; row < 3; ++row) {
    const int i = static_cast<int>(row);
    gradient[row] += slope_N[i];
    gradient[3 + row] += turn[i];
    for (std::size_t column = 0; column < 3; ++column) {
      const int j = static_cast<int>(column);
      hessian(row, 3 + column) += mixed[j][i];
      if (column < row) continue;
      hessian(row, column) += stiffness_N_per_mm[j][i];
      hessian(3 + row, 3 + column) += turned[j][i];
    }
  }
}

glm::dvec3 addPull(double stiffness_N_per_mm, double most_N, const glm::dvec3& arm_mm, const glm::dvec3& way_mm,
                   Balance& balance) noexcept {
  const double k = stiffness_N_per_mm, most = most_N, length_mm = glm::length(way_mm);
  if (k * length_mm <= most) {
    balance.energy_Nmm += 0.5 * k * length_mm * length_mm;
    balance.addForce(arm_mm, -k * way_mm, glm::dmat3(k));
    return k * way_mm;
  }
  const glm::dvec3 along = way_mm / length_mm;
  balance.energy_Nmm += most * length_mm - 0.5 * most * most / k;
  balance.addForce(arm_mm, -most * along, most / length_mm * acrossOf(along));
  return most * along;
}

Wrench<calibration::Patient> addSpring(const PieceSpring& spring, const PiecePose& X_PQ, const glm::dvec3& centre_Q_mm,
                                       Balance& balance) noexcept {
  const glm::dvec3 arm_mm = X_PQ.rotation * (spring.grip_Q.mm - centre_Q_mm);
  const glm::dvec3 way_mm = (spring.target_X_PQ * spring.grip_Q).mm - (X_PQ * spring.grip_Q).mm;
  const glm::dvec3 force_N = addPull(spring.stiffness_N_per_mm, spring.most_force_N, arm_mm, way_mm, balance);
  return {{force_N}, {springTorque_Nmm(spring, halfTurn(X_PQ.rotation, spring.target_X_PQ.rotation), balance)}};
}

void addDrag(const PiecePose& start_X_PQ, const PiecePose& X_PQ, const glm::dvec3& centre_Q_mm, double N_per_mm,
             double lever_mm, Balance& balance) noexcept {
  addDragOf(start_X_PQ, X_PQ, centre_Q_mm, N_per_mm, lever_mm, balance);
}

void addDrag(const calibration::Pose<calibration::Patient, calibration::Tool>& start_X_PT,
             const calibration::Pose<calibration::Patient, calibration::Tool>& X_PT, const glm::dvec3& centre_T_mm,
             double N_per_mm, double lever_mm, Balance& balance) noexcept {
  addDragOf(start_X_PT, X_PT, centre_T_mm, N_per_mm, lever_mm, balance);
}

bool isUsable(const PieceDrive& drive) noexcept {
  const PieceSpring& spring = drive.spring;
  const auto not_negative = [](double value) { return value >= 0.0; };  // nor not a number
  return calibration::isFinite(drive.force_N.xyz) && calibration::isFinite(drive.torque_Nmm.xyz) &&
         calibration::isFinite(drive.load_at_P.mm) && calibration::isFinite(spring.grip_Q.mm) &&
         isFinite(spring.target_X_PQ) && std::isfinite(spring.stiffness_N_per_mm) &&
         std::isfinite(spring.stiffness_Nmm_per_rad) && not_negative(spring.stiffness_N_per_mm) &&
         not_negative(spring.stiffness_Nmm_per_rad) && not_negative(spring.most_force_N) &&
         not_negative(spring.most_torque_Nmm);
}

}  // namespace haptics
