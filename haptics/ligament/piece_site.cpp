#include "haptics/ligament/piece_site.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "assets/tissue.h"
#include "haptics/body/components.h"

namespace haptics {
namespace {

constexpr double kBand_mm = 1.6;  // of the field: a piece is never deeper

/// All bricks of `grid`, whose first brick is `first` of the bone's.
std::vector<std::uint8_t> bytesOf(const CarvedBone& bone, const assets::VolumeGrid& grid, glm::ivec3 first) {
  std::vector<std::uint8_t> bytes(grid.voxelCount());
  forBricks(grid.bricks(), [&](std::size_t, glm::ivec3 corner) {
    std::array<std::uint8_t, 512> brick{};
    bone.copyBrick(first + corner / assets::kBrickVoxels, brick);
    std::size_t n = 0;
    assets::forVoxels(corner, corner + assets::kBrickVoxels, [&](glm::ivec3 ijk) {
      const std::uint8_t solid = brick[n++];
      if (grid.contains(ijk)) bytes[grid.index(ijk)] = solid;
    });
  });
  return bytes;
}

/// Dentine has fibres; enamel, pulp and what was cut have none, as no bone lies in front of them.
IsRoot rootOf(const SocketScene& scene) {
  return [&scene](const glm::dvec3& p_Q_mm, const glm::dvec3& outward) {
    const glm::ivec3 ijk(glm::round(scene.piece_grid.indexFromPoint(p_Q_mm - 0.3 * outward)));
    return scene.label.empty() || (scene.piece_grid.contains(ijk) && scene.label[scene.piece_grid.index(ijk)] ==
                                                                         static_cast<int>(assets::Tissue::dentine));
  };
}

}  // namespace

SocketSource::SocketSource(const Bodies& bodies) : bodies_(bodies) {
  if (bodies.bones().size() < 2) return;
  const assets::VolumeGrid &jaw = bodies.grid(), &tooth = bodies.bones()[1].grid();
  constexpr double kMostBricks = 64.0;
  const int margin =
      static_cast<int>(std::ceil(std::min(kMargin_mm / jaw.spacing_mm / assets::kBrickVoxels, kMostBricks)));
  const glm::ivec3 tooth_at(glm::round(jaw.indexFromPoint(tooth.centre_P_mm({0, 0, 0}))));
  const glm::ivec3 last = glm::min(tooth_at / assets::kBrickVoxels + tooth.bricks() + margin, jaw.bricks());
  first_brick_ = glm::max(tooth_at / assets::kBrickVoxels - margin, glm::ivec3(0));
  const glm::ivec3 first = first_brick_ * assets::kBrickVoxels;
  grid_ = {glm::min(last * assets::kBrickVoxels, jaw.size) - first, jaw.spacing_mm, jaw.centre_P_mm(first)};
  bone_at_first_ = bytesOf(bodies.jaw(), grid_, first_brick_);
}

SocketScene SocketSource::scene(std::size_t piece, std::span<const PiecePose, kMaxPieces> X_PQ) const {
  const CarvedBone& own = bodies_.bones()[piece + 1];
  SocketScene scene{grid_,
                    bone_at_first_,
                    bytesOf(bodies_.jaw(), grid_, first_brick_),
                    own.grid(),
                    bytesOf(own, own.grid(), glm::ivec3(0)),
                    {}};
  if (const SolidField field = own.field(); field.label != nullptr) {
    scene.label.resize(scene.piece.size());
    assets::forVoxels(own.grid(), [&](glm::ivec3 ijk, std::size_t v) { scene.label[v] = field.labelAt(ijk); });
  }
  for (std::size_t other = 0; other + 1 < bodies_.bones().size(); ++other)
    if (other != piece) addPiece(other, X_PQ[other], scene);
  return scene;
}

/// The nearest voxel counts: a third of a voxel of error is the field's own.
void SocketSource::addPiece(std::size_t piece, const PiecePose& X_PQ, SocketScene& scene) const {
  const CarvedBone& bone = bodies_.bones()[piece + 1];
  const std::vector<std::uint8_t> bytes = bytesOf(bone, bone.grid(), glm::ivec3(0));
  if (std::all_of(bytes.begin(), bytes.end(), [](std::uint8_t solid) { return solid == 0; })) return;
  const calibration::Pose<calibration::Piece, calibration::Patient> X_QP = X_PQ.inverse();
  assets::forVoxels(scene.around_grid, [&](glm::ivec3 ijk, std::size_t v) {
    const calibration::Point<calibration::Patient> p_P{scene.around_grid.centre_P_mm(ijk)};
    const glm::ivec3 at(glm::round(bone.grid().indexFromPoint((X_QP * p_P).mm)));
    if (!bone.grid().contains(at)) return;
    scene.around[v] = static_cast<std::uint8_t>(std::min(255, scene.around[v] + bytes[bone.grid().index(at)]));
  });
}

std::unique_ptr<PieceSite> makePieceSite(const SocketScene& scene, const LigamentLaw& law) {
  const DistanceField first(scene.around_grid, scene.bone_at_first, kBand_mm);
  DistanceField now(scene.around_grid, scene.around, kBand_mm);
  PieceSamples samples = arranged(surfaceSamples({scene.piece_grid, scene.piece}, first, rootOf(scene), law));
  const SocketChange change = socketAfter(now, samples);
  double solid = 0.0;
  for (const std::uint8_t byte : scene.piece) solid += byte;
  auto site = std::make_unique<PieceSite>(PieceSite{std::move(now), PieceHold(std::move(samples), law),
                                                    solid / 255.0 * scene.piece_grid.voxelVolume_mm3()});
  site->hold.meet(change);
  return site;
}

}  // namespace haptics
