#include "assets/import/tissue_from_grey.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace assets {
namespace {

constexpr double kReach_mm = 0.6;      ///< half width of a blurred surface, at least two voxels
constexpr double kVoidDepth_mm = 1.0;  ///< minimum; marrow spaces are smaller

/// Grey values, extended beyond the border.
class Greys {
 public:
  Greys(const VolumeGrid& grid, const std::vector<std::int16_t>& hounsfield) : grid_(grid), hounsfield_(hounsfield) {}

  int at(glm::ivec3 ijk) const { return hounsfield_[grid_.index(glm::clamp(ijk, glm::ivec3(0), grid_.size - 1))]; }
  int near(const glm::dvec3& index) const { return at(glm::ivec3(glm::round(index))); }

  /// Unit, or zero.
  glm::dvec3 gradient(glm::ivec3 ijk) const {
    glm::dvec3 up(0.0);
    for (int axis = 0; axis < 3; ++axis) {
      glm::ivec3 step(0);
      step[axis] = 1;
      up[axis] = at(ijk + step) - at(ijk - step);
    }
    const double steepness = glm::length(up);
    return steepness > 0.0 ? up / steepness : up;
  }

 private:
  const VolumeGrid& grid_;
  const std::vector<std::int16_t>& hounsfield_;
};

bool isNearVoid(const Greys& greys, glm::ivec3 ijk, int reach) {
  for (int corner = 0; corner < 8; ++corner)
    if (greys.at(ijk + reach * (2 * cornerOffset(corner) - 1)) <= kSoftBelow_hu) return true;
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {-reach, reach}) {
      glm::ivec3 next = ijk;
      next[axis] += side;
      if (greys.at(next) <= kSoftBelow_hu) return true;
    }
  return false;
}

/// Tissue behind a voxel at a surface, else its own.
Tissue tissueAt(const Greys& greys, glm::ivec3 ijk, int hounsfield, int reach, int void_depth) {
  const Tissue own = tissueFromGrey(hounsfield);
  if (own == Tissue::unlabelled || own == Tissue::enamel || !isNearVoid(greys, ijk, reach)) return own;
  const glm::dvec3 up = greys.gradient(ijk), here(ijk);
  bool is_outside = false;
  for (int step = 1; step <= reach && !is_outside; ++step)
    is_outside = greys.near(here - double(step) * up) <= kSoftBelow_hu &&
                 greys.near(here - double(step + void_depth) * up) <= kSoftBelow_hu;
  if (!is_outside) return own;
  int densest = hounsfield;
  for (int step = 1; step <= reach; ++step) densest = std::max(densest, greys.near(here + double(step) * up));
  const Tissue behind = tissueFromGrey(densest);
  return behind == Tissue::trabecular ? Tissue::cortical : behind;
}

/// The 26 neighbours inside the grid.
template <class Visit>
void forNeighbours(const VolumeGrid& grid, glm::ivec3 ijk, const Visit& visit) {
  for (int n = 0; n < 27; ++n) {
    const glm::ivec3 next = ijk + glm::ivec3(n % 3, n / 3 % 3, n / 9) - 1;
    if (next != ijk && grid.contains(next)) visit(grid.index(next));
  }
}

/// Whether a tooth number overrides the label.
bool isOverridable(Tissue label) {
  return label == Tissue::unlabelled || label == Tissue::cortical || label == Tissue::trabecular ||
         label == Tissue::gingiva;
}

bool isInsideTooth(const CtVolume& ct, glm::ivec3 ijk) {
  const std::uint8_t fdi = ct.tooth[ct.grid.index(ijk)];
  bool is_inside = true;
  forNeighbours(ct.grid, ijk, [&](std::size_t neighbour) { is_inside = is_inside && ct.tooth[neighbour] == fdi; });
  return is_inside;
}

}  // namespace

std::vector<std::uint8_t> labelsFromGrey(const VolumeGrid& grid, const std::vector<std::int16_t>& hounsfield) {
  const Greys greys(grid, hounsfield);
  const int reach = std::max(2, static_cast<int>(std::ceil(kReach_mm / grid.spacing_mm)));
  const int void_depth = std::max(1, static_cast<int>(std::ceil(kVoidDepth_mm / grid.spacing_mm)));
  std::vector<std::uint8_t> label(hounsfield.size());
  forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    label[v] = static_cast<std::uint8_t>(tissueAt(greys, ijk, hounsfield[v], reach, void_depth));
  });
  return label;
}

void labelNumberedTeeth(CtVolume& ct) {
  forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (ct.tooth[v] == 0 || !isOverridable(Tissue{ct.label[v]})) return;
    const Tissue grey = tissueFromGrey(ct.hounsfield[v]);
    const bool is_soft = grey == Tissue::unlabelled || grey == Tissue::trabecular;
    Tissue tissue = grey == Tissue::enamel ? grey : Tissue::dentine;
    if (is_soft && isInsideTooth(ct, ijk)) tissue = Tissue::pulp;
    ct.label[v] = static_cast<std::uint8_t>(tissue);
  });
}

void labelPartialVoxels(CtVolume& ct) {
  const std::vector<std::uint8_t> label = ct.label, tooth = ct.tooth;
  forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const Tissue own{label[v]};
    if (ct.solid[v] < kHalfSolid || (own != Tissue::unlabelled && own != Tissue::gingiva)) return;
    int densest = std::numeric_limits<int>::min();
    forNeighbours(ct.grid, ijk, [&](std::size_t neighbour) {
      if (!isHard(label[neighbour]) || ct.hounsfield[neighbour] <= densest) return;
      densest = ct.hounsfield[neighbour];
      ct.label[v] = label[neighbour];
      if (!tooth.empty()) ct.tooth[v] = tooth[neighbour];
    });
  });
}

}  // namespace assets
