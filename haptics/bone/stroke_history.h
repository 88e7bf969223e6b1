// What the bone was before each of the last strokes of the drill, block by block, so that they can be taken back, the
// newest first. A block is saved once a stroke, before it is first written; giving it back restores every byte of it,
// its sums, and the bone's digest and removed volume. Room is set aside at construction and never grows: 15.6 MB and 4
// bytes for each block of the bone. When it is full the oldest stroke is forgotten, always as a whole; a stroke of
// more than a quarter of the room counts as several, each taken back by itself. So what comes back is always a bone
// that once was, and never half a block. Only the reserve for precise cutting (CarvedBone::blocksLeft) does not come
// back. Servo thread; no allocation, no throw; save() some 30 ns, restore() some 300 ns a block. Not a recording.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "haptics/bone/carved_bone.h"

namespace haptics {

class StrokeHistory {
 public:
  static constexpr std::size_t kMaxStrokes = 32;
  static constexpr std::size_t kMaxBlocks = 60'000;  ///< of 260 bytes

  /// Room for four times the whole bone, at most for `max_blocks` (at least 4).
  explicit StrokeHistory(const CarvedBone& bone, std::size_t max_blocks = kMaxBlocks);

  /// Whether a block has to be saved before it is written.
  bool needsSaving(std::size_t block) const { return saved_in_[block] != stroke_; }
  /// Begins a stroke if none is on.
  void save(std::size_t block, const BlockState& state) noexcept;
  /// What is saved from now on belongs to another stroke.
  void endStroke() noexcept;

  /// That can be taken back.
  std::size_t strokes() const { return count_; }

  struct Restored {
    double volume_mm3 = 0.0;
    std::size_t blocks = 0;
  };
  /// Gives back up to `max_blocks` of the newest stroke, its last first, and forgets them; ends the stroke that is on.
  /// The stroke has come back when strokes() has fallen by one. Only for the bone this was made for.
  Restored restore(CarvedBone& bone, std::size_t max_blocks) noexcept;

  std::size_t bytes() const { return saved_.size() * sizeof(Saved) + saved_in_.size() * sizeof(std::uint32_t); }

 private:
  struct Saved {
    BlockState state;
    std::uint32_t block = 0;
  };
  struct Stroke {
    std::size_t first = 0, blocks = 0;  ///< places in saved_, which is a ring
  };
  Stroke& newest() { return strokes_[(oldest_ + count_ - 1) % kMaxStrokes]; }
  void forgetOldest() noexcept;
  void beginStroke() noexcept;

  std::vector<Saved> saved_;
  std::vector<std::uint32_t> saved_in_;  ///< by block: the stroke that saved it last
  std::array<Stroke, kMaxStrokes> strokes_{};
  std::size_t oldest_ = 0, count_ = 0, saved_count_ = 0;
  std::uint32_t stroke_ = 1;  ///< the one that is on, or the next
  bool on_ = false;
};

}  // namespace haptics
