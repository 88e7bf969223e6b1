// A named set of reference runs of one case, and the measures of other runs against it (reference/product 4.6):
// z-scores by measure, from three runs on a grade with median and range. Holds measures alone: no path, no name of a
// person. Kept as JSON in the data folder's "references", or in a file of its own. Any thread; a few file-system calls.
//
// A measure counts for the grade where more is better or worse for everybody (kGraded). For it
// its z is taken positive where the run is better than the set's mean, in standard deviations of the set. The grade is
// of the median of the medians of these over the runs: the same as the set from -1 on, below it from -2 on, else well
// below; never where an event that no average may hide (app/session/gates.h) happened. Bounds: our default.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/session/metrics.h"

namespace app {

struct ReferenceSet {
  struct Run {
    std::string program;
    std::map<std::string, double> values;  ///< by the measure's id
  };
  std::string name, case_title, made_utc;
  std::vector<Run> runs;
  ContactEnvelope envelope;  ///< of all runs
};

/// Fewer runs have no spread, and no grade.
inline constexpr std::size_t kLeastRuns = 3;

/// Throws UsageError: runs of several cases.
ReferenceSet referenceOf(const std::string& name, std::span<const SessionMetrics> runs);

std::string referenceText(const ReferenceSet& set);
/// Throws UsageError, beginning with `where`: not such a set.
ReferenceSet referenceFromText(const std::string& text, const std::string& where);

/// The file of a set in the data folder. Throws UsageError for a name that is none: letters, digits, '-' and '_'.
std::string referenceFile(const std::string& name);
/// A name, or a file FILE.json. Throws UsageError: there is no such set, or it cannot be read.
ReferenceSet loadReference(const std::string& name_or_file);
/// Of an option that names one.
inline constexpr const char* kReferenceHelp =
    "Hold it against this set of runs, see molar reference: a name, or FILE.json";
/// Of the data folder, by name.
std::vector<std::string> referenceNames();

/// Throws UsageError: runs of this case are not held against the set, which is of another.
void refuseOtherCase(const std::string& case_title, const ReferenceSet& set);

struct Score {
  std::string_view id, name, unit;
  double value = 0.0, median = 0.0, low = 0.0, high = 0.0;  ///< the run's; of the set
  std::optional<double> z;   ///< standard deviations above the set's mean, whatever is better; none: fewer than three
                             ///< runs, or no spread
  int better = 0;            ///< 1: more is better, -1: less, 0: neither, it is not graded
  bool is_confirmed = true;  ///< false: it rests on what nobody has confirmed
};
/// Of what run and set both tell. Throws UsageError: of another case.
std::vector<Score> scoresOf(const SessionMetrics& run, const ReferenceSet& set);

/// S6: share of contact time above the set's envelope of force and of speed, in place of the untold values.
void tellAgainst(SessionMetrics& run, const ReferenceSet& set);

struct Grade {
  std::optional<double> z, low, high;  ///< median over the runs, and their range, positive is better; none: see words
  std::string words;                   ///< "as the set", "below the set" …; why there is none
};
Grade gradeOf(std::span<const SessionMetrics> runs, const ReferenceSet& set);

/// For people: events first, then scores, then conditions.
std::string scoresText(const SessionMetrics& run, const ReferenceSet& set);
std::string scoresJson(const SessionMetrics& run, const ReferenceSet& set);

}  // namespace app
