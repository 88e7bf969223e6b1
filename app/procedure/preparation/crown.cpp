#include "app/procedure/preparation/crown.h"

#include <algorithm>
#include <cmath>

#include "assets/segment/cell_masks.h"

namespace app {
namespace {

constexpr int kEdge = FineSolid::kEdge;
constexpr int kAround = 6;  ///< blocks: as far as a bur beside the tooth cuts a neighbour

/// Whole blocks around all of the tooth over a height, and how far it reaches.
struct Extent {
  glm::ivec3 low{1 << 30}, high{-1};  ///< blocks
  double top_mm = 0.0, reach_mm = 0.0;
};

Extent extentOf(const ToothBlocks& tooth, const assets::ToothFrame& frame, double below_mm) {
  Extent extent;
  const assets::VolumeGrid& grid = tooth.grid();
  assets::forVoxels(glm::ivec3(0), grid.size / kEdge, [&](glm::ivec3 block) {
    const FineSolid::Block label = tooth.labels(block), solid = tooth.block(block);
    if (label.bytes == nullptr && !assets::isToothPart(label.same)) return;
    const glm::dvec3 middle = frame.local(grid.centre_P_mm(block * kEdge + kEdge / 2));
    if (middle.z < -below_mm) return;
    bool is_tooth = false;
    std::size_t v = 0;
    assets::forVoxels(block * kEdge, (block + 1) * kEdge, [&](glm::ivec3 ijk) {
      const std::size_t at = v++;
      if (!assets::isToothPart(label.at(at)) || solid.at(at) < 128) return;
      is_tooth = true;
      const glm::dvec3 p = frame.local(grid.centre_P_mm(ijk));
      extent.top_mm = std::max(extent.top_mm, p.z + 0.5 * grid.spacing_mm);
      if (p.z > 0.0) extent.reach_mm = std::max(extent.reach_mm, std::hypot(p.x, p.y));
    });
    if (!is_tooth) return;
    extent.low = glm::min(extent.low, block), extent.high = glm::max(extent.high, block);
  });
  return extent;
}

assets::VolumeGrid boxOf(const ToothBlocks& tooth, const Extent& extent) {
  const assets::VolumeGrid& grid = tooth.grid();
  if (extent.high.x < 0) return {glm::ivec3(kEdge), grid.spacing_mm, grid.origin_P_mm};
  const glm::ivec3 low = glm::max(extent.low - kAround, glm::ivec3(0)) * kEdge;
  const glm::ivec3 end = glm::min((extent.high + 1 + kAround) * kEdge, grid.size);
  return {end - low, grid.spacing_mm, grid.centre_P_mm(low)};
}

/// The labels of a tooth's blocks as a field.
class LabelField final : public FineSolid {
 public:
  explicit LabelField(const ToothBlocks& tooth) : tooth_(tooth) {}
  const assets::VolumeGrid& grid() const override { return tooth_.grid(); }
  Block block(glm::ivec3 block) const override { return tooth_.labels(block); }

 private:
  const ToothBlocks& tooth_;
};

}  // namespace

BoxBytes::BoxBytes(const FineSolid& field, const assets::VolumeGrid& box) : BoxBytes(box) {
  const glm::ivec3 low(glm::round(field.grid().indexFromPoint(box.origin_P_mm))), end = low + box.size;
  assets::forVoxels(low / kEdge, (end + kEdge - 1) / kEdge, [&](glm::ivec3 block) {
    const FineSolid::Block one = field.block(block);
    if (one.bytes == nullptr && one.same == 0) return;
    const glm::ivec3 from = glm::max(block * kEdge, low), to = glm::min((block + 1) * kEdge, end);
    assets::forVoxels(from, to, [&](glm::ivec3 ijk) { bytes_[box.index(ijk - low)] = one.at(FineSolid::within(ijk)); });
  });
}

double BoxBytes::at(const glm::dvec3& p_P_mm) const {
  const glm::dvec3 index = grid_.indexFromPoint(p_P_mm), low = glm::floor(index), f = index - low;
  const glm::ivec3 ijk(low);
  if (!grid_.contains(ijk) || !grid_.contains(ijk + 1))
    return assets::trilinearAt(grid_, p_P_mm, [this](glm::ivec3 at) { return voxel(at) / 255.0; });
  const auto row = static_cast<std::size_t>(grid_.size.x), layer = row * static_cast<std::size_t>(grid_.size.y);
  const std::uint8_t* const byte = &bytes_[grid_.index(ijk)];
  const auto along = [&](std::size_t from) { return byte[from] + f.x * (byte[from + 1] - byte[from]); };
  const double below = along(0) + f.y * (along(row) - along(0));
  const double above = along(layer) + f.y * (along(layer + row) - along(layer));
  return (below + f.z * (above - below)) / 255.0;
}

double BoxBytes::solidBetween_mm(const glm::dvec3& from_P_mm, const glm::dvec3& way_P, double length_mm) const {
  constexpr int kSamples = 28;
  const double step_mm = length_mm / kSamples;
  double sum = 0.0;
  for (int n = 0; n < kSamples; ++n) sum += at(from_P_mm + (n + 0.5) * step_mm * way_P);
  return sum * step_mm;
}

Crown::Crown(const ToothBlocks& tooth, const assets::ToothFrame& of, double below_mm)
    : frame(of), solid(assets::VolumeGrid{}), label(assets::VolumeGrid{}) {
  const Extent extent = extentOf(tooth, frame, below_mm);
  const assets::VolumeGrid box = boxOf(tooth, extent);
  solid = BoxBytes(tooth, box);
  label = BoxBytes(LabelField(tooth), box);
  top_mm = extent.top_mm, reach_mm = extent.reach_mm;
}

BoxBytes attached(const Crown& crown, const BoxBytes& made) {
  constexpr double kNeck_mm = 0.5;
  constexpr std::uint8_t kHolds = 64;  ///< any matter holds, however thin
  const assets::VolumeGrid& grid = made.grid();
  const auto is_tooth = [&](std::size_t v) { return assets::isToothPart(crown.label.bytes()[v]); };
  std::vector<std::uint8_t> matter(grid.voxelCount());
  for (std::size_t v = 0; v < matter.size(); ++v) matter[v] = made.bytes()[v] >= kHolds && is_tooth(v) ? 1 : 0;
  const assets::CellPieces pieces = assets::piecesOfCells(grid.size, matter);
  std::vector<std::uint8_t> stands(pieces.cells.size(), 0);
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (matter[v] != 0 && crown.frame.local(grid.centre_P_mm(ijk)).z < kNeck_mm)
      stands[static_cast<std::size_t>(pieces.of[v])] = 1;
  });
  const auto is_left = [&](std::size_t v) { return stands[static_cast<std::size_t>(pieces.of[v])] != 0; };
  // A rim that is thinner than what holds goes with what it borders on.
  BoxBytes left = made;
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (made.bytes()[v] == 0 || !is_tooth(v) || is_left(v)) return;
    bool is_beside = false;
    assets::forVoxels(glm::max(ijk - 1, glm::ivec3(0)), glm::min(ijk + 2, grid.size),
                      [&](glm::ivec3 at) { is_beside = is_beside || is_left(grid.index(at)); });
    if (!is_beside) left.bytes()[v] = 0;
  });
  return left;
}

}  // namespace app
