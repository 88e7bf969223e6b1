#include "app/session/measures/strokes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace app {
namespace {

/// Ticks of an arm, at least 2.
std::size_t armOf(const std::vector<WorkSample>& samples) {
  const double dt_s = samples.front().dt_s;
  return static_cast<std::size_t>(std::clamp(StrokeFinder::kArm_s / dt_s, 2.0, 1000.0) + 0.5);
}

}  // namespace

double grooveDepth_mm(double section_mm2, double radius_mm) {
  const double R = radius_mm, half_mm2 = 0.5 * std::numbers::pi * R * R;
  if (!(section_mm2 > 0.0) || !(R > 0.0)) return 0.0;
  if (section_mm2 >= half_mm2) return std::min(4.0 * R, R + (section_mm2 - half_mm2) / (2.0 * R));
  double low = 0.0, high = R;
  while (high - low > 1e-6 * R) {
    const double h = 0.5 * (low + high);
    const double section = R * R * std::acos(1.0 - h / R) - (R - h) * std::sqrt(h * (2.0 * R - h));
    (section < section_mm2 ? low : high) = h;
  }
  return 0.5 * (low + high);
}

void StrokeFinder::add(const WorkSample& sample) {
  if (!sample.valid) return endRun();
  if (!sample.drills()) {
    if (samples_.empty()) return;
    idle_s_ += sample.dt_s;
    if (idle_s_ > kPause_s) return endRun();
  } else {
    idle_s_ = 0.0;
  }
  samples_.push_back(sample);
  lookForTurn();
  if (sample.t_s - samples_[begin_].t_s >= kLongest_s) {
    endStroke(samples_.size() - 1);
    lowest_ = 0.0;
  }
}

/// Of the way before and after; 1 where the bur rests.
double StrokeFinder::cosineAt(std::size_t k) const {
  constexpr double kRest_mm = 0.02;
  const std::size_t arm = armOf(samples_);
  const glm::dvec3 before = samples_[k].bur_P_mm - samples_[k - arm].bur_P_mm;
  const glm::dvec3 after = samples_[k + arm].bur_P_mm - samples_[k].bur_P_mm;
  const double lengths = glm::length(before) * glm::length(after);
  return lengths > kRest_mm * kRest_mm ? glm::dot(before, after) / lengths : 1.0;
}

/// At the newest place that has an arm to either side.
void StrokeFinder::lookForTurn() {
  constexpr double kAlike = 0.01;
  const std::size_t arm = armOf(samples_);
  looked_ = std::max(looked_, arm);
  for (; looked_ + arm < samples_.size(); ++looked_) {
    const double cosine = cosineAt(looked_);
    if (cosine >= 0.0 && lowest_ < 0.0) {
      lowest_ = 0.0;
      endStroke((low_from_ + low_to_) / 2);
      return;  // the samples have moved; the next call goes on
    }
    if (cosine >= 0.0) continue;
    // On a straight way back many are as low: the turn is in their middle.
    if (cosine < lowest_ - kAlike || lowest_ == 0.0) low_from_ = looked_;
    if (cosine < lowest_ + kAlike) low_to_ = looked_;
    lowest_ = std::min(lowest_, cosine);
  }
}

/// Tells of the stroke that ends with sample `end`, and forgets what no later one needs.
void StrokeFinder::endStroke(std::size_t end) {
  Stroke stroke;
  // What follows the last contact of a run is no stroke.
  std::size_t last = end;
  while (last > begin_ && !samples_[last].drills()) --last;
  const WorkSample &first = samples_[begin_], &until = samples_[last];
  double weight_s = 0.0;
  for (std::size_t k = begin_ + 1; k <= last; ++k) {
    const WorkSample& sample = samples_[k];
    stroke.length_mm += glm::distance(sample.bur_P_mm, samples_[k - 1].bur_P_mm);
    stroke.removed_mm3 += sample.removed_mm3;
    stroke.speed_mm_per_s.push_back(glm::length(sample.velocity_P_mm_per_s));
    if (!sample.drills()) continue;
    stroke.mean_normal_force_N += sample.dt_s * glm::dot(sample.force_P_N, sample.normal_P);
    stroke.normal_P += sample.dt_s * sample.normal_P;
    weight_s += sample.dt_s;
  }
  stroke.begin_s = first.t_s;
  stroke.duration_s = until.t_s - first.t_s;
  stroke.dt_s = first.dt_s;
  stroke.radius_mm = first.radius_mm;
  stroke.chord_P_mm = until.bur_P_mm - first.bur_P_mm;
  stroke.middle_P_mm = 0.5 * (until.bur_P_mm + first.bur_P_mm);
  if (weight_s > 0.0) stroke.mean_normal_force_N /= weight_s;
  const double normal = glm::length(stroke.normal_P);
  stroke.normal_P = normal > 0.0 ? stroke.normal_P / normal : glm::dvec3(0.0);
  if (stroke.length_mm >= kShortest_mm) {
    stroke.straightness = glm::length(stroke.chord_P_mm) / stroke.length_mm;
    stroke.mean_speed_mm_per_s = stroke.length_mm / stroke.duration_s;
    stroke.depth_mm = grooveDepth_mm(stroke.removed_mm3 / stroke.length_mm, stroke.radius_mm);
    found_(stroke);
  }

  // The next stroke begins with the turn and looks an arm back.
  const std::size_t keep = end - std::min(end, armOf(samples_));
  samples_.erase(samples_.begin(), samples_.begin() + static_cast<std::ptrdiff_t>(keep));
  begin_ = end - keep;
  looked_ = std::max(begin_, looked_ - std::min(looked_, keep));
}

void StrokeFinder::endRun() {
  if (samples_.size() > begin_ + 1) endStroke(samples_.size() - 1);
  samples_.clear();
  begin_ = looked_ = 0;
  lowest_ = idle_s_ = 0.0;
}

void StrokeFinder::finish() { endRun(); }

}  // namespace app
