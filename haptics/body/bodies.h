// The live volumes of a rehearsal: the jaw, the tooth to be removed as a body of its own from the start, later in up to
// kMaxPieces pieces, and what is laid into a tooth. Frame P, mm; a piece lies in its frame Q, which is P until it
// moves. One writer, the servo; other threads copy dirty bricks of single bones, and take poses and the number of
// pieces from the Tick. All pieces have the tooth's grid: a split moves solid from one to an empty one, block by block.
// While a piece is at rest, forces, cuts and pictures are those of one undivided volume. Construction divides the
// volume (assets/scan/tooth_division) and allocates; every other call but solidInGridOrder() is bounded and never
// allocates, locks or throws.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "assets/metal_fragment.h"
#include "haptics/body/solid_bodies.h"
#include "haptics/bone/carve.h"
#include "haptics/bone/carved_bone.h"
#include "haptics/bone/filling.h"

namespace haptics {

class Bodies {
 public:
  using PiecePose = calibration::Pose<calibration::Patient, calibration::Piece>;

  /// `solid` and `label` in the order of `grid`; label may be empty. `is_tooth`: not 0 in the voxels of the tooth to be
  /// removed; empty or all 0: the jaw alone. Copies all. Spans must fit the grid (assert).
  Bodies(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid, std::span<const std::uint8_t> label,
         std::span<const std::uint8_t> is_tooth = {});
  /// The jaw alone.
  explicit Bodies(CarvedBone jaw);

  /// Steel in the jaw from the beginning, which no tool cuts and root-canal files meet (file/file_fragments). Before a
  /// servo takes the bodies over; allocates.
  void leave(std::vector<assets::MetalFragment> fragments) { fragments_ = std::move(fragments); }
  std::span<const assets::MetalFragment> fragments() const { return fragments_; }

  /// The jaw first, then the pieces, also those that hold nothing yet.
  std::span<CarvedBone> bones() { return bones_; }
  std::span<const CarvedBone> bones() const { return bones_; }
  const CarvedBone& jaw() const { return bones_.front(); }
  /// What is laid into a tooth of a fine grid (bone/filling); null: of a jaw.
  Filling* filling() { return filling_ ? &*filling_ : nullptr; }
  const Filling* filling() const { return filling_ ? &*filling_ : nullptr; }
  /// Up to the last one that holds solid; the tooth itself always counts.
  std::size_t pieces() const;

  /// Of piece n, from 0, an empty one too. A rotation that is not of unit length is normalised. Writer only, with the
  /// servo stopped.
  void place(std::size_t piece, const PiecePose& X_PQ);
  const PiecePose& pose(std::size_t piece) const { return X_PQ_[piece]; }
  /// A pose() of before, to the bit. Writer only.
  void putBack(std::size_t piece, const PiecePose& X_PQ);
  bool isAtRest(std::size_t piece) const { return at_rest_[piece]; }
  static bool isRest(const PiecePose& X_PQ);
  /// Out of the mouth for good: far from everything, no longer met nor seen. Writer only.
  void setAside(std::size_t piece) { place(piece, {{1.0, 0.0, 0.0, 0.0}, glm::dvec3(kAside_mm)}); }
  bool isSetAside(std::size_t piece) const { return isAside(X_PQ_[piece]); }
  static bool isAside(const PiecePose& X_PQ) { return X_PQ.translation_mm.x >= kAside_mm; }

  /// Moves up to `given` of each voxel of a block of the tooth's grid from a piece to another that is where it is
  /// (CarvedBone::moveBlock). Writer only.
  void moveBlock(std::size_t from, std::size_t to, std::size_t block, std::span<const std::uint8_t, kBlockVoxels> given,
                 StrokeHistory* strokes = nullptr) noexcept;

  /// Takes up to `given` of each voxel of a block of a bone (in the order of bones()) away. Returns mm3. Writer only.
  double loseBlock(std::size_t bone, std::size_t block, std::span<const std::uint8_t, kBlockVoxels> given,
                   StrokeHistory* strokes = nullptr) noexcept;

  SolidBodies view() const { return view(true); }
  /// For what goes through filling that has not set.
  SolidBodies viewOfSet() const { return view(false); }

  /// The brick of a piece at rest under a brick of the jaw's grid; none: outside the tooth's grid.
  std::optional<glm::ivec3> brickOfPiece(glm::ivec3 brick) const;
  /// Brick of the jaw's grid where the tooth's begins.
  glm::ivec3 firstBrick() const { return first_brick_; }

  /// The jaw's grid, on which a piece at rest lies too.
  const assets::VolumeGrid& grid() const { return jaw().grid(); }

  /// The jaw's digest d alone, or with the pieces, in order:
  ///   d <- mixedBits(d xor piece's digest); then for each number x of its pose (rotation w, x, y, z, translation x, y,
  ///   z) d <- mixedBits(d xor bits of x)        mixedBits: calibration/random
  /// and with the filling's, where something is laid.
  std::uint64_t digest() const;
  /// The same as if this piece were at rest.
  std::uint64_t digestWithoutPose(std::size_t piece) const;

  /// Sum over the bodies, see CarvedBone; without the filling.
  std::array<double, assets::kTissueCount> removedByTissue_mm3() const noexcept;

  /// Bricks of the jaw's grid in which the jaw, a piece at rest or the filling has changed; may name a brick twice. One
  /// reading thread.
  void takeDirtyBricks(std::vector<glm::ivec3>& out);
  /// Solid fraction of jaw and pieces at rest, without the filling. O(voxels), allocates; writing thread, or without a
  /// writer.
  std::vector<std::uint8_t> solidInGridOrder() const;
  /// With moved pieces, too, where they came from, but for those set aside: what is still in the mouth.
  std::vector<std::uint8_t> solidInMouth() const;

 private:
  void numberBlocks();
  SolidBodies view(bool with_plastic) const;
  std::uint64_t digestAt(std::span<const PiecePose, kMaxPieces> X_PQ) const;
  template <class Counts>
  std::vector<std::uint8_t> solidWhere(const Counts& counts) const;

  static constexpr double kAside_mm = 10'000.0;

  std::vector<CarvedBone> bones_;
  std::vector<assets::MetalFragment> fragments_;
  std::array<PiecePose, kMaxPieces> X_PQ_{};
  std::array<bool, kMaxPieces> at_rest_{};
  std::optional<Filling> filling_;
  glm::ivec3 first_brick_{0};
};

/// bone/carve over all bodies: a step with a head of any shape at rest at X_PT. What is taken of a filling stands by
/// its label alone, not in the sum.
CarveResult carveTool(Bodies& bodies, const BurShape& head,
                      const calibration::Pose<calibration::Patient, calibration::Tool>& X_PT, const ErosionStep& step,
                      std::uint64_t tick, int interleave = 1, StrokeHistory* strokes = nullptr) noexcept;

}  // namespace haptics
