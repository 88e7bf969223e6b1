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

/// How both began and what they left, read once for all that is made of them.
struct ComparedEnds {
  StoredStart start_a, start_b;
  BoneLeft left_a, left_b;
};
/// Throws SessionError; UsageError where they are of different cases, before anything is run again. A replay of each
/// that does not hold its bone.
ComparedEnds comparedEnds(const std::string& path_a, const std::string& path_b);

struct SessionComparison {
  SessionMetrics a, b;
  RemovalDifference bone;
};
/// `ends`: of these. Throws SessionError.
SessionComparison comparisonOf(const std::string& path_a, const std::string& path_b, const ComparedEnds& ends);

/// Of both; those of kMeasures first.
struct ComparedMeasure {
  std::string key;
  std::string_view name, unit;
  std::optional<double> a, b;
  bool is_confirmed = true;  ///< false: in one of them it rests on what nobody has confirmed
};
std::vector<ComparedMeasure> comparedMeasures(const SessionComparison& comparison);

/// Of the steps of the first; none where a procedure was not followed in both.
struct ComparedStep {
  std::string title;
  double a_s = 0.0;
  std::optional<double> b_s;
};
std::vector<ComparedStep> comparedSteps(const SessionComparison& comparison);

std::string comparisonText(const SessionComparison& comparison);
std::string comparisonJson(const SessionComparison& comparison);

}  // namespace app
