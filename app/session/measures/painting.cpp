#include "app/session/measures/painting.h"

#include <algorithm>
#include <cmath>

namespace app {

std::optional<double> medianOf(std::vector<double> values) {
  if (values.empty()) return {};
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

std::optional<double> PaintingParts::index() const {
  double product = 1.0;
  bool is_whole = true;
  for (const auto& part : {sweep, shallow, straight, overlap, light}) {
    if (part && *part <= 0.0) return 0.0;
    is_whole = is_whole && part;
    product *= part.value_or(1.0);
  }
  return is_whole ? std::optional(std::pow(product, 0.2)) : std::nullopt;
}

void PaintingIndex::add(const WorkSample& sample) {
  constexpr double kSweep_mm_per_s = 3.0;
  if (!sample.valid || !sample.drills() || sample.normal_P == glm::dvec3(0.0)) return;
  const double across = glm::dot(sample.velocity_P_mm_per_s, sample.normal_P);
  const double along = glm::length(sample.velocity_P_mm_per_s - across * sample.normal_P);
  const double force_N = std::abs(glm::dot(sample.force_P_N, sample.normal_P));
  contact_s_ += sample.dt_s;
  if (along >= kSweep_mm_per_s) sweep_s_ += sample.dt_s;
  into_mm_ += sample.dt_s * std::max(0.0, -across);
  along_mm_ += sample.dt_s * along;
  force_sum_Ns_ += sample.dt_s * force_N;
  force_squares_N2s_ += sample.dt_s * force_N * force_N;
}

void PaintingIndex::add(const Stroke& stroke) {
  constexpr double kShallow = 0.25, kStraight_mm = 1.0, kLeast = 0.25, kMost = 1.0;
  ++strokes_;
  if (stroke.depth_mm <= kShallow * stroke.radius_mm) ++shallow_;
  if (stroke.length_mm > kStraight_mm) straightness_.push_back(stroke.straightness);

  // Beside the last one: across its chord, along the surface.
  const glm::dvec3 side = glm::cross(stroke.normal_P, stroke.chord_P_mm);
  if (last_ && glm::length(side) > 0.0) {
    const double step_mm = std::abs(glm::dot(stroke.middle_P_mm - last_->middle_P_mm, side)) / glm::length(side);
    ++neighbours_;
    if (step_mm >= kLeast * stroke.radius_mm && step_mm <= kMost * stroke.radius_mm) ++overlapping_;
  }
  last_ = stroke;
  last_->speed_mm_per_s.clear();
}

PaintingParts PaintingIndex::parts() const {
  const auto share = [](std::size_t n, std::size_t of) {
    return of > 0 ? std::optional(static_cast<double>(n) / static_cast<double>(of)) : std::nullopt;
  };
  PaintingParts parts;
  parts.shallow = share(shallow_, strokes_);
  parts.straight = medianOf(straightness_);
  parts.overlap = share(overlapping_, neighbours_);
  if (!(contact_s_ > 0.0)) return parts;
  parts.sweep = sweep_s_ / contact_s_;
  if (along_mm_ > 0.0) parts.plunge_ratio = into_mm_ / along_mm_;
  const double mean_N = force_sum_Ns_ / contact_s_;
  const double variance = std::max(0.0, force_squares_N2s_ / contact_s_ - mean_N * mean_N);
  if (mean_N > 0.0) parts.light = 1.0 / (1.0 + std::sqrt(variance) / mean_N);
  return parts;
}

}  // namespace app
