#include "app/review/session_trend.h"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <utility>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "app/report/markup.h"
#include "app/session/measures/painting.h"
#include "app/session/session_error.h"
#include "app/session/session_list.h"
#include "app/station/session_case.h"
#include "calibration/record/utc.h"

namespace app {
namespace {

struct Column {
  std::string_view key, head, name;
  std::optional<double> (*of)(const SessionMetrics& metrics);
};

constexpr std::array kColumns{
    Column{"minutes", "min", "length, min", [](const SessionMetrics& m) { return std::optional(m.duration_s / 60.0); }},
    Column{"removed_mm3", "mm³", "removed, mm³", [](const SessionMetrics& m) { return std::optional(m.removed_mm3); }},
    Column{"rate_mm3_per_s", "mm³/s", "removed, mm³/s drilling",
           [](const SessionMetrics& m) { return valueOf(m, "M3.rate"); }},
    Column{"painting_index", "painting", "painting index", [](const SessionMetrics& m) { return valueOf(m, "PI"); }},
    Column{"smoothness", "SPARC", "smoothness, SPARC", [](const SessionMetrics& m) { return valueOf(m, "M5.SPARC"); }},
    Column{"dry_s", "dry s", "drilled dry, s", [](const SessionMetrics& m) { return std::optional(m.dry_drilling_s); }},
    Column{"max_force_N", "most N", "largest force, N",
           [](const SessionMetrics& m) { return std::optional(m.max_force_N); }},
};

struct Spread {
  double median = 0.0, low = 0.0, high = 0.0;
};

/// None: of fewer runs than kRunsForTrend.
std::optional<Spread> spreadOf(const CaseTrend& one, const Column& column) {
  std::vector<double> values;
  for (const TrendRun& run : one.runs)
    if (const auto value = column.of(run.metrics)) values.push_back(*value);
  if (values.size() < kRunsForTrend) return {};
  const auto [low, high] = std::ranges::minmax(values);
  return Spread{*medianOf(values), low, high};
}

/// None: the set is of another case.
std::optional<Grade> gradeOf(const CaseTrend& one, const ReferenceSet* reference) {
  if (reference == nullptr || reference->case_title != one.title) return {};
  std::vector<SessionMetrics> runs;
  for (const TrendRun& run : one.runs) runs.push_back(run.metrics);
  return gradeOf(runs, *reference);
}

std::string gradeText(const Grade& grade) {
  std::string words = "grade                 " + grade.words;
  if (grade.z)
    words += fmt::format("; median z {:+.1f}, from {:+.1f} to {:+.1f}, positive is better", *grade.z, *grade.low,
                         *grade.high);
  return words + "\n";
}

std::string fileOf(const SessionListing& session) { return std::filesystem::path(session.path).filename().string(); }

TrendRun measured(const SessionListing& session) {
  return {fileOf(session), session.unix_s, metricsOf(session.path, caseOfSession)};
}

/// By title, each from old to new.
std::vector<CaseTrend> casesOf(const std::filesystem::path& folder, const ReportLine& report,
                               const std::function<bool(const SessionListing&)>& is_asked,
                               const std::function<TrendRun(const SessionListing&)>& run) {
  refuseMissingFolder(folder);
  std::map<std::string, CaseTrend> by_title;
  std::vector<SessionListing> listed = listSessions(folder);
  std::ranges::reverse(listed);
  for (const SessionListing& session : listed) {
    if (!session.isReadable()) {
      report(fileOf(session) + ": " + session.remark + ", left out");
      continue;
    }
    if (!is_asked(session)) continue;
    try {
      TrendRun one = run(session);
      CaseTrend& trend = by_title[session.case_title];
      trend.title = session.case_title;
      trend.runs.push_back(std::move(one));
    } catch (const SessionError& error) {
      report(std::string(error.what()) + ", left out");
    }
  }
  std::vector<CaseTrend> cases;
  for (auto& [title, one] : by_title) cases.push_back(std::move(one));
  return cases;
}

}  // namespace

TrendTable trendTable(const CaseTrend& one) {
  TrendTable table;
  for (const Column& column : kColumns) {
    table.heads.emplace_back(column.head);
    table.names.emplace_back(column.name);
  }
  for (const TrendRun& run : one.runs) {
    TrendTable::Row& row = table.runs.emplace_back(TrendTable::Row{timeText(calibration::utcOf(run.unix_s)), {}});
    for (const Column& column : kColumns) row.values.push_back(column.of(run.metrics));
  }
  if (one.runs.size() < kRunsForTrend) return table;
  for (const auto& [name, part] :
       {std::pair("median", &Spread::median), std::pair("least", &Spread::low), std::pair("most", &Spread::high)}) {
    TrendTable::Row& row = table.spread.emplace_back(TrendTable::Row{name, {}});
    for (const Column& column : kColumns) {
      const auto spread = spreadOf(one, column);
      row.values.push_back(spread ? std::optional((*spread).*part) : std::nullopt);
    }
  }
  return table;
}

void refuseMissingFolder(const std::filesystem::path& folder) {
  if (std::error_code failed; !std::filesystem::is_directory(folder, failed))
    throw SessionError(folder.string() + ": there is no such folder, name one that molar rehearse recorded into");
}

std::vector<CaseTrend> trendOf(const std::filesystem::path& folder, const ReportLine& report) {
  std::vector<CaseTrend> cases = casesOf(
      folder, report, [](const SessionListing&) { return true; }, measured);
  if (cases.empty())
    throw SessionError(folder.string() + ": holds no session that can be measured, record one with molar rehearse");
  return cases;
}

std::optional<CaseTrend> trendOf(const std::filesystem::path& folder, const ReportLine& report,
                                 const std::string& own_path, const SessionMetrics& own) {
  std::vector<CaseTrend> cases = casesOf(
      folder, report, [&own](const SessionListing& session) { return session.case_title == own.patient_title; },
      [&](const SessionListing& session) {
        std::error_code failed;
        if (!std::filesystem::equivalent(session.path, own_path, failed)) return measured(session);
        return TrendRun{fileOf(session), session.unix_s, own, true};
      });
  if (cases.empty()) return {};
  return std::move(cases.front());
}

std::string trendText(const std::vector<CaseTrend>& cases, const ReferenceSet* reference) {
  std::string words;
  for (const CaseTrend& one : cases) {
    const TrendTable table = trendTable(one);
    words += (words.empty() ? "" : "\n") + one.title + "\n" + fmt::format("{:<22}", "");
    for (const std::string& head : table.heads) words += fmt::format("{:>10}", head);
    words += "\n";
    const auto add = [&words](const std::vector<TrendTable::Row>& rows) {
      for (const TrendTable::Row& row : rows) {
        words += fmt::format("{:<22}", row.name);
        for (const auto& value : row.values)
          words += value ? fmt::format("{:>10.2f}", *value + 0.0) : fmt::format("{:>10}", "-");
        words += "\n";
      }
    };
    add(table.runs);
    if (const auto grade = gradeOf(one, reference)) words += gradeText(*grade);
    if (table.spread.empty()) words += fmt::format("median and range from {} runs on\n", kRunsForTrend);
    add(table.spread);
  }
  return words;
}

std::string trendJson(const std::vector<CaseTrend>& cases, const ReferenceSet* reference) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const CaseTrend& one : cases) {
    nlohmann::ordered_json entry = {{"patient", one.title}, {"runs", nlohmann::ordered_json::array()}};
    for (const TrendRun& run : one.runs) {
      nlohmann::ordered_json values = {{"file", run.file}, {"unix_s", run.unix_s}};
      for (const Column& column : kColumns) {
        const auto value = column.of(run.metrics);
        values[std::string(column.key)] = value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
      }
      entry["runs"].push_back(std::move(values));
    }
    for (const Column& column : kColumns) {
      const auto spread = spreadOf(one, column);
      entry["spread"][std::string(column.key)] =
          spread ? nlohmann::ordered_json{{"median", spread->median}, {"least", spread->low}, {"most", spread->high}}
                 : nlohmann::ordered_json();
    }
    if (const auto grade = gradeOf(one, reference)) {
      entry["grade"] = {{"reference", reference->name}, {"words", grade->words}, {"z", nullptr}};
      if (grade->z)
        entry["grade"].update(nlohmann::ordered_json{{"z", *grade->z}, {"least", *grade->low}, {"most", *grade->high}});
    }
    list.push_back(std::move(entry));
  }
  return list.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace app
