#include "haptics/servo/forceps.h"

#include <algorithm>

#include "haptics/contact/overlap.h"

namespace haptics {
namespace {

using calibration::Patient;
using calibration::Piece;

constexpr std::size_t kNoPiece = kMaxPieces;
constexpr double kAllTorn = 0.999;  // of the ligament

double movedBy_mm(const PieceSite& site, const Bodies::PiecePose& X_PQ) {
  const calibration::Point<Piece> centre{site.hold.samples().centre_Q_mm};
  return glm::distance((X_PQ * centre).mm, centre.mm);
}

}  // namespace

void Forceps::receive(const Bodies& bodies, const SiteOrder& order) noexcept {
  if (order.serial == order_.serial) return;
  order_ = order;
  answer_ = SiteAnswer::refused;
  if (held_.holds || order.site == nullptr || order.piece >= bodies.pieces() || order.bodies_digest != bodies.digest())
    return;
  // The same piece in a socket that may have changed remembers; another one begins where it lies.
  PieceSite* const before = sites_[order.piece];
  order.site->hold.takeOver(before == nullptr ? nullptr : &before->hold, bodies.pose(order.piece),
                            torn_share_[order.piece]);
  order.site->hold.meet(order.site->change);
  sites_[order.piece] = order.site;
  made_of_[order.piece] = bodies.digestWithoutPose(order.piece);
  settling_s_[order.piece] = 0.0;
  answer_ = SiteAnswer::ready;
}

void Forceps::part(std::size_t from, std::size_t to) noexcept {
  torn_share_[to] = sites_[from] == nullptr ? torn_share_[from] : sites_[from]->hold.tornShare();
  sites_[to] = nullptr;
  settling_s_[from] = settling_s_[to] = 0.0;
}

/// Neither it nor bone was cut, restored or split since, and no other piece has moved.
bool Forceps::isReady(const Bodies& bodies, std::size_t piece) const noexcept {
  return sites_[piece] != nullptr && !bodies.isSetAside(piece) && made_of_[piece] == bodies.digestWithoutPose(piece);
}

/// The one that the beaks share most with; kNoPiece: none that is ready.
std::size_t Forceps::pieceAt(const Bodies& bodies, double radius_mm, const ToolPose& X_PT) const noexcept {
  std::size_t best = kNoPiece;
  double most_mm3 = 0.0;
  for (std::size_t n = 0; n < bodies.pieces(); ++n) {
    if (!isReady(bodies, n)) continue;
    const SolidBody body{bodies.bones()[n + 1].field(), bodies.isAtRest(n), bodies.pose(n)};
    const double shared_mm3 =
        sphereOverlap(body.field, body.inBody(calibration::Point<Patient>{X_PT.translation_mm}), radius_mm).volume_mm3;
    if (shared_mm3 <= most_mm3) continue;
    most_mm3 = shared_mm3;
    best = n;
  }
  return best;
}

void Forceps::letGo(Bodies& bodies) noexcept {
  held_.holds = false;
  const PieceSite& site = *sites_[held_.piece];
  if (held_.torn_share >= kAllTorn && movedBy_mm(site, bodies.pose(held_.piece)) >= ForcepsLaw::kClear_mm) {
    bodies.setAside(held_.piece);
    held_.set_aside = true;
  } else {
    settling_s_[held_.piece] = ForcepsLaw::kSettle_s;
  }
}

void Forceps::step(Bodies& bodies, double radius_mm, const ToolPose& beaks_X_PT, const ToolPose& hand_X_PT, bool closed,
                   double dt_s) noexcept {
  held_.torn_Nmm = held_.max_stored_Nmm = 0.0;
  held_.unsettled = held_.set_aside = false;
  const bool closes = closed && !was_closed_;
  was_closed_ = closed;
  if (held_.holds && !closed) letGo(bodies);
  if (closes && !held_.holds)
    if (const std::size_t piece = pieceAt(bodies, radius_mm, beaks_X_PT); piece != kNoPiece) {
      held_.holds = true;
      held_.piece = piece;
      grip_X_QT_ = bodies.pose(piece).inverse() * beaks_X_PT;
      // The hand is where the beaks are: no jump at the grip.
      slack_ = hand_X_PT.inverse() * beaks_X_PT;
      settling_s_[piece] = 0.0;
    }

  for (std::size_t n = 0; n < bodies.pieces(); ++n) {
    const bool is_held = held_.holds && held_.piece == n;
    if (!is_held && settling_s_[n] <= 0.0) continue;
    settling_s_[n] = std::max(0.0, settling_s_[n] - dt_s);
    PieceDrive drive;
    if (is_held) {
      drive.spring = {
          hand_X_PT * slack_ * grip_X_QT_.inverse(), {grip_X_QT_.translation_mm}, ForcepsLaw::kSpring_N_per_mm,
          ForcepsLaw::kSpring_Nmm_per_rad,           ForcepsLaw::kMost_N,         ForcepsLaw::kMost_Nmm};
    }
    const HoldTick tick = sites_[n]->hold.step(drive, &sites_[n]->obstacles, dt_s);
    if (!tick.refused) bodies.place(n, tick.X_PQ);
    held_.torn_Nmm += tick.torn_Nmm;
    held_.unsettled = held_.unsettled || tick.unsettled;
    if (!is_held) continue;
    held_.torn_share = tick.torn_share;
    held_.X_PT = bodies.pose(n) * grip_X_QT_;
    held_.on_piece = -1.0 * tick.on_hand;
    held_.felt = (1.0 / ForcepsLaw::kForceScale) * tick.on_hand;
    const double stretch_mm = glm::length(tick.on_hand.force_N.xyz) / ForcepsLaw::kSpring_N_per_mm;
    held_.max_stored_Nmm = 0.5 * glm::length(held_.felt.force_N.xyz) * stretch_mm;
  }
}

}  // namespace haptics
