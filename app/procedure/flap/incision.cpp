#include "app/procedure/flap/incision.h"

#include <cmath>
#include <limits>

namespace app {
namespace {

constexpr std::size_t kNewest = 3;         // points behind the blade: only half a millimetre counts there
constexpr double kLongestStep_mm = 1.5;    // from the newest point on in one stroke
constexpr double kDeepensWithin_mm = 0.5;  // of a point

}  // namespace

std::optional<std::size_t> Incision::nearest(const glm::dvec3& p_P_mm, double reach_mm) const {
  std::optional<std::size_t> found;
  double least_mm = reach_mm;
  for (std::size_t n = 0; n < points_.size(); ++n)
    if (const double mm = glm::distance(points_[n].at_P_mm, p_P_mm); mm <= least_mm) least_mm = mm, found = n;
  return found;
}

bool Incision::deepen(const glm::dvec3& p_P_mm, double depth_mm, bool is_full) {
  bool changed = false;
  for (IncisionPoint& point : points_) {
    if (glm::distance(point.at_P_mm, p_P_mm) > kDeepensWithin_mm) continue;
    changed = changed || depth_mm > point.depth_mm + 0.1 || (is_full && !point.is_full);
    point.depth_mm = std::max(point.depth_mm, depth_mm);
    point.is_full = point.is_full || is_full;
  }
  return changed;
}

void Incision::add(const glm::dvec3& at_P_mm) {
  const ChartPlace at = chart_.placeOf(at_P_mm);
  points_.push_back({at, chart_.surface_P_mm(at), 0.0, false, strokes_});
  goes_on_ = true;
}

bool Incision::follow(const std::optional<Blade>& blade, double dt_s) {
  const double depth_mm = blade ? chart_.depth_mm(blade->tip_P_mm) : 0.0;
  const ChartPlace at = blade ? chart_.placeOf(blade->tip_P_mm) : ChartPlace{};
  if (!blade || depth_mm < kLeastDepth_mm || !chart_.isGum(at)) {
    const bool ends = smooth_P_mm_ && goes_on_ && glm::distance(points_.back().at_P_mm, last_P_mm_) > 0.5 * kPoint_mm &&
                      glm::distance(points_.back().at_P_mm, last_P_mm_) < kLongestStep_mm;
    if (ends) {
      // Where the blade left the gum.
      const IncisionPoint before = points_.back();
      add(last_P_mm_);
      points_.back().depth_mm = before.depth_mm, points_.back().is_full = before.is_full;
    }
    smooth_P_mm_.reset();
    goes_on_ = false;
    return ends;
  }
  const glm::dvec3 here = last_P_mm_ = chart_.surface_P_mm(at);
  if (!smooth_P_mm_) smooth_P_mm_ = here;
  *smooth_P_mm_ += (1.0 - std::exp(-dt_s / kSmoothing_s)) * (here - *smooth_P_mm_);

  const glm::dvec3 p = *smooth_P_mm_;
  bool changed = false;
  const auto near = nearest(p, kSameCut_mm);
  if (!near) {
    // A stroke that has left the cut goes on from where it did.
    const bool joins = goes_on_ && glm::distance(points_.back().at_P_mm, p) < kLongestStep_mm;
    if (!joins) ++strokes_;
    add(p);
    changed = true;
  } else if (*near + kNewest >= points_.size() && goes_on_) {
    // At the head of the stroke: a point each half millimetre, on the way to the blade.
    const glm::dvec3 step = p - points_.back().at_P_mm;
    const double step_mm = glm::length(step);
    bool is_new = step_mm >= kPoint_mm;
    for (std::size_t n = 0; is_new && n + 1 < points_.size(); ++n) {
      const bool is_newest = n + kNewest >= points_.size();
      is_new = glm::distance(points_[n].at_P_mm, p) >= (is_newest ? kPoint_mm : kSameCut_mm);
    }
    if (is_new) add(points_.back().at_P_mm + kPoint_mm / step_mm * step), changed = true;
  } else if (points_[*near].stroke == strokes_ || *near + 1 == points_.size()) {
    goes_on_ = *near + 1 == points_.size();
  }
  // Depth belongs to the smoothed place too, or the newest points would be passed before they are made.
  return deepen(p, depth_mm, blade->meets_bone) || changed;
}

double Incision::length_mm() const {
  double sum_mm = 0.0;
  for (std::size_t n = 1; n < points_.size(); ++n)
    if (points_[n].stroke == points_[n - 1].stroke) sum_mm += glm::distance(points_[n].at_P_mm, points_[n - 1].at_P_mm);
  return sum_mm;
}

double Incision::fullShare() const {
  double sum_mm = 0.0, full_mm = 0.0;
  for (std::size_t n = 1; n < points_.size(); ++n) {
    if (points_[n].stroke != points_[n - 1].stroke) continue;
    const double mm = glm::distance(points_[n].at_P_mm, points_[n - 1].at_P_mm);
    sum_mm += mm;
    full_mm += 0.5 * mm * ((points_[n].is_full ? 1.0 : 0.0) + (points_[n - 1].is_full ? 1.0 : 0.0));
  }
  return sum_mm > 0.0 ? full_mm / sum_mm : 0.0;
}

}  // namespace app
