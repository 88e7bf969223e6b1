#include "haptics/ligament/elevator_hold.h"

#include <algorithm>
#include <cmath>

#include "haptics/ligament/settle.h"

namespace haptics {
namespace {

using calibration::Patient;
using calibration::Piece;
using calibration::Point;
using calibration::Tool;

/// Edges press with hundreds of newtons, of which a device renders a fiftieth.
constexpr double kStill_N = 0.02, kStillShare = 5e-4;

Six partOf(const Twelve& step, std::size_t body) noexcept {
  Six part{};
  std::copy_n(step.begin() + static_cast<std::ptrdiff_t>(6 * body), 6, part.begin());
  return part;
}

/// Both sides of a blade between two walls of the piece.
struct Walls {
  glm::dvec3 reference{0.0};
  glm::dvec3 push_N[2]{}, at_N_mm[2]{};
  double sum_N[2]{};

  void add(const BladeContact& contact) noexcept {
    const std::size_t side = glm::dot(contact.out_P, reference) >= 0.0 ? 0 : 1;
    push_N[side] -= contact.push_N() * contact.out_P;
    at_N_mm[side] += contact.push_N() * contact.at_P_mm;
    sum_N[side] += contact.push_N();
  }
  Wedging wedging() const noexcept {
    const glm::dvec3 apart = push_N[1] - push_N[0];
    const double size = glm::length(apart);
    if (sum_N[0] <= 0.0 || sum_N[1] <= 0.0 || size == 0.0) return {};
    const glm::dvec3 axis = apart / size;
    const double force_N = std::min(glm::dot(push_N[1], axis), -glm::dot(push_N[0], axis));
    if (force_N <= 0.0) return {};
    return {force_N, axis, 0.5 * (at_N_mm[0] / sum_N[0] + at_N_mm[1] / sum_N[1])};
  }
};

}  // namespace

struct ElevatorHold::Tried {
  ToolPose X_PT;
  PiecePose X_PQ;
  PairBalance balance{};
  HandPull pull{};
  double residual_N = 0.0, contact_Nmm = 0.0;
};

bool ElevatorHold::take(ElevatorKind kind, const ToolPose& X_PT) noexcept {
  if (!isUsable(ElevatorHand{.X_PT = X_PT})) return false;
  shape_ = elevatorShape(kind);
  state_ = {X_PT, {}};
  return true;
}

ElevatorHold::Tried ElevatorHold::tryAt(const ElevatorHand& hand, const ElevatorScene& scene, const PieceHold* piece,
                                        const ToolPose& X_PT, const PiecePose& X_PQ, double period_s) noexcept {
  Tried tried{.X_PT = X_PT, .X_PQ = X_PQ};
  PairBalance& balance = tried.balance;
  Balance blade;
  tried.pull = addHand(hand, X_PT, shape_.middle_T_mm, blade);
  addDrag(state_.X_PT, X_PT, shape_.middle_T_mm, law_.drag_Ns_per_mm / period_s, law_.drag_lever_mm, blade);
  balance.add(blade, 0);

  glm::dvec3 centre_Q_mm(0.0);
  PiecePose start_X_PQ;
  if (piece != nullptr) {
    centre_Q_mm = piece->samples().centre_Q_mm;
    start_X_PQ = piece->state().X_PQ;
    const LigamentLaw& law = piece->law();
    HoldBalance hold = piece->balanceAt(X_PQ, scene.obstacles, period_s);
    tried.contact_Nmm = hold.contact_Nmm;
    addDrag(start_X_PQ, X_PQ, centre_Q_mm, law.drag_Ns_per_mm / period_s, law.drag_lever_mm, hold.balance);
    balance.add(hold.balance, 1);
  } else {
    for (std::size_t n = 6; n < 12; ++n) balance.hessian(n, n) = 1.0;
  }
  contacts_.press(X_PT, X_PQ, balance);
  state_.friction.add(law_, state_.X_PT, start_X_PQ, X_PT, X_PQ, shape_.middle_T_mm, centre_Q_mm, balance);
  tried.residual_N = largest(balance.gradient, 1.0 / law_.drag_lever_mm);
  return tried;
}

ElevatorTick ElevatorHold::step(const ElevatorHand& hand, const ElevatorScene& scene, PieceHold* piece,
                                double period_s) noexcept {
  ElevatorTick tick;
  tick.X_PT = state_.X_PT;
  if (piece != nullptr) tick.X_PQ = piece->state().X_PQ;
  tick.refused = !isUsable(hand) || !(period_s > 0.0 && period_s <= kLongestTick_s);
  if (tick.refused) return tick;

  ElevatorScene here = scene;
  if (piece == nullptr) here.piece = nullptr;
  contacts_.find(shape_, here, piece == nullptr ? nullptr : &piece->samples(), law_.point_N_per_mm,
                 piece == nullptr ? 0.0 : piece->law().contact_N_per_mm3, state_.X_PT, tick.X_PQ);

  const auto try_at = [&](const ToolPose& X_PT, const PiecePose& X_PQ) {
    return tryAt(hand, here, piece, X_PT, X_PQ, period_s);
  };
  const glm::dvec3 centre_Q_mm = piece == nullptr ? glm::dvec3(0.0) : piece->samples().centre_Q_mm;
  const Tried first = try_at(state_.X_PT, tick.X_PQ);
  double pressed_N = 0.0;
  for (const BladeContact& contact : contacts_.pressing()) pressed_N += contact.push_N();
  SettleEffort effort;
  const Tried end = settled<12>(
      first, kStill_N + kStillShare * pressed_N, law_.drag_lever_mm,
      [&](const Tried& from, const Twelve& step) {
        return try_at(moved(from.X_PT, shape_.middle_T_mm, partOf(step, 0)),
                      piece == nullptr ? from.X_PQ : moved(from.X_PQ, centre_Q_mm, partOf(step, 1)));
      },
      effort);

  // The last pose tried may not be the one taken.
  PairBalance again;
  contacts_.press(end.X_PT, end.X_PQ, again);
  sayForces(end, tick);
  state_.friction.slide(law_, state_.X_PT, tick.X_PQ, end.X_PT, end.X_PQ, contacts_.pressing());
  state_.X_PT = tick.X_PT = end.X_PT;
  if (piece != nullptr) {
    const HoldTick held = piece->moveTo(end.X_PQ, here.obstacles, end.contact_Nmm, period_s);
    tick.X_PQ = held.X_PQ;
    tick.torn_Nmm = held.torn_Nmm;
    tick.stored_Nmm = held.stored_Nmm;
    tick.torn_share = held.torn_share;
  }
  tick.residual_N = end.residual_N;
  tick.evaluations = effort.evaluations;
  tick.unsettled = effort.unsettled;
  if (tick.unsettled) ++unsettled_;
  return tick;
}

void ElevatorHold::sayForces(const Tried& end, ElevatorTick& tick) const noexcept {
  tick.on_hand = -1.0 * end.pull.on_blade;
  tick.twist_Nmm = end.pull.twist_Nmm;
  tick.coupling_Nmm = end.pull.stored_Nmm;

  double most_N = 0.0, fulcrum_N = 0.0;
  Walls walls;
  for (const BladeContact& contact : contacts_.pressing()) {
    const double push_N = contact.push_N();
    if (contact.on != BladeContact::On::piece) {
      (contacts_.isOnTeeth(contact) ? tick.blade_on_teeth_N : tick.blade_on_bone_N) += push_N;
      tick.fulcrum_P_mm += push_N * contact.at_P_mm;
      fulcrum_N += push_N;
      continue;
    }
    const glm::dvec3 on_piece_N = -push_N * contact.out_P;
    tick.blade_on_piece_N += push_N;
    tick.on_piece.force_N.xyz += on_piece_N;
    tick.on_piece.torque_Nmm.xyz += glm::cross(contact.at_P_mm - end.X_PT.translation_mm, on_piece_N);
    if (push_N <= most_N) continue;
    most_N = push_N;
    walls.reference = contact.out_P;
  }
  if (fulcrum_N > 0.0) tick.fulcrum_P_mm /= fulcrum_N;
  for (const BladeContact& contact : contacts_.pressing())
    if (contact.on == BladeContact::On::piece) walls.add(contact);
  tick.wedging = walls.wedging();
}

double gapOf_mm(const ElevatorShape& shape, const ToolPose& X_PT, const DistanceField& piece,
                const PiecePose& X_PQ) noexcept {
  const calibration::Pose<Piece, Tool> X_QT = X_PQ.inverse() * X_PT;
  double least_mm = 1e9;
  for (std::size_t n = 0; n < static_cast<std::size_t>(shape.points); ++n) {
    const glm::dvec3 p_Q_mm = (X_QT * Point<Tool>{shape.point_T_mm[n]}).mm;
    const assets::VolumeGrid& grid = piece.grid();
    const glm::dvec3 index = grid.indexFromPoint(p_Q_mm), last(grid.size - 1);
    const double beyond_mm = grid.spacing_mm * glm::distance(index, glm::clamp(index, glm::dvec3(0.0), last));
    const double gap_mm = static_cast<double>(piece.near(glm::vec3(index))) - shape.point_radius_mm[n];
    least_mm = std::min(least_mm, gap_mm + beyond_mm);
  }
  return least_mm;
}

}  // namespace haptics
