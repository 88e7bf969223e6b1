#include "assets/import/mandibular_canal_voxels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <queue>
#include <unordered_map>

#include "assets/tissue.h"

namespace assets {

namespace {

constexpr double kMinCell_mm = 0.8;
constexpr std::size_t kMaxParts = 64;  ///< largest parts of a canal that are joined; the rest is noise
constexpr double kMaxGap_mm = 8.0;     // segmentations lose the canal where a root lies on it

/// A node of the graph: the voxels of a coarse cell.
struct Cell {
  glm::ivec3 at{0};
  glm::dvec3 sum_P_mm{0.0};
  std::vector<glm::dvec3> points_P_mm;
  std::vector<std::size_t> neighbours;

  glm::dvec3 mean_P_mm() const { return sum_P_mm / static_cast<double>(points_P_mm.size()); }
};

std::vector<Cell> cellsOf(const VolumeGrid& grid, const std::vector<std::uint8_t>& label) {
  std::vector<Cell> cells;
  const double cell_mm = std::max(kMinCell_mm, grid.spacing_mm);
  const auto cell_of = [&](glm::ivec3 ijk) {
    return glm::ivec3(glm::floor(glm::dvec3(ijk) * grid.spacing_mm / cell_mm + 1.0e-9));
  };
  const glm::ivec3 lattice = cell_of(grid.size - 1) + 1;
  const auto key_of = [&](glm::ivec3 at) {
    return (static_cast<std::int64_t>(at.z) * lattice.y + at.y) * lattice.x + at.x;
  };
  std::unordered_map<std::int64_t, std::size_t> index;
  forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (label[v] != static_cast<std::uint8_t>(Tissue::mandibular_canal)) return;
    const glm::ivec3 at = cell_of(ijk);
    const auto [found, is_new] = index.try_emplace(key_of(at), cells.size());
    if (is_new) cells.push_back({at, {}, {}, {}});
    Cell& cell = cells[found->second];
    cell.points_P_mm.push_back(grid.centre_P_mm(ijk));
    cell.sum_P_mm += cell.points_P_mm.back();
  });

  // Two cells are neighbours if at most one empty cell lies between.
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (int offset = 0; offset < 125; ++offset) {
      const glm::ivec3 at = cells[c].at + glm::ivec3(offset % 5, offset / 5 % 5, offset / 25) - 2;
      if (glm::any(glm::lessThan(at, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(at, lattice))) continue;
      const auto found = index.find(key_of(at));
      if (found != index.end() && found->second != c) cells[c].neighbours.push_back(found->second);
    }
  return cells;
}

/// Length of the shortest path from `start` to every cell; infinite if unreachable.
std::vector<double> pathsFrom(std::size_t start, const std::vector<Cell>& cells) {
  std::vector<double> path_mm(cells.size(), std::numeric_limits<double>::infinity());
  using Reached = std::pair<double, std::size_t>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> front;
  path_mm[start] = 0.0;
  front.emplace(0.0, start);
  while (!front.empty()) {
    const auto [length_mm, cell] = front.top();
    front.pop();
    if (length_mm > path_mm[cell]) continue;
    for (const std::size_t next : cells[cell].neighbours) {
      const double longer_mm = length_mm + glm::distance(cells[cell].mean_P_mm(), cells[next].mean_P_mm());
      if (longer_mm >= path_mm[next]) continue;
      path_mm[next] = longer_mm;
      front.emplace(longer_mm, next);
    }
  }
  return path_mm;
}

std::size_t farthest(const std::vector<double>& path_mm) {
  std::size_t best = 0;
  double longest_mm = -1.0;
  for (std::size_t c = 0; c < path_mm.size(); ++c)
    if (std::isfinite(path_mm[c]) && path_mm[c] > longest_mm) {
      longest_mm = path_mm[c];
      best = c;
    }
  return best;
}

/// Connected components.
std::vector<std::vector<std::size_t>> canalsOf(const std::vector<Cell>& cells) {
  std::vector<std::vector<std::size_t>> canals;
  std::vector<bool> seen(cells.size(), false);
  for (std::size_t start = 0; start < cells.size(); ++start) {
    if (seen[start]) continue;
    std::vector<std::size_t> canal = {start};
    seen[start] = true;
    for (std::size_t c = 0; c < canal.size(); ++c)
      for (const std::size_t next : cells[canal[c]].neighbours)
        if (!seen[next]) {
          seen[next] = true;
          canal.push_back(next);
        }
    canals.push_back(std::move(canal));
  }
  return canals;
}

std::size_t voxelsOf(const std::vector<std::size_t>& canal, const std::vector<Cell>& cells) {
  std::size_t voxels = 0;
  for (const std::size_t c : canal) voxels += cells[c].points_P_mm.size();
  return voxels;
}

struct Join {
  std::size_t from = 0, to = 0;
  double gap_mm = kMaxGap_mm;
};

/// A part's cells binned in cubes of the largest gap's edge.
class Cubes {
 public:
  Cubes(const std::vector<std::size_t>& part, const std::vector<Cell>& cells) {
    for (const std::size_t c : part) cells_[cubeAt(cells[c].mean_P_mm())].push_back(c);
  }

  /// Visits all cells within the largest gap of `p_P_mm`, and some others.
  template <class Visit>
  void forCellsAround(const glm::dvec3& p_P_mm, const Visit& visit) const {
    const Cube middle = cubeAt(p_P_mm);
    for (int n = 0; n < 27; ++n) {
      const auto found = cells_.find({middle[0] + n % 3 - 1, middle[1] + n / 3 % 3 - 1, middle[2] + n / 9 - 1});
      if (found == cells_.end()) continue;
      for (const std::size_t c : found->second) visit(c);
    }
  }

 private:
  using Cube = std::array<std::int64_t, 3>;
  static Cube cubeAt(const glm::dvec3& p_P_mm) {
    const glm::dvec3 at = glm::floor(p_P_mm / kMaxGap_mm);
    return {static_cast<std::int64_t>(at.x), static_cast<std::int64_t>(at.y), static_cast<std::int64_t>(at.z)};
  }

  std::map<Cube, std::vector<std::size_t>> cells_;
};

/// Nearest two cells of two parts, if within the largest gap.
Join nearestOf(const std::vector<std::size_t>& a, const Cubes& b, const std::vector<Cell>& cells) {
  Join nearest;
  for (const std::size_t from : a) {
    const glm::dvec3 mean = cells[from].mean_P_mm();
    b.forCellsAround(mean, [&](std::size_t to) {
      if (const double gap_mm = glm::distance(mean, cells[to].mean_P_mm()); gap_mm < nearest.gap_mm)
        nearest = {from, to, gap_mm};
    });
  }
  return nearest;
}

/// Joins parts of one canal: their nearest cells become neighbours. Limited to the largest parts, which bounds the cost
/// of noisy labels.
void joinAcrossGaps(std::vector<Cell>& cells) {
  auto parts = canalsOf(cells);
  std::ranges::stable_sort(parts, std::greater{}, [&](const auto& part) { return voxelsOf(part, cells); });
  parts.resize(std::min(parts.size(), kMaxParts));
  for (std::size_t larger = 0; larger + 1 < parts.size(); ++larger) {
    const Cubes cubes(parts[larger], cells);
    for (std::size_t smaller = larger + 1; smaller < parts.size(); ++smaller) {
      const Join join = nearestOf(parts[smaller], cubes, cells);
      if (join.from == join.to) continue;
      cells[join.from].neighbours.push_back(join.to);
      cells[join.to].neighbours.push_back(join.from);
    }
  }
}

/// The canal nearest to a point, ignoring those below a tenth of the largest; without a point the largest.
std::vector<std::size_t> selectedCanal(const std::vector<Cell>& cells, const std::optional<glm::dvec3>& near_P_mm) {
  const auto canals = canalsOf(cells);
  std::size_t largest = 0;
  for (const auto& canal : canals) largest = std::max(largest, voxelsOf(canal, cells));
  std::vector<std::size_t> selected;
  double best = std::numeric_limits<double>::infinity();
  for (const auto& canal : canals) {
    const std::size_t voxels = voxelsOf(canal, cells);
    if (voxels * 10 < largest) continue;
    double distance = -static_cast<double>(voxels);
    if (near_P_mm) {
      distance = std::numeric_limits<double>::infinity();
      for (const std::size_t c : canal) distance = std::min(distance, glm::distance(cells[c].mean_P_mm(), *near_P_mm));
    }
    if (distance >= best) continue;
    best = distance;
    selected = canal;
  }
  return selected;
}

}  // namespace

OrderedVoxels orderedMandibularCanal(const VolumeGrid& grid, const std::vector<std::uint8_t>& label,
                                     const std::optional<glm::dvec3>& near_P_mm) {
  std::vector<Cell> cells = cellsOf(grid, label);
  joinAcrossGaps(cells);
  const std::vector<std::size_t> canal = selectedCanal(cells, near_P_mm);
  if (canal.empty()) return {};

  // The cell farthest from any other is an end; path lengths from there order all cells.
  const std::size_t end = farthest(pathsFrom(canal.front(), cells));
  const std::vector<double> path_mm = pathsFrom(end, cells);
  OrderedVoxels voxels;
  for (const std::size_t c : canal)
    for (const glm::dvec3& p_P_mm : cells[c].points_P_mm) {
      voxels.centre_P_mm.push_back(p_P_mm);
      voxels.along_mm.push_back(path_mm[c]);
    }
  return voxels;
}

}  // namespace assets
