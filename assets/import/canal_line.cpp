#include "assets/import/canal_line.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <queue>

#include "assets/tissue.h"

namespace assets {

namespace {

constexpr double kCell_mm = 0.8;
constexpr double kStep_mm = 1.0;
constexpr double kShortest_mm = 5.0;
constexpr double kLargestGap_mm = 8.0;  // segmentations lose the canal where a root lies on it
constexpr int kRefinements = 6;

using Points = std::vector<glm::dvec3>;

/// The canal's voxels gathered in coarse cells: a small graph whatever the voxel size.
struct Cell {
  glm::dvec3 sum_P_mm{0.0};
  Points points_P_mm;
  std::vector<std::size_t> neighbours;

  glm::dvec3 mean_P_mm() const { return sum_P_mm / static_cast<double>(points_P_mm.size()); }
};

std::vector<Cell> cellsOf(const VolumeGrid& grid, const std::vector<std::uint8_t>& label) {
  using Key = std::array<int, 3>;
  std::map<Key, std::size_t> index;
  std::vector<Cell> cells;
  const double cell_mm = std::max(kCell_mm, grid.spacing_mm);
  for (int k = 0; k < grid.size.z; ++k)
    for (int j = 0; j < grid.size.y; ++j)
      for (int i = 0; i < grid.size.x; ++i) {
        if (label[grid.index({i, j, k})] != static_cast<std::uint8_t>(Tissue::canal)) continue;
        const glm::ivec3 at(glm::floor(glm::dvec3(i, j, k) * grid.spacing_mm / cell_mm + 1.0e-9));
        const auto [found, is_new] = index.try_emplace(Key{at.x, at.y, at.z}, cells.size());
        if (is_new) cells.emplace_back();
        Cell& cell = cells[found->second];
        cell.points_P_mm.push_back(grid.centre_P_mm({i, j, k}));
        cell.sum_P_mm += cell.points_P_mm.back();
      }

  // Two cells are neighbours if at most one empty cell lies between.
  for (const auto& [key, cell] : index)
    for (int offset = 0; offset < 125; ++offset) {
      const auto found = index.find({key[0] + offset % 5 - 2, key[1] + offset / 5 % 5 - 2, key[2] + offset / 25 - 2});
      if (found != index.end() && found->second != cell) cells[cell].neighbours.push_back(found->second);
    }
  return cells;
}

/// Length of the shortest way from `start` to every cell; infinite where there is none.
std::vector<double> wayFrom(std::size_t start, const std::vector<Cell>& cells) {
  std::vector<double> way_mm(cells.size(), std::numeric_limits<double>::infinity());
  using Reached = std::pair<double, std::size_t>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> front;
  way_mm[start] = 0.0;
  front.emplace(0.0, start);
  while (!front.empty()) {
    const auto [length_mm, cell] = front.top();
    front.pop();
    if (length_mm > way_mm[cell]) continue;
    for (const std::size_t next : cells[cell].neighbours) {
      const double longer_mm = length_mm + glm::distance(cells[cell].mean_P_mm(), cells[next].mean_P_mm());
      if (longer_mm >= way_mm[next]) continue;
      way_mm[next] = longer_mm;
      front.emplace(longer_mm, next);
    }
  }
  return way_mm;
}

std::size_t farthest(const std::vector<double>& way_mm) {
  std::size_t best = 0;
  double longest_mm = -1.0;
  for (std::size_t c = 0; c < way_mm.size(); ++c)
    if (std::isfinite(way_mm[c]) && way_mm[c] > longest_mm) {
      longest_mm = way_mm[c];
      best = c;
    }
  return best;
}

/// Splits into connected canals.
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

/// Joins parts of one canal: their nearest cells become neighbours.
void joinAcrossGaps(std::vector<Cell>& cells) {
  const auto parts = canalsOf(cells);
  for (std::size_t a = 0; a < parts.size(); ++a)
    for (std::size_t b = a + 1; b < parts.size(); ++b) {
      double nearest_mm = kLargestGap_mm;
      std::pair<std::size_t, std::size_t> ends(0, 0);
      for (const std::size_t from : parts[a])
        for (const std::size_t to : parts[b]) {
          const double gap_mm = glm::distance(cells[from].mean_P_mm(), cells[to].mean_P_mm());
          if (gap_mm >= nearest_mm) continue;
          nearest_mm = gap_mm;
          ends = {from, to};
        }
      if (ends.first == ends.second) continue;
      cells[ends.first].neighbours.push_back(ends.second);
      cells[ends.second].neighbours.push_back(ends.first);
    }
}

std::size_t voxelsOf(const std::vector<std::size_t>& canal, const std::vector<Cell>& cells) {
  std::size_t voxels = 0;
  for (const std::size_t c : canal) voxels += cells[c].points_P_mm.size();
  return voxels;
}

/// The canal meant: nearest to the place given, crumbs of less than a tenth of the largest left aside; or the largest.
std::vector<std::size_t> canalMeant(const std::vector<Cell>& cells, const std::optional<glm::dvec3>& beside_P_mm) {
  const auto canals = canalsOf(cells);
  std::size_t largest = 0;
  for (const auto& canal : canals) largest = std::max(largest, voxelsOf(canal, cells));
  std::vector<std::size_t> meant;
  double best = std::numeric_limits<double>::infinity();
  for (const auto& canal : canals) {
    const std::size_t voxels = voxelsOf(canal, cells);
    if (voxels * 10 < largest) continue;
    double distance = -static_cast<double>(voxels);
    if (beside_P_mm) {
      distance = std::numeric_limits<double>::infinity();
      for (const std::size_t c : canal)
        distance = std::min(distance, glm::distance(cells[c].mean_P_mm(), *beside_P_mm));
    }
    if (distance >= best) continue;
    best = distance;
    meant = canal;
  }
  return meant;
}

double lengthOf(const Points& line) {
  double length_mm = 0.0;
  for (std::size_t p = 1; p < line.size(); ++p) length_mm += glm::distance(line[p - 1], line[p]);
  return length_mm;
}

/// Where along the line its nearest point to p lies; the end segments go on beyond the ends.
double alongLine(const Points& line, const glm::dvec3& p_P_mm) {
  double along_mm = 0.0;
  double nearest_mm = std::numeric_limits<double>::infinity();
  double before_mm = 0.0;
  for (std::size_t s = 0; s + 1 < line.size(); ++s) {
    const glm::dvec3 segment = line[s + 1] - line[s];
    const double length_mm = glm::length(segment);
    double t = glm::dot(p_P_mm - line[s], segment) / (length_mm * length_mm);
    if (s > 0) t = std::max(t, 0.0);
    if (s + 2 < line.size()) t = std::min(t, 1.0);
    const double distance_mm = glm::distance(p_P_mm, line[s] + t * segment);
    if (distance_mm < nearest_mm) {
      nearest_mm = distance_mm;
      along_mm = before_mm + t * length_mm;
    }
    before_mm += length_mm;
  }
  return along_mm;
}

/// Means of the points over equal steps of their place along the canal, in order; straight across steps without any.
struct Means {
  Points line;
  double before_mm = 0.0;    ///< length of canal before the first mean
  double after_mm = 0.0;     ///< and after the last
  double labelled_mm = 0.0;  ///< length of the steps that hold points
};

/// Beside a gap or an end a step may hold a sliver of the section, whose mean lies to one side: it does not count as a
/// mean.
std::vector<bool> isSliver(const std::vector<double>& count, double usual) {
  std::vector<bool> sliver(count.size(), false);
  for (std::size_t s = 0; s < count.size(); ++s) {
    const bool is_open = s == 0 || s + 1 == count.size() || count[s - 1] == 0.0 || count[s + 1] == 0.0;
    sliver[s] = is_open && count[s] > 0.0 && count[s] < 0.6 * usual;
  }
  return sliver;
}

double medianOfFilled(std::vector<double> count) {
  std::erase(count, 0.0);
  const auto middle = count.begin() + static_cast<std::ptrdiff_t>(count.size() / 2);
  std::nth_element(count.begin(), middle, count.end());
  return *middle;
}

Means meansAlong(const Points& points, const std::vector<double>& along_mm) {
  const auto [first, last] = std::minmax_element(along_mm.begin(), along_mm.end());
  const double range_mm = std::max(*last - *first, 1.0e-9);
  const auto steps = static_cast<std::size_t>(std::max(1.0, std::round(range_mm / kStep_mm)));
  const double step_mm = range_mm / static_cast<double>(steps);
  Points sum(steps, glm::dvec3(0.0));
  std::vector<double> count(steps, 0.0);
  for (std::size_t p = 0; p < points.size(); ++p) {
    const auto step = std::min(steps - 1, static_cast<std::size_t>((along_mm[p] - *first) / step_mm));
    sum[step] += points[p];
    count[step] += 1.0;
  }

  const double usual = medianOfFilled(count);
  const std::vector<bool> sliver = isSliver(count, usual);
  Means result;
  std::optional<std::size_t> before;
  glm::dvec3 mean_before(0.0);
  for (std::size_t s = 0; s < steps; ++s) {
    const double filled_mm = step_mm * std::min(1.0, count[s] / usual);
    result.labelled_mm += filled_mm;
    result.after_mm += filled_mm;
    if (count[s] == 0.0 || sliver[s]) continue;

    // A mean; straight on from the one before if steps lie between.
    const glm::dvec3 mean = sum[s] / count[s];
    for (std::size_t gap = before.value_or(s) + 1; gap < s; ++gap)
      result.line.push_back(
          glm::mix(mean_before, mean, static_cast<double>(gap - *before) / static_cast<double>(s - *before)));
    if (!before) result.before_mm = result.after_mm - 0.5 * filled_mm;
    result.line.push_back(mean);
    result.after_mm = 0.5 * filled_mm;
    before = s;
    mean_before = mean;
  }
  return result;
}

/// Binomial weights 1 4 6 4 1 (sigma 1 step), shorter towards the ends, which stay.
Points smoothed(const Points& line) {
  Points result = line;
  for (int pass = 0; pass < 2; ++pass) {
    const Points before = result;
    for (std::size_t p = 1; p + 1 < line.size(); ++p)
      result[p] = 0.25 * before[p - 1] + 0.5 * before[p] + 0.25 * before[p + 1];
  }
  return result;
}

/// Without the ends, whose direction is the least certain: projection goes on straight beyond them.
Points trimmed(const Points& line) {
  constexpr std::size_t kTrim = 3;
  if (line.size() < 4 * kTrim) return line;
  return {line.begin() + kTrim, line.end() - kTrim};
}

/// The end points are means of a step: the canal goes on a little beyond.
void extendEnds(Points& line, double before_mm, double after_mm) {
  const glm::dvec3 front = line.front() + before_mm * glm::normalize(line.front() - line[1]);
  line.back() += after_mm * glm::normalize(line.back() - line[line.size() - 2]);
  line.front() = front;
}

/// Points every kStep_mm or a little less along the line, both ends kept.
Points evenlySpaced(const Points& line) {
  const double length_mm = lengthOf(line);
  const auto steps = static_cast<std::size_t>(std::ceil(length_mm / kStep_mm - 1.0e-9));
  Points result = {line.front()};
  std::size_t segment = 0;
  double before_mm = 0.0;
  for (std::size_t s = 1; s < steps; ++s) {
    const double at_mm = length_mm * static_cast<double>(s) / static_cast<double>(steps);
    while (segment + 2 < line.size() && before_mm + glm::distance(line[segment], line[segment + 1]) < at_mm) {
      before_mm += glm::distance(line[segment], line[segment + 1]);
      ++segment;
    }
    const double t = (at_mm - before_mm) / glm::distance(line[segment], line[segment + 1]);
    result.push_back(glm::mix(line[segment], line[segment + 1], t));
  }
  result.push_back(line.back());
  return result;
}

}  // namespace

std::optional<CanalLine> canalLine(const VolumeGrid& grid, const std::vector<std::uint8_t>& label,
                                   const std::optional<glm::dvec3>& beside_P_mm) {
  std::vector<Cell> cells = cellsOf(grid, label);
  joinAcrossGaps(cells);
  const std::vector<std::size_t> canal = canalMeant(cells, beside_P_mm);
  if (canal.empty()) return std::nullopt;

  // From any cell the farthest is an end; the way from there orders all others.
  const std::size_t end = farthest(wayFrom(canal.front(), cells));
  const std::vector<double> way_mm = wayFrom(end, cells);
  Points points;
  std::vector<double> along_mm;
  for (const std::size_t c : canal)
    for (const glm::dvec3& p_P_mm : cells[c].points_P_mm) {
      points.push_back(p_P_mm);
      along_mm.push_back(way_mm[c]);
    }
  Means means = meansAlong(points, along_mm);
  for (int refinement = 0; refinement < kRefinements && means.line.size() >= 2; ++refinement) {
    const Points line = trimmed(smoothed(means.line));
    for (std::size_t p = 0; p < points.size(); ++p) along_mm[p] = alongLine(line, points[p]);
    means = meansAlong(points, along_mm);
  }
  Points line = smoothed(means.line);
  if (line.size() < 2 || lengthOf(line) < kShortest_mm) return std::nullopt;

  extendEnds(line, means.before_mm, means.after_mm);
  if (line.front().y > line.back().y) std::reverse(line.begin(), line.end());
  const double volume_mm3 = static_cast<double>(points.size()) * grid.voxelVolume_mm3();
  return CanalLine{evenlySpaced(line), std::sqrt(volume_mm3 / (std::numbers::pi * means.labelled_mm))};
}

}  // namespace assets
