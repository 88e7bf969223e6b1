#include "haptics/body/bodies.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <utility>

#include "assets/scan/tooth_division.h"
#include "calibration/random.h"

namespace haptics {

bool Bodies::isRest(const PiecePose& X_PQ) {
  return X_PQ.rotation == glm::dquat(1.0, 0.0, 0.0, 0.0) && X_PQ.translation_mm == glm::dvec3(0.0);
}

Bodies::Bodies(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid, std::span<const std::uint8_t> label,
               std::span<const std::uint8_t> is_tooth) {
  bones_.reserve(kMaxBodies);
  if (is_tooth.empty()) {
    bones_.emplace_back(grid, solid, label);
  } else {
    const assets::ToothDivision divided = assets::divideByTooth(grid, solid, label, is_tooth);
    bones_.emplace_back(grid, divided.jaw.solid, divided.jaw.label, BlockStorage::dense);
    if (!divided.tooth.solid.empty()) {
      bones_.emplace_back(divided.tooth.grid, divided.tooth.solid, divided.tooth.label, BlockStorage::dense);
      while (bones_.size() < kMaxBodies)
        bones_.push_back(CarvedBone::emptied(divided.tooth.grid, divided.tooth.solid, divided.tooth.label));
    }
    first_brick_ = divided.first_brick;
  }
  at_rest_.fill(true);
  numberBlocks();
}

Bodies::Bodies(CarvedBone jaw) {
  bones_.reserve(kMaxBodies);
  bones_.push_back(std::move(jaw));
  at_rest_.fill(true);
  numberBlocks();
}

/// One numbering for the stroke history, of the filling last.
void Bodies::numberBlocks() {
  std::size_t first = 0;
  for (CarvedBone& bone : bones_) {
    bone.setFirstBlock(first);
    first += bone.blocks();
  }
  if (!isFillable(grid())) return;
  filling_.emplace(grid());
  filling_->setFirstBlock(first);
}

std::size_t Bodies::pieces() const {
  std::size_t last = bones_.size() - 1;
  while (last > 1 && bones_[last].isEmpty()) --last;
  return last;
}

void Bodies::moveBlock(std::size_t from, std::size_t to, std::size_t block,
                       std::span<const std::uint8_t, kBlockVoxels> given, StrokeHistory* strokes) noexcept {
  assert(from != to && isAtRest(from) == isAtRest(to));
  bones_[from + 1].moveBlock(block, given, bones_[to + 1], strokes);
}

double Bodies::loseBlock(std::size_t bone, std::size_t block, std::span<const std::uint8_t, kBlockVoxels> given,
                         StrokeHistory* strokes) noexcept {
  const std::int64_t steps = bones_[bone].loseBlock(block, given, strokes);
  return static_cast<double>(steps) * grid().voxelVolume_mm3() / 255.0;
}

void Bodies::place(std::size_t piece, const PiecePose& X_PQ) {
  assert(piece + 1 < bones_.size());
  assert(calibration::isFinite(X_PQ.translation_mm) && glm::length(X_PQ.rotation) > 0.5);
  putBack(piece, {glm::normalize(X_PQ.rotation), X_PQ.translation_mm});
}

void Bodies::putBack(std::size_t piece, const PiecePose& X_PQ) {
  X_PQ_[piece] = X_PQ;
  at_rest_[piece] = isRest(X_PQ);
}

SolidBodies Bodies::view(bool with_plastic) const {
  SolidBodies view(jaw().field());
  for (std::size_t n = 0; n < pieces(); ++n) view.add({bones_[n + 1].field(), at_rest_[n], X_PQ_[n]});
  if (!filling_) return view;
  if (with_plastic && !filling_->isEmpty()) view.add({filling_->field(), true, {}});
  if (!with_plastic && filling_->hasSet()) view.add({filling_->setField(), true, {}});
  return view;
}

std::optional<glm::ivec3> Bodies::brickOfPiece(glm::ivec3 brick) const {
  if (bones_.size() < 2) return {};
  const glm::ivec3 own = brick - first_brick_, bricks = bones_[1].grid().bricks();
  if (glm::any(glm::lessThan(own, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(own, bricks))) return {};
  return own;
}

std::uint64_t Bodies::digest() const { return digestAt(X_PQ_); }

std::uint64_t Bodies::digestWithoutPose(std::size_t piece) const {
  std::array<PiecePose, kMaxPieces> X_PQ = X_PQ_;
  X_PQ[piece] = {};
  return digestAt(X_PQ);
}

std::uint64_t Bodies::digestAt(std::span<const PiecePose, kMaxPieces> X_PQ) const {
  std::uint64_t digest = jaw().digest();
  const auto mix = [&](std::uint64_t bits) { digest = calibration::mixedBits(digest ^ bits); };
  for (std::size_t n = 0; n < pieces(); ++n) {
    const glm::dquat& r = X_PQ[n].rotation;
    const glm::dvec3& t = X_PQ[n].translation_mm;
    mix(bones_[n + 1].digest());
    for (const double number : {r.w, r.x, r.y, r.z, t.x, t.y, t.z}) mix(std::bit_cast<std::uint64_t>(number));
  }
  if (filling_ && filling_->digest() != 0) mix(filling_->digest());
  return digest;
}

std::array<double, assets::kTissueCount> Bodies::removedByTissue_mm3() const noexcept {
  std::array<double, assets::kTissueCount> removed_mm3 = jaw().removedByTissue_mm3();
  for (const CarvedBone& piece : bones().subspan(1)) {
    const auto part_mm3 = piece.removedByTissue_mm3();
    for (std::size_t tissue = 0; tissue < removed_mm3.size(); ++tissue) removed_mm3[tissue] += part_mm3[tissue];
  }
  return removed_mm3;
}

void Bodies::takeDirtyBricks(std::vector<glm::ivec3>& out) {
  bones_.front().dirtyBricks().takeInto(out);
  for (std::size_t n = 0; n + 1 < bones_.size(); ++n) {
    const std::size_t first = out.size();
    bones_[n + 1].dirtyBricks().takeInto(out);
    for (std::size_t at = first; at < out.size(); ++at) out[at] += first_brick_;
  }
  if (filling_) filling_->dirtyBricks().takeInto(out);
}

std::vector<std::uint8_t> Bodies::solidInGridOrder() const {
  return solidWhere([this](std::size_t n) { return at_rest_[n]; });
}

std::vector<std::uint8_t> Bodies::solidInMouth() const {
  return solidWhere([this](std::size_t n) { return !isSetAside(n); });
}

template <class Counts>
std::vector<std::uint8_t> Bodies::solidWhere(const Counts& counts) const {
  std::vector<std::uint8_t> solid = jaw().solidInGridOrder();
  for (std::size_t n = 0; n + 1 < bones_.size(); ++n) {
    if (!counts(n)) continue;
    const SolidField piece = bones_[n + 1].field();
    const glm::ivec3 first = first_brick_ * assets::kBrickVoxels;
    assets::forVoxels(first, glm::min(first + piece.grid.size, grid().size), [&](glm::ivec3 ijk) {
      std::uint8_t& at = solid[grid().index(ijk)];
      at = static_cast<std::uint8_t>(std::min(255, at + piece.solidAt(ijk - first)));
    });
  }
  return solid;
}

CarveResult carveTool(Bodies& bodies, const BurShape& head,
                      const calibration::Pose<calibration::Patient, calibration::Tool>& X_PT, const ErosionStep& step,
                      std::uint64_t tick, int interleave, StrokeHistory* strokes) noexcept {
  CarveResult removed = carveTool(bodies.bones().front(), head, X_PT, step, tick, interleave, strokes);
  for (std::size_t n = 0; n < bodies.pieces(); ++n) {
    const SolidBody body{{}, bodies.isAtRest(n), bodies.pose(n)};
    ErosionStep turned = step;
    if (!body.at_rest) turned.axis_P.xyz = glm::conjugate(body.X_PQ.rotation) * step.axis_P.xyz;
    removed += carveTool(bodies.bones()[n + 1], head, body.inBody(X_PT), turned, tick, interleave, strokes);
  }
  if (Filling* const filling = bodies.filling(); filling != nullptr && !filling->isEmpty()) {
    CarveResult of_filling = carveTool(*filling, head, X_PT, step, tick, interleave, strokes);
    of_filling.removed_mm3 = 0.0;
    removed += of_filling;
  }
  return removed;
}

}  // namespace haptics
