// The pieces of tooth in their sockets, as luxating instruments move them: the site in force of each
// (ligament/piece_site), what its ligament remembers, and what becomes of that when a site is replaced, a piece parts
// or a stroke is undone. A state that was put back waits for a site made from the same bytes of the piece; the piece
// is not ready until then. Frame P; N mm of the model. Servo thread; no allocation after construction, no throw; a move
// costs a step of PieceHold, a state 4 floats a sample.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "haptics/body/bodies.h"
#include "haptics/ligament/elevator_hold.h"
#include "haptics/ligament/piece_site.h"

namespace haptics {

/// Part of the Command: a piece made ready to be gripped. The site is not recorded: it follows from the bodies.
struct SiteOrder {
  std::uint64_t serial = 0;         ///< rises by one for every site
  std::uint64_t bodies_digest = 0;  ///< Bodies::digest() of what it was made from
  std::uint64_t piece = 0;
  PieceSite* site = nullptr;  ///< the servo's from now on, until a later one of this piece was taken over
};

enum class SiteAnswer : std::uint8_t {
  none = 0,
  ready = 1,
  refused = 2,  ///< the bodies have changed since, or a piece is held
};

inline constexpr double kLooseShare = 0.999;   ///< of the ligament torn: the piece is loose
inline constexpr double kOutOfPlace_mm = 6.0;  ///< a loose piece let go of so far from its place is set aside

/// Where a piece lies and what its ligament remembers, by value.
struct PieceMemory {
  PiecePose X_PQ;                  ///< in the bodies
  PiecePose hold_X_PQ;             ///< of the hold; may differ in the last bit
  std::size_t samples = 0;         ///< with ligament
  std::uint64_t piece_digest = 0;  ///< CarvedBone::digest() of the piece: other bytes have other samples
  double torn_share = 0.0;
  /// Of LigamentMemory: torn, fluid, strain, widened.
  std::array<std::array<float, kMostSamples>, 4> ligament{};
};

class PieceSites {
 public:
  static constexpr double kSettle_s = 0.3;  ///< a piece let go of springs back and rests

  /// Allocates.
  PieceSites() = default;

  bool isNew(const SiteOrder& order) const { return order.serial != order_.serial; }
  /// First in a tick: an order holds for the bodies as they are then, or not at all. `held`: an instrument holds a
  /// piece. `left`: this piece after the newest stroke that moved it, or null.
  void receive(const Bodies& bodies, const SiteOrder& order, bool held, const PieceMemory* left) noexcept;
  /// Of the newest order.
  SiteAnswer answer() const { return answer_; }
  /// A part of `from` becomes piece `to`: as much of its ligament is torn.
  void part(const Bodies& bodies, std::size_t from, std::size_t to) noexcept;

  /// What waits, for a copy without it (servo.h): while it is out, nothing else may be called.
  std::vector<PieceMemory> takeMemory() noexcept { return std::move(waiting_); }
  void giveMemory(std::vector<PieceMemory>&& waiting) noexcept { waiting_ = std::move(waiting); }
  /// The site in force of a piece; null: none.
  PieceSite* inForce(std::size_t piece) const noexcept { return sites_[piece]; }

  /// Neither it nor bone was cut, restored or split since its site was made, and no other piece has moved.
  bool isReady(const Bodies& bodies, std::size_t piece) const noexcept;
  /// Of a piece that has a site.
  const PieceSamples& samples(std::size_t piece) const noexcept { return sites_[piece]->hold.samples(); }
  /// What an elevator is among, there.
  ElevatorScene scene(std::size_t piece) const noexcept {
    return {&sites_[piece]->obstacles, &sites_[piece]->teeth, &sites_[piece]->piece};
  }
  /// Of the ligament; of a piece without a site, that of the piece it was part of.
  double tornShare(const Bodies& bodies, std::size_t piece) const noexcept;
  /// Since the start, less what was undone.
  double tornTotal_Nmm() const { return torn_total_Nmm_; }

  /// One tick of a piece that is ready, or was when the instrument took hold of it.
  HoldTick move(Bodies& bodies, std::size_t piece, const PieceDrive& drive, double dt_s) noexcept;
  /// The same under an elevator's blade.
  ElevatorTick lever(Bodies& bodies, std::size_t piece, ElevatorHold& blade, const ElevatorHand& hand,
                     double dt_s) noexcept;
  /// The instrument leaves it alone from now on: it settles, or (true) is set aside.
  bool letGo(Bodies& bodies, std::size_t piece) noexcept;
  bool isSettling(std::size_t piece) const noexcept { return settling_s_[piece] > 0.0; }
  bool areSettling() const noexcept;
  void stopSettling(std::size_t piece) noexcept { settling_s_[piece] = 0.0; }
  void stopSettling() noexcept { settling_s_.fill(0.0); }
  /// A tick of those left alone. True: the balance of one was not found.
  bool settle(Bodies& bodies, double dt_s) noexcept;

  /// Of a piece that has a site.
  void remember(const Bodies& bodies, std::size_t piece, PieceMemory& memory) const noexcept;
  /// The bytes of the piece must be those of that time when it is next made ready; else as much is torn everywhere.
  void putBack(Bodies& bodies, std::size_t piece, const PieceMemory& memory) noexcept;
  void putBackTornTotal(double torn_Nmm) noexcept { torn_total_Nmm_ = torn_Nmm; }

 private:
  /// What was put back, as long as the site in force is that of other bytes; else null.
  const PieceMemory* waitingFor(const Bodies& bodies, std::size_t piece) const noexcept;

  std::array<PieceSite*, kMaxPieces> sites_{};
  /// Of the bodies (digestWithoutPose()) and of the piece when its site was taken over: it holds for these.
  std::array<std::uint64_t, kMaxPieces> made_of_{}, piece_digest_{};
  std::array<double, kMaxPieces> torn_share_{};  ///< of a piece without a site yet
  std::array<double, kMaxPieces> settling_s_{};  ///< left for a piece that was let go of
  std::vector<PieceMemory> waiting_{kMaxPieces};
  std::array<bool, kMaxPieces> is_waiting_{};
  double torn_total_Nmm_ = 0.0;
  SiteOrder order_;
  SiteAnswer answer_ = SiteAnswer::none;
};

}  // namespace haptics
