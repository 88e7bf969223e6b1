#include "haptics/ligament/piece_site.h"

#include <algorithm>
#include <cmath>

#include "assets/tissue.h"

namespace haptics {
namespace {

constexpr double kBand_mm = 1.6;  // of the field: a piece is never deeper

int bandVoxels(double spacing_mm) { return static_cast<int>(std::ceil(kBand_mm / spacing_mm)) + 1; }

struct Crop {
  glm::ivec3 first{1 << 20}, end{-1};

  void add(glm::ivec3 ijk) {
    first = glm::min(first, ijk);
    end = glm::max(end, ijk + 1);
  }
  /// Without a voxel: a small one.
  Crop widened(int by) const {
    if (end.x < 0) return {glm::ivec3(0), glm::ivec3(2)};
    return {first - by, end + by};
  }
  assets::VolumeGrid of(const assets::VolumeGrid& grid) const {
    return {end - first, grid.spacing_mm, grid.centre_P_mm(first)};
  }
};

/// Of the piece and the band around it, also beyond its grid.
DistanceField fieldOf(const SocketScene& scene) {
  const assets::VolumeGrid& grid = scene.piece_grid;
  Crop box;
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (scene.piece[v] != 0) box.add(ijk);
  });
  box = box.widened(bandVoxels(grid.spacing_mm));
  const assets::VolumeGrid around = box.of(grid);
  std::vector<std::uint8_t> solid(around.voxelCount(), 0);
  assets::forVoxels(around, [&](glm::ivec3 ijk, std::size_t v) {
    if (grid.contains(box.first + ijk)) solid[v] = scene.piece[grid.index(box.first + ijk)];
  });
  return {around, solid, kBand_mm};
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
  const glm::ivec3 last = glm::min(bodies.firstBrick() + tooth.bricks() + margin, jaw.bricks());
  first_brick_ = glm::max(bodies.firstBrick() - margin, glm::ivec3(0));
  const glm::ivec3 first = first_brick_ * assets::kBrickVoxels;
  grid_ = {glm::min(last * assets::kBrickVoxels, jaw.size) - first, jaw.spacing_mm, jaw.centre_P_mm(first)};
  bone_at_first_ = bodies.jaw().copyBox(first_brick_, grid_.size);
  findTeeth();
}

/// The jaw holds no voxel of the tooth that comes out, so its teeth are the others.
void SocketSource::findTeeth() {
  const SolidField jaw = bodies_.jaw().field();
  const glm::ivec3 first = first_brick_ * assets::kBrickVoxels;
  const auto is_teeth = [&](glm::ivec3 ijk) { return assets::isTooth(jaw.labelAt(first + ijk)); };
  Crop box;
  assets::forVoxels(grid_, [&](glm::ivec3 ijk, std::size_t v) {
    if (bone_at_first_[v] != 0 && is_teeth(ijk)) box.add(ijk);
  });
  // No further than the jaw's own box: beyond it teeth go on as at its side.
  box = box.widened(bandVoxels(grid_.spacing_mm));
  box.first = glm::max(box.first, glm::ivec3(0));
  box.end = glm::max(glm::min(box.end, grid_.size), box.first + 2);
  teeth_first_ = box.first;
  teeth_grid_ = box.of(grid_);
  is_teeth_.resize(teeth_grid_.voxelCount());
  assets::forVoxels(teeth_grid_, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::ivec3 at = teeth_first_ + ijk;
    is_teeth_[v] = grid_.contains(at) && is_teeth(at) ? 1 : 0;
  });
}

DistanceField SocketSource::firstSocket() const { return {grid_, bone_at_first_, kBand_mm}; }

SocketScene SocketSource::scene(std::size_t piece, std::span<const PiecePose, kMaxPieces> X_PQ) const {
  const CarvedBone& own = bodies_.bones()[piece + 1];
  SocketScene scene;
  scene.around_grid = grid_;
  scene.around = bodies_.jaw().copyBox(first_brick_, grid_.size);
  scene.piece_grid = own.grid();
  scene.piece = own.copyBox(glm::ivec3(0), own.grid().size);
  scene.teeth_grid = teeth_grid_;
  scene.teeth.resize(is_teeth_.size());
  assets::forVoxels(teeth_grid_, [&](glm::ivec3 ijk, std::size_t v) {
    if (is_teeth_[v] != 0) scene.teeth[v] = scene.around[grid_.index(teeth_first_ + ijk)];
  });
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
  return std::make_unique<PieceSite>(PieceSite{std::move(now), DistanceField(scene.teeth_grid, scene.teeth, kBand_mm),
                                               fieldOf(scene), PieceHold(std::move(samples), law), std::move(change),
                                               solid / 255.0 * scene.piece_grid.voxelVolume_mm3()});
}

}  // namespace haptics
