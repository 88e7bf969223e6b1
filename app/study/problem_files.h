// What people decide about the problems of a study, as tables in its folder: merged.csv (a problem that is another one:
// its evidence counts there, both stay, and it can be undone) and ratings-E2.csv, a sheet on which one rater gives each
// problem a severity without seeing what others gave. Neither is sealed: they hold names and titles of problems.
// Start-up; milliseconds.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace app {

inline constexpr char kMergedName[] = "merged.csv";

/// From a problem to the one that it is.
using MergedProblems = std::map<std::string, std::string>;
/// Where a chain of them ends.
std::string lastOf(const MergedProblems& merged, std::string problem);

/// Of STUDY/merged.csv; none where there is no such file. Throws LoadError with line and column, also for a circle.
MergedProblems mergedIn(const std::string& study);
/// The file with one more. Throws UsageError: it would be a circle, or is merged already.
void mergeProblem(const std::string& study, const std::string& problem, const std::string& into);
/// Throws UsageError: it is not merged.
void unmergeProblem(const std::string& study, const std::string& problem);

struct Rating {
  std::string problem, rater;
  std::optional<int> severity;  ///< 0 to 4; none: not rated yet
};

/// Of all STUDY/ratings-*.csv. Throws LoadError with line and column.
std::vector<Rating> ratingsIn(const std::string& study);

struct RatedProblem {
  std::string problem, title, tasks;
};
/// STUDY/ratings-E2.csv to fill in; the severities that stand in an older one are kept. The file's name.
std::string writeRatingSheet(const std::string& study, const std::string& rater,
                             const std::vector<RatedProblem>& problems);

}  // namespace app
