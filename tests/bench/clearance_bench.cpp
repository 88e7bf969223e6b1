// How near a bur is to a structure: every head with its shaft at R = 2 mm, beside the least over points of its surface.
// Near: within 4 mm, where it is told; far: up to 40 mm. CPU time of this thread; four structures make a query.
#include <cmath>
#include <cstdio>

#include "calibration/geometry/units.h"
#include "haptics/tool/clearance.h"
#include "tests/bench/extraction_parts.h"
#include "tests/haptics/structure_phantom.h"

namespace bench {
namespace {

using haptics::phantom::ToolPose;

/// A head's sides and ends, a tenth of a millimetre apart.
std::vector<glm::dvec3> surfacePoints_T(const haptics::BurShape& head) {
  constexpr double kStep_mm = 0.1;
  std::vector<glm::dvec3> points;
  const double half = haptics::halfHeight_mm(head);
  for (double z = -half; z < half + 1e-9; z += kStep_mm)
    for (double r = 0.0; r < head.radius_mm + 1e-9; r += kStep_mm) {
      const glm::dvec3 p(r, 0.0, z);
      const double off_mm = 0.5 * kStep_mm;
      if (haptics::phantom::toHead_mm(head, p) > 0.0) continue;
      if (haptics::phantom::toHead_mm(head, p + glm::dvec3(off_mm, 0, 0)) == 0.0 &&
          haptics::phantom::toHead_mm(head, p + glm::dvec3(0, 0, off_mm)) == 0.0 &&
          haptics::phantom::toHead_mm(head, p - glm::dvec3(0, 0, off_mm)) == 0.0)
        continue;
      const int steps = 1 + static_cast<int>(2.0 * calibration::kPi * r / kStep_mm);
      for (int n = 0; n < steps; ++n) {
        const double angle = 2.0 * calibration::kPi * n / steps;
        points.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
      }
    }
  return points;
}

void benchHead(const char* name, const haptics::BurShape& head, const assets::StructureDistance& distance,
               double nearest_mm, double farthest_mm) {
  const haptics::Tool tool{head, haptics::standardShaft(head)};
  std::mt19937 random(1);
  std::vector<ToolPose> poses;
  while (poses.size() < 1000) {
    const ToolPose X_PT = haptics::phantom::randomPose(random, farthest_mm > 5.0 ? 40.0 : 12.0);
    const double mm = haptics::clearance_mm(distance, tool, X_PT);
    if (mm >= nearest_mm && mm < farthest_mm) poses.push_back(X_PT);
  }
  double sum = 0.0;
  const double us = p10_us(9,
                           [&] {
                             for (const ToolPose& X_PT : poses) sum += haptics::clearance_mm(distance, tool, X_PT);
                           }) /
                    static_cast<double>(poses.size());
  double worst_us = 0.0;
  for (const ToolPose& X_PT : poses)
    worst_us = std::max(worst_us, p10_us(9, [&] { sum += haptics::clearance_mm(distance, tool, X_PT); }));
  const std::vector<glm::dvec3> points = surfacePoints_T(head);
  const double slow_us =
      p10_us(3,
             [&] {
               for (std::size_t n = 0; n < 50; ++n) {
                 double least_mm = 1e9;
                 for (const glm::dvec3& p : points)
                   least_mm = std::min(least_mm, distance.near_mm(poses[n].rotation * p + poses[n].translation_mm));
                 sum += least_mm;
               }
             }) /
      50.0;
  std::printf("  %-9s %5.2f us, slowest %5.2f; %zu points of the head alone %7.1f us%s\n", name, us, worst_us,
              points.size(), slow_us, std::isnan(sum) ? "!" : "");
}

void benchAll(const char* where, const assets::StructureDistance& distance, double nearest_mm, double farthest_mm) {
  std::printf("%s, one structure:\n", where);
  using haptics::ShapeKind;
  benchHead("sphere", {ShapeKind::sphere, 2.0, 0.0}, distance, nearest_mm, farthest_mm);
  benchHead("capsule", {ShapeKind::capsule, 2.0, 5.0}, distance, nearest_mm, farthest_mm);
  benchHead("cylinder", {ShapeKind::cylinder, 2.0, 5.0}, distance, nearest_mm, farthest_mm);
  benchHead("cone", {ShapeKind::cone, 2.0, 5.0}, distance, nearest_mm, farthest_mm);
}

}  // namespace
}  // namespace bench

int main() {
  const auto canal = haptics::phantom::canal(0.25);
  assets::StructureDistance distance;
  const double make_ms = 1e-3 * bench::p10_us(3, [&] { distance = canal.distance(); });
  std::printf("field of %zu voxels at 0.25 mm: %.1f MB, %.0f ms on this thread\n", distance.distance.size(),
              1e-6 * static_cast<double>(distance.bytes()), make_ms);
  bench::benchAll("canal, 0 to 4 mm away", distance, 0.0, 4.0);
  bench::benchAll("canal, inside or touched", distance, -9.0, 0.0);
  bench::benchAll("canal, 4 to 40 mm away", distance, 4.0, 40.0);
  return 0;
}
