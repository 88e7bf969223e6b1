// Two recorded rehearsals of one case side by side: each measure, the difference, steps, and the bone that only one of
// them removed. For `molar compare`. Any thread; some seconds.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/session/measures/plan_comparison.h"
#include "app/session/metrics.h"

namespace app {

struct SessionComparison {
  SessionMetrics a, b;
  RemovalDifference bone;
};

/// Throws SessionError; UsageError where they are of different cases.
SessionComparison comparisonOf(const std::string& path_a, const std::string& path_b);

/// Of both; those of kMeasures first.
struct ComparedMeasure {
  std::string key;
  std::string_view name, unit;
  std::optional<double> a, b;
};
std::vector<ComparedMeasure> comparedMeasures(const SessionComparison& comparison);

std::string comparisonText(const SessionComparison& comparison);
std::string comparisonJson(const SessionComparison& comparison);

}  // namespace app
