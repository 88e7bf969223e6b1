#include "assets/import/mandibular_canal_line.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "assets/import/canal_bridge.h"
#include "assets/import/mandibular_canal_voxels.h"

namespace assets {

namespace {

constexpr double kStep_mm = 1.0;
constexpr double kShortest_mm = 5.0;
constexpr int kRefinements = 6;

using Points = std::vector<glm::dvec3>;

double lengthOf(const Points& line) {
  double length_mm = 0.0;
  for (std::size_t p = 1; p < line.size(); ++p) length_mm += glm::distance(line[p - 1], line[p]);
  return length_mm;
}

/// Segment of a line with precomputed terms.
struct Segment {
  glm::dvec3 start{0.0}, along{0.0};
  double length_mm = 0.0, per_squared = 0.0, before_mm = 0.0;
};

std::vector<Segment> segmentsOf(const Points& line) {
  std::vector<Segment> segments;
  double before_mm = 0.0;
  for (std::size_t p = 0; p + 1 < line.size(); ++p) {
    const glm::dvec3 along = line[p + 1] - line[p];
    const double length_mm = glm::length(along);
    segments.push_back({line[p], along, length_mm, 1.0 / (length_mm * length_mm), before_mm});
    before_mm += length_mm;
  }
  return segments;
}

/// Arc length of the line's point nearest to p; the end segments are extended.
double alongLine(const std::vector<Segment>& line, const glm::dvec3& p_P_mm) {
  double along_mm = 0.0;
  double nearest_mm2 = std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s < line.size(); ++s) {
    const glm::dvec3 from_start = p_P_mm - line[s].start;
    double t = glm::dot(from_start, line[s].along) * line[s].per_squared;
    if (s > 0) t = std::max(t, 0.0);
    if (s + 1 < line.size()) t = std::min(t, 1.0);
    const glm::dvec3 apart = from_start - t * line[s].along;
    const double squared = glm::dot(apart, apart);
    if (squared >= nearest_mm2) continue;
    nearest_mm2 = squared;
    along_mm = line[s].before_mm + t * line[s].length_mm;
  }
  return along_mm;
}

/// Means of the points over equal steps along the canal, in order; interpolated over empty steps.
struct Means {
  Points line;
  std::vector<bool> is_bridge;  ///< per point: interpolated
  double before_mm = 0.0;       ///< canal before the first mean
  double after_mm = 0.0;        ///< and after the last
  double labelled_mm = 0.0;     ///< length of the filled steps
};

/// Steps next to a gap or an end that hold only part of the section, whose mean lies to one side; they are ignored.
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

    // A mean; interpolate from the previous one over empty steps.
    const glm::dvec3 mean = sum[s] / count[s];
    for (std::size_t gap = before.value_or(s) + 1; gap < s; ++gap) {
      result.line.push_back(
          glm::mix(mean_before, mean, static_cast<double>(gap - *before) / static_cast<double>(s - *before)));
      result.is_bridge.push_back(true);
    }
    if (!before) result.before_mm = result.after_mm - 0.5 * filled_mm;
    result.line.push_back(mean);
    result.is_bridge.push_back(false);
    result.after_mm = 0.5 * filled_mm;
    before = s;
    mean_before = mean;
  }
  return result;
}

/// Binomial weights 1 4 6 4 1 (sigma 1 step), shorter towards the ends, which are fixed.
Points smoothed(const Points& line) {
  Points result = line;
  for (int pass = 0; pass < 2; ++pass) {
    const Points before = result;
    for (std::size_t p = 1; p + 1 < line.size(); ++p)
      result[p] = 0.25 * before[p - 1] + 0.5 * before[p] + 0.25 * before[p + 1];
  }
  return result;
}

/// Without the ends, whose direction is uncertain; projection extends the line straight.
Points trimmed(const Points& line) {
  constexpr std::size_t kTrim = 3;
  if (line.size() < 4 * kTrim) return line;
  return {line.begin() + kTrim, line.end() - kTrim};
}

/// The end points are means of a step; the canal extends beyond them.
void extendEnds(Points& line, double before_mm, double after_mm) {
  const glm::dvec3 front = line.front() + before_mm * glm::normalize(line.front() - line[1]);
  line.back() += after_mm * glm::normalize(line.back() - line[line.size() - 2]);
  line.front() = front;
}

/// Points at most kStep_mm apart along the line, with both ends.
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

std::optional<MandibularCanalLine> mandibularCanalLine(const VolumeGrid& grid, const std::vector<std::uint8_t>& label,
                                                       const std::optional<glm::dvec3>& near_P_mm) {
  const OrderedVoxels canal = orderedMandibularCanal(grid, label, near_P_mm);
  const Points& points = canal.centre_P_mm;
  std::vector<double> along_mm = canal.along_mm;
  if (points.empty()) return std::nullopt;

  Means means = meansAlong(points, along_mm);
  for (int refinement = 0; refinement < kRefinements && means.line.size() >= 2; ++refinement) {
    const std::vector<Segment> line = segmentsOf(trimmed(smoothed(means.line)));
    for (std::size_t p = 0; p < points.size(); ++p) along_mm[p] = alongLine(line, points[p]);
    means = meansAlong(points, along_mm);
  }
  Points line = smoothed(means.line);
  if (line.size() < 2 || lengthOf(line) < kShortest_mm) return std::nullopt;

  const double volume_mm3 = static_cast<double>(points.size()) * grid.voxelVolume_mm3();
  const double radius_mm = std::sqrt(volume_mm3 / (std::numbers::pi * means.labelled_mm));
  routeAroundTeeth(line, means.is_bridge, radius_mm, grid, label);
  extendEnds(line, means.before_mm, means.after_mm);
  if (line.front().y > line.back().y) std::reverse(line.begin(), line.end());
  return MandibularCanalLine{evenlySpaced(line), radius_mm};
}

}  // namespace assets
