#include "assets/synthetic/front_row.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "assets/synthetic/implicit_shape.h"
#include "assets/synthetic/tooth_row.h"
#include "assets/tissue.h"
#include "assets/tooth.h"

namespace assets {
namespace {

constexpr int kLast = 4;                                                    ///< of each side, from the midline
constexpr double kCrest_mm = -11.5, kGumEnds_mm = -9.0, kFloor_mm = -32.0;  ///< heights
constexpr double kGum_mm = 1.8, kCuff_mm = 1.0, kBeyond_mm = 4.0;
constexpr BoundingBox kFrontBox{{-24.0, -7.5, -34.0}, {24.0, 22.0, 2.0}};

/// One side's; the other's are their mirror images.
std::vector<PlacedTooth> sideOfRow() {
  const DentalArch arch;
  std::vector<PlacedTooth> teeth;
  for (int position = 1; position <= kLast; ++position) teeth.push_back(eruptedTooth(arch, position));
  return teeth;
}

/// Onto the left side.
glm::dvec3 leftOf(const glm::dvec3& p) { return {std::abs(p.x), p.y, p.z}; }

/// A ridge that gets broader downwards.
double ridge_mm(const DentalArch& arch, const glm::dvec3& p) {
  const glm::dvec3 left = leftOf(p);
  const ArchCoordinates at = arch.coordinatesOf(glm::dvec2(left));
  const double below_mm = std::max(0.0, kCrest_mm - p.z);
  const double side_mm = std::abs(at.buccal_mm) - (4.0 + 0.12 * std::min(below_mm, 15.0));
  return smoothMax(smoothMax(side_mm, p.z - kCrest_mm, 2.0), kFloor_mm - p.z, 2.0);
}

}  // namespace

ToothFrame frontToothFrame(int fdi) {
  const PlacedTooth tooth = eruptedTooth(DentalArch(), positionOf(fdi));
  ToothFrame frame{tooth.cervix_J_mm, tooth.axes_J};
  if (!isRight(fdi)) return frame;
  const glm::dvec3 mirror(-1.0, 1.0, 1.0);
  frame.cervix_P_mm *= mirror;
  for (int axis = 0; axis < 3; ++axis) frame.axes_P[axis] *= mirror;
  return frame;
}

CtVolume frontRow(double spacing_mm) {
  const DentalArch arch;
  const std::vector<PlacedTooth> teeth = sideOfRow();
  CtVolume ct;
  ct.grid = {glm::ivec3(glm::ceil((kFrontBox.high_mm - kFrontBox.low_mm) / spacing_mm)), spacing_mm, kFrontBox.low_mm};
  const std::size_t count = ct.grid.voxelCount();
  ct.solid.assign(count, 0), ct.label.assign(count, 0), ct.tooth.assign(count, 0);
  const auto share = [&](double mm) { return std::clamp(0.5 - mm / spacing_mm, 0.0, 1.0); };
  const auto byte = [](double of) { return static_cast<std::uint8_t>(255.0 * of + 0.5); };
  const auto put = [&](glm::ivec3 ijk) {
    const std::size_t v = ct.grid.index(ijk);
    const glm::dvec3 p = ct.grid.centre_P_mm(ijk), left = leftOf(p);
    const double bone_mm = ridge_mm(arch, p);
    double tooth_mm = 1e3;
    const PlacedTooth* nearest = nullptr;
    for (const PlacedTooth& one : teeth)
      if (const double mm = one.shape.outer_mm(one.local(left)); mm < tooth_mm) tooth_mm = mm, nearest = &one;
    if (tooth_mm <= 0.5 * spacing_mm) {
      const bool is_enamel = nearest->shape.core_mm(nearest->local(left), tooth_mm) > 0.0;
      ct.label[v] = static_cast<std::uint8_t>(is_enamel ? Tissue::enamel : Tissue::dentine);
      ct.tooth[v] = static_cast<std::uint8_t>((p.x < 0.0 ? 40 : 30) + nearest->position);
      ct.solid[v] = byte(std::max(share(tooth_mm), share(bone_mm)));
      return;
    }
    const double gum_mm = smoothMax(std::min(bone_mm - kGum_mm, tooth_mm - kCuff_mm), p.z - kGumEnds_mm, 0.8);
    ct.solid[v] = byte(share(bone_mm));
    if (bone_mm <= 0.5 * spacing_mm)
      ct.label[v] = static_cast<std::uint8_t>(bone_mm > -1.5 ? Tissue::cortical : Tissue::trabecular);
    else if (gum_mm <= 0.0 && p.z > kFloor_mm + kBeyond_mm)
      ct.label[v] = static_cast<std::uint8_t>(Tissue::gingiva);
  };
  tbb::parallel_for(0, ct.grid.size.z, [&](int k) {
    forVoxels(glm::ivec3(0, 0, k), glm::ivec3(ct.grid.size.x, ct.grid.size.y, k + 1), put);
  });
  return ct;
}

}  // namespace assets
