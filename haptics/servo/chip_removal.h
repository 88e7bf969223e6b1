// Chips that have come off bone or tooth leave the volumes, on command: at most kBlocksPerTick blocks a tick, while the
// tool touches nothing, and only from the bodies in which they were found (body/chip_search). From then on they are
// loose particles that nobody feels. The change belongs to the newest stroke (bone/stroke_history): its undo puts them
// back where they broke off. Servo thread; 1 to 2 us a block; no allocation, no throw.
#pragma once

#include <cstdint>

#include "haptics/body/bodies.h"
#include "haptics/body/chip_plan.h"
#include "haptics/bone/stroke_history.h"

namespace haptics {

/// Part of the Command. The plan is not recorded: it follows from the bodies at the start and those with this digest.
struct ChipOrder {
  std::uint64_t serial = 0;         ///< rises by one for every order
  std::uint64_t bodies_digest = 0;  ///< Bodies::digest() of what was looked at
  std::uint64_t plan_digest = 0;    ///< ChipPlan::digest
  const ChipPlan* plan = nullptr;   ///< borrowed until the answer is `done` or `refused`
};

enum class ChipAnswer : std::uint8_t {
  none = 0,
  waiting = 1,  ///< for the tool to be clear
  running = 2,
  done = 3,
  refused = 4,  ///< the bodies have changed since, or the plan is another or none
};

class ChipRemoval {
 public:
  static constexpr std::size_t kBlocksPerTick = 32;

  /// First in a tick: an order holds for the bodies as they are then, or not at all.
  void receive(const Bodies& bodies, const ChipOrder& order) noexcept;
  /// After the cut, while no piece parts. `clear`: the tool touches nothing solid and nothing is being undone. Returns
  /// the mm3 that left in this tick.
  double step(Bodies& bodies, bool clear, StrokeHistory& strokes) noexcept;

  /// Of the newest order.
  ChipAnswer answer() const { return answer_; }
  bool isRunning() const { return answer_ == ChipAnswer::running; }
  /// step() has changed the strokes in this tick.
  bool hasChanged() const { return changed_; }

 private:
  bool isPossible(const Bodies& bodies) const noexcept;

  ChipOrder order_;
  ChipAnswer answer_ = ChipAnswer::none;
  std::size_t bone_ = 0, next_ = 0;  ///< of the plan
  bool changed_ = false;
};

}  // namespace haptics
