// Bridges of tooth that break under load, each when its piece is levered or twisted. What the break leaves is planned
// on a worker (body/bridge_break) and ordered; it is carried out by tooth_split. An order holds for the bytes of its
// piece, wherever that lies: it is out of date while the piece is cut or broken, and holds again once that is undone.
// Frame P; N, N mm of the model. Servo thread; some hundred flops; no allocation, no throw.
#pragma once

#include <array>
#include <cstdint>

#include "haptics/body/bodies.h"
#include "haptics/body/break_plan.h"
#include "haptics/wrench.h"

namespace haptics {

/// Part of the Command. The plan is not recorded: it follows from the bodies with this digest, and from the bridge.
struct BreakOrder {
  std::uint64_t serial = 0;         ///< rises by one for every order
  std::uint64_t bodies_digest = 0;  ///< Bodies::digest() of what was looked at
  std::uint64_t piece = 0;          ///< that the bridge holds together
  std::uint64_t plan_digest = 0;    ///< BreakPlan::digest
  Bridge bridge;
  const BreakPlan* plan = nullptr;  ///< borrowed until a later one of this piece was taken over
};

enum class BreakAnswer : std::uint8_t {
  none = 0,
  armed = 1,
  refused = 2,   ///< the bodies have changed since, the plan is another or none, or no piece is left
  outdated = 3,  ///< the piece has been cut or broken since
  breaking = 4,  ///< its solid is on the way
};

/// A bridge that broke; in the tick in which it did.
struct BrokenBridge {
  std::uint8_t piece = 0;    ///< 1 + the piece that it held together; 0: none broke
  bool is_complete = false;  ///< false: it left a spur on the root
  double area_mm2 = 0.0;
  double force_N = 0.0;      ///< that pushed its slot apart, or of the grip
  double bending_Nmm = 0.0;  ///< about its centre

  bool operator==(const BrokenBridge&) const = default;
};

class ToothBreak {
 public:
  /// First in a tick: an order holds for the bodies as they are then, or not at all.
  void receive(const Bodies& bodies, const BreakOrder& order) noexcept;
  /// To the newest order.
  BreakAnswer answer(const Bodies& bodies) const noexcept;

  /// The loads of this tick, each of one piece, after reset(). An instrument that pushes the walls of its slot apart:
  void wedge(const Bodies& bodies, std::size_t piece, double wedging_N) noexcept;
  /// One that holds a piece on one side of the bridge, with `on_piece` about `at_P`. All of it goes through the bridge:
  /// what ligament and bone take on that side is left out.
  void grip(const Bodies& bodies, std::size_t piece, const Wrench<calibration::Patient>& on_piece,
            const calibration::Point<calibration::Patient>& at_P) noexcept;
  void reset() noexcept { share_ = 0.0, broken_ = {}; }

  /// The largest share of what breaks a bridge in this tick; 0: none is armed.
  double share() const { return share_; }
  /// Piece 0: none. The caller parts the piece by planOf() in this tick.
  const BrokenBridge& broken() const { return broken_; }
  const SplitPlan& planOf(std::size_t piece) const { return order_[piece].plan->split; }

 private:
  bool isArmed(const Bodies& bodies, std::size_t piece) const noexcept;
  void load(std::size_t piece, double share, double force_N, double bending_Nmm) noexcept;

  std::array<BreakOrder, kMaxPieces> order_{};  ///< by piece; plan null: none
  std::array<std::uint64_t, kMaxPieces> piece_digest_{};
  std::uint64_t serial_ = 0, piece_ = 0;  ///< of the newest order
  bool refused_ = false;
  double share_ = 0.0;
  BrokenBridge broken_;
};

}  // namespace haptics
