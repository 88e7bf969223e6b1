#include "haptics/ligament/piece_site.h"

#include <algorithm>
#include <cmath>

#include "assets/tissue.h"

namespace haptics {
namespace {

constexpr double kBand_mm = 1.6;  // of the field: a piece is never deeper

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
  const glm::ivec3 last = glm::min(bodies.firstBrick() + tooth.bricks() + margin, jaw.bricks());
  first_brick_ = glm::max(bodies.firstBrick() - margin, glm::ivec3(0));
  const glm::ivec3 first = first_brick_ * assets::kBrickVoxels;
  grid_ = {glm::min(last * assets::kBrickVoxels, jaw.size) - first, jaw.spacing_mm, jaw.centre_P_mm(first)};
  bone_at_first_ = bodies.jaw().copyBox(first_brick_, grid_.size);
}

DistanceField SocketSource::firstSocket() const { return {grid_, bone_at_first_, kBand_mm}; }

SocketScene SocketSource::scene(std::size_t piece, std::span<const PiecePose, kMaxPieces> X_PQ) const {
  const CarvedBone& own = bodies_.bones()[piece + 1];
  SocketScene scene{grid_,
                    bodies_.jaw().copyBox(first_brick_, grid_.size),
                    own.grid(),
                    own.copyBox(glm::ivec3(0), own.grid().size),
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
  const std::vector<std::uint8_t> bytes = bone.copyBox(glm::ivec3(0), bone.grid().size);
  if (std::all_of(bytes.begin(), bytes.end(), [](std::uint8_t solid) { return solid == 0; })) return;
  const calibration::Pose<calibration::Piece, calibration::Patient> X_QP = X_PQ.inverse();
  assets::forVoxels(scene.around_grid, [&](glm::ivec3 ijk, std::size_t v) {
    const calibration::Point<calibration::Patient> p_P{scene.around_grid.centre_P_mm(ijk)};
    const glm::ivec3 at(glm::round(bone.grid().indexFromPoint((X_QP * p_P).mm)));
    if (!bone.grid().contains(at)) return;
    scene.around[v] = static_cast<std::uint8_t>(std::min(255, scene.around[v] + bytes[bone.grid().index(at)]));
  });
}

std::unique_ptr<PieceSite> makePieceSite(const SocketScene& scene, const DistanceField& first_socket,
                                         const LigamentLaw& law) {
  DistanceField now(scene.around_grid, scene.around, kBand_mm);
  PieceSamples samples = arranged(surfaceSamples({scene.piece_grid, scene.piece}, first_socket, rootOf(scene), law));
  SocketChange change = socketAfter(now, samples);
  double solid = 0.0;
  for (const std::uint8_t byte : scene.piece) solid += byte;
  return std::make_unique<PieceSite>(PieceSite{std::move(now), PieceHold(std::move(samples), law), std::move(change),
                                               solid / 255.0 * scene.piece_grid.voxelVolume_mm3()});
}

}  // namespace haptics
