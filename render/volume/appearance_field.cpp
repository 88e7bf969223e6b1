#include "render/volume/appearance_field.h"

#include <tbb/parallel_for.h>

#include <array>
#include <cmath>

#include "assets/volume_grid.h"
#include "render/volume/tissue_appearance.h"

namespace render {
namespace {

constexpr int kCore = assets::kBrickVoxels, kWide = kCore + 2;

// Colour and finish times weight, and the weight.
using Share = std::array<float, 5>;
using Block = std::array<Share, static_cast<std::size_t>(kWide) * kWide * kWide>;

constexpr std::size_t at(int i, int j, int k) { return static_cast<std::size_t>((k * kWide + j) * kWide + i); }

std::uint32_t packed(const glm::vec3& colour, float finish) {
  const auto byte = [](float x) { return static_cast<std::uint32_t>(std::lround(255.0f * glm::clamp(x, 0.0f, 1.0f))); };
  const glm::vec3 root = glm::sqrt(colour);
  return byte(root.r) | byte(root.g) << 8 | byte(root.b) << 16 | byte(finish) << 24;
}

// Weights 1/8, 3/4, 1/8 of the quadratic B-spline at a voxel centre, in place; valid for the inner voxels only.
void smoothAxis(Block& block, std::size_t step) {
  const Block before = block;
  for (int k = 0; k < kWide; ++k)
    for (int j = 0; j < kWide; ++j)
      for (int i = 0; i < kWide; ++i) {
        const std::size_t here = at(i, j, k);
        if (here < step || here + step >= block.size()) continue;
        for (std::size_t c = 0; c < 5; ++c)
          block[here][c] = 0.75f * before[here][c] + 0.125f * (before[here - step][c] + before[here + step][c]);
      }
}

const TissueAppearance& appearanceOf(std::uint8_t tissue) {
  return kTissueAppearance[tissue < kTissueAppearance.size() ? tissue : 0];
}

/// `tissue_at(voxel)`: its appearance, by reference.
template <class TissueAt>
void blend(const BorderedField<std::uint8_t>& solid, const TissueAt& tissue_at, glm::ivec3 brick,
           BorderedField<std::uint32_t>& field) {
  // The brick and its border. Of one tissue alone, most of them, there is nothing to blend.
  const glm::ivec3 size = solid.layout().size;
  const glm::ivec3 first = kCore * brick, extent = glm::min(glm::ivec3(kCore), size - first);
  const glm::ivec3 low = glm::max(first - 1, 0), high = glm::min(first + kCore + 1, size);
  const TissueAppearance& one = tissue_at(low);
  bool is_one = true;
  for (int k = low.z; k < high.z && is_one; ++k)
    for (int j = low.y; j < high.y && is_one; ++j)
      for (int i = low.x; i < high.x && is_one; ++i) is_one = &tissue_at({i, j, k}) == &one;
  if (is_one) {
    const std::uint32_t colour = packed(one.albedo, one.finish);
    forEachIn({first, extent}, [&](glm::ivec3 v) { *field.at(v) = colour; });
    return;
  }
  Block block{};
  forEachIn({low, high - low}, [&](glm::ivec3 v) {
    const float filled = static_cast<float>(*solid.at(v)) / 255.0f;
    const TissueAppearance& appearance = tissue_at(v);
    const float weight = (filled * filled + 1e-4f) * appearance.colour_weight;
    const glm::ivec3 in = v - first + 1;
    block[at(in.x, in.y, in.z)] = {weight * appearance.albedo.r, weight * appearance.albedo.g,
                                   weight * appearance.albedo.b, weight * appearance.finish, weight};
  });

  smoothAxis(block, at(1, 0, 0));
  smoothAxis(block, at(0, 1, 0));
  smoothAxis(block, at(0, 0, 1));
  forEachIn({glm::ivec3(0), extent}, [&](glm::ivec3 v) {
    const Share& share = block[at(v.x + 1, v.y + 1, v.z + 1)];
    *field.at(first + v) = packed(glm::vec3(share[0], share[1], share[2]) / share[4], share[3] / share[4]);
  });
}

}  // namespace

BorderedField<std::uint32_t> appearanceField(const BorderedField<std::uint8_t>& solid,
                                             std::span<const std::uint8_t> label) {
  const glm::ivec3 size = solid.layout().size, bricks = (size + (kCore - 1)) / kCore;
  const TissueAppearance& plain = kTissueAppearance[0];
  BorderedField<std::uint32_t> field(size, packed(plain.albedo, plain.finish));
  const auto tissue_at = [&](glm::ivec3 v) -> const TissueAppearance& {
    return label.empty() ? plain : appearanceOf(label[indexIn(size, v)]);
  };
  tbb::parallel_for(0, bricks.z, [&](int k) {
    forEachIn({{0, 0, k}, {bricks.x, bricks.y, 1}}, [&](glm::ivec3 brick) { blend(solid, tissue_at, brick, field); });
  });
  return field;
}

void blendBrick(const BorderedField<std::uint8_t>& solid, const BorderedField<std::uint8_t>& label, glm::ivec3 brick,
                BorderedField<std::uint32_t>& field) {
  blend(
      solid, [&](glm::ivec3 v) -> const TissueAppearance& { return appearanceOf(*label.at(v)); }, brick, field);
}

}  // namespace render
