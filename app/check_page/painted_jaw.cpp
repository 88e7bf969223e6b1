#include "app/check_page/painted_jaw.h"

#include <cassert>
#include <utility>

namespace app {

PaintedJaw::PaintedJaw(const assets::CtVolume& ct, assets::JawSegmentation stored, std::size_t most_bytes)
    : ct_(ct), jaw_(std::move(stored)), most_bytes_(most_bytes) {}

void PaintedJaw::take(assets::JawSegmentation found) {
  jaw_ = std::move(found);
  found_teeth_ = jaw_.teeth;
  counts_ = assets::toothCounts(ct_.grid, jaw_.tooth);
  painted_.clear();
  stroke_.reset();
}

void PaintedJaw::change(std::size_t v, const glm::ivec3& ijk, assets::VoxelLabel to, const Shown& shown) {
  const std::uint8_t before = jaw_.tooth[v];
  if (before != to.tooth) {
    if (before != 0) counts_.add(ijk, before, -1);
    if (to.tooth != 0) counts_.add(ijk, to.tooth, 1);
  }
  jaw_.label[v] = to.label, jaw_.tooth[v] = to.tooth;
  shown(ijk, to);
}

void PaintedJaw::paint(const assets::VoxelEdit& edit, std::size_t first, assets::LabelChanges& changes,
                       const Shown& shown) {
  assets::forVoxelsChangedBy({ct_.grid, ct_.hounsfield}, jaw_, edit, first,
                             [&](const glm::ivec3& ijk, std::size_t v, assets::VoxelLabel to) {
                               changes.keep(jaw_, ijk);
                               change(v, ijk, to, shown);
                             });
}

void PaintedJaw::takeBack(const assets::LabelChanges& changes, const Shown& shown) {
  changes.takeBack(jaw_,
                   [&](const glm::ivec3& ijk, std::size_t v, assets::VoxelLabel to) { change(v, ijk, to, shown); });
}

void PaintedJaw::count() {
  jaw_.teeth = found_teeth_;
  if (!painted_.empty()) assets::takeCounts(ct_.grid, counts_, jaw_);
}

bool PaintedJaw::follow(const std::vector<assets::VoxelEdit>& edits, const Shown& shown) {
  if (!isFound()) return true;
  std::size_t same = 0;
  while (same < painted_.size() && same < edits.size() && painted_[same].edit == edits[same]) ++same;
  for (std::size_t n = same; n < painted_.size(); ++n)
    if (!painted_[n].changes) return false;
  const bool is_new = painted_.size() != same || edits.size() != same;
  for (; painted_.size() > same; painted_.pop_back()) takeBack(*painted_.back().changes, shown);
  for (std::size_t n = same; n < edits.size(); ++n) {
    Painted one{edits[n], assets::LabelChanges(ct_.grid)};
    paint(one.edit, 0, *one.changes, shown);
    one.changes->pack(jaw_);
    painted_.push_back(std::move(one));
    keepWithinBudget();
  }
  if (is_new) count();
  return true;
}

void PaintedJaw::dab(const assets::BrushStroke& stroke, std::size_t first, const Shown& shown) {
  assert(isFound());
  if (!stroke_) stroke_.emplace(ct_.grid);
  paint(stroke, first, *stroke_, shown);
}

void PaintedJaw::endStroke(const assets::BrushStroke& stroke) {
  if (!stroke_) return;
  stroke_->pack(jaw_);
  painted_.push_back({stroke, std::exchange(stroke_, std::nullopt)});
  keepWithinBudget();
  count();
}

void PaintedJaw::leaveStroke(const Shown& shown) {
  if (!stroke_) return;
  stroke_->pack(jaw_);
  takeBack(*stroke_, shown);
  stroke_.reset();
}

std::size_t PaintedJaw::keptBytes() const {
  std::size_t sum = 0;
  for (const Painted& one : painted_) sum += one.changes ? one.changes->bytes() : 0;
  return sum;
}

void PaintedJaw::keepWithinBudget() {
  std::size_t sum = keptBytes();
  for (Painted& one : painted_) {
    if (sum <= most_bytes_) return;
    if (!one.changes) continue;
    sum -= one.changes->bytes();
    one.changes.reset();
  }
}

}  // namespace app
