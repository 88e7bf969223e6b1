#include "app/psychophysics/probe_measures.h"

#include <algorithm>

namespace app {
namespace {

constexpr double kContactShareOfPeak = 0.05;
constexpr double kFaintest_N = 1e-6;

}  // namespace

ProbeMeasures measuresOf(std::span<const ProbeSample> samples) {
  ProbeMeasures felt;
  for (const ProbeSample& s : samples) felt.peak_force_N = std::max(felt.peak_force_N, s.force_N);
  if (felt.peak_force_N <= kFaintest_N) return {};

  // Means, then moments about the means.
  double n = 0.0, mean_depth = 0.0, mean_force = 0.0;
  const double in_contact_N = kContactShareOfPeak * felt.peak_force_N;
  for (const ProbeSample& s : samples) {
    if (s.force_N < in_contact_N) continue;
    n += 1.0, mean_depth += s.depth_mm, mean_force += s.force_N;
    felt.depth_mm = std::max(felt.depth_mm, s.depth_mm);
  }
  mean_depth /= n, mean_force /= n;
  double covariance = 0.0, variance = 0.0;
  for (const ProbeSample& s : samples) {
    if (s.force_N < in_contact_N) continue;
    covariance += (s.depth_mm - mean_depth) * (s.force_N - mean_force);
    variance += (s.depth_mm - mean_depth) * (s.depth_mm - mean_depth);
  }
  felt.stiffness_N_per_mm = variance > 0.0 ? covariance / variance : 0.0;
  felt.contact_share = n / static_cast<double>(samples.size());
  for (std::size_t i = 1; i < samples.size(); ++i)
    felt.work_Nmm +=
        0.5 * (samples[i].force_N + samples[i - 1].force_N) * (samples[i].depth_mm - samples[i - 1].depth_mm);
  return felt;
}

}  // namespace app
