#include "haptics/servo/piece_sites.h"

#include <algorithm>
#include <cassert>
#include <span>

namespace haptics {
namespace {

bool fits(const PieceMemory& memory, const PieceHold& hold) { return memory.samples == hold.samples().ligament; }

void restore(PieceHold& hold, const PieceMemory& memory) noexcept {
  const auto part = [&](std::size_t n) { return std::span(memory.ligament[n]).first(memory.samples); };
  hold.restore(memory.hold_X_PQ, part(0), part(1), part(2), part(3));
}

}  // namespace

void PieceSites::receive(const Bodies& bodies, const SiteOrder& order, bool held, const PieceMemory* left) noexcept {
  if (!isNew(order)) return;
  order_ = order;
  answer_ = SiteAnswer::refused;
  if (held || order.site == nullptr || order.piece >= bodies.pieces() || order.bodies_digest != bodies.digest()) return;
  const std::size_t piece = order.piece;
  const std::uint64_t piece_digest = bodies.bones()[piece + 1].digest();
  PieceHold& hold = order.site->hold;
  // The same piece in a socket that may have changed remembers, also after a cut into it was undone; another one begins
  // where it lies.
  const PieceMemory* const waiting = waitingFor(bodies, piece);
  const PieceSite* const before = waiting != nullptr ? nullptr : sites_[piece];
  const bool is_other = before == nullptr || piece_digest_[piece] != piece_digest;
  const PieceMemory* const memory = waiting != nullptr ? waiting : is_other ? left : nullptr;
  if (memory != nullptr && memory->piece_digest == piece_digest && fits(*memory, hold)) {
    restore(hold, *memory);
    hold.takeOver(nullptr, bodies.pose(piece), 0.0);
  } else {
    hold.takeOver(before == nullptr ? nullptr : &before->hold, bodies.pose(piece), tornShare(bodies, piece));
  }
  hold.meet(order.site->change);
  is_waiting_[piece] = false;
  sites_[piece] = order.site;
  made_of_[piece] = bodies.digestWithoutPose(piece);
  piece_digest_[piece] = piece_digest;
  settling_s_[piece] = 0.0;
  answer_ = SiteAnswer::ready;
}

void PieceSites::part(const Bodies& bodies, std::size_t from, std::size_t to) noexcept {
  torn_share_[to] = tornShare(bodies, from);
  sites_[to] = nullptr;
  is_waiting_[to] = false;
  settling_s_[from] = settling_s_[to] = 0.0;
}

bool PieceSites::isReady(const Bodies& bodies, std::size_t piece) const noexcept {
  return sites_[piece] != nullptr && !bodies.isSetAside(piece) && made_of_[piece] == bodies.digestWithoutPose(piece);
}

const PieceMemory* PieceSites::waitingFor(const Bodies& bodies, std::size_t piece) const noexcept {
  const bool fits_site = sites_[piece] != nullptr && piece_digest_[piece] == bodies.bones()[piece + 1].digest();
  return is_waiting_[piece] && !fits_site ? &waiting_[piece] : nullptr;
}

double PieceSites::tornShare(const Bodies& bodies, std::size_t piece) const noexcept {
  if (const PieceMemory* const waiting = waitingFor(bodies, piece)) return waiting->torn_share;
  return sites_[piece] == nullptr ? torn_share_[piece] : sites_[piece]->hold.tornShare();
}

HoldTick PieceSites::move(Bodies& bodies, std::size_t piece, const PieceDrive& drive, double dt_s) noexcept {
  is_waiting_[piece] = false;
  const HoldTick tick = sites_[piece]->hold.step(drive, &sites_[piece]->obstacles, dt_s);
  if (!tick.refused) bodies.place(piece, tick.X_PQ);
  torn_total_Nmm_ += tick.torn_Nmm;
  return tick;
}

ElevatorTick PieceSites::lever(Bodies& bodies, std::size_t piece, ElevatorHold& blade, const ElevatorHand& hand,
                               double dt_s) noexcept {
  is_waiting_[piece] = false;
  const ElevatorTick tick = blade.step(hand, scene(piece), &sites_[piece]->hold, dt_s);
  if (!tick.refused) bodies.place(piece, tick.X_PQ);
  torn_total_Nmm_ += tick.torn_Nmm;
  return tick;
}

bool PieceSites::letGo(Bodies& bodies, std::size_t piece) noexcept {
  const calibration::Point<calibration::Piece> centre{samples(piece).centre_Q_mm};
  const bool is_out = glm::distance((bodies.pose(piece) * centre).mm, centre.mm) >= kOutOfPlace_mm;
  if (is_out && tornShare(bodies, piece) >= kLooseShare) {
    bodies.setAside(piece);
    return true;
  }
  settling_s_[piece] = kSettle_s;
  return false;
}

bool PieceSites::areSettling() const noexcept {
  return std::ranges::any_of(settling_s_, [](double left_s) { return left_s > 0.0; });
}

bool PieceSites::settle(Bodies& bodies, double dt_s) noexcept {
  bool unsettled = false;
  for (std::size_t n = 0; n < bodies.pieces(); ++n) {
    if (!isSettling(n)) continue;
    settling_s_[n] = std::max(0.0, settling_s_[n] - dt_s);
    unsettled = move(bodies, n, {}, dt_s).unsettled || unsettled;
  }
  return unsettled;
}

void PieceSites::remember(const Bodies& bodies, std::size_t piece, PieceMemory& memory) const noexcept {
  if (const PieceMemory* const waiting = waitingFor(bodies, piece)) {
    memory = *waiting;
  } else {
    assert(sites_[piece] != nullptr);
    const PieceState& state = sites_[piece]->hold.state();
    const LigamentMemory& ligament = state.ligament;
    memory.hold_X_PQ = state.X_PQ;
    memory.samples = ligament.torn.size();
    memory.piece_digest = piece_digest_[piece];
    memory.torn_share = tornShare(bodies, piece);
    std::ranges::copy(ligament.torn, memory.ligament[0].begin());
    std::ranges::copy(ligament.fluid_N_per_mm2, memory.ligament[1].begin());
    std::ranges::copy(ligament.strain, memory.ligament[2].begin());
    std::ranges::copy(ligament.widened_mm, memory.ligament[3].begin());
  }
  memory.X_PQ = bodies.pose(piece);
}

void PieceSites::putBack(Bodies& bodies, std::size_t piece, const PieceMemory& memory) noexcept {
  bodies.putBack(piece, memory.X_PQ);
  settling_s_[piece] = 0.0;
  PieceSite* const site = sites_[piece];
  is_waiting_[piece] = site == nullptr || piece_digest_[piece] != memory.piece_digest || !fits(memory, site->hold);
  if (is_waiting_[piece])
    waiting_[piece] = memory;
  else
    restore(site->hold, memory);
}

}  // namespace haptics
