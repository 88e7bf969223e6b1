#include "assets/synthetic/preparation_block.h"

#include <algorithm>
#include <cmath>

#include "assets/synthetic/practice_block.h"
#include "assets/tissue.h"

namespace assets {
namespace {

constexpr double kCorner_mm = 2.0, kEdge_mm = 0.5;  ///< round, seen from the bite; along the biting surface
constexpr double kNeck_mm = 3.0;                    ///< of the crown's form below its cervical line
constexpr glm::dvec3 kBase_mm{8.0, 7.0, 2.0};       ///< half edges, height
constexpr double kRoundAir_mm = 2.0;

/// Of a square with round corners.
double toSquare_mm(const glm::dvec2& p_mm, const glm::dvec2& half_mm, double corner_mm) {
  const glm::dvec2 q = glm::abs(p_mm) - half_mm + corner_mm;
  return std::min(std::max(q.x, q.y), 0.0) + glm::length(glm::max(q, glm::dvec2(0.0))) - corner_mm;
}

/// Below a face and within a wall, their edge round.
double roundBoth_mm(double a_mm, double b_mm, double radius_mm) {
  const glm::dvec2 q = glm::dvec2(a_mm, b_mm) + radius_mm;
  return std::min(std::max(q.x, q.y), 0.0) + glm::length(glm::max(q, glm::dvec2(0.0))) - radius_mm;
}

double toBase_mm(const glm::dvec3& p_mm) {
  return std::max({std::abs(p_mm.x) - kBase_mm.x, std::abs(p_mm.y) - kBase_mm.y, p_mm.z + kNeck_mm,
                   -kNeck_mm - kBase_mm.z - p_mm.z});
}

}  // namespace

const PreparationBlock* preparationBlockOf(std::string_view key) {
  const auto found = std::ranges::find(kPreparationBlocks, key, &PreparationBlock::key);
  return found == kPreparationBlocks.end() ? nullptr : &*found;
}

double toBlockCrown_mm(const glm::dvec3& p_mm) {
  return roundBoth_mm(toSquare_mm(glm::dvec2(p_mm), kBlockHalf_mm, kCorner_mm), p_mm.z - kBlockCrown_mm, kEdge_mm);
}

Patient preparationBlock(const PreparationBlock& block, double spacing_mm) {
  Patient patient;
  patient.title = block.title;
  PreparedTooth tooth{kPreparationBlockTooth, {}, std::string(block.ideal), "", {}};
  for (int axis = 0; axis < 3; ++axis) tooth.frame.axes_P[axis] = fromBlock(glm::dmat3(1.0)[axis]);
  tooth.frame.cervix_P_mm = -kBlockCrown_mm * tooth.frame.axes_P[2];

  const glm::dvec3 low_mm(-kBase_mm.x, -kBase_mm.y, -kNeck_mm - kBase_mm.z),
      high_mm(kBase_mm.x, kBase_mm.y, kBlockCrown_mm);
  glm::dvec3 low(1e9), high(-1e9);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p = tooth.frame.inP(glm::mix(low_mm, high_mm, glm::dvec3(cornerOffset(corner))));
    low = glm::min(low, p), high = glm::max(high, p);
  }
  CtVolume& ct = patient.ct;
  ct.grid.spacing_mm = spacing_mm;
  ct.grid.origin_P_mm = low - kRoundAir_mm;
  ct.grid.size = glm::ivec3(glm::ceil((high - low + 2.0 * kRoundAir_mm) / spacing_mm)) + 1;
  const std::size_t count = ct.grid.voxelCount();
  ct.hounsfield.resize(count), ct.solid.resize(count), ct.label.resize(count), ct.tooth.assign(count, 0);
  forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p = tooth.frame.local(ct.grid.centre_P_mm(ijk));
    // A root without end: the base cuts it off.
    const double crown_mm = std::max(toBlockCrown_mm(p), -kNeck_mm - p.z), base_mm = toBase_mm(p);
    const double share = std::clamp(0.5 - std::min(crown_mm, base_mm) / spacing_mm, 0.0, 1.0);
    // Enamel ends at the cervical line.
    const bool is_enamel = p.z > 0.0 && toBlockCrown_mm(p) > -kBlockEnamel_mm;
    const Tissue tissue = crown_mm <= 0.5 * spacing_mm  ? (is_enamel ? Tissue::enamel : Tissue::dentine)
                          : base_mm <= 0.5 * spacing_mm ? Tissue::cortical
                                                        : Tissue::unlabelled;
    constexpr double kAir_HU = -1000.0;
    ct.label[v] = static_cast<std::uint8_t>(tissue);
    ct.solid[v] = static_cast<std::uint8_t>(std::lround(255.0 * share));
    ct.hounsfield[v] = static_cast<std::int16_t>(
        glm::mix(kAir_HU, static_cast<double>(kTissues[static_cast<std::size_t>(tissue)].hounsfield), share));
  });
  patient.prepared = std::move(tooth);
  return patient;
}

}  // namespace assets
