#include "haptics/contact/harmonic.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "calibration/geometry/units.h"
#include "haptics/contact/immersion.h"
#include "haptics/contact/overlap.h"

namespace haptics {
namespace {

using calibration::kPi;

/// Blocks with their middle beyond this act from their centre of mass: error under 1e-3 of their part.
constexpr double kFar_voxels = 10.0;

/// Positions of the voxels within a block.
struct Within {
  alignas(64) std::array<float, kBlockVoxels> x{}, y{}, z{};
};
constexpr Within kWithin = [] {
  Within within;
  for (std::size_t n = 0; n < kBlockVoxels; ++n) {
    within.x[n] = static_cast<float>(n & 3);
    within.y[n] = static_cast<float>((n >> 2) & 3);
    within.z[n] = static_cast<float>(n >> 4);
  }
  return within;
}();

/// The bur in voxels, and the voxels it may touch.
struct Reach {
  glm::dvec3 centre{0.0};
  double radius = 0.0;
  VoxelBox box;
};

Reach reachOf(const ToolInBone& at, const SolidBody& body) {
  const assets::VolumeGrid& grid = body.field.grid;
  Reach reach;
  reach.centre = grid.indexFromPoint(body.inBody(calibration::Point<calibration::Patient>{at.X_PT.translation_mm}).mm);
  reach.radius = at.head.radius_mm / grid.spacing_mm;
  const double outer = reach.radius + kVoxelChargeRadius;
  reach.box = {grid, reach.centre - outer, reach.centre + outer};
  return reach;
}

/// Sum of `force_of` (field, reach) over the bodies, mm.
template <class Force>
calibration::Vector<calibration::Patient> sumOverBodies_mm(const ToolInBone& at, const Force& force_of) {
  calibration::Vector<calibration::Patient> sum;
  for (const SolidBody& body : at.bodies.bodies())
    sum = sum + body.fromBody({body.field.grid.spacing_mm * force_of(body.field, reachOf(at, body))});
  return sum;
}

/// Force of one voxel's ball over its distance: the factor of the vector from bur to voxel.
class VoxelCharge {
 public:
  explicit VoxelCharge(double radius)
      : inner_(static_cast<float>(radius - kVoxelChargeRadius)),
        outer_(static_cast<float>(radius + kVoxelChargeRadius)) {
    constexpr double kB = kVoxelChargeRadius;
    const double density = 3.0 / (4.0 * kPi * kB * kB * kB);
    constant_ = static_cast<float>(0.5 * radius * density);
    linear_ = static_cast<float>(density / 3.0);
    inverse_ =
        static_cast<float>(density * (-radius * radius * radius / 6.0 + 0.5 * radius * kB * kB + kB * kB * kB / 3.0));
  }

  [[gnu::always_inline]] float over(float d2) const {
    const float d = std::sqrt(d2), nearest = static_cast<float>(kVoxelChargeRadius);
    const float from = d > nearest ? d : nearest, inverse = 1.0f / from;
    const float whole = static_cast<float>(0.5 / kPi) * inverse * inverse * inverse;
    const float across = (constant_ - linear_ * from + inverse_ * inverse * inverse) * inverse;
    const float force = d < inner_ ? whole : across;
    return d < outer_ ? force : 0.0f;
  }

 private:
  float inner_, outer_, constant_, linear_, inverse_;
};

using BlockWeights = std::array<float, kBlockVoxels>;

/// Sixteen partial sums in fixed order, unfused: the same bits with every instruction set.
[[gnu::always_inline]] inline float sumInOrder(const BlockWeights& part) {
  alignas(64) std::array<float, 16> lane{};
  for (std::size_t plane = 0; plane < 4; ++plane)
    for (std::size_t n = 0; n < 16; ++n) lane[n] += part[16 * plane + n];
  float sum = 0.0f;
  for (float each : lane) sum += each;
  return sum;
}

/// Force of a block with voxel (0,0,0) at `low` from the centre; overwrites the weights.
[[gnu::always_inline]] inline void pullOfBlock(const VoxelCharge& charge, const glm::vec3& low, BlockWeights& weight,
                                               std::array<float, 3>& pull) {
  alignas(64) BlockWeights dx, dy, dz;
  for (std::size_t n = 0; n < kBlockVoxels; ++n) {
    dx[n] = low.x + kWithin.x[n], dy[n] = low.y + kWithin.y[n], dz[n] = low.z + kWithin.z[n];
    weight[n] *= charge.over(dx[n] * dx[n] + dy[n] * dy[n] + dz[n] * dz[n]);
  }
  for (std::size_t n = 0; n < kBlockVoxels; ++n) dx[n] *= weight[n], dy[n] *= weight[n], dz[n] *= weight[n];
  pull = {sumInOrder(dx), sumInOrder(dy), sumInOrder(dz)};
}

void pullOfBlockPortable(const VoxelCharge& charge, const glm::vec3& low, BlockWeights& weight,
                         std::array<float, 3>& pull) {
  pullOfBlock(charge, low, weight, pull);
}
#if defined(__x86_64__)
[[gnu::target("avx2")]] void pullOfBlockAvx2(const VoxelCharge& charge, const glm::vec3& low, BlockWeights& weight,
                                             std::array<float, 3>& pull) {
  pullOfBlock(charge, low, weight, pull);
}
[[gnu::target("avx512f,prefer-vector-width=512")]] void pullOfBlockAvx512(const VoxelCharge& charge,
                                                                          const glm::vec3& low, BlockWeights& weight,
                                                                          std::array<float, 3>& pull) {
  pullOfBlock(charge, low, weight, pull);
}
#endif

class HarmonicSum {
 public:
  HarmonicSum(const TissueStiffness& tissue, const SolidField& field, const Reach& reach)
      : tissue_(tissue), field_(field), reach_(reach), charge_(reach.radius) {}

  glm::dvec3 sum() {
    const double outer = reach_.radius + kVoxelChargeRadius, inner = reach_.radius - kVoxelChargeRadius;
    if (reach_.box.empty()) return {};
    const glm::ivec3 first = reach_.box.first / kBlockEdge, last = reach_.box.last / kBlockEdge;
    for (int k = first.z; k <= last.z; ++k)
      for (int j = first.y; j <= last.y; ++j)
        for (int i = first.x; i <= last.x; ++i) {
          const glm::ivec3 block(i, j, k);
          const std::size_t at = field_.slotAt(block);
          if (field_.weight[at] == 0) continue;
          // Nearest and farthest voxel of the block.
          const glm::dvec3 low = glm::dvec3(4 * block) - reach_.centre, high = low + 3.0;
          const glm::dvec3 near = glm::max(glm::dvec3(0.0), glm::max(low, -high));
          if (glm::dot(near, near) >= outer * outer) continue;
          const glm::dvec3 far = glm::max(glm::abs(low), glm::abs(high)), middle = low + 1.5;
          const bool whole = inner > 0.0 && glm::dot(far, far) <= inner * inner;
          if (whole && field_.only_label[at] != kMixedLabels && glm::dot(middle, middle) > kFar_voxels * kFar_voxels)
            addFar(low, at);
          else
            addVoxels(low, at);
        }
    return -force_ / 255.0;
  }

 private:
  void addFar(const glm::dvec3& low, std::size_t slot) {
    const double weight = field_.weight[slot];
    const glm::dvec3 from =
        low + glm::dvec3(field_.weight_x[slot], field_.weight_y[slot], field_.weight_z[slot]) / weight;
    const double d2 = glm::dot(from, from);
    force_ += weight * tissue_.of(field_.only_label[slot]) * (0.5 / kPi) / (d2 * std::sqrt(d2)) * from;
  }

  void addVoxels(const glm::dvec3& low, std::size_t slot) {
    const std::uint8_t* solid = field_.solid + kBlockVoxels * slot;
    alignas(64) BlockWeights weight;
    if (field_.only_label[slot] != kMixedLabels) {
      const auto factor = static_cast<float>(tissue_.of(field_.only_label[slot]));
      for (std::size_t n = 0; n < kBlockVoxels; ++n) weight[n] = factor * static_cast<float>(solid[n]);
    } else {
      const std::uint8_t* label = field_.label + kBlockVoxels * slot;
      for (std::size_t n = 0; n < kBlockVoxels; ++n)
        weight[n] = static_cast<float>(tissue_.of(label[n])) * static_cast<float>(solid[n]);
    }
    std::array<float, 3> pull;
    // Direct calls, so that tests/architecture/servo_symbols.cmake can follow them.
#if defined(__x86_64__)
    if (set_ == assets::InstructionSet::avx512)
      pullOfBlockAvx512(charge_, glm::vec3(low), weight, pull);
    else if (set_ == assets::InstructionSet::avx2)
      pullOfBlockAvx2(charge_, glm::vec3(low), weight, pull);
    else
#endif
      pullOfBlockPortable(charge_, glm::vec3(low), weight, pull);
    force_ += glm::dvec3(pull[0], pull[1], pull[2]);
  }

  const TissueStiffness& tissue_;
  const SolidField& field_;
  const Reach& reach_;
  VoxelCharge charge_;
  assets::InstructionSet set_ = assets::chosenInstructionSet();
  glm::dvec3 force_{0.0};
};

}  // namespace

double harmonicForceOfBall(double R, double B, double d) noexcept {
  if (d >= R + B || d <= 0.0) return 0.0;
  if (d + B <= R) return d >= B ? 2.0 / 3.0 * B * B * B / (d * d) : 2.0 / 3.0 * d;
  // The bur inside the ball has bone on all sides.
  if (d + R <= B) return 0.0;
  if (d < B - R || d < R - B) return 0.0;
  return 0.5 * R - d / 3.0 + (-R * R * R / 6.0 + 0.5 * R * B * B + B * B * B / 3.0) / (d * d);
}

calibration::Vector<calibration::Patient> harmonicForce_mm(const ToolInBone& at) noexcept {
  if (at.head.radius_mm <= 2.0 * kVoxelChargeRadius * at.bodies.spacing_mm()) return harmonicForceVoxelByVoxel_mm(at);
  return sumOverBodies_mm(
      at, [&](const SolidField& field, const Reach& reach) { return HarmonicSum(at.tissue, field, reach).sum(); });
}

calibration::Vector<calibration::Patient> harmonicForceVoxelByVoxel_mm(const ToolInBone& at) noexcept {
  constexpr double kB = kVoxelChargeRadius;
  return sumOverBodies_mm(at, [&](const SolidField& field, const Reach& reach) {
    glm::dvec3 force(0.0);
    for (int k = reach.box.first.z; k <= reach.box.last.z; ++k)
      for (int j = reach.box.first.y; j <= reach.box.last.y; ++j)
        for (int i = reach.box.first.x; i <= reach.box.last.x; ++i) {
          const glm::dvec3 from = glm::dvec3(i, j, k) - reach.centre;
          const double d = glm::length(from);
          if (d <= 0.0) continue;
          const double weight = field.solidAt({i, j, k}) / 255.0 * at.tissue.of(field.labelAt({i, j, k}));
          force -= weight * 3.0 / (4.0 * kPi * kB * kB * kB) * harmonicForceOfBall(reach.radius, kB, d) / d * from;
        }
    return force;
  });
}

Contact harmonicContact(const HarmonicParameters& parameters, const ToolInBone& at) noexcept {
  Contact contact = contactAlongNormal(immersionOf(at), 0.0, parameters.stiffness_N_per_mm);
  if (contact.depth_mm <= 0.0) return contact;
  contact.force_P_N = parameters.stiffness_N_per_mm * harmonicForce_mm(at);
  return contact;
}

}  // namespace haptics
