#include "app/procedure/preparation/crown.h"

#include <algorithm>
#include <cmath>

namespace app {
namespace {

constexpr int kEdge = FineSolid::kEdge;
constexpr int kAround = 6;  ///< blocks: as far as a bur beside the tooth cuts a neighbour

/// Whole blocks around all of the tooth over a height, and how far it reaches.
struct Extent {
  glm::ivec3 low{1 << 30}, high{-1};  ///< blocks
  double top_mm = 0.0, reach_mm = 0.0;
};

Extent extentOf(const ToothBlocks& tooth, const assets::ToothFrame& frame, double below_mm) {
  Extent extent;
  const assets::VolumeGrid& grid = tooth.grid();
  assets::forVoxels(glm::ivec3(0), grid.size / kEdge, [&](glm::ivec3 block) {
    const FineSolid::Block label = tooth.labels(block), solid = tooth.block(block);
    if (label.bytes == nullptr && !assets::isToothPart(label.same)) return;
    const glm::dvec3 middle = frame.local(grid.centre_P_mm(block * kEdge + kEdge / 2));
    if (middle.z < -below_mm) return;
    bool is_tooth = false;
    std::size_t v = 0;
    assets::forVoxels(block * kEdge, (block + 1) * kEdge, [&](glm::ivec3 ijk) {
      const std::size_t at = v++;
      if (!assets::isToothPart(label.at(at)) || solid.at(at) < 128) return;
      is_tooth = true;
      const glm::dvec3 p = frame.local(grid.centre_P_mm(ijk));
      extent.top_mm = std::max(extent.top_mm, p.z + 0.5 * grid.spacing_mm);
      if (p.z > 0.0) extent.reach_mm = std::max(extent.reach_mm, std::hypot(p.x, p.y));
    });
    if (!is_tooth) return;
    extent.low = glm::min(extent.low, block), extent.high = glm::max(extent.high, block);
  });
  return extent;
}

assets::VolumeGrid boxOf(const ToothBlocks& tooth, const Extent& extent) {
  const assets::VolumeGrid& grid = tooth.grid();
  if (extent.high.x < 0) return {glm::ivec3(kEdge), grid.spacing_mm, grid.origin_P_mm};
  const glm::ivec3 low = glm::max(extent.low - kAround, glm::ivec3(0)) * kEdge;
  const glm::ivec3 end = glm::min((extent.high + 1 + kAround) * kEdge, grid.size);
  return {end - low, grid.spacing_mm, grid.centre_P_mm(low)};
}

/// The labels of a tooth's blocks as a field.
class LabelField final : public FineSolid {
 public:
  explicit LabelField(const ToothBlocks& tooth) : tooth_(tooth) {}
  const assets::VolumeGrid& grid() const override { return tooth_.grid(); }
  Block block(glm::ivec3 block) const override { return tooth_.labels(block); }

 private:
  const ToothBlocks& tooth_;
};

/// Stretches of matter along x, and which of them hang together by their faces.
class MatterRuns {
 public:
  MatterRuns(const Crown& crown, const BoxBytes& made) : size_(made.grid().size), rows_{0} {
    constexpr std::uint8_t kHolds = 64;  ///< any matter holds, however thin
    std::size_t v = 0;
    for (int row = 0; row < size_.y * size_.z; ++row) {
      for (int x = 0; x < size_.x; ++x, ++v) {
        if (made.bytes()[v] < kHolds || !assets::isToothPart(crown.label.bytes()[v])) continue;
        if (rows_.back() == runs_.size() || runs_.back().end != x)
          runs_.push_back({x, x, static_cast<std::uint32_t>(runs_.size())});
        runs_.back().end = x + 1;
      }
      rows_.push_back(runs_.size());
      if (row % size_.y > 0) join(row - 1, row);
      if (row >= size_.y) join(row - size_.y, row);
    }
  }

  /// visit(row, from, end, number of its piece).
  template <class Visit>
  void forEach(const Visit& visit) {
    for (int row = 0; row < size_.y * size_.z; ++row)
      for (std::size_t n = rows_[static_cast<std::size_t>(row)]; n < rows_[static_cast<std::size_t>(row) + 1]; ++n)
        visit(row, runs_[n].from, runs_[n].end, rootOf(static_cast<std::uint32_t>(n)));
  }
  std::size_t count() const { return runs_.size(); }

 private:
  struct Run {
    int from, end;
    std::uint32_t parent;
  };

  std::uint32_t rootOf(std::uint32_t n) {
    while (runs_[n].parent != n) n = runs_[n].parent = runs_[runs_[n].parent].parent;
    return n;
  }
  void join(int row, int other) {
    std::size_t a = rows_[static_cast<std::size_t>(row)], b = rows_[static_cast<std::size_t>(other)];
    const std::size_t end_a = rows_[static_cast<std::size_t>(row) + 1],
                      end_b = rows_[static_cast<std::size_t>(other) + 1];
    while (a < end_a && b < end_b) {
      if (runs_[a].from < runs_[b].end && runs_[b].from < runs_[a].end)
        runs_[rootOf(static_cast<std::uint32_t>(a))].parent = rootOf(static_cast<std::uint32_t>(b));
      (runs_[a].end < runs_[b].end ? a : b) += 1;
    }
  }

  glm::ivec3 size_;
  std::vector<Run> runs_;
  std::vector<std::size_t> rows_;  ///< where each begins
};

/// 1 in the voxels of what hangs on the tooth's neck.
std::vector<std::uint8_t> standing(const Crown& crown, const BoxBytes& made) {
  constexpr double kNeck_mm = 0.5;
  const assets::VolumeGrid& grid = made.grid();
  MatterRuns runs(crown, made);
  const auto height_mm = [&](int row, int x) {
    return crown.frame.local(grid.centre_P_mm({x, row % grid.size.y, row / grid.size.y})).z;
  };
  std::vector<std::uint8_t> holds(runs.count(), 0), stands(grid.voxelCount(), 0);
  runs.forEach([&](int row, int from, int end, std::uint32_t piece) {
    // Heights are straight along a run.
    if (std::min(height_mm(row, from), height_mm(row, end - 1)) < kNeck_mm) holds[piece] = 1;
  });
  runs.forEach([&](int row, int from, int end, std::uint32_t piece) {
    if (holds[piece] == 0) return;
    const std::size_t first = static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.size.x);
    std::fill(stands.begin() + static_cast<std::ptrdiff_t>(first) + from,
              stands.begin() + static_cast<std::ptrdiff_t>(first) + end, std::uint8_t{1});
  });
  return stands;
}

}  // namespace

BoxBytes::BoxBytes(const FineSolid& field, const assets::VolumeGrid& box) : BoxBytes(box) {
  const glm::ivec3 low(glm::round(field.grid().indexFromPoint(box.origin_P_mm))), end = low + box.size;
  assets::forVoxels(low / kEdge, (end + kEdge - 1) / kEdge, [&](glm::ivec3 block) {
    const FineSolid::Block one = field.block(block);
    if (one.bytes == nullptr && one.same == 0) return;
    const glm::ivec3 from = glm::max(block * kEdge, low), to = glm::min((block + 1) * kEdge, end);
    assets::forVoxels(from, to, [&](glm::ivec3 ijk) { bytes_[box.index(ijk - low)] = one.at(FineSolid::within(ijk)); });
  });
}

double BoxBytes::atIndex(const glm::dvec3& index) const {
  if (isInside(index)) return inside(index);
  return assets::trilinearAt(grid_, grid_.origin_P_mm + grid_.spacing_mm * index,
                             [this](glm::ivec3 at) { return voxel(at) / 255.0; });
}

double BoxBytes::solidBetween_mm(const glm::dvec3& from_P_mm, const glm::dvec3& way_P, double length_mm) const {
  constexpr int kSamples = 28;
  const double step_mm = length_mm / kSamples;
  const glm::dvec3 step = way_P * (step_mm / grid_.spacing_mm);
  const glm::dvec3 first = grid_.indexFromPoint(from_P_mm) + 0.5 * step;
  double sum = 0.0;
  if (isInside(first) && isInside(first + (kSamples - 1.0) * step))
    for (int n = 0; n < kSamples; ++n) sum += inside(first + static_cast<double>(n) * step);
  else
    for (int n = 0; n < kSamples; ++n) sum += atIndex(first + static_cast<double>(n) * step);
  return sum * step_mm;
}

Crown::Crown(const ToothBlocks& tooth, const assets::ToothFrame& of, double below_mm)
    : frame(of), solid(assets::VolumeGrid{}), label(assets::VolumeGrid{}) {
  const Extent extent = extentOf(tooth, frame, below_mm);
  const assets::VolumeGrid box = boxOf(tooth, extent);
  solid = BoxBytes(tooth, box);
  label = BoxBytes(LabelField(tooth), box);
  top_mm = extent.top_mm, reach_mm = extent.reach_mm;
}

BoxBytes attached(const Crown& crown, const BoxBytes& made) {
  const assets::VolumeGrid& grid = made.grid();
  const auto is_tooth = [&](std::size_t v) { return assets::isToothPart(crown.label.bytes()[v]); };
  const std::vector<std::uint8_t> stands = standing(crown, made);
  // A rim that is thinner than what holds goes with what it borders on.
  BoxBytes left = made;
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (made.bytes()[v] == 0 || stands[v] != 0 || !is_tooth(v)) return;
    bool is_beside = false;
    assets::forVoxels(glm::max(ijk - 1, glm::ivec3(0)), glm::min(ijk + 2, grid.size),
                      [&](glm::ivec3 at) { is_beside = is_beside || stands[grid.index(at)] != 0; });
    if (!is_beside) left.bytes()[v] = 0;
  });
  return left;
}

}  // namespace app
