#include "assets/scan/fine_tooth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "assets/load_error.h"
#include "assets/tissue.h"

namespace assets {
namespace {

constexpr double kLigament_mm = 0.2;  ///< of it at least between tooth and bone, which labels cannot show
/// How much faster than the way a distance may change: lattices, ellipses, smooth unions; and that to the enamel.
constexpr double kSteep = 1.1, kPulpSteep = 1.25, kCoreSteep = 1.6;

void refuseThinCanals(const ToothCanals& canals, double spacing_mm) {
  for (const ToothCanal& canal : canals.canals) {
    if (canal.smallestWidth_mm() >= spacing_mm) continue;
    std::ostringstream line;
    line << "tooth " << canals.fdi << ": its canal " << canal.name << " is " << canal.smallestWidth_mm()
         << " mm wide, thinner than a voxel of " << spacing_mm << " mm; give smaller voxels";
    throw LoadError(line.str());
  }
}

VolumeGrid gridAround(const ToothShell::Box& box, double spacing_mm) {
  const glm::dvec3 low = box.low_P_mm - kFineMargin_mm, size = box.high_P_mm + kFineMargin_mm - low;
  constexpr int kEdge = ToothSampler::kEdge;
  VolumeGrid grid;
  grid.spacing_mm = spacing_mm;
  grid.origin_P_mm = low;
  grid.size = (glm::ivec3(glm::ceil(size / spacing_mm)) + kEdge) / kEdge * kEdge;
  return grid;
}

class FineTooth final : public ToothSampler {
 public:
  FineTooth(std::unique_ptr<ToothShell> shell, const ToothCanals& canals, const CtVolume& ct, double spacing_mm)
      : shell_(std::move(shell)),
        pulp_(canals),
        grid_(gridAround(shell_->box(), spacing_mm)),
        around_(ct, canals.fdi, grid_.origin_P_mm, grid_.centre_P_mm(grid_.size - 1)) {}

  const VolumeGrid& grid() const override { return grid_; }

  std::optional<Same> same(glm::ivec3 low, int edge) const override {
    const Cube cube = cubeAt(low, edge);
    const double outer_mm = shell_->outer_mm(cube.middle_P);
    if (outer_mm < -kSteep * cube.reach_mm) {
      const double pulp_mm = std::min(pulp_.at_mm(cube.middle_P), shell_->pulp_mm(cube.middle_P));
      if (pulp_mm < -kPulpSteep * cube.reach_mm) return Same{0, labelOf(Tissue::pulp)};
      if (pulp_mm < kPulpSteep * cube.reach_mm) return std::nullopt;
      const double core_mm = shell_->core_mm(cube.middle_P, outer_mm);
      if (std::abs(core_mm) < kCoreSteep * cube.reach_mm) return std::nullopt;
      return Same{255, labelOf(core_mm < 0.0 ? Tissue::dentine : Tissue::enamel)};
    }
    if (outer_mm < kSteep * cube.reach_mm) return std::nullopt;
    const double hard_mm = around_.hard_mm(cube.middle_P);
    const bool is_hard = hard_mm < 0.0;
    if (std::abs(hard_mm) < kSteep * cube.reach_mm) return std::nullopt;
    if (is_hard && outer_mm < kLigament_mm + kSteep * cube.reach_mm) return std::nullopt;
    const auto label = around_.label(cube.low_P, cube.high_P, is_hard);
    if (!label) return std::nullopt;
    return Same{is_hard ? std::uint8_t{255} : std::uint8_t{0}, *label};
  }

  void block(glm::ivec3 block, std::span<std::uint8_t, kVoxels> solid,
             std::span<std::uint8_t, kVoxels> label) const override {
    // Which surfaces are near decides what has to be asked. Those of lattices are asked at the corners.
    const Cube cube = cubeAt(block * kEdge, kEdge);
    const double middle_mm = shell_->outer_mm(cube.middle_P), near_mm = kSteep * cube.reach_mm;
    const bool inside = middle_mm<-near_mm, outside = middle_mm> near_mm + kLigament_mm;
    const double middle_core_mm = outside ? middle_mm : shell_->core_mm(cube.middle_P, middle_mm);
    const bool near_core = !outside && std::abs(middle_core_mm) < kCoreSteep * cube.reach_mm;
    const auto corner = [&](std::size_t n) {
      return glm::mix(cube.low_P, cube.high_P, glm::dvec3(cornerOffset(static_cast<int>(n))));
    };
    Corners outer_at{}, core_at{}, hard_at{};
    for (std::size_t n = 0; n < outer_at.size(); ++n) {
      if (!outside) outer_at[n] = shell_->outer_mm(corner(n));
      if (near_core) core_at[n] = shell_->core_mm(corner(n), outer_at[n]);
      if (!inside) hard_at[n] = around_.hard_mm(corner(n));
    }
    const Spread outer = outside ? constant(middle_mm) : spread(outer_at);
    const Spread core = near_core ? spread(core_at) : constant(middle_core_mm);
    const Spread hard_tissue = inside ? constant(1.0) : spread(hard_at);
    const auto soft_label = around_.label(cube.low_P, cube.high_P, false);
    const auto hard_label = around_.label(cube.low_P, cube.high_P, true);
    const auto label_at = [&](const glm::dvec3& p_P, bool is_hard) {
      const auto& all = is_hard ? hard_label : soft_label;
      return all ? *all : around_.label(p_P, is_hard);
    };
    const double pulp_mm = outside ? 1.0 : pulp_.at_mm(cube.middle_P);
    const bool near_pulp = std::abs(pulp_mm) < kPulpSteep * cube.reach_mm;
    const PulpDistance::Parts parts = near_pulp ? pulp_.partsNear(cube.middle_P, cube.reach_mm) : 0;
    const double shown_mm = outside ? 1.0 : shell_->pulp_mm(cube.middle_P);
    const bool near_shown = std::abs(shown_mm) < near_mm;
    std::size_t v = 0;
    forVoxels(block * kEdge, block * kEdge + kEdge, [&](glm::ivec3 ijk) {
      const glm::dvec3 p_P = grid_.centre_P_mm(ijk);
      const double pulp =
          std::min(near_pulp ? pulp_.at_mm(p_P, parts) : pulp_mm, near_shown ? shell_->pulp_mm(p_P) : shown_mm);
      const double hard = inside ? 1.0 : std::max(hard_tissue[v], kLigament_mm - outer[v]);
      const double tooth = outside ? -1.0 : std::min(-outer[v], pulp);
      solid[v] = solidOf(std::max(tooth, -hard));
      if (outer[v] >= 0.0)
        label[v] = label_at(p_P, hard < 0.0);
      else
        label[v] = labelOf(pulp < 0.0 ? Tissue::pulp : core[v] < 0.0 ? Tissue::dentine : Tissue::enamel);
      ++v;
    });
  }

 private:
  struct Cube {
    glm::dvec3 low_P, high_P, middle_P;
    double reach_mm;  ///< from its middle to the farthest centre, and to where its voxel is whole
  };

  static constexpr std::uint8_t labelOf(Tissue tissue) { return static_cast<std::uint8_t>(tissue); }

  Cube cubeAt(glm::ivec3 low, int edge) const {
    const glm::dvec3 low_P = grid_.centre_P_mm(low), high_P = grid_.centre_P_mm(low + edge - 1);
    return {low_P, high_P, 0.5 * (low_P + high_P), 0.5 * glm::distance(low_P, high_P) + 0.5 * grid_.spacing_mm};
  }

  using Corners = std::array<double, 8>;
  using Spread = std::array<double, kVoxels>;
  static Spread constant(double everywhere) {
    Spread out;
    out.fill(everywhere);
    return out;
  }
  /// Linear between the corners of a block.
  static Spread spread(const Corners& at) {
    Spread out;
    std::size_t v = 0;
    constexpr double kStep = 1.0 / (kEdge - 1);
    for (int k = 0; k < kEdge; ++k)
      for (int j = 0; j < kEdge; ++j) {
        const auto across = [&](std::size_t n) {
          const double low = at[n] + kStep * j * (at[n + 2] - at[n]);
          return low + kStep * k * (at[n + 4] + kStep * j * (at[n + 6] - at[n + 4]) - low);
        };
        const double low = across(0), step = kStep * (across(1) - low);
        for (int i = 0; i < kEdge; ++i) out[v++] = low + step * i;
      }
    return out;
  }

  std::uint8_t solidOf(double depth_mm) const {
    return static_cast<std::uint8_t>(255.0 * std::clamp(0.5 + depth_mm / grid_.spacing_mm, 0.0, 1.0) + 0.5);
  }

  std::unique_ptr<ToothShell> shell_;
  PulpDistance pulp_;
  VolumeGrid grid_;
  ToothSurroundings around_;
};

}  // namespace

std::unique_ptr<ToothSampler> fineTooth(std::unique_ptr<ToothShell> shell, const ToothCanals& canals,
                                        const CtVolume& ct, double spacing_mm) {
  refuseThinCanals(canals, spacing_mm);
  return std::make_unique<FineTooth>(std::move(shell), canals, ct, spacing_mm);
}

}  // namespace assets
