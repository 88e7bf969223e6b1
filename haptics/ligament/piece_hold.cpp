#include "haptics/ligament/piece_hold.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "haptics/ligament/series.h"
#include "haptics/ligament/settle.h"

namespace haptics {
namespace {

float narrow(double value) { return static_cast<float>(value); }

HoldConstants constantsOf(const LigamentLaw& law) {
  const double wall = law.wall_N_per_mm2 / law.wall_stiffening, end = exponentialOf(law.wall_stiffening);
  const double peak = law.peakStress_N_per_mm2();
  HoldConstants c{};
  c.fibre = narrow(law.fibre_N_per_mm2 / law.fibre_stiffening);
  c.stiffening = narrow(law.fibre_stiffening);
  c.peak_stretch = narrow(law.peak_stretch);
  c.peak_stress = narrow(peak);
  c.per_softening = narrow(1.0 / (law.torn_stretch - law.peak_stretch));
  c.shear = narrow(law.shear_weight);
  c.wall = narrow(wall);
  c.wall_stiffening = narrow(law.wall_stiffening);
  c.wall_slope = narrow(law.wall_N_per_mm2);
  c.wall_end = narrow(wall * (end - 1.0));
  c.wall_end_slope = narrow(law.wall_N_per_mm2 * end);
  c.fluid = narrow(law.fluid_N_per_mm2);
  c.contact = narrow(law.contact_N_per_mm3);
  c.creep_floor = narrow(law.creep_floor);
  c.yield = narrow(law.yield_N_per_mm2);
  return c;
}

void copyInto(std::span<const float> from, std::vector<float>& to) noexcept {
  assert(from.size() == to.size());
  std::copy(from.begin(), from.end(), to.begin());
}

}  // namespace

struct PieceHold::Tried {
  PiecePose X_PQ;
  Balance balance{};
  double residual_N = 0.0, contact_Nmm = 0.0;
  Wrench<calibration::Patient> spring{};
};

PieceHold::PieceHold(PieceSamples samples, const LigamentLaw& law)
    : samples_(std::move(samples)),
      law_(law.sanitised()),
      constants_(constantsOf(law_)),
      ligament_area_mm2_(samples_.ligamentArea_mm2()),
      state_{{}, unworn(samples_)} {
  assert(samples_.size() <= kMostSamples && samples_.size() % kSampleLanes == 0);
}

HoldConstants PieceHold::constantsFor(double period_s) const noexcept {
  HoldConstants c = constants_;
  c.fluid_kept = narrow(1.0 / (1.0 + period_s / law_.fluid_relaxation_s));
  c.creep = narrow(period_s / law_.creep_s);
  c.widening = narrow(period_s / law_.yield_Ns_per_mm3);
  return c;
}

HoldSamples PieceHold::view() const noexcept {
  const PieceSamples& s = samples_;
  const LigamentMemory& m = state_.ligament;
  return {s.place_mm[0].data(),      s.place_mm[1].data(),
          s.place_mm[2].data(),      s.normal[0].data(),
          s.normal[1].data(),        s.normal[2].data(),
          s.area_mm2.data(),         s.width_mm.data(),
          s.rest_gap_mm.data(),      m.torn.data(),
          m.fluid_N_per_mm2.data(),  m.strain.data(),
          m.widened_mm.data(),       static_cast<int>(s.ligament),
          static_cast<int>(s.size())};
}

HoldPlace PieceHold::placeAt(const PiecePose& X_PQ, const DistanceField* obstacles) const noexcept {
  const glm::dquat& q = X_PQ.rotation;
  const glm::dvec3 centre_P_mm = (X_PQ * calibration::Point<calibration::Piece>{samples_.centre_Q_mm}).mm;
  const glm::dvec3 shift = centre_P_mm - samples_.centre_Q_mm;
  HoldPlace place{};
  // Rotation less the unit matrix, without cancellation.
  const double turn[9] = {
      -2.0 * (q.y * q.y + q.z * q.z), 2.0 * (q.x * q.y - q.w * q.z),  2.0 * (q.x * q.z + q.w * q.y),
      2.0 * (q.x * q.y + q.w * q.z),  -2.0 * (q.x * q.x + q.z * q.z), 2.0 * (q.y * q.z - q.w * q.x),
      2.0 * (q.x * q.z - q.w * q.y),  2.0 * (q.y * q.z + q.w * q.x),  -2.0 * (q.x * q.x + q.y * q.y)};
  for (int n = 0; n < 9; ++n) place.turn[n] = narrow(turn[n]);
  for (int axis = 0; axis < 3; ++axis) place.shift[axis] = narrow(shift[axis]);
  if (obstacles == nullptr) return place;

  const assets::VolumeGrid& grid = obstacles->grid();
  assert(grid.size.x > 1 && grid.size.y > 1 && grid.size.z > 1);
  const glm::dvec3 index = grid.indexFromPoint(centre_P_mm);
  place.distance = obstacles->voxels_mm().data();
  place.per_mm = narrow(1.0 / grid.spacing_mm);
  for (int axis = 0; axis < 3; ++axis) {
    place.size[axis] = grid.size[axis];
    place.centre[axis] = narrow(index[axis]);
  }
  return place;
}

PieceHold::KernelInput PieceHold::inputAt(const PiecePose& X_PQ, const DistanceField* obstacles,
                                          double period_s) const noexcept {
  return {constantsFor(period_s), view(), placeAt(X_PQ, obstacles)};
}

HoldBalance PieceHold::balanceAt(const PiecePose& X_PQ, const DistanceField* obstacles,
                                 double period_s) const noexcept {
  return balanceAt(X_PQ, constantsFor(period_s), obstacles);
}

HoldBalance PieceHold::balanceAt(const PiecePose& X_PQ, const HoldConstants& constants,
                                 const DistanceField* obstacles) const noexcept {
  const HoldSums sums = sumHold(constants, view(), placeAt(X_PQ, obstacles));
  HoldBalance hold;
  hold.balance.energy_Nmm = sums.energy;
  std::copy(std::begin(sums.gradient), std::end(sums.gradient), hold.balance.gradient.begin());
  std::copy(std::begin(sums.hessian), std::end(sums.hessian), hold.balance.hessian.upper.begin());
  hold.contact_Nmm = sums.contact_energy;
  return hold;
}

/// `drive` with its load already about the centre.
PieceHold::Tried PieceHold::tryAt(const PiecePose& X_PQ, const HoldConstants& constants, const DistanceField* obstacles,
                                  const PieceDrive& drive, double drag_N_per_mm) const noexcept {
  const HoldBalance hold = balanceAt(X_PQ, constants, obstacles);
  Tried tried{.X_PQ = X_PQ, .balance = hold.balance, .contact_Nmm = hold.contact_Nmm};
  Balance& balance = tried.balance;

  // The load's work along the way and, to second order, the turn of this tick.
  const glm::dvec3& centre_Q_mm = samples_.centre_Q_mm;
  const calibration::Point<calibration::Piece> centre{centre_Q_mm};
  const glm::dquat turn = X_PQ.rotation * glm::conjugate(state_.X_PQ.rotation);
  const glm::dvec3 way_mm = (X_PQ * centre).mm - (state_.X_PQ * centre).mm;
  balance.energy_Nmm -=
      glm::dot(drive.force_N.xyz, way_mm) + 2.0 * glm::dot(drive.torque_Nmm.xyz, glm::dvec3(turn.x, turn.y, turn.z));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    balance.gradient[axis] -= drive.force_N.xyz[static_cast<int>(axis)];
    balance.gradient[3 + axis] -= drive.torque_Nmm.xyz[static_cast<int>(axis)];
  }
  tried.spring = addSpring(drive.spring, X_PQ, centre_Q_mm, balance);
  addDrag(state_.X_PQ, X_PQ, centre_Q_mm, drag_N_per_mm, law_.drag_lever_mm, balance);
  tried.residual_N = largest(balance.gradient, 1.0 / law_.drag_lever_mm);
  return tried;
}

HoldTick PieceHold::step(const PieceDrive& drive, const DistanceField* obstacles, double period_s) noexcept {
  HoldTick tick{.X_PQ = state_.X_PQ};
  tick.refused = !isUsable(drive) || !(period_s > 0.0 && period_s <= kLongestTick_s);
  if (tick.refused) return tick;

  // The load about the centre where that is as the tick begins.
  PieceDrive about_centre = drive;
  const glm::dvec3 centre_P_mm = (state_.X_PQ * calibration::Point<calibration::Piece>{samples_.centre_Q_mm}).mm;
  about_centre.torque_Nmm.xyz += glm::cross(drive.load_at_P.mm - centre_P_mm, drive.force_N.xyz);

  const HoldConstants constants = constantsFor(period_s);
  const double drag_N_per_mm = law_.drag_Ns_per_mm / period_s;
  const auto try_at = [&](const PiecePose& X_PQ) {
    return tryAt(X_PQ, constants, obstacles, about_centre, drag_N_per_mm);
  };
  SettleEffort effort;
  const Tried end = settled<6>(
      try_at(state_.X_PQ), kBalanced_N, law_.drag_lever_mm,
      [&](const Tried& from, const Six& step) { return try_at(moved(from.X_PQ, samples_.centre_Q_mm, step)); }, effort);

  tick = moveTo(end.X_PQ, obstacles, end.contact_Nmm, period_s);
  tick.evaluations = effort.evaluations;
  tick.unsettled = effort.unsettled;
  if (tick.unsettled) ++unsettled_;
  tick.on_hand = -1.0 * end.spring;
  tick.residual_N = end.residual_N;
  return tick;
}

HoldTick PieceHold::moveTo(const PiecePose& X_PQ, const DistanceField* obstacles, double contact_Nmm,
                           double period_s) noexcept {
  HoldTick tick{.X_PQ = X_PQ};
  state_.X_PQ = X_PQ;
  LigamentMemory& ligament = state_.ligament;
  const HoldAge age = ageHold(
      constantsFor(period_s), view(), placeAt(X_PQ, obstacles),
      {ligament.torn.data(), ligament.fluid_N_per_mm2.data(), ligament.strain.data(), ligament.widened_mm.data()});
  tick.torn_Nmm = age.torn_Nmm;
  tick.stored_Nmm = age.stored_Nmm + contact_Nmm;
  tick.torn_share = ligament_area_mm2_ > 0.0 ? age.torn_area_mm2 / ligament_area_mm2_ : 1.0;
  return tick;
}

void PieceHold::restore(const PieceState& state) noexcept {
  const LigamentMemory& from = state.ligament;
  restore(state.X_PQ, from.torn, from.fluid_N_per_mm2, from.strain, from.widened_mm);
}

void PieceHold::restore(const PiecePose& X_PQ, std::span<const float> torn, std::span<const float> fluid_N_per_mm2,
                        std::span<const float> strain, std::span<const float> widened_mm) noexcept {
  state_.X_PQ = X_PQ;
  copyInto(torn, state_.ligament.torn);
  copyInto(fluid_N_per_mm2, state_.ligament.fluid_N_per_mm2);
  copyInto(strain, state_.ligament.strain);
  copyInto(widened_mm, state_.ligament.widened_mm);
}

void PieceHold::takeOver(const PieceHold* before, const PiecePose& X_PQ, double torn_share) noexcept {
  if (before != nullptr && before->samples_.ligament == samples_.ligament &&
      std::ranges::equal(before->samples_.place_mm, samples_.place_mm)) {
    restore(before->state_);
  } else {
    const float least = narrow(before == nullptr ? torn_share : before->tornShare());
    for (float& share : state_.ligament.torn) share = std::max(share, least);
  }
  state_.X_PQ = X_PQ;
}

double PieceHold::tornShare() const noexcept {
  double torn_mm2 = 0.0;
  for (std::size_t n = 0; n < samples_.ligament; ++n)
    torn_mm2 += static_cast<double>(samples_.area_mm2[n]) * static_cast<double>(state_.ligament.torn[n]);
  return ligament_area_mm2_ > 0.0 ? torn_mm2 / ligament_area_mm2_ : 1.0;
}

void PieceHold::meet(const SocketChange& change) noexcept {
  copyInto(change.rest_gap_mm, samples_.rest_gap_mm);
  std::vector<float>& torn = state_.ligament.torn;
  assert(change.torn.size() == torn.size());
  for (std::size_t n = 0; n < torn.size(); ++n) torn[n] = std::max(torn[n], change.torn[n]);
}

}  // namespace haptics
