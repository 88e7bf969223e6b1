// A piece of tooth made ready to be moved: what is around it as a distance field, and its hold in the socket. Made on a
// worker from a copy of the bodies, used by the servo. The same bytes give the same bits. Frame P, mm.
// For a molar at 0.25 mm (haptics_extraction_bench site): scene() 8 ms, main thread or a replay; firstSocket() and
// makePieceSite() 0.1 s each, any thread. All allocate.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "haptics/body/bodies.h"
#include "haptics/body/distance_field.h"
#include "haptics/ligament/piece_hold.h"

namespace haptics {

struct PieceSite {
  DistanceField obstacles;  ///< jaw, its other teeth, the other pieces
  DistanceField teeth;      ///< the jaw's other teeth alone, where they are; the band if there are none
  DistanceField piece;      ///< of the piece itself, frame Q
  PieceHold hold;           ///< unworn, at rest, in the first socket
  SocketChange change;      ///< of the socket since then, to be met
  double volume_mm3 = 0.0;
};

/// Bytes of the bodies around the tooth, in the order of their grids.
struct SocketScene {
  assets::VolumeGrid around_grid;
  std::vector<std::uint8_t> around;  ///< all but the piece
  assets::VolumeGrid piece_grid;
  std::vector<std::uint8_t> piece, label;  ///< of the piece
  assets::VolumeGrid teeth_grid;           ///< around the other teeth
  std::vector<std::uint8_t> teeth;
};

class SocketSource {
 public:
  static constexpr double kMargin_mm = 5.0;  ///< around the tooth

  /// Before the first cut. Borrows the bodies. Without a tooth: scene() must not be called.
  explicit SocketSource(const Bodies& bodies);

  /// The jaw when the rehearsal began: what has ligament is decided by it.
  DistanceField firstSocket() const;
  /// As the bodies are, or as a reading thread sees them: whole only if nothing wrote meanwhile. The other pieces lie
  /// where `X_PQ` says.
  SocketScene scene(std::size_t piece, std::span<const PiecePose, kMaxPieces> X_PQ) const;

 private:
  void findTeeth();
  void addPiece(std::size_t piece, const PiecePose& X_PQ, SocketScene& scene) const;

  const Bodies& bodies_;
  assets::VolumeGrid grid_;
  glm::ivec3 first_brick_{0};
  std::vector<std::uint8_t> bone_at_first_;
  assets::VolumeGrid teeth_grid_;
  glm::ivec3 teeth_first_{0};           ///< voxel of grid_ where that begins
  std::vector<std::uint8_t> is_teeth_;  ///< labels do not change
};

/// `first_socket`: of the scene's source.
std::unique_ptr<PieceSite> makePieceSite(const SocketScene& scene, const DistanceField& first_socket,
                                         const LigamentLaw& law = {});

}  // namespace haptics
