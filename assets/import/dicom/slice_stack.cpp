#include "assets/import/dicom/slice_stack.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace assets {
namespace {

constexpr double kDouble = 0.1;          // of the usual step: at the same place
constexpr double kHole = 1.5;            // of the usual step: something may be missing
constexpr std::size_t kChangeAfter = 3;  // equal steps in a row: a change, no hole
constexpr double kMostMissing = 3.0;
constexpr double kAtSlice = 0.02;  // voxels of drift that are copied, as in scan/resampling.h

double tolerance_mm(double step_mm) { return std::max(0.01, 0.01 * step_mm); }

/// The step that most others equal; the smaller one of two.
double usualStep_mm(std::vector<double> steps_mm) {
  std::ranges::sort(steps_mm);
  double usual = steps_mm[steps_mm.size() / 2];
  std::size_t most = 0;
  std::size_t end = 0;
  for (std::size_t begin = 0; begin < steps_mm.size(); ++begin) {
    const double limit = steps_mm[begin] + 2.0 * tolerance_mm(steps_mm[begin]);
    while (end < steps_mm.size() && steps_mm[end] <= limit) ++end;
    if (end - begin <= most) continue;
    most = end - begin;
    usual = steps_mm[begin + (end - begin) / 2];
  }
  return usual;
}

/// Steps that differ from the usual one: short holes, or changes of the step.
void judgeSteps(const std::vector<double>& steps_mm, SliceStack& stack) {
  const double usual = stack.step_mm, tolerance = tolerance_mm(usual);
  bool has_changes = false;
  std::size_t n = 0;
  while (n < steps_mm.size()) {
    if (std::abs(steps_mm[n] - usual) <= tolerance) {
      ++n;
      continue;
    }
    stack.is_regular = false;
    std::size_t end = n + 1;
    while (end < steps_mm.size() && std::abs(steps_mm[end] - usual) > tolerance) ++end;
    const bool is_hole = end - n < kChangeAfter && std::all_of(steps_mm.begin() + static_cast<std::ptrdiff_t>(n),
                                                               steps_mm.begin() + static_cast<std::ptrdiff_t>(end),
                                                               [&](double step) { return step > kHole * usual; });
    if (!is_hole) {
      has_changes = true;
    } else {
      for (std::size_t hole = n; hole < end; ++hole) {
        SliceGap gap{hole, steps_mm[hole] - usual};
        const double missing = std::round(steps_mm[hole] / usual) - 1.0;
        const bool is_whole = std::abs(steps_mm[hole] - (missing + 1.0) * usual) <= (missing + 1.0) * tolerance;
        if (is_whole && missing <= kMostMissing) gap.missing_slices = static_cast<int>(missing);
        stack.gaps.push_back(gap);
      }
    }
    n = end;
  }
  for (std::size_t step = 1; has_changes && step < steps_mm.size(); ++step)
    if (std::abs(steps_mm[step] - steps_mm[step - 1]) > tolerance) stack.changes.push_back(step);
}

}  // namespace

std::optional<SliceAxes> sliceAxes(const glm::dmat2x3& row_column) {
  constexpr double kExact = 1.0e-3, kMendable = 1.0e-2;
  const double row = glm::length(row_column[0]), column = glm::length(row_column[1]);
  if (!(std::abs(row - 1.0) <= kMendable && std::abs(column - 1.0) <= kMendable)) return std::nullopt;
  SliceAxes axes;
  axes.row_P = row_column[0] / row;
  const glm::dvec3 along_column = row_column[1] / column;
  const double skew = glm::dot(axes.row_P, along_column);
  if (!(std::abs(skew) <= kMendable)) return std::nullopt;
  axes.column_P = glm::normalize(along_column - skew * axes.row_P);
  axes.is_mended = std::max({std::abs(row - 1.0), std::abs(column - 1.0), std::abs(skew)}) > kExact;
  return axes;
}

SliceStack stackOf(const std::vector<glm::dvec3>& positions_P_mm, const SliceAxes& axes) {
  const glm::dvec3 normal_P = axes.normal_P();
  std::vector<double> along(positions_P_mm.size());
  std::ranges::transform(positions_P_mm, along.begin(), [&](const glm::dvec3& p) { return glm::dot(p, normal_P); });
  std::vector<std::size_t> sorted(along.size());
  std::iota(sorted.begin(), sorted.end(), std::size_t{0});
  std::ranges::stable_sort(sorted, {}, [&](std::size_t n) { return along[n]; });

  SliceStack stack;
  std::vector<double> steps_mm;
  for (std::size_t n = 1; n < sorted.size(); ++n) steps_mm.push_back(along[sorted[n]] - along[sorted[n - 1]]);
  // Doubles would pull the usual step to zero.
  std::vector<double> apart_mm = steps_mm;
  std::erase_if(apart_mm, [](double step) { return step < 1.0e-3; });
  const double usual_mm = apart_mm.empty() ? 0.0 : usualStep_mm(apart_mm);

  for (std::size_t n = 0; n < sorted.size(); ++n) {
    const bool is_double = n > 0 && along[sorted[n]] - stack.along_mm.back() <= kDouble * usual_mm;
    if (!is_double) {
      stack.order.push_back(sorted[n]);
      stack.along_mm.push_back(along[sorted[n]]);
    } else if (!stack.doubles.empty() && stack.doubles.back().front() == stack.order.back()) {
      stack.doubles.back().push_back(sorted[n]);
    } else {
      stack.doubles.push_back({stack.order.back(), sorted[n]});
    }
  }
  if (stack.order.size() < 2) return stack;

  steps_mm.clear();
  for (std::size_t n = 1; n < stack.along_mm.size(); ++n) steps_mm.push_back(stack.along_mm[n] - stack.along_mm[n - 1]);
  stack.step_mm = usualStep_mm(steps_mm);
  const auto [smallest, largest] = std::ranges::minmax_element(steps_mm);
  stack.smallest_step_mm = *smallest, stack.largest_step_mm = *largest;
  judgeSteps(steps_mm, stack);

  const glm::dvec3 first = positions_P_mm[stack.order.front()], last = positions_P_mm[stack.order.back()];
  stack.per_mm_P = (last - first) / stack.extent_mm();
  const double cosine = 1.0 / glm::length(stack.per_mm_P);
  stack.tilt_deg = std::acos(std::min(1.0, cosine)) * 180.0 / std::numbers::pi;
  for (std::size_t n = 0; n < stack.order.size(); ++n) {
    const glm::dvec3 straight = first + (stack.along_mm[n] - stack.along_mm[0]) * stack.per_mm_P;
    stack.sideways_mm = std::max(stack.sideways_mm, glm::distance(positions_P_mm[stack.order[n]], straight));
  }
  return stack;
}

EvenSlices evenSlices(const SliceStack& stack) {
  EvenSlices even;
  const std::size_t count = stack.order.size();
  if (stack.is_regular || count < 2) {
    even.step_mm = count < 2 ? 0.0 : stack.extent_mm() / static_cast<double>(count - 1);
    for (std::size_t n = 0; n < count; ++n) even.slices.push_back({n, n, 0.0});
    return even;
  }
  const double target_mm = stack.changes.empty() ? stack.step_mm : std::min(stack.step_mm, stack.smallest_step_mm);
  const double steps = std::max(1.0, std::round(stack.extent_mm() / target_mm));
  even.step_mm = stack.extent_mm() / steps;
  std::size_t below = 0;
  for (int n = 0; n <= static_cast<int>(steps); ++n) {
    const double at_mm = stack.along_mm.front() + n * even.step_mm;
    while (below + 2 < count && stack.along_mm[below + 1] <= at_mm) ++below;
    const double share = (at_mm - stack.along_mm[below]) / (stack.along_mm[below + 1] - stack.along_mm[below]);
    // A slice that is there is taken as it is.
    even.slices.push_back({below, below + 1, share < kAtSlice ? 0.0 : share > 1.0 - kAtSlice ? 1.0 : share});
  }
  return even;
}

}  // namespace assets
