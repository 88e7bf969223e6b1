#include "app/study/problem_files.h"

#include <algorithm>
#include <filesystem>

#include "app/study/csv.h"
#include "app/text/anonymous_id.h"
#include "app/text/parse_number.h"
#include "app/text/usage_error.h"
#include "assets/load_error.h"
#include "calibration/output_file.h"

namespace app {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kRatings = "ratings-";
constexpr int kWorst = 4;

std::string mergedPath(const std::string& study) { return (fs::path(study) / kMergedName).string(); }

void writeMerged(const std::string& study, const MergedProblems& merged) {
  std::string text = csvLine({"problem", "merged_into"});
  for (const auto& [problem, into] : merged) text += csvLine({problem, into});
  calibration::OutputFile(mergedPath(study), true).commit(text);
}

std::vector<Rating> ratingsOf(const std::string& file) {
  std::vector<Rating> ratings;
  const CsvTable table = csvTableOf(file);
  const std::size_t problem = table.column("problem"), rater = table.column("rater"),
                    severity = table.column("severity");
  for (const CsvRow& row : table.rows) {
    Rating one{row.cells[problem], row.cells[rater], {}};
    if (one.problem.empty()) table.refuse(row, problem, "it is empty, fill it in");
    if (!isAnonymousId(one.rater)) table.refuse(row, rater, "give a code as E1, never a name");
    if (!row.cells[severity].empty()) {
      one.severity = parseNumber<int>(row.cells[severity]);
      if (!one.severity || *one.severity < 0 || *one.severity > kWorst)
        table.refuse(row, severity, "give a whole number from 0 to 4");
    }
    ratings.push_back(std::move(one));
  }
  return ratings;
}

}  // namespace

std::string lastOf(const MergedProblems& merged, std::string problem) {
  // Bounded by the table, should it hold a circle.
  for (std::size_t steps = 0; steps <= merged.size(); ++steps) {
    const auto next = merged.find(problem);
    if (next == merged.end()) break;
    problem = next->second;
  }
  return problem;
}

MergedProblems mergedIn(const std::string& study) {
  MergedProblems merged;
  std::error_code failed;
  if (!fs::exists(mergedPath(study), failed)) return merged;
  const CsvTable table = csvTableOf(mergedPath(study));
  const std::size_t problem = table.column("problem"), into = table.column("merged_into");
  for (const CsvRow& row : table.rows) {
    if (row.cells[problem].empty() || row.cells[into].empty()) table.refuse(row, into, "it is empty, fill it in");
    if (lastOf(merged, row.cells[into]) == row.cells[problem])
      table.refuse(row, into, "it leads back to its beginning");
    if (!merged.emplace(row.cells[problem], row.cells[into]).second)
      table.refuse(row, problem, "it is merged above, keep one row");
  }
  return merged;
}

void mergeProblem(const std::string& study, const std::string& problem, const std::string& into) {
  MergedProblems merged = mergedIn(study);
  if (lastOf(merged, into) == problem) throw UsageError("study merge: " + into + " is " + problem + " already");
  if (!merged.emplace(problem, into).second)
    throw UsageError("study merge: " + problem + " is merged into " + merged[problem] + ", undo that first");
  writeMerged(study, merged);
}

void unmergeProblem(const std::string& study, const std::string& problem) {
  MergedProblems merged = mergedIn(study);
  if (merged.erase(problem) == 0) throw UsageError("study unmerge: " + problem + " is not merged into another");
  writeMerged(study, merged);
}

std::vector<Rating> ratingsIn(const std::string& study) {
  std::vector<std::string> files;
  std::error_code failed;
  for (const auto& entry : fs::directory_iterator(study, failed)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(kRatings) && name.ends_with(".csv")) files.push_back(entry.path().string());
  }
  std::ranges::sort(files);
  std::vector<Rating> ratings;
  for (const std::string& file : files)
    for (Rating& one : ratingsOf(file)) ratings.push_back(std::move(one));
  return ratings;
}

std::string writeRatingSheet(const std::string& study, const std::string& rater,
                             const std::vector<RatedProblem>& problems) {
  if (!isAnonymousId(rater)) throw UsageError("study rate: give the rater's code as E2, never a name");
  const std::string name = std::string(kRatings) + rater + ".csv", path = (fs::path(study) / name).string();
  std::map<std::string, std::string> given;
  std::error_code failed;
  if (fs::exists(path, failed))
    for (const Rating& one : ratingsOf(path))
      if (one.severity) given[one.problem] = std::to_string(*one.severity);
  std::string text = csvLine({"problem", "title", "tasks", "rater", "severity"});
  for (const RatedProblem& one : problems)
    text += csvLine({one.problem, one.title, one.tasks, rater, given[one.problem]});
  calibration::OutputFile(path, true).commit(text);
  return path;
}

}  // namespace app
