// Undo and redo: the state of every block before each of the last strokes of the drill. A block is saved once per
// stroke, before its first write. Strokes of something else stand between them, marked (servo/luxation_strokes). Undo
// exchanges it with the block as it is, redo exchanges it again: every byte, its sums, and the bone's digest and
// removed volume follow. A new stroke drops what could be redone. Memory is allocated at construction: 15.6 MB and 4
// bytes per block of the bone. When it is full the oldest stroke is dropped whole; a stroke of more than a quarter of
// it counts as several. CarvedBone::blocksLeft is not restored. Servo thread; no allocation, no throw; save() about 30
// ns, undo() and redo() about 300 ns a block. Not a recording.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "haptics/bone/carved_bone.h"

namespace haptics {

class Filling;

/// Memory layout:
///
///   saved_     ring of 260-byte entries, at 260 n: solid u8 [64] | reach u8 [64] | dose u16 [64] | block u32
///   strokes_   ring of 200 (first entry, number of entries, of them undone) in saved_, and mark; the oldest at oldest_
///   saved_in_  u32 per block of all bones: number of the stroke that saved it last
///
///   saved_   | .. free .. | oldest stroke | ... | newest | undone stroke | ... | .. free .. |   contiguous, modulo
///   size
///                           \_____ count_ strokes ______/ \____ undone_ ____/
///   The newest of the count_ strokes may be undone in part, from its last entry backwards.
class StrokeHistory {
 public:
  static constexpr std::size_t kMaxStrokes = 200;
  static constexpr std::size_t kMaxBlocks = 60'000;

  /// Capacity for four times all bones, at most `max_blocks` (at least 4). A block's number counts on from bone to bone
  /// (CarvedBone::setFirstBlock), the filling last.
  explicit StrokeHistory(std::span<const CarvedBone> bones, std::size_t max_blocks = kMaxBlocks,
                         const Filling* filling = nullptr);
  explicit StrokeHistory(const CarvedBone& bone, std::size_t max_blocks = kMaxBlocks)
      : StrokeHistory(std::span(&bone, 1), max_blocks) {}

  /// Whether a block must be saved before it is written.
  bool needsSaving(std::size_t block) const { return saved_in_[block] != stroke_; }
  /// Begins a stroke if none is open; what was undone can no longer be redone.
  void save(std::size_t block, const BlockState& state) noexcept;
  /// Later saves belong to the newest stroke again, if there is one; what was undone can no longer be redone.
  void reopen() noexcept;
  /// Later saves belong to another stroke.
  void endStroke() noexcept;
  /// Adds a stroke of which more than blocks is kept, elsewhere, under its place(); what was undone can no longer be
  /// redone. Saves belong to it after reopen() only.
  void addMarked() noexcept;
  /// There must be one (assert).
  void dropOldest() noexcept;

  /// Number of strokes that can be undone, one undone in part included.
  std::size_t strokes() const { return count_; }
  /// Number of strokes that can be redone whole.
  std::size_t undoneStrokes() const { return undone_; }
  /// The newest stroke is undone in part.
  bool isBetweenStrokes() const { return count_ > 0 && newest().undone > 0; }
  /// Of stroke n: the oldest is 0, the first that can be redone strokes().
  bool isMarked(std::size_t n) const { return strokes_[place(n)].marked; }
  /// Below kMaxStrokes; no other stroke that can be undone or redone has it.
  std::size_t place(std::size_t n) const { return (oldest_ + n) % kMaxStrokes; }

  struct Restored {
    double volume_mm3 = 0.0;  ///< of bone and tooth; below 0: redone
    std::size_t blocks = 0;
  };
  /// Undoes up to `max_blocks` of the newest stroke, last saved first; ends the open stroke. The stroke is undone when
  /// strokes() has fallen by one. `bones` and `filling` are those of the constructor.
  Restored undo(std::span<CarvedBone> bones, std::size_t max_blocks, Filling* filling = nullptr) noexcept;
  Restored undo(CarvedBone& bone, std::size_t max_blocks) noexcept { return undo(std::span(&bone, 1), max_blocks); }
  /// Redoes up to `max_blocks` of the stroke undone in part, or else of the one undone last. It is redone when
  /// isBetweenStrokes() is false.
  Restored redo(std::span<CarvedBone> bones, std::size_t max_blocks, Filling* filling = nullptr) noexcept;
  Restored redo(CarvedBone& bone, std::size_t max_blocks) noexcept { return redo(std::span(&bone, 1), max_blocks); }

  /// The arrays, for a copy without them (servo/servo.h): while they are out, nothing else may be called.
  struct Saved {
    BlockState state;
    std::uint32_t block = 0;
  };
  struct Memory {
    std::vector<Saved> saved;
    std::vector<std::uint32_t> saved_in;
  };
  Memory takeMemory() noexcept { return {std::move(saved_), std::move(saved_in_)}; }
  void giveMemory(Memory&& memory) noexcept {
    saved_ = std::move(memory.saved);
    saved_in_ = std::move(memory.saved_in);
  }

  std::size_t bytes() const { return saved_.size() * sizeof(Saved) + saved_in_.size() * sizeof(std::uint32_t); }

 private:
  struct Stroke {
    std::size_t first = 0, blocks = 0, undone = 0;
    bool marked = false;
  };
  const Stroke& newest() const { return strokes_[(oldest_ + count_ - 1) % kMaxStrokes]; }
  Stroke& newest() { return strokes_[(oldest_ + count_ - 1) % kMaxStrokes]; }
  /// Exchanges an entry with the block as it is. Returns the solid steps of bone and tooth restored.
  std::int64_t exchange(std::span<CarvedBone> bones, Filling* filling, std::size_t entry) noexcept;
  void dropUndone() noexcept;
  void beginStroke(bool marked) noexcept;

  std::vector<Saved> saved_;
  std::vector<std::uint32_t> saved_in_;
  std::array<Stroke, kMaxStrokes> strokes_{};
  std::size_t oldest_ = 0, count_ = 0, undone_ = 0, saved_count_ = 0;
  std::uint32_t stroke_ = 1;  ///< number of the open stroke, or of the next
  bool open_ = false;
};

}  // namespace haptics
