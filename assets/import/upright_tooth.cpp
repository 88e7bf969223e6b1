#include "assets/import/upright_tooth.h"

#include <cmath>

namespace assets {
namespace {

constexpr double kLeastOff_mm = 0.7;   ///< from the middle of the dentine to that of the enamel
constexpr double kMostAside = 0.7;     ///< of that way, along any other axis
constexpr double kPulpAbove_mm = 1.0;  ///< the pulp's middle over the enamel's

template <class Values>
void move(Values& values, const VolumeGrid& from, const VolumeGrid& to, const CrownSide& crown, int up) {
  Values turned(values.size());
  const int way = crown.sign * up;
  forVoxels(from, [&](glm::ivec3 p, std::size_t v) {
    const glm::ivec3 last = from.size - 1;
    glm::ivec3 at = p;
    if (crown.axis == 2) at = {p.x, last.y - p.y, last.z - p.z};
    if (crown.axis == 0) at = way > 0 ? glm::ivec3(last.z - p.z, p.y, p.x) : glm::ivec3(p.z, p.y, last.x - p.x);
    if (crown.axis == 1) at = way > 0 ? glm::ivec3(p.x, last.z - p.z, p.y) : glm::ivec3(p.x, p.z, last.y - p.y);
    turned[to.index(at)] = values[v];
  });
  values = std::move(turned);
}

}  // namespace

CrownSide crownSide(const CtVolume& tooth) {
  const auto middle = [&](Tissue tissue) {
    return voxelSum(tooth.grid, [&](std::size_t v) { return Tissue{tooth.label[v]} == tissue; });
  };
  const VoxelSum enamel = middle(Tissue::enamel), dentine = middle(Tissue::dentine), pulp = middle(Tissue::pulp);
  CrownSide crown;
  if (enamel.count == 0.0 || dentine.count == 0.0) return crown;
  const glm::dvec3 off_mm = tooth.grid.spacing_mm * (enamel.sum / enamel.count - dentine.sum / dentine.count);
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(off_mm[axis]) > std::abs(off_mm[crown.axis])) crown.axis = axis;
  crown.sign = off_mm[crown.axis] > 0.0 ? 1 : -1;
  crown.is_plain = std::abs(off_mm[crown.axis]) >= kLeastOff_mm;
  for (int axis = 0; axis < 3; ++axis)
    if (axis != crown.axis && std::abs(off_mm[axis]) > kMostAside * std::abs(off_mm[crown.axis]))
      crown.is_plain = false;
  if (pulp.count > 0.0) {
    const glm::dvec3 over_mm = tooth.grid.spacing_mm * (pulp.sum / pulp.count - enamel.sum / enamel.count);
    if (crown.sign * over_mm[crown.axis] > kPulpAbove_mm) crown.is_plain = false;
  }
  return crown;
}

void turnUpright(CtVolume& tooth, const CrownSide& crown, int up) {
  if (crown.axis == 2 && crown.sign == up) return;
  const VolumeGrid from = tooth.grid;
  VolumeGrid to = from;
  if (crown.axis != 2) std::swap(to.size[crown.axis], to.size.z);
  to.origin_P_mm = from.origin_P_mm + 0.5 * from.spacing_mm * glm::dvec3(from.size - to.size);
  move(tooth.label, from, to, crown, up);
  move(tooth.solid, from, to, crown, up);
  tooth.grid = to;
}

}  // namespace assets
