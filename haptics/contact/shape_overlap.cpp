#include "haptics/contact/shape_overlap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "haptics/bone/bur_coverage.h"

namespace haptics {
namespace {

/// From a block's middle to the middle of its farthest voxel.
const double kBlockReach = 0.5 * (kBlockEdge - 1) * std::sqrt(3.0);
constexpr int kFullBlock = 255 * kBlockVoxels;

/// In voxels and steps of 1/255 (1/255² for grey).
struct Sums {
  double volume = 0.0, stiff = 0.0, grey = 0.0;
  glm::dvec3 moment_T{0.0};      ///< of partly covered voxels, along T
  glm::dvec3 moment_index{0.0};  ///< of whole voxels, along i, j, k
  glm::dvec3 rise_index{0.0};    ///< neighbour differences along i, j, k, weighted by coverage
};

/// A block and its six neighbours; air beyond the volume.
class Neighbourhood {
 public:
  Neighbourhood(const SolidField& field, glm::ivec3 block) : field_(field), block_(block) {
    constexpr std::array<glm::ivec3, kBlocks> kOffset = {
        {{0, 0, 0}, {-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};
    int total = 0;
    for (std::size_t n = 0; n < kBlocks; ++n) {
      const glm::ivec3 at = block + kOffset[n];
      const bool there = at.x >= 0 && at.y >= 0 && at.z >= 0 && at.x < field.blocks.x && at.y < field.blocks.y &&
                         at.z < field.blocks.z;
      const std::size_t slot = there ? field.slotAt(at) : 0;
      const int weight = there ? field.weight[slot] : 0;
      solid_[n] = weight != 0 ? field.solid + slot * kBlockVoxels : kAir.data();
      total += weight;
      if (n == 0) slot_ = slot, weight_ = weight;
    }
    empty_ = total == 0;
    even_ = empty_ || total == kBlocks * kFullBlock;
  }

  bool empty() const { return empty_; }
  /// Every voxel of the block has equal neighbours.
  bool even() const { return even_; }
  bool airInside() const { return weight_ == 0; }
  int weight() const { return weight_; }
  std::size_t slot() const { return slot_; }
  const std::uint8_t* solid() const { return solid_[0]; }

  /// Difference of every voxel's neighbours along i, j, k.
  using Rise = std::array<std::array<std::int16_t, kBlockVoxels>, 3>;
  void riseInto(Rise& rise) const {
    const std::uint8_t *own = solid_[0], *left = solid_[1], *right = solid_[2], *front = solid_[3], *back = solid_[4],
                       *below = solid_[5], *above = solid_[6];
    for (int n = 0; n < kBlockVoxels; ++n) {
      const int before_k = n < 16 ? below[n + 48] : own[n - 16], after_k = n < 48 ? own[n + 16] : above[n - 48];
      rise[2][static_cast<std::size_t>(n)] = static_cast<std::int16_t>(after_k - before_k);
    }
    for (int plane = 0; plane < kBlockVoxels; plane += 16)
      for (int n = 0; n < 16; ++n) {
        const int before_j = n < 4 ? front[plane + n + 12] : own[plane + n - 4];
        const int after_j = n < 12 ? own[plane + n + 4] : back[plane + n - 12];
        rise[1][static_cast<std::size_t>(plane + n)] = static_cast<std::int16_t>(after_j - before_j);
      }
    for (int row = 0; row < kBlockVoxels; row += 4) {
      const int w[6] = {left[row + 3], own[row], own[row + 1], own[row + 2], own[row + 3], right[row]};
      for (int n = 0; n < 4; ++n)
        rise[0][static_cast<std::size_t>(row + n)] = static_cast<std::int16_t>(w[n + 2] - w[n]);
    }
  }

 private:
  static constexpr std::size_t kBlocks = 7;
  static constexpr std::array<std::uint8_t, kBlockVoxels> kAir{};
  const SolidField& field_;
  glm::ivec3 block_;
  std::array<const std::uint8_t*, kBlocks> solid_;
  std::size_t slot_ = 0;
  int weight_ = 0;
  bool empty_ = true, even_ = true;
};

/// Interval of the head's axis, voxels from its middle; interval of blocks along a row.
struct Span {
  double from, to;
};
struct Range {
  int first, last;
};

/// Blocks near parts of the axis, so that a long thin head does not visit its whole box.
class AxisSpans {
 public:
  explicit AxisSpans(const BurCoverage& bur) : centre_(bur.centre), axis_(bur.to_T[0].z, bur.to_T[1].z, bur.to_T[2].z) {
    const bool slanted = bur.kind == ShapeKind::cone || bur.kind == ShapeKind::revolved;
    const bool flat = bur.kind == ShapeKind::cylinder || slanted;
    // Discs reach across the axis, balls in all directions; a voxel within reach of two faces of an edge is farther
    // out.
    reach_ = (flat ? glm::sqrt(glm::max(glm::dvec3(0.0), 1.0 - axis_ * axis_)) : glm::dvec3(1.0)) * bur.radius;
    const double at_an_edge = flat ? 1.0 / std::min(bur.side_cos, 0.7) : 1.0;
    reach_ += bur.voxel_reach * at_an_edge * (slanted ? 2.0 : 1.0);
  }

  /// The part of `span` near the blocks with this index along an axis; empty: from > to.
  Span within(const Span& span, int axis, int block) const {
    const double middle = kBlockEdge * block + 0.5 * (kBlockEdge - 1), off = middle - centre_[axis];
    const double room = reach_[axis] + 0.5 * (kBlockEdge - 1), slope = axis_[axis];
    if (std::abs(slope) < 1e-9) return std::abs(off) <= room ? span : Span{1.0, -1.0};
    const double one = (off - room) / slope, other = (off + room) / slope;
    return {std::max(span.from, std::min(one, other)), std::min(span.to, std::max(one, other))};
  }

  /// The blocks near an interval, along an axis.
  Range blocksOn(const Span& span, int axis, const Range& most) const {
    if (span.from > span.to) return {0, -1};
    const double one = centre_[axis] + span.from * axis_[axis], other = centre_[axis] + span.to * axis_[axis];
    const double low = (std::min(one, other) - reach_[axis] - (kBlockEdge - 1)) / kBlockEdge;
    const double high = (std::max(one, other) + reach_[axis]) / kBlockEdge;
    return {static_cast<int>(std::max(std::ceil(low), static_cast<double>(most.first))),
            static_cast<int>(std::min(std::floor(high), static_cast<double>(most.last)))};
  }

 private:
  glm::dvec3 centre_, axis_, reach_{0.0};
};

/// The sum over a field, block by block.
class BlockSums {
 public:
  BlockSums(const SolidField& field, const BurCoverage& bur, const TissueStiffness& tissue)
      : field_(field), bur_(bur), tissue_(tissue), head_(bur.kernelShape()), reach_(kBlockReach + bur.voxel_reach) {}

  /// Skips rows in air with one test.
  void addRow(const Range& row, int j, int k) {
    if (isAir(row, j, k) && isAir(row, j - 1, k) && isAir(row, j + 1, k) && isAir(row, j, k - 1) &&
        isAir(row, j, k + 1))
      return;
    for (int i = row.first; i <= row.last; ++i) add({i, j, k});
  }

  const Sums& sums() const { return sums_; }

 private:
  /// The blocks of a row, and the one before and after it.
  bool isAir(const Range& row, int j, int k) const {
    if (j < 0 || k < 0 || j >= field_.blocks.y || k >= field_.blocks.z) return true;
    const int first = std::max(row.first - 1, 0), last = std::min(row.last + 1, field_.blocks.x - 1);
    const std::size_t blocks = field_.blockAt({0, j, k});
    unsigned any = 0;
    for (int i = first; i <= last; ++i) any |= field_.weight[field_.slotOf(blocks + static_cast<std::size_t>(i))];
    return any == 0;
  }

  void add(glm::ivec3 block) {
    const Neighbourhood around(field_, block);
    if (around.empty()) return;
    const glm::dvec3 corner(block * kBlockEdge), position = bur_.to_T * (corner - bur_.centre);
    const double beyond = bur_.beyondFaces(position + to_middle_);
    if (beyond >= reach_) return;
    if (beyond <= -reach_)
      addWhole(around, corner);
    else
      addCut(around, block * kBlockEdge, position);
  }

  /// Every voxel counts whole: uses the block's sums (reference/physics 5).
  void addWhole(const Neighbourhood& around, const glm::dvec3& corner) {
    const std::size_t at = around.slot();
    if (!around.airInside()) {
      const double weight = around.weight();
      sums_.volume += weight;
      sums_.grey += field_.grey[at];
      sums_.moment_index +=
          glm::dvec3(field_.weight_x[at], field_.weight_y[at], field_.weight_z[at]) + weight * (corner - bur_.centre);
      sums_.stiff += stiffOf(around);
    }
    if (around.even()) return;
    around.riseInto(rise_);
    for (int axis = 0; axis < 3; ++axis) {
      int sum = 0;
      for (const std::int16_t rise : rise_[static_cast<std::size_t>(axis)]) sum += rise;
      sums_.rise_index[axis] += sum;
    }
  }

  void addCut(const Neighbourhood& around, glm::ivec3 corner, const glm::dvec3& position) {
    HeadBlock block{{static_cast<float>(position.x), static_cast<float>(position.y), static_cast<float>(position.z)},
                    around.solid(),
                    {},
                    nullptr,
                    0.0f};
    if (!around.even()) {
      around.riseInto(rise_);
      for (std::size_t axis = 0; axis < 3; ++axis) block.rise[axis] = rise_[axis].data();
    }
    if (const auto only = onlyFactor(around)) {
      block.only_factor = static_cast<float>(*only);
    } else {
      for (std::size_t n = 0; n < kBlockVoxels; ++n)
        factor_[n] = static_cast<float>(tissue_.of(field_.label[around.slot() * kBlockVoxels + n]));
      block.factor = factor_.data();
    }
    const HeadSums cut = bur_.hasKernel() ? sumUnderHead(head_, block) : sumInParts(block, corner);
    sums_.volume += cut.volume;
    sums_.stiff += cut.stiff;
    sums_.grey += cut.grey;
    for (int axis = 0; axis < 3; ++axis) {
      sums_.moment_T[axis] += cut.moment[axis];
      sums_.rise_index[axis] += cut.rise[axis];
    }
  }

  /// A head of a voxel or two: voxel by voxel in double.
  HeadSums sumInParts(const HeadBlock& block, glm::ivec3 corner) const {
    Sums sums;
    for (int n = 0; n < kBlockVoxels; ++n) {
      const double w = block.solid[n];
      const bool rises = block.rise[0] != nullptr && (block.rise[0][n] | block.rise[1][n] | block.rise[2][n]) != 0;
      if (w == 0.0 && !rises) continue;
      const VoxelShare share = bur_.shareAt(corner + glm::ivec3(n & 3, n >> 2 & 3, n >> 4));
      const double covered = w * share.fraction;
      sums.volume += covered;
      sums.grey += covered * (255.0 - w);
      sums.stiff += covered * (block.factor != nullptr ? block.factor[n] : block.only_factor);
      sums.moment_T += w * share.moment;
      if (!rises) continue;
      for (int axis = 0; axis < 3; ++axis) sums.rise_index[axis] += share.fraction * block.rise[axis][n];
    }
    const glm::vec3 moment(sums.moment_T), rise(sums.rise_index);
    return {static_cast<float>(sums.volume),
            static_cast<float>(sums.stiff),
            static_cast<float>(sums.grey),
            {moment.x, moment.y, moment.z},
            {rise.x, rise.y, rise.z}};
  }

  /// Of a block with one tissue.
  std::optional<double> onlyFactor(const Neighbourhood& around) const {
    if (field_.label == nullptr || around.airInside()) return tissue_.factor[0];
    const std::uint8_t only = field_.only_label[around.slot()];
    return only == kMixedLabels ? std::nullopt : std::optional(tissue_.of(only));
  }
  double stiffOf(const Neighbourhood& around) const {
    if (const auto only = onlyFactor(around)) return around.weight() * *only;
    double sum = 0.0;
    for (std::size_t n = 0; n < kBlockVoxels; ++n)
      sum += around.solid()[n] * tissue_.of(field_.label[around.slot() * kBlockVoxels + n]);
    return sum;
  }

  const SolidField& field_;
  const BurCoverage& bur_;
  const TissueStiffness& tissue_;
  HeadShape head_;
  double reach_;
  glm::dvec3 to_middle_ = bur_.to_T * glm::dvec3(0.5 * (kBlockEdge - 1));
  Sums sums_;
  Neighbourhood::Rise rise_;
  std::array<float, kBlockVoxels> factor_;
};

ShapeOverlap scaled(const Sums& sums, const BurCoverage& bur, double s) {
  const glm::dmat3 to_P = glm::transpose(bur.to_T);
  const double voxel = s * s * s / 255.0;
  return {sums.volume * voxel,
          {(to_P * sums.moment_T + sums.moment_index) * (voxel * s)},
          {sums.rise_index * (-0.5 * s * s / 255.0)},
          sums.stiff * voxel,
          sums.grey * voxel / 255.0};
}

/// Half the area of a surface at the volume's boundary is in the voxels beyond.
constexpr int kBeyond = 1;

}  // namespace

ShapeOverlap shapeOverlap(const SolidField& field, const BurShape& shape,
                          const calibration::Pose<calibration::Patient, calibration::Tool>& X_PT,
                          const TissueStiffness& tissue) noexcept {
  const BurCoverage bur(field.grid, shape, X_PT, kBeyond);
  if (bur.box.empty()) return {};
  BlockSums blocks(field, bur, tissue);
  const glm::ivec3 first = (bur.box.first + kBlockEdge) / kBlockEdge - 1,
                   last = (bur.box.last + kBlockEdge) / kBlockEdge - 1;
  const AxisSpans spans(bur);
  for (int k = first.z; k <= last.z; ++k) {
    const Span in_plane = spans.within({-bur.half, bur.half}, 2, k);
    const Range rows = spans.blocksOn(in_plane, 1, {first.y, last.y});
    for (int j = rows.first; j <= rows.last; ++j) {
      const Range row = spans.blocksOn(spans.within(in_plane, 1, j), 0, {first.x, last.x});
      blocks.addRow(row, j, k);
    }
  }
  return scaled(blocks.sums(), bur, field.grid.spacing_mm);
}

ShapeOverlap shapeOverlap(const SolidBodies& bodies, const BurShape& shape,
                          const calibration::Pose<calibration::Patient, calibration::Tool>& X_PT,
                          const TissueStiffness& tissue) noexcept {
  const std::span<const SolidBody> all = bodies.bodies();
  ShapeOverlap sum = shapeOverlap(all.front().field, shape, X_PT, tissue);
  for (const SolidBody& body : all.subspan(1)) {
    const ShapeOverlap part = shapeOverlap(body.field, shape, body.inBody(X_PT), tissue);
    sum.volume_mm3 += part.volume_mm3;
    sum.first_moment_P_mm4 = sum.first_moment_P_mm4 + body.fromBody(part.first_moment_P_mm4);
    sum.area_P_mm2 = sum.area_P_mm2 + body.fromBody(part.area_P_mm2);
    sum.stiff_mm3 += part.stiff_mm3;
    sum.grey_mm3 += part.grey_mm3;
  }
  return sum;
}

}  // namespace haptics
