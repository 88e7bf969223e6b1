// A piece of tooth that has fallen apart becomes two, on command: its part moves to the next empty piece, at most
// kBlocksPerTick blocks a tick, so that 300 mm3 take some 30 ms. Both stay where they are, so no force and no picture
// changes. It begins when the tool touches nothing, and only on the bodies from which the plan was made. The change
// belongs to the newest stroke (bone/stroke_history): its undo joins the pieces again. A bridge that breaks
// (servo/tooth_break) parts its piece alike, at once. Servo thread; 1 to 2 us a block (haptics_extraction_bench site);
// no allocation, no throw.
#pragma once

#include <cstdint>
#include <optional>

#include "haptics/body/bodies.h"
#include "haptics/body/split_plan.h"
#include "haptics/bone/stroke_history.h"

namespace haptics {

/// Part of the Command. A plan is not recorded: it follows from the bodies with this digest (partingPlan).
struct SplitOrder {
  std::uint64_t serial = 0;         ///< rises by one for every split
  std::uint64_t bodies_digest = 0;  ///< Bodies::digest() of what was looked at
  std::uint64_t piece = 0;          ///< that comes apart
  const SplitPlan* plan = nullptr;  ///< borrowed until the answer is `done` or `refused`
};

enum class SplitAnswer : std::uint8_t {
  none = 0,
  waiting = 1,  ///< for the tool to be clear
  running = 2,
  done = 3,
  refused = 4,  ///< the bodies have changed since, there is no plan, or no piece is left
};

class ToothSplit {
 public:
  static constexpr std::size_t kBlocksPerTick = 32;

  /// First in a tick: an order holds for the bodies as they are then, or not at all.
  void receive(const Bodies& bodies, const SplitOrder& order) noexcept;
  /// Of a piece whose bridge breaks, before step(), while none runs and there is room for another piece; the plan is
  /// borrowed while isRunning().
  void breakOff(Bodies& bodies, std::size_t piece, const SplitPlan& plan, StrokeHistory& strokes) noexcept;
  /// After the cut. `clear`: the tool touches nothing solid and nothing is being undone. True: the strokes have
  /// changed.
  bool step(Bodies& bodies, bool clear, StrokeHistory& strokes) noexcept;

  /// Of the newest order.
  SplitAnswer answer() const { return answer_; }
  bool isRunning() const { return plan_ != nullptr; }
  bool isBreaking() const { return isRunning() && answer_ != SplitAnswer::running; }
  /// The pieces of a split that began in this tick's step().
  struct Begun {
    std::size_t from = 0, to = 0;
  };
  std::optional<Begun> begun() const { return begun_; }

 private:
  bool isPossible(const Bodies& bodies) const noexcept;
  void begin(Bodies& bodies, std::size_t piece, const SplitPlan& plan, StrokeHistory& strokes) noexcept;

  SplitOrder order_;
  SplitAnswer answer_ = SplitAnswer::none;
  const SplitPlan* plan_ = nullptr;           ///< that runs; null: none
  std::size_t from_ = 0, to_ = 0, next_ = 0;  ///< pieces; block of the plan
  bool has_just_begun_ = false;
  std::optional<Begun> begun_;
};

}  // namespace haptics
