#include "haptics/ligament/piece_samples.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "haptics/body/surface_points.h"

namespace haptics {
namespace {

/// -1..1 from a hash of the index.
double scattered(std::size_t index) {
  auto h = static_cast<std::uint32_t>(index) * 2654435761U;
  h = (h ^ (h >> 15U)) * 2246822519U;
  h ^= h >> 13U;
  return static_cast<double>(h >> 8U) / 8388608.0 - 1.0;
}

void append(PieceSamples& samples, const SamplePoint& point) {
  const glm::dvec3 p = point.p_Q_mm - samples.centre_Q_mm;
  for (int axis = 0; axis < 3; ++axis) {
    samples.place_mm[axis].push_back(static_cast<float>(p[axis]));
    samples.normal[axis].push_back(static_cast<float>(point.outward[axis]));
  }
  samples.area_mm2.push_back(static_cast<float>(point.area_mm2));
  samples.width_mm.push_back(static_cast<float>(point.width_mm));
  samples.rest_gap_mm.push_back(static_cast<float>(point.rest_gap_mm));
}

}  // namespace

double PieceSamples::ligamentArea_mm2() const {
  return std::accumulate(area_mm2.begin(), area_mm2.begin() + static_cast<std::ptrdiff_t>(ligament), 0.0);
}

PieceSamples arranged(const std::vector<SamplePoint>& points) {
  PieceSamples samples;
  double area_mm2 = 0.0;
  for (const SamplePoint& point : points) {
    samples.centre_Q_mm += point.area_mm2 * point.p_Q_mm;
    area_mm2 += point.area_mm2;
  }
  if (area_mm2 > 0.0) samples.centre_Q_mm /= area_mm2;

  // Padding lies at the centre, where no bone is, and has no area.
  const auto add_group = [&](bool has_ligament) {
    for (const SamplePoint& point : points)
      if (point.has_ligament == has_ligament) append(samples, point);
    const SamplePoint padding{.p_Q_mm = samples.centre_Q_mm, .rest_gap_mm = -1e3};
    while (samples.size() % kSampleLanes != 0) append(samples, padding);
  };
  add_group(true);
  samples.ligament = samples.size();
  add_group(false);
  assert(samples.size() <= kMostSamples);
  return samples;
}

LigamentMemory unworn(const PieceSamples& samples) {
  const std::vector<float> zero(samples.ligament, 0.0F);
  return {zero, zero, zero, zero};
}

std::vector<SamplePoint> surfaceSamples(const SolidVoxels& piece, const DistanceField& obstacles, const IsRoot& is_root,
                                        const LigamentLaw& law, double spacing_mm) {
  constexpr std::size_t kMost = kMostSamples - 2 * kSampleLanes;
  constexpr double kFacing = 0.5;  // cosine between the normal and the way to the bone

  const DistanceField own(piece.grid, piece.solid, 2.0 * spacing_mm);
  const glm::dvec3 middle_mm = piece.grid.centre_P_mm(piece.grid.size / 2);
  SurfacePoints surface = surfacePoints(own, middle_mm, spacing_mm);
  while (surface.at_mm.size() > kMost) {
    spacing_mm *= 1.1;
    surface = surfacePoints(DistanceField(piece.grid, piece.solid, 2.0 * spacing_mm), middle_mm, spacing_mm);
  }

  std::vector<SamplePoint> points;
  points.reserve(surface.at_mm.size());
  for (const glm::vec3& at_mm : surface.at_mm) {
    SamplePoint point{.p_Q_mm = middle_mm + glm::dvec3(at_mm), .area_mm2 = static_cast<double>(surface.area_mm2)};
    const glm::dvec3 slope(own.at(glm::vec3(piece.grid.indexFromPoint(point.p_Q_mm))).gradient);
    const double steep = glm::length(slope);
    if (steep < 0.1) continue;
    point.outward = slope / steep;
    point.width_mm = law.width_mm * (1.0 + law.width_scatter * scattered(points.size()));

    const auto around = obstacles.at(glm::vec3(obstacles.grid().indexFromPoint(point.p_Q_mm)));
    const double gap_mm = static_cast<double>(around.distance_mm);
    const bool faces_bone = gap_mm < kLigamentReach_mm &&
                            glm::dot(point.outward, glm::dvec3(around.gradient)) < -kFacing &&
                            obstacles.at_mm(point.p_Q_mm + gap_mm * point.outward) < 0.5 * kSocketReach_mm;
    point.has_ligament = faces_bone && is_root(point.p_Q_mm, point.outward);
    point.rest_gap_mm = point.has_ligament ? gap_mm : std::min(gap_mm, 0.0);
    points.push_back(point);
  }
  return points;
}

SocketChange socketAfter(const DistanceField& obstacles, const PieceSamples& samples) {
  SocketChange change{samples.rest_gap_mm, std::vector<float>(samples.ligament, 0.0F)};
  for (std::size_t n = 0; n < samples.size(); ++n) {
    if (samples.area_mm2[n] == 0.0F) continue;
    glm::dvec3 place_mm = samples.centre_Q_mm, outward(0.0);
    for (int axis = 0; axis < 3; ++axis) {
      place_mm[axis] += static_cast<double>(samples.place_mm[axis][n]);
      outward[axis] = static_cast<double>(samples.normal[axis][n]);
    }
    const auto gap_mm = static_cast<float>(obstacles.at_mm(place_mm));
    float& rest_gap_mm = change.rest_gap_mm[n];
    if (n >= samples.ligament) {
      rest_gap_mm = std::min(gap_mm, 0.0F);
      continue;
    }
    const double wall_mm = static_cast<double>(rest_gap_mm);
    const bool is_gone = obstacles.at_mm(place_mm + wall_mm * outward) > kSocketReach_mm;
    change.torn[n] = is_gone ? 1.0F : 0.0F;
    // The remnants of torn fibres stay on the root, as thick as they were.
    rest_gap_mm = is_gone ? std::min(rest_gap_mm, gap_mm) : gap_mm;
  }
  return change;
}

}  // namespace haptics
