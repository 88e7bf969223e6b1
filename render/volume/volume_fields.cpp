#include "render/volume/volume_fields.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <string>

#include "render/gpu/gpu_error.h"
#include "render/shaders/shared_constants.glsl"
#include "render/volume/appearance_field.h"

namespace render {
namespace {

constexpr int kB = assets::kBrickVoxels;
constexpr int kEdge = AMBIENT_CELL_VOXELS;

const assets::VolumeGrid& checked(const assets::VolumeGrid& grid, std::size_t solid, std::size_t label) {
  if (grid.voxelCount() == 0 || !(grid.spacing_mm > 0.0) || solid != grid.voxelCount() ||
      (label != 0 && label != grid.voxelCount()))
    throw GpuError("volume of " + std::to_string(grid.voxelCount()) + " voxels, renderer: got " +
                   std::to_string(solid) + " solid values and " + std::to_string(label) +
                   " labels; give one of each per voxel");
  return grid;
}

BorderedField<std::uint8_t> bordered(const assets::VolumeGrid& grid, std::span<const std::uint8_t> values) {
  BorderedField<std::uint8_t> field(grid.size);
  if (values.empty()) return field;
  for (int k = 0; k < grid.size.z; ++k)
    for (int j = 0; j < grid.size.y; ++j) std::copy_n(&values[grid.index({0, j, k})], grid.size.x, field.at({0, j, k}));
  return field;
}

// Merges boxes that are close together.
std::vector<VoxelBox> gathered(const std::vector<VoxelBox>& boxes) {
  VoxelBox all;
  std::size_t sum = 0;
  for (const VoxelBox& box : boxes) {
    all = boxAround(all, box);
    sum += grown(box, kSmoothReach, glm::ivec3(1 << 30)).count();
  }
  if (boxes.size() > 1 && all.count() > 2 * sum) return boxes;
  return {all};
}

}  // namespace

VolumeFields::VolumeFields(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid,
                           std::span<const std::uint8_t> label)
    : grid_(checked(grid, solid.size(), label.size())),
      solid_(bordered(grid, solid)),
      smooth_(grid.size),
      ambient_(grid.bricks() * (kB / kEdge)),
      appearance_(appearanceField(solid_, label)),
      label_(bordered(grid, label)) {
  // In slabs of a brick's height, to limit the working memory.
  tbb::parallel_for(0, grid.bricks().z, [&](int slab) {
    Smoother smoother;
    smoother.smooth(solid_, {{0, 0, kB * slab}, {grid.size.x, grid.size.y, std::min(kB, grid.size.z - kB * slab)}},
                    smooth_);
  });
  meanCells({{0, 0, 0}, ambient_.layout().size});
}

void VolumeFields::updateBrick(glm::ivec3 brick, std::span<const std::uint8_t, Occupancy::kBrickValues> values) {
  assert(glm::all(glm::greaterThanEqual(brick, glm::ivec3(0))) && glm::all(glm::lessThan(brick, grid_.bricks())));
  const glm::ivec3 first = kB * brick, extent = glm::min(glm::ivec3(kB), grid_.size - first);
  glm::ivec3 low(kB), high(-1);
  for (int k = 0; k < extent.z; ++k)
    for (int j = 0; j < extent.y; ++j) {
      const auto from = values.begin() + (k * kB + j) * kB;
      std::uint8_t* const to = solid_.at(first + glm::ivec3(0, j, k));
      for (int i = 0; i < extent.x; ++i)
        if (to[i] != from[i]) {
          to[i] = from[i];
          low = glm::min(low, glm::ivec3(i, j, k));
          high = glm::max(high, glm::ivec3(i, j, k));
        }
    }
  if (high.x < 0) return;
  touched_.push_back({first + low, high - low + 1});
}

void VolumeFields::updateTissue(glm::ivec3 brick, std::span<const std::uint8_t, Occupancy::kBrickValues> values) {
  const std::size_t number = indexIn(grid_.bricks(), brick);
  auto kept = scanned_.find(number);
  if (kept == scanned_.end()) {
    if (std::ranges::all_of(values, [](std::uint8_t value) { return value == 0; })) return;
    kept = scanned_.try_emplace(number).first;
    forEachIn(brickBox(brick),
              [&](glm::ivec3 v) { kept->second[indexIn(glm::ivec3(kB), v - kB * brick)] = *label_.at(v); });
  }
  forEachIn(brickBox(brick), [&](glm::ivec3 v) {
    const std::size_t n = indexIn(glm::ivec3(kB), v - kB * brick);
    const std::uint8_t tissue = values[n] != 0 ? values[n] : kept->second[n];
    if (*label_.at(v) == tissue) return;
    *label_.at(v) = tissue;
    relabelled_.insert(number);
  });
}

VoxelBox VolumeFields::brickBox(glm::ivec3 brick) const {
  return {kB * brick, glm::min(glm::ivec3(kB), grid_.size - kB * brick)};
}

// Colours blend over a voxel, so that bricks beside change too.
void VolumeFields::blendRelabelled() {
  const glm::ivec3 bricks = grid_.bricks();
  std::set<std::size_t> around;
  for (const std::size_t number : relabelled_) {
    const auto at = static_cast<int>(number);
    const glm::ivec3 brick(at % bricks.x, at / bricks.x % bricks.y, at / bricks.x / bricks.y);
    const glm::ivec3 low = glm::max(brick - 1, 0), high = glm::min(brick + 2, bricks);
    forEachIn({low, high - low}, [&](glm::ivec3 next) { around.insert(indexIn(bricks, next)); });
  }
  relabelled_.clear();
  for (const std::size_t number : around) {
    const auto at = static_cast<int>(number);
    const glm::ivec3 brick(at % bricks.x, at / bricks.x % bricks.y, at / bricks.x / bricks.y);
    blendBrick(solid_, label_, brick, appearance_);
    changes_.tissue.push_back(brickBox(brick));
  }
}

void VolumeFields::meanCells(const VoxelBox& cells) {
  forEachIn(cells, [this](glm::ivec3 cell) {
    std::uint32_t sum = 0;
    forEachIn(grown({kEdge * cell, glm::ivec3(kEdge)}, 0, grid_.size),
              [&](glm::ivec3 voxel) { sum += *solid_.at(voxel); });
    *ambient_.at(cell) = static_cast<std::uint16_t>(sum * 257u / (kEdge * kEdge * kEdge));
  });
  for (const PlacedFields& piece : pieces_) addPiece(piece, cells);
}

assets::SolidVoxels VolumeFields::voxels() const {
  const FieldLayout& layout = solid_.layout();
  return {grid_,
          {solid_.data(), layout.count()},
          static_cast<std::size_t>(layout.origin),
          static_cast<std::size_t>(layout.row),
          static_cast<std::size_t>(layout.slice)};
}

// All that a piece can fill, with its border.
VoxelBox VolumeFields::cellsOf(const PlacedFields& piece) const {
  const assets::VolumeGrid& grid = piece.fields->grid();
  glm::dvec3 low(1e9), high(-1e9);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::ivec3 ijk = assets::cornerOffset(corner) * (grid.size + 2 * kEdge - 1) - kEdge;
    const glm::dvec3 p_P_mm = (piece.X_PQ * calibration::Point<calibration::Piece>{grid.centre_P_mm(ijk)}).mm;
    const glm::dvec3 cell = grid_.indexFromPoint(p_P_mm) / static_cast<double>(kEdge);
    low = glm::min(low, cell), high = glm::max(high, cell);
  }
  const glm::ivec3 cells = ambient_.layout().size;
  const glm::ivec3 first(glm::floor(glm::clamp(low, -1e6, 1e6))), end(glm::ceil(glm::clamp(high, -1e6, 1e6)));
  const glm::ivec3 inside = glm::clamp(first, glm::ivec3(0), cells);
  return {inside, glm::clamp(end + 1, inside, cells) - inside};
}

// The piece's own means, trilinear at the centre of each cell.
void VolumeFields::addPiece(const PlacedFields& piece, const VoxelBox& cells) {
  const BorderedField<std::uint16_t>& means = piece.fields->ambient_;
  const assets::VolumeGrid& grid = piece.fields->grid();
  const VoxelBox own = cellsOf(piece);
  const glm::ivec3 low = glm::max(own.first, cells.first);
  const VoxelBox both{low, glm::min(own.first + own.extent, cells.first + cells.extent) - low};
  if (both.empty()) return;

  const auto Q_from_P = piece.X_PQ.inverse();
  const auto position_of = [&](glm::ivec3 cell) {
    const glm::dvec3 centre(glm::dvec3(kEdge * cell) + 0.5 * (kEdge - 1));
    const glm::dvec3 p_Q_mm =
        (Q_from_P * calibration::Point<calibration::Patient>{grid_.origin_P_mm + grid_.spacing_mm * centre}).mm;
    return (grid.indexFromPoint(p_Q_mm) + 0.5) / static_cast<double>(kEdge) - 0.5;
  };
  const glm::dvec3 origin = position_of(both.first), step_x = position_of(both.first + glm::ivec3(1, 0, 0)) - origin,
                   step_y = position_of(both.first + glm::ivec3(0, 1, 0)) - origin,
                   step_z = position_of(both.first + glm::ivec3(0, 0, 1)) - origin;
  const glm::vec3 most(means.layout().size);
  forEachIn(both, [&](glm::ivec3 cell) {
    const glm::dvec3 to(cell - both.first);
    const glm::vec3 at(origin + to.x * step_x + to.y * step_y + to.z * step_z);
    if (glm::any(glm::lessThanEqual(at, glm::vec3(-1.0f))) || glm::any(glm::greaterThanEqual(at, most))) return;
    std::uint16_t& mean = *ambient_.at(cell);
    mean = static_cast<std::uint16_t>(std::min(65535.0f, static_cast<float>(mean) + trilinear(means, at)));
  });
}

void VolumeFields::place(std::span<const PlacedFields> pieces, bool changed) {
  const auto is_same = [](const PlacedFields& a, const PlacedFields& b) {
    return a.fields == b.fields && a.X_PQ.rotation == b.X_PQ.rotation && a.X_PQ.translation_mm == b.X_PQ.translation_mm;
  };
  if (!changed && std::ranges::equal(pieces, pieces_, is_same)) return;
  // Where they were, and where they are.
  shaded_.insert(shaded_.end(), piece_cells_.begin(), piece_cells_.end());
  pieces_.assign(pieces.begin(), pieces.end());
  piece_cells_.clear();
  for (const PlacedFields& piece : pieces_) piece_cells_.push_back(cellsOf(piece));
  shaded_.insert(shaded_.end(), piece_cells_.begin(), piece_cells_.end());
  std::erase_if(shaded_, [](const VoxelBox& cells) { return cells.empty(); });
}

const FieldChanges& VolumeFields::prepare() {
  changes_.solid.clear(), changes_.smooth.clear(), changes_.ambient.clear(), changes_.tissue.clear();
  if (!relabelled_.empty()) blendRelabelled();
  if (!touched_.empty()) changes_.solid = gathered(touched_);
  touched_.clear();
  for (const VoxelBox& box : changes_.solid) {
    changes_.smooth.push_back(grown(box, kSmoothReach, grid_.size));
    smoother_.smooth(solid_, changes_.smooth.back(), smooth_);
    const glm::ivec3 first = box.first / kEdge;
    changes_.ambient.push_back({first, (box.first + box.extent - 1) / kEdge + 1 - first});
    meanCells(changes_.ambient.back());
  }
  if (shaded_.empty()) return changes_;
  for (const VoxelBox& cells : gathered(shaded_)) {
    changes_.ambient.push_back(cells);
    meanCells(cells);
  }
  shaded_.clear();
  return changes_;
}

}  // namespace render
