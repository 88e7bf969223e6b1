#include "haptics/ligament/blade_friction.h"

#include <cmath>

namespace haptics {
namespace {

using calibration::Patient;
using calibration::Piece;
using calibration::Point;
using calibration::Tool;

glm::dvec3 acrossOf(const glm::dvec3& v, const glm::dvec3& unit) noexcept { return v - glm::dot(v, unit) * unit; }

std::size_t regionOf(const glm::dvec3& p_T_mm, bool on_piece) noexcept {
  return (on_piece ? 4U : 0U) + (p_T_mm.y < 0.0 ? 2U : 0U) + (p_T_mm.x < 0.0 ? 1U : 0U);
}

}  // namespace

/// Of the spring now, and the normal that held as the tick began.
glm::dvec3 BladeFriction::stretch_P_mm(std::size_t n, const ToolPose& start_X_PT, const PiecePose& start_X_PQ,
                                       const ToolPose& X_PT, const PiecePose& X_PQ, glm::dvec3& out_P) const noexcept {
  const Region& r = region[n];
  const Point<Tool> at_T{r.at_T_mm};
  const Point<Patient> then = start_X_PT * at_T;
  if (!isAgainstPiece(n)) {
    out_P = r.out;
    return r.stretched_mm + acrossOf((X_PT * at_T).mm - then.mm, out_P);
  }
  out_P = start_X_PQ.rotation * r.out;
  const glm::dvec3 carried_mm = (X_PQ * (start_X_PQ.inverse() * then)).mm;
  return start_X_PQ.rotation * r.stretched_mm + acrossOf((X_PT * at_T).mm - carried_mm, out_P);
}

double BladeFriction::add(const ElevatorLaw& law, const ToolPose& start_X_PT, const PiecePose& start_X_PQ,
                          const ToolPose& X_PT, const PiecePose& X_PQ, const glm::dvec3& middle_T_mm,
                          const glm::dvec3& centre_Q_mm, PairBalance& balance) const noexcept {
  double stored_Nmm = 0.0;
  const glm::dvec3 middle_P_mm = (X_PT * Point<Tool>{middle_T_mm}).mm;
  const glm::dvec3 centre_P_mm = (X_PQ * Point<Piece>{centre_Q_mm}).mm;
  for (std::size_t n = 0; n < kRegions; ++n) {
    if (region[n].normal_N == 0.0 || law.friction == 0.0) continue;
    glm::dvec3 out;
    const glm::dvec3 stretch_mm = stretch_P_mm(n, start_X_PT, start_X_PQ, X_PT, X_PQ, out);
    const double length_mm = glm::length(stretch_mm), most_N = law.friction * region[n].normal_N;
    const bool sticks = law.stick_N_per_mm * length_mm <= most_N;
    const glm::dvec3 any = std::fabs(out.x) < 0.6 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 along = length_mm > 1e-9 ? stretch_mm / length_mm : glm::normalize(glm::cross(out, any));
    const double force_N = sticks ? law.stick_N_per_mm * length_mm : most_N;
    stored_Nmm += sticks ? 0.5 * force_N * length_mm : most_N * (length_mm - 0.5 * most_N / law.stick_N_per_mm);
    const glm::dvec3 at_P_mm = (X_PT * Point<Tool>{region[n].at_T_mm}).mm;
    const glm::dvec3 blade_arm = at_P_mm - middle_P_mm, piece_arm = at_P_mm - centre_P_mm;
    const bool on_piece = isAgainstPiece(n);
    balance.addAlong(wayAlong(along, blade_arm, piece_arm, on_piece), force_N, sticks ? law.stick_N_per_mm : 0.0,
                     on_piece ? 2 : 1);
    balance.addAlong(wayAlong(glm::cross(out, along), blade_arm, piece_arm, on_piece), 0.0,
                     sticks ? law.stick_N_per_mm : most_N / length_mm, on_piece ? 2 : 1);
  }
  balance.energy_Nmm += stored_Nmm;
  return stored_Nmm;
}

void BladeFriction::slide(const ElevatorLaw& law, const ToolPose& start_X_PT, const PiecePose& start_X_PQ,
                          const ToolPose& X_PT, const PiecePose& X_PQ,
                          std::span<const BladeContact> pressing) noexcept {
  std::array<Region, kRegions> next{};
  const calibration::Pose<Tool, Patient> X_TP = X_PT.inverse();
  for (const BladeContact& contact : pressing) {
    const glm::dvec3 at_T_mm = (X_TP * Point<Patient>{contact.at_P_mm}).mm;
    Region& r = next[regionOf(at_T_mm, contact.on == BladeContact::On::piece)];
    r.normal_N += contact.push_N();
    r.at_T_mm += contact.push_N() * at_T_mm;
    r.out += contact.push_N() * contact.out_P;
  }
  for (std::size_t n = 0; n < kRegions; ++n) {
    Region& r = next[n];
    const double size = glm::length(r.out);
    if (r.normal_N <= 0.0 || size < 1e-3 * r.normal_N) {
      r = {};
      continue;
    }
    // Opposed normals within a region press, but do not hold.
    r.at_T_mm /= r.normal_N;
    r.normal_N = size;
    glm::dvec3 out_P = r.out / size, then_out, stretch_P_mm_now(0.0);
    if (region[n].normal_N > 0.0)
      stretch_P_mm_now = acrossOf(stretch_P_mm(n, start_X_PT, start_X_PQ, X_PT, X_PQ, then_out), out_P);
    const double length_mm = glm::length(stretch_P_mm_now), most_mm = law.friction * r.normal_N / law.stick_N_per_mm;
    if (length_mm > most_mm) stretch_P_mm_now *= most_mm / length_mm;
    if (isAgainstPiece(n)) {
      const glm::dquat to_Q = glm::conjugate(X_PQ.rotation);
      out_P = to_Q * out_P;
      stretch_P_mm_now = to_Q * stretch_P_mm_now;
    }
    r.out = out_P;
    r.stretched_mm = stretch_P_mm_now;
  }
  region = next;
}

}  // namespace haptics
