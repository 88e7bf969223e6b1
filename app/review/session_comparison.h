// Two recorded rehearsals of one case side by side: each measure, the difference, steps, and the bone that only one of
// them removed. For `molar compare`. Any thread; some seconds.
#pragma once

#include <string>

#include "app/session/measures/plan_comparison.h"
#include "app/session/metrics.h"

namespace app {

struct SessionComparison {
  SessionMetrics a, b;
  RemovalDifference bone;
};

/// Throws SessionError; UsageError where they are of different cases.
SessionComparison comparisonOf(const std::string& path_a, const std::string& path_b);

std::string comparisonText(const SessionComparison& comparison);
std::string comparisonJson(const SessionComparison& comparison);

}  // namespace app
