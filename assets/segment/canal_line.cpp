#include "assets/segment/canal_line.h"

#include <algorithm>
#include <cmath>

#include "assets/trilinear.h"

namespace assets {
namespace {

using Line = std::vector<glm::dvec3>;

constexpr double kDisc_mm = 1.8, kStep_mm = 1.0, kKeptEnd_mm = 3.0;
constexpr int kCentrings = 3;

/// Means over as many neighbours on either side, fewer towards the ends, which stay in place.
Line smoothedLine(const Line& line, double sigma) {
  const int reach = static_cast<int>(3.0 * sigma) + 1, count = static_cast<int>(line.size());
  Line out;
  for (int p = 0; p < count; ++p) {
    glm::dvec3 sum(0.0);
    double weights = 0.0;
    const int own_reach = std::min({reach, p, count - 1 - p});
    for (int d = -own_reach; d <= own_reach; ++d) {
      const double weight = std::exp(-0.5 * d * d / (sigma * sigma));
      sum += weight * line[static_cast<std::size_t>(p + d)];
      weights += weight;
    }
    out.push_back(sum / weights);
  }
  return out;
}

/// Drawn to the darkness in a disc across the line.
void centre(const HalfJaw& half, Line& line) {
  const double spacing_mm = half.grid.spacing_mm;
  const int reach = static_cast<int>(std::ceil(kDisc_mm / spacing_mm));
  const VolumeGrid cells{half.grid.size, 1.0, glm::dvec3(0.0)};
  const auto hounsfield_at = [&](glm::ivec3 ijk) {
    return half.smooth_hu[cells.index(glm::clamp(ijk, glm::ivec3(0), cells.size - 1))];
  };
  for (int round = 0; round < kCentrings; ++round) {
    const Line course = smoothedLine(line, 3.0);
    for (std::size_t p = 0; p < line.size(); ++p) {
      const glm::dvec3 along = course[std::min(p + 1, line.size() - 1)] - course[p > 0 ? p - 1 : 0];
      const glm::dvec3 tangent = along / std::max(glm::length(along), 1e-9);
      std::vector<glm::dvec3> away;
      std::vector<float> hu;
      forVoxels(glm::ivec3(-reach), glm::ivec3(reach + 1), [&](glm::ivec3 step) {
        const glm::dvec3 d(step);
        if (glm::length(d) * spacing_mm >= kDisc_mm) return;
        away.push_back(d - glm::dot(d, tangent) * tangent);
        hu.push_back(static_cast<float>(trilinearAt(cells, line[p] + away.back(), hounsfield_at)));
      });
      const float dark_hu = valueAtShare(hu, 0.45);
      glm::dvec3 pull(0.0);
      double weights = 1e-9;
      for (std::size_t n = 0; n < hu.size(); ++n) {
        const auto weight = static_cast<double>(std::clamp(dark_hu - hu[n], 0.0F, 400.0F));
        pull += weight * away[n], weights += weight;
      }
      line[p] += 0.7 * pull / weights;
    }
    line = smoothedLine(line, 1.2 / spacing_mm);
  }
}

/// Points a step apart, the ends among them.
Line spacedEvenly(const Line& line) {
  double length_mm = 0.0;
  for (std::size_t p = 1; p < line.size(); ++p) length_mm += glm::distance(line[p - 1], line[p]);
  const int steps = std::max(1, static_cast<int>(std::lround(length_mm / kStep_mm)));
  Line out{line.front()};
  double walked_mm = 0.0;
  for (std::size_t p = 1; p < line.size(); ++p) {
    const double piece_mm = glm::distance(line[p - 1], line[p]);
    while (static_cast<int>(out.size()) < steps &&
           walked_mm + piece_mm >= length_mm * static_cast<double>(out.size()) / steps && piece_mm > 0.0) {
      const double share = (length_mm * static_cast<double>(out.size()) / steps - walked_mm) / piece_mm;
      out.push_back(glm::mix(line[p - 1], line[p], share));
    }
    walked_mm += piece_mm;
  }
  out.push_back(line.back());
  return out;
}

}  // namespace

double wayLength_mm(const Line& line_P_mm) {
  double length_mm = 0.0;
  for (std::size_t p = 1; p < line_P_mm.size(); ++p) length_mm += glm::distance(line_P_mm[p - 1], line_P_mm[p]);
  return length_mm;
}

Line pointsOfWay(const VolumeGrid& cells, const std::vector<std::size_t>& way) {
  Line points;
  for (const std::size_t cell : way) points.push_back(cells.centre_P_mm(elementAt(cells.size, cell)));
  return points;
}

Line centredCanal(const HalfJaw& half, const Line& way_P_mm, CanalEnds ends) {
  if (way_P_mm.size() < 2) return {};
  Line line;
  for (const glm::dvec3& p : way_P_mm) line.push_back(half.grid.indexFromPoint(p));
  const Line before = line;
  centre(half, line);
  for (std::size_t p = 0; p < line.size() && ends == CanalEnds::kept; ++p) {
    const double to_end = std::min(glm::distance(before[p], before.front()), glm::distance(before[p], before.back())) *
                          half.grid.spacing_mm;
    line[p] = glm::mix(before[p], line[p], std::min(1.0, to_end / kKeptEnd_mm));
  }
  for (glm::dvec3& p : line) p = half.grid.origin_P_mm + half.grid.spacing_mm * p;
  return spacedEvenly(line);
}

}  // namespace assets
