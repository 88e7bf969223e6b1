#include "app/procedure/drawn_plan/drawn_cut.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "calibration/geometry/segment.h"

namespace app {
namespace {

constexpr double kLineStep_mm = 0.25;
constexpr int kGone = 128;  ///< of 255: so much less is removed

glm::dvec3 seenAlong(const glm::dvec3& p, const glm::dvec3& outward) { return p - glm::dot(p, outward) * outward; }

/// Points of the line, evenly from its beginning to its end.
std::vector<glm::dvec3> placesOn(const std::vector<glm::dvec3>& line) {
  std::vector<glm::dvec3> places{line.front()};
  for (std::size_t n = 1; n < line.size(); ++n) {
    const int steps = std::max(1, static_cast<int>(std::ceil(glm::distance(line[n - 1], line[n]) / kLineStep_mm)));
    for (int step = 1; step <= steps; ++step)
      places.push_back(glm::mix(line[n - 1], line[n], static_cast<double>(step) / steps));
  }
  return places;
}

}  // namespace

DrawnCut drawnCut(const std::vector<glm::dvec3>& line_P_mm, const glm::dvec3& outward_P, double beside_mm,
                  const assets::VolumeGrid& grid, std::span<const std::uint8_t> before,
                  std::span<const std::uint8_t> after) {
  assert(line_P_mm.size() > 1 && before.size() == grid.voxelCount() && after.size() == grid.voxelCount());
  const glm::dvec3 outward = glm::normalize(outward_P);
  std::vector<glm::dvec3> line = line_P_mm;
  for (glm::dvec3& p : line) p = seenAlong(p, outward);
  const std::vector<glm::dvec3> places = placesOn(line);
  std::vector<char> is_followed(places.size(), 0);

  DrawnCut cut{.length_mm = lengthOf_mm(line_P_mm)};
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    const int lost = before[v] - after[v];
    if (lost <= 0) return;
    const glm::dvec3 p = seenAlong(grid.centre_P_mm(ijk), outward);
    double off_mm = std::numeric_limits<double>::infinity();
    for (std::size_t n = 1; n < line.size(); ++n)
      off_mm = std::min(off_mm, calibration::distanceToSegment(p, line[n - 1], line[n]));
    const double mm3 = lost / 255.0 * grid.voxelVolume_mm3();
    cut.removed_mm3 += mm3;
    cut.off_mm += mm3 * off_mm;
    if (off_mm > beside_mm) cut.beside_mm3 += mm3;
    if (lost < kGone || off_mm > kFollows_mm) return;
    for (std::size_t n = 0; n < places.size(); ++n)
      if (glm::distance(p, places[n]) <= kFollows_mm) is_followed[n] = 1;
  });
  if (cut.removed_mm3 > 0.0) cut.off_mm /= cut.removed_mm3;
  cut.followed_share = static_cast<double>(std::ranges::count(is_followed, 1)) / static_cast<double>(places.size());
  return cut;
}

}  // namespace app
