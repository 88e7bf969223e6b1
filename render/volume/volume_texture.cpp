#include "render/volume/volume_texture.h"

#include <array>
#include <cassert>
#include <string>
#include <vector>

#include "render/gpu/gpu_error.h"
#include "render/shaders/shared_numbers.glsl"
#include "render/volume/smooth_field.h"

namespace render {
namespace {

constexpr int kB = assets::kBrickVoxels;
constexpr int kCells = kB / AMBIENT_CELL_VOXELS;  // ambient cells along a brick
constexpr int kFramesBetweenRebuilds = 60;

constexpr std::uint16_t widened(std::uint8_t value) { return static_cast<std::uint16_t>(value * 257); }

const assets::VolumeGrid& checked(const assets::VolumeGrid& grid, std::size_t solid, std::size_t label) {
  if (grid.voxelCount() == 0 || !(grid.spacing_mm > 0.0) || solid != grid.voxelCount() ||
      (label != 0 && label != grid.voxelCount()))
    throw GpuError("volume of " + std::to_string(grid.voxelCount()) + " voxels, renderer: got " +
                   std::to_string(solid) + " solid values and " + std::to_string(label) +
                   " labels; give one of each per voxel");
  return grid;
}

}  // namespace

VolumeTexture::VolumeTexture(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid,
                             std::span<const std::uint8_t> label)
    : grid_(checked(grid, solid.size(), label.size())),
      occupancy_(grid, solid),
      solid_(Texture::volume(grid.size, TexelFormat::r16)),
      smooth_(Texture::volume(grid.size, TexelFormat::r16)),
      label_(Texture::volume(grid.size, TexelFormat::r8ui)),
      emptiness_(Texture::volume(grid.bricks(), TexelFormat::r8ui)),
      ambient_(Texture::volume(grid.bricks() * kCells, TexelFormat::r16)) {
  // Solid, slice by slice.
  const glm::ivec3 slice{grid.size.x, grid.size.y, 1};
  const std::size_t slice_voxels = static_cast<std::size_t>(slice.x) * static_cast<std::size_t>(slice.y);
  std::vector<std::uint16_t> wide(slice_voxels);
  for (int k = 0; k < grid.size.z; ++k) {
    const auto row = solid.subspan(static_cast<std::size_t>(k) * slice_voxels, slice_voxels);
    for (std::size_t v = 0; v < slice_voxels; ++v) wide[v] = widened(row[v]);
    solid_.upload({0, 0, k}, slice, std::as_bytes(std::span(wide)));
  }

  // The smoothed copy, in slabs of a brick's height to keep the working memory small.
  for (int k = 0; k < grid.size.z; k += kB)
    uploadSmooth({0, 0, k}, {grid.size.x, grid.size.y, glm::min(kB, grid.size.z - k)});

  // Labels.
  const std::vector<std::uint8_t> unlabelled(label.empty() ? grid.voxelCount() : 0);
  label_.upload({0, 0, 0}, grid.size, std::as_bytes(label.empty() ? std::span<const std::uint8_t>(unlabelled) : label));

  // What is derived brick by brick.
  std::array<std::uint8_t, Occupancy::kBrickValues> values;
  for (int k = 0; k < grid.bricks().z; ++k)
    for (int j = 0; j < grid.bricks().y; ++j)
      for (int i = 0; i < grid.bricks().x; ++i) {
        values.fill(0);
        const glm::ivec3 first = kB * glm::ivec3(i, j, k);
        const glm::ivec3 extent = glm::min(glm::ivec3(kB), grid.size - first);
        for (int z = 0; z < extent.z; ++z)
          for (int y = 0; y < extent.y; ++y)
            for (int x = 0; x < extent.x; ++x)
              values[static_cast<std::size_t>((z * kB + y) * kB + x)] = solid[grid.index(first + glm::ivec3(x, y, z))];
        uploadAmbient({i, j, k}, values);
      }
  uploadEmptiness();
}

void VolumeTexture::updateBrick(glm::ivec3 brick, std::span<const std::uint8_t, Occupancy::kBrickValues> values) {
  assert(glm::all(glm::greaterThanEqual(brick, glm::ivec3(0))) && glm::all(glm::lessThan(brick, grid_.bricks())));
  const glm::ivec3 first = kB * brick;
  const glm::ivec3 extent = glm::min(glm::ivec3(kB), grid_.size - first);
  std::array<std::uint16_t, Occupancy::kBrickValues> wide;
  std::array<std::uint8_t, Occupancy::kBrickValues> inside{};
  std::size_t n = 0;
  for (int k = 0; k < extent.z; ++k)
    for (int j = 0; j < extent.y; ++j)
      for (int i = 0; i < extent.x; ++i) {
        const auto at = static_cast<std::size_t>((k * kB + j) * kB + i);
        inside[at] = values[at];
        wide[n++] = widened(values[at]);
      }
  solid_.upload(first, extent, std::as_bytes(std::span(wide).first(n)));
  uploadAmbient(brick, inside);
  occupancy_.updateBrick(brick, values);
  const glm::ivec3 low = glm::max(first - kSmoothReach, glm::ivec3(0));
  uploadSmooth(low, glm::min(first + extent + kSmoothReach, grid_.size) - low);
  ++changes_since_prepare_;
}

void VolumeTexture::uploadAmbient(glm::ivec3 brick, std::span<const std::uint8_t, Occupancy::kBrickValues> values) {
  constexpr int kEdge = AMBIENT_CELL_VOXELS;
  std::array<std::uint32_t, kCells * kCells * kCells> sum{};
  for (int k = 0; k < kB; ++k)
    for (int j = 0; j < kB; ++j)
      for (int i = 0; i < kB; ++i)
        sum[static_cast<std::size_t>(((k / kEdge) * kCells + j / kEdge) * kCells + i / kEdge)] +=
            values[static_cast<std::size_t>((k * kB + j) * kB + i)];
  std::array<std::uint16_t, kCells * kCells * kCells> mean;
  for (std::size_t c = 0; c < sum.size(); ++c)
    mean[c] = static_cast<std::uint16_t>(sum[c] * 257u / (kEdge * kEdge * kEdge));
  ambient_.upload(kCells * brick, glm::ivec3(kCells), std::as_bytes(std::span(mean)));
}

void VolumeTexture::uploadSmooth(glm::ivec3 first, glm::ivec3 extent) {
  const std::vector<std::uint16_t> values = smoothed(grid_, occupancy_.solid(), first, extent);
  smooth_.upload(first, extent, std::as_bytes(std::span(values)));
}

void VolumeTexture::uploadEmptiness() {
  emptiness_.upload({0, 0, 0}, occupancy_.bricks(), std::as_bytes(occupancy_.emptiness()));
}

// Carving only empties bricks, so the old emptiness stays safe; the exact one is made in a quiet frame, or now and
// then.
void VolumeTexture::prepare() {
  ++frames_since_rebuild_;
  bool changed = occupancy_.refresh();
  if (changes_since_prepare_ == 0 || frames_since_rebuild_ >= kFramesBetweenRebuilds) {
    changed = occupancy_.rebuildIfStale() || changed;
    frames_since_rebuild_ = 0;
  }
  changes_since_prepare_ = 0;
  if (changed) uploadEmptiness();
}

void VolumeTexture::bind() const {
  solid_.bind(SOLID_UNIT);
  smooth_.bind(SMOOTH_UNIT);
  label_.bind(LABEL_UNIT);
  emptiness_.bind(EMPTINESS_UNIT);
  ambient_.bind(AMBIENT_UNIT);
}

}  // namespace render
