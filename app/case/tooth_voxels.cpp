#include "app/case/tooth_voxels.h"

#include <array>
#include <cmath>
#include <optional>

#include "assets/import/tissue_from_grey.h"
#include "calibration/geometry/units.h"

namespace app {
namespace {

using assets::CtVolume;
using assets::Tissue;

bool isInEnamel(const CtVolume& ct, glm::ivec3 ijk) {
  return ct.grid.contains(ijk) && Tissue{ct.label[ct.grid.index(ijk)]} == Tissue::enamel;
}

/// Enamel grows by a voxel within the tooth: its outermost voxels are darkened by the air beside them.
void growEnamel(CtVolume& tooth) {
  std::vector<std::uint8_t> grown = tooth.label;
  assets::forVoxels(tooth.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (tooth.tooth[v] == 0) return;
    for (int axis = 0; axis < 3; ++axis)
      for (const int way : {-1, 1}) {
        glm::ivec3 beside = ijk;
        beside[axis] += way;
        if (isInEnamel(tooth, beside)) grown[v] = static_cast<std::uint8_t>(Tissue::enamel);
      }
  });
  tooth.label = std::move(grown);
}

}  // namespace

CtVolume toothAlone(const CtVolume& ct, int fdi) {
  constexpr int kMargin = 3;
  constexpr double kDarkened_mm = 0.5;
  CtVolume alone;
  if (ct.tooth.empty()) return alone;
  glm::ivec3 low(ct.grid.size), high(-1);
  assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (ct.tooth[v] != fdi) return;
    low = glm::min(low, ijk);
    high = glm::max(high, ijk);
  });
  if (high.x < 0) return alone;
  low = glm::max(low - kMargin, glm::ivec3(0));
  high = glm::min(high + kMargin, ct.grid.size - 1);
  alone.grid = {high - low + 1, ct.grid.spacing_mm, ct.grid.centre_P_mm(low)};

  bool by_grey = false;
  assets::forVoxels(low, high + 1, [&](glm::ivec3 ijk) {
    const std::size_t v = ct.grid.index(ijk);
    const bool mine = ct.tooth[v] == fdi;
    auto tissue = mine ? Tissue{ct.label[v]} : Tissue::unlabelled;
    if (tissue == Tissue::other_teeth) {
      const bool bright = !ct.hounsfield.empty() && assets::tissueFromGrey(ct.hounsfield[v]) == Tissue::enamel;
      tissue = bright ? Tissue::enamel : Tissue::dentine;
      by_grey = true;
    }
    alone.label.push_back(static_cast<std::uint8_t>(tissue));
    alone.tooth.push_back(static_cast<std::uint8_t>(mine ? fdi : 0));
    alone.solid.push_back(mine ? ct.solid[v] : std::uint8_t{0});
  });
  if (by_grey)
    for (double mm = 0.0; mm < kDarkened_mm; mm += ct.grid.spacing_mm) growEnamel(alone);
  return alone;
}

ToothVoxels toothVoxels(const CtVolume& ct, int fdi) {
  ToothVoxels tooth;
  if (ct.tooth.empty()) return tooth;
  const auto belongs = [&](glm::ivec3 ijk) { return ct.grid.contains(ijk) && ct.tooth[ct.grid.index(ijk)] == fdi; };
  assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (ct.tooth[v] != fdi) return;
    const glm::dvec3 centre = ct.grid.centre_P_mm(ijk);
    tooth.all_P_mm.push_back(centre);
    if (Tissue{ct.label[v]} == Tissue::enamel) tooth.enamel_P_mm.push_back(centre);
    for (int axis = 0; axis < 3; ++axis)
      for (const int way : {-1, 1}) {
        glm::ivec3 outward(0);
        outward[axis] = way;
        if (belongs(ijk + outward)) continue;
        tooth.faces.push_back({centre + 0.5 * ct.grid.spacing_mm * glm::dvec3(outward), outward});
      }
  });
  return tooth;
}

std::vector<glm::dvec3> cervicalLine_P_mm(const ToothVoxels& tooth, const glm::dvec3& axis_P) {
  constexpr std::size_t kSectors = 24;
  if (tooth.enamel_P_mm.empty()) return {};
  glm::dvec3 middle(0.0);
  for (const glm::dvec3& p : tooth.all_P_mm) middle += p / static_cast<double>(tooth.all_P_mm.size());
  const glm::dvec3 aside = std::abs(axis_P.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(axis_P, aside)), w = glm::cross(axis_P, u);

  std::array<std::optional<glm::dvec3>, kSectors> lowest;
  for (const glm::dvec3& p : tooth.enamel_P_mm) {
    const double turn = std::atan2(glm::dot(p - middle, w), glm::dot(p - middle, u)) / (2.0 * calibration::kPi) + 0.5;
    auto& least = lowest[static_cast<std::size_t>(turn * kSectors) % kSectors];
    if (!least || glm::dot(p - *least, axis_P) < 0.0) least = p;
  }
  std::vector<glm::dvec3> line;
  for (const auto& p : lowest)
    if (p) line.push_back(*p);
  if (4 * line.size() < 3 * kSectors) line.clear();
  return line;
}

}  // namespace app
