#include "assets/scan/tooth_surroundings.h"

#include "assets/scan/label_distance.h"

namespace assets {
namespace {

constexpr double kMargin_mm = 1.0;  ///< where the crop ends there seems to be a surface

constexpr auto kCortical = static_cast<std::uint8_t>(Tissue::cortical);
constexpr auto kLigament = static_cast<std::uint8_t>(Tissue::ligament);

bool isOwn(const CtVolume& ct, std::size_t voxel, int fdi) { return !ct.tooth.empty() && ct.tooth[voxel] == fdi; }

}  // namespace

ToothSurroundings::ToothSurroundings(const CtVolume& ct, int fdi, const glm::dvec3& low_P_mm,
                                     const glm::dvec3& high_P_mm) {
  if (ct.grid.voxelCount() == 0) return;
  const glm::ivec3 low =
      glm::clamp(glm::ivec3(glm::floor(ct.grid.indexFromPoint(low_P_mm - kMargin_mm))), glm::ivec3(0), ct.grid.size);
  const glm::ivec3 end = glm::clamp(glm::ivec3(glm::ceil(ct.grid.indexFromPoint(high_P_mm + kMargin_mm))) + 1,
                                    glm::ivec3(0), ct.grid.size);
  if (glm::any(glm::lessThanEqual(end, low))) return;
  grid_ = {end - low, ct.grid.spacing_mm, ct.grid.centre_P_mm(low)};

  // Hard tissue that is not the tooth's own.
  std::vector<std::uint8_t> is_hard(grid_.voxelCount()), is_other(grid_.voxelCount());
  std::vector<std::uint8_t> label(grid_.voxelCount());
  forVoxels(grid_, [&](glm::ivec3 ijk, std::size_t v) {
    const std::size_t from = ct.grid.index(low + ijk);
    label[v] = ct.label[from];
    const bool own = isOwn(ct, from, fdi);
    is_hard[v] = isHard(label[v]) && !own ? 1 : 0;
    is_other[v] = own || isHard(label[v]) ? 0 : 1;
  });
  hard_ = structureDistance(grid_, is_hard, 0.5 * (low_P_mm + high_P_mm));

  // Beyond its own voxels a tissue goes on for one more.
  const auto spread = [&](const std::vector<std::uint8_t>& is_it, std::uint8_t otherwise) {
    std::vector<std::uint8_t> out(label.size(), otherwise);
    forVoxels(grid_, [&](glm::ivec3 ijk, std::size_t v) {
      if (is_it[v] != 0) {
        out[v] = label[v];
        return;
      }
      for (int side = 0; side < 6; ++side) {
        glm::ivec3 beside = ijk;
        beside[side / 2] += side % 2 == 0 ? -1 : 1;
        if (!grid_.contains(beside) || is_it[grid_.index(beside)] == 0) continue;
        out[v] = label[grid_.index(beside)];
        return;
      }
    });
    return out;
  };
  hard_label_ = spread(is_hard, kCortical);
  soft_label_ = spread(is_other, kLigament);
}

glm::ivec3 ToothSurroundings::nearest(const glm::dvec3& p_P_mm) const {
  return glm::clamp(glm::ivec3(glm::floor(grid_.indexFromPoint(p_P_mm) + 0.5)), glm::ivec3(0), grid_.size - 1);
}

std::uint8_t ToothSurroundings::label(const glm::dvec3& p_P_mm, bool is_hard) const {
  return grid_.voxelCount() == 0 ? 0 : labels(is_hard)[grid_.index(nearest(p_P_mm))];
}

std::optional<std::uint8_t> ToothSurroundings::label(const glm::dvec3& low_P_mm, const glm::dvec3& high_P_mm,
                                                     bool is_hard) const {
  if (grid_.voxelCount() == 0) return std::uint8_t{0};
  const glm::ivec3 low = nearest(low_P_mm), high = nearest(high_P_mm);
  const std::uint8_t first = labels(is_hard)[grid_.index(low)];
  bool all = true;
  forVoxels(low, high + 1, [&](glm::ivec3 ijk) { all = all && labels(is_hard)[grid_.index(ijk)] == first; });
  return all ? std::optional(first) : std::nullopt;
}

}  // namespace assets
