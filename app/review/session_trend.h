// The rehearsals of a folder over time, by case: a few measures of each, and from three runs of a case on their median
// and range; a grade against a named set of references alone. For `molar trend`. Any thread; some seconds a session, as
// metricsOf().
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/review/reference_set.h"
#include "app/session/metrics.h"
#include "app/text/message.h"

namespace app {

struct TrendRun {
  std::string file;  ///< without folder
  std::int64_t unix_s = 0;
  SessionMetrics metrics;
  bool is_own = false;  ///< the session that is reported
};

struct CaseTrend {
  std::string title;           ///< of the case
  std::vector<TrendRun> runs;  ///< oldest first
};

/// Runs below this have no median.
inline constexpr std::size_t kRunsForTrend = 3;

/// Throws SessionError: there is no such folder.
void refuseMissingFolder(const std::filesystem::path& folder);

/// Complete or killed sessions; what cannot be read is told and left out. Throws SessionError where the folder holds
/// none, or is missing.
std::vector<CaseTrend> trendOf(const std::filesystem::path& folder, const ReportLine& report);

/// Of the case of a session that is measured already, which is known by its file and not measured again; nothing where
/// the folder holds no session of that case. Throws as the other.
std::optional<CaseTrend> trendOf(const std::filesystem::path& folder, const ReportLine& report,
                                 const std::string& own_path, const SessionMetrics& own);

/// A few measures of each run, and from kRunsForTrend on median, least and most of each.
struct TrendTable {
  struct Row {
    std::string name;  ///< when it was, "2026-11-24 15:43 UTC", or "median"
    std::vector<std::optional<double>> values;
  };
  std::vector<std::string> heads, names;  ///< short; for people, with the unit
  std::vector<Row> runs, spread;
};
TrendTable trendTable(const CaseTrend& one);

/// `reference`: the grade of the runs of its case against it; null: none.
std::string trendText(const std::vector<CaseTrend>& cases, const ReferenceSet* reference = nullptr);
std::string trendJson(const std::vector<CaseTrend>& cases, const ReferenceSet* reference = nullptr);

}  // namespace app
