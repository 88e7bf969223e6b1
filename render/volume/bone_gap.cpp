#include "render/volume/bone_gap.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/volume/bur_distance.h"

namespace render {
namespace {

constexpr int kBrick = assets::kBrickVoxels;
constexpr double kSurfaceSolid = 127.5;
constexpr int kFiner = 4;               // parts of a voxel's edge around the nearest places
constexpr std::size_t kMostCells = 48;  // that are looked at more finely
constexpr double kCellReach = 0.87;     // voxels from a crossing to anywhere in a cell that it borders: half a diagonal

/// The cutting head in P.
class Head {
 public:
  explicit Head(const Frame& frame)
      : frame_(frame),
        centre_(frame.X_PT.translation_mm),
        axis_(frame.X_PT.rotation * glm::dvec3(0.0, 0.0, 1.0)),
        reach_mm_(burReach_mm(frame)) {}

  const glm::dvec3& centre_P_mm() const { return centre_; }
  double reach_mm() const { return reach_mm_; }
  double distance_mm(const glm::dvec3& p_P_mm) const {
    const glm::dvec3 offset = p_P_mm - centre_;
    const double z = glm::dot(offset, axis_);
    return burDistance_mm(frame_, glm::dvec2(std::sqrt(std::max(glm::dot(offset, offset) - z * z, 0.0)), z));
  }

 private:
  const Frame& frame_;
  glm::dvec3 centre_, axis_;
  double reach_mm_;
};

/// Solid fraction of a cell's corners, 0..255, trilinear in between. Corner n: bit 0 i, bit 1 j, bit 2 k.
struct Cell {
  std::array<double, 8> corner;

  Cell(const BorderedField<std::uint8_t>& solid, glm::ivec3 first) : corner() {
    for (int n = 0; n < 8; ++n)
      corner[static_cast<std::size_t>(n)] = *solid.at(first + glm::ivec3(n & 1, (n >> 1) & 1, n >> 2));
  }
  double at(const glm::dvec3& part) const {
    const auto row = [&](std::size_t n) { return glm::mix(corner[n], corner[n + 1], part.x); };
    return glm::mix(glm::mix(row(0), row(2), part.y), glm::mix(row(4), row(6), part.y), part.z);
  }
};

/// Calls visit(place, from 0 to 1 in the cell) where the surface crosses the edges of a finer lattice.
template <class Visit>
void forCrossingsIn(const Cell& cell, const Visit& visit) {
  constexpr int kEnd = kFiner + 1;
  std::array<double, kEnd * kEnd * kEnd> value;
  const auto index = [](int i, int j, int k) { return static_cast<std::size_t>((k * kEnd + j) * kEnd + i); };
  for (int k = 0; k < kEnd; ++k)
    for (int j = 0; j < kEnd; ++j)
      for (int i = 0; i < kEnd; ++i) value[index(i, j, k)] = cell.at(glm::dvec3(i, j, k) / double{kFiner});
  for (int k = 0; k < kEnd; ++k)
    for (int j = 0; j < kEnd; ++j)
      for (int i = 0; i < kEnd; ++i)
        for (int axis = 0; axis < 3; ++axis) {
          glm::ivec3 next(i, j, k);
          if (++next[axis] == kEnd) continue;
          const double here = value[index(i, j, k)], there = value[index(next.x, next.y, next.z)];
          if ((here < kSurfaceSolid) == (there < kSurfaceSolid)) continue;
          glm::dvec3 place(i, j, k);
          place[axis] += (kSurfaceSolid - here) / (there - here);
          visit(place / double{kFiner});
        }
}

/// First voxel of a brick; those at the volume's side include the border of air.
glm::ivec3 firstOf(glm::ivec3 brick) {
  return glm::mix(kBrick * brick, glm::ivec3(-1), glm::equal(brick, glm::ivec3(0)));
}

}  // namespace

GapFinder::GapFinder(const assets::VolumeGrid& grid, const BorderedField<std::uint8_t>& solid)
    : grid_(grid), solid_(solid), bricks_(grid.bricks()), marks_(countIn(bricks_), Mark::unknown) {}

// Edges that leave a brick belong to it, so its neighbours before it change too.
void GapFinder::touch(glm::ivec3 brick) {
  const VoxelBox around{glm::max(brick - 1, glm::ivec3(0)), brick - glm::max(brick - 1, glm::ivec3(0)) + 1};
  forEachIn(around, [&](glm::ivec3 one) { marks_[indexIn(bricks_, one)] = Mark::unknown; });
}

bool GapFinder::hasSurface(glm::ivec3 brick) {
  Mark& mark = marks_[indexIn(bricks_, brick)];
  if (mark != Mark::unknown) return mark == Mark::surface;
  const glm::ivec3 first = firstOf(brick), end = glm::min(kBrick * (brick + 1) + 1, grid_.size + 1);
  bool air = false, matter = false;
  for (int k = first.z; k < end.z; ++k)
    for (int j = first.y; j < end.y; ++j) {
      const std::uint8_t* const row = solid_.at({first.x, j, k});
      for (int i = 0; i < end.x - first.x; ++i) (row[i] > kSurfaceSolid ? matter : air) = true;
    }
  mark = air && matter ? Mark::surface : Mark::no_surface;
  return air && matter;
}

/// Bricks within reach that have surface, nearest first. A brick covers the cells that begin in it.
void GapFinder::collect(const glm::dvec3& centre_P_mm, double reach_mm, double enclosing_mm) {
  nearby_.clear();
  const glm::dvec3 centre = (centre_P_mm - grid_.origin_P_mm) / grid_.spacing_mm;
  const double reach = (reach_mm + enclosing_mm) / grid_.spacing_mm;
  const glm::dvec3 last(bricks_ - 1);
  const glm::ivec3 low(glm::clamp(glm::floor((centre - reach) / double{kBrick}) - 1.0, glm::dvec3(0.0), last));
  const glm::ivec3 high(glm::clamp(glm::floor((centre + reach) / double{kBrick}), glm::dvec3(0.0), last));
  forEachIn({low, high - low + 1}, [&](glm::ivec3 brick) {
    const glm::dvec3 first(firstOf(brick));
    const glm::dvec3 outside =
        glm::max(glm::max(first - centre, centre - double{kBrick} * glm::dvec3(brick + 1)), glm::dvec3(0.0));
    const double at_least_mm = glm::length(outside) * grid_.spacing_mm - enclosing_mm;
    if (at_least_mm <= reach_mm && hasSurface(brick)) nearby_.push_back({static_cast<float>(at_least_mm), brick});
  });
  std::ranges::sort(nearby_, {}, &Nearby::at_least_mm);
}

std::optional<BoneGap> GapFinder::find(const Frame& frame) {
  const Head head(frame);
  const glm::dvec3 centre_P_mm = head.centre_P_mm();
  if (!std::isfinite(glm::length(centre_P_mm)) || !std::isfinite(head.reach_mm())) return {};
  const double spacing = grid_.spacing_mm;
  const auto place = [&](const glm::dvec3& index) { return grid_.origin_P_mm + spacing * index; };

  // Inside the bone nothing is left of the gap.
  const glm::dvec3 index = (centre_P_mm - grid_.origin_P_mm) / spacing;
  if (glm::all(glm::greaterThanEqual(index, glm::dvec3(-1.0))) &&
      glm::all(glm::lessThan(index, glm::dvec3(grid_.size)))) {
    const glm::dvec3 low = glm::floor(index);
    if (Cell(solid_, glm::ivec3(low)).at(index - low) > kSurfaceSolid) return BoneGap{0.0, {centre_P_mm}};
  }

  // The nearest crossing of a voxel edge, and the cells next to those that come close to it.
  struct Crossing {
    double mm;
    glm::ivec3 voxel;
    int axis;
  };
  double best_mm = kMaxGap_mm + kCellReach * spacing;
  glm::dvec3 nearest(0.0);
  std::vector<Crossing> crossings;
  collect(centre_P_mm, best_mm, head.reach_mm());
  const auto& layout = solid_.layout();
  const std::array<std::ptrdiff_t, 3> stride{1, layout.row, layout.slice};
  for (const Nearby& near : nearby_) {
    if (near.at_least_mm > best_mm + 2.0 * kCellReach * spacing) break;
    const glm::ivec3 first = firstOf(near.brick), end = glm::min(kBrick * (near.brick + 1), grid_.size);
    forEachIn({first, end - first}, [&](glm::ivec3 voxel) {
      const std::uint8_t* const here = solid_.at(voxel);
      for (int axis = 0; axis < 3; ++axis) {
        const double a = *here, b = here[stride[static_cast<std::size_t>(axis)]];
        if ((a < kSurfaceSolid) == (b < kSurfaceSolid)) continue;
        glm::dvec3 at(voxel);
        at[axis] += (kSurfaceSolid - a) / (b - a);
        const glm::dvec3 p = place(at);
        const double mm = head.distance_mm(p);
        if (mm < best_mm + 2.0 * kCellReach * spacing) crossings.push_back({mm, voxel, axis});
        if (mm < best_mm) best_mm = mm, nearest = p;
      }
    });
  }
  if (crossings.empty()) return {};

  // More finely in the nearest cells.
  std::erase_if(crossings, [&](const Crossing& one) { return one.mm > best_mm + 2.0 * kCellReach * spacing; });
  const std::size_t finer = std::min(kMostCells / 4, crossings.size());
  std::ranges::partial_sort(crossings, crossings.begin() + static_cast<std::ptrdiff_t>(finer), {}, &Crossing::mm);
  std::vector<glm::ivec3> looked_at;
  for (std::size_t n = 0; n < finer; ++n)
    for (int side = 0; side < 4; ++side) {
      glm::ivec3 cell = crossings[n].voxel;
      cell[(crossings[n].axis + 1) % 3] -= side & 1;
      cell[(crossings[n].axis + 2) % 3] -= side >> 1;
      if (std::ranges::find(looked_at, cell) != looked_at.end()) continue;
      looked_at.push_back(cell);
      forCrossingsIn(Cell(solid_, cell), [&](const glm::dvec3& part) {
        const glm::dvec3 p = place(glm::dvec3(cell) + part);
        const double mm = head.distance_mm(p);
        if (mm < best_mm) best_mm = mm, nearest = p;
      });
    }
  if (best_mm > kMaxGap_mm) return {};
  return BoneGap{std::max(best_mm, 0.0), {nearest}};
}

}  // namespace render
