// Strokes of instruments that move pieces of tooth, on the stack of the bur's (bone/stroke_history), so that strokes of
// any kind are undone in order. Of each: pose and ligament of the pieces it moved, before it and when it had ended. A
// stroke begins when an instrument takes hold and ends when all pieces have settled, or when something else begins.
// Frame P. Servo thread; allocates 12.6 MB when made for a tooth, nothing after. For up to kMostKept pieces in all
// strokes: then the oldest stroke that moved one is dropped, with everything older. A piece costs up to 64 kB of
// copying, 6 us.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "haptics/bone/stroke_history.h"
#include "haptics/servo/piece_sites.h"

namespace haptics {

class LuxationStrokes {
 public:
  static constexpr std::size_t kMostKept = 96;

  explicit LuxationStrokes(const Bodies& bodies) : kept_(bodies.bones().size() > 1 ? kMostKept : 0) {}

  /// Of an instrument that takes hold of `piece`. The open one ends; what settles goes on in this one. What was undone
  /// can no longer be redone.
  void begin(StrokeHistory& strokes, const Bodies& bodies, PieceSites& sites, std::size_t piece) noexcept;
  /// Before a piece moves for the first time in the open stroke; after that nothing.
  void keep(StrokeHistory& strokes, const Bodies& bodies, const PieceSites& sites, std::size_t piece) noexcept;
  /// Of the open one, if any: what has not settled stays where it is.
  void end(const Bodies& bodies, PieceSites& sites) noexcept;
  bool isOpen() const { return open_.has_value(); }

  /// What the marked stroke at this place of the history did; it must have ended.
  void undo(std::size_t place, Bodies& bodies, PieceSites& sites) const noexcept;
  void redo(std::size_t place, Bodies& bodies, PieceSites& sites) const noexcept;

  /// A piece after the newest stroke that moved it, of those that have ended and are not undone; null: none. Valid
  /// until the next call that is not const.
  const PieceMemory* newestOf(const StrokeHistory& strokes, std::size_t piece) const noexcept;

  std::size_t bytes() const;

  struct Kept {
    std::size_t piece = 0;
    PieceMemory before, after;
  };
  /// What is kept, for a copy without it (servo.h): while it is out, nothing else may be called.
  std::vector<Kept> takeMemory() noexcept { return std::move(kept_); }
  void giveMemory(std::vector<Kept>&& kept) noexcept { kept_ = std::move(kept); }

 private:
  struct Stroke {
    std::size_t first = 0, pieces = 0;  ///< numbers of its pieces, counting on; piece n is at kept_[n % size]
    double torn_before_Nmm = 0.0, torn_after_Nmm = 0.0;
  };
  const Kept& kept(const Stroke& stroke, std::size_t n) const { return kept_[(stroke.first + n) % kept_.size()]; }
  void close(const Bodies& bodies, const PieceSites& sites) noexcept;
  Kept& kept(const Stroke& stroke, std::size_t n) { return kept_[(stroke.first + n) % kept_.size()]; }

  std::vector<Kept> kept_;
  std::array<Stroke, StrokeHistory::kMaxStrokes> strokes_{};  ///< by place
  std::optional<std::size_t> open_;                           ///< place
};

}  // namespace haptics
