#include "haptics/servo/forceps.h"

#include "haptics/contact/overlap.h"

namespace haptics {
namespace {

using calibration::Patient;

constexpr std::size_t kNoPiece = kMaxPieces;

}  // namespace

/// The one that the beaks share most with; kNoPiece: none that is ready.
std::size_t Forceps::pieceAt(const Bodies& bodies, const PieceSites& sites, double radius_mm,
                             const ToolPose& X_PT) const noexcept {
  std::size_t best = kNoPiece;
  double most_mm3 = 0.0;
  for (std::size_t n = 0; n < bodies.pieces(); ++n) {
    if (!sites.isReady(bodies, n)) continue;
    const SolidBody body{bodies.bones()[n + 1].field(), bodies.isAtRest(n), bodies.pose(n)};
    const double shared_mm3 =
        sphereOverlap(body.field, body.inBody(calibration::Point<Patient>{X_PT.translation_mm}), radius_mm).volume_mm3;
    if (shared_mm3 <= most_mm3) continue;
    most_mm3 = shared_mm3;
    best = n;
  }
  return best;
}

bool Forceps::grip(const Bodies& bodies, const PieceSites& sites, double radius_mm, const ToolPose& beaks_X_PT,
                   const ToolPose& hand_X_PT, bool closed, LedTool& held) noexcept {
  const bool closes = closed && !was_closed_;
  was_closed_ = closed;
  if (!closes) return false;
  const std::size_t piece = pieceAt(bodies, sites, radius_mm, beaks_X_PT);
  if (piece == kNoPiece) return false;
  held.leads = held.holds = true;
  held.piece = piece;
  grip_X_QT_ = bodies.pose(piece).inverse() * beaks_X_PT;
  // The hand is where the beaks are: no jump at the grip.
  slack_ = hand_X_PT.inverse() * beaks_X_PT;
  return true;
}

void Forceps::move(Bodies& bodies, PieceSites& sites, const ToolPose& hand_X_PT, bool closed, double dt_s,
                   LedTool& held) noexcept {
  was_closed_ = closed;
  if (!closed) {
    held.leads = held.holds = false;
    held.set_aside = sites.letGo(bodies, held.piece);
    return;
  }

  PieceDrive drive;
  drive.spring = {hand_X_PT * slack_ * grip_X_QT_.inverse(), {grip_X_QT_.translation_mm}, ForcepsLaw::kSpring_N_per_mm,
                  ForcepsLaw::kSpring_Nmm_per_rad,           ForcepsLaw::kMost_N,         ForcepsLaw::kMost_Nmm};
  const HoldTick tick = sites.move(bodies, held.piece, drive, dt_s);
  held.unsettled = tick.unsettled;
  held.torn_share = tick.torn_share;
  held.X_PT = bodies.pose(held.piece) * grip_X_QT_;
  held.gripped = -1.0 * tick.on_hand;
  held.felt = (1.0 / LedTool::kForceScale) * tick.on_hand;
  const double stretch_mm = glm::length(tick.on_hand.force_N.xyz) / ForcepsLaw::kSpring_N_per_mm;
  held.max_stored_Nmm = 0.5 * glm::length(held.felt.force_N.xyz) * stretch_mm;
}

}  // namespace haptics
