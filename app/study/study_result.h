// What a study says: answers by item, category and group, groups and sessions compared, tasks, and problems by how bad
// and how common they are. Pure; any thread; a second for 60 participants.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/study/agreement.h"
#include "app/study/problem_files.h"
#include "app/study/statistics.h"
#include "app/study/study_data.h"

namespace app {

/// Below it answers are listed as they are, and nothing is claimed from a deviation.
inline constexpr std::size_t kFewestForDeviation = 5;

/// Answers of a group to an item, or to those of a category (each participant's mean), or the score of all.
struct AnswerRow {
  std::string id, says, category, group, session;  ///< group "all": everybody
  Summary summary;
  std::size_t missing = 0;
  std::optional<ValueRange> mean_interval, median_interval;  ///< at 95 %
  std::vector<double> values;                                ///< sorted
  std::optional<PublishedSummary> published = {};            ///< of everybody, by the study the questionnaire is of
  bool can_be_answered = true;                               ///< false: no whole answers have what is published

  bool hasDeviation() const { return values.size() >= kFewestForDeviation; }
};

/// Two groups, or one group's two sessions, on an item, category or score.
struct Difference {
  std::string id, of, against;  ///< how far `of` lies above `against`
  bool is_paired = false;
  std::size_t count = 0;  ///< values, or pairs
  RankTest test;
  double holm_p = 1.0;  ///< for as many tests as there are of this study

  /// "student against surgeon".
  std::string words() const { return of + (is_paired ? " after " : " against ") + against; }
};

struct TaskRow {
  std::string task;
  std::size_t count = 0, success = 0, partly = 0, failed = 0;
  int helps = 0;
  std::optional<ValueRange> success_share;    ///< at 95 %
  std::optional<double> time_s;               ///< geometric mean of those who succeeded
  std::optional<ValueRange> time_interval_s;  ///< at 95 %
};

/// How many participants met a problem in one task.
struct MetInTask {
  std::string task;
  std::size_t met_by = 0;
};

struct ProblemRow {
  std::string problem, title;
  std::vector<MetInTask> tasks;
  std::vector<std::string> participants, moments;  ///< who met it: codes
  std::vector<std::string> also;                   ///< problems that were merged into it
  std::size_t met_by = 0, could_meet = 0;          ///< participants
  std::optional<ValueRange> share;                 ///< at 95 %
  std::optional<double> severity;                  ///< median of raters; none while one of them has not rated all
  double weight = 0.0;                             ///< severity (1 where it is not rated) times share
};

/// A sentence that somebody answered with.
struct SaidAnswer {
  std::string item, participant, words;
};

/// Of raters on severity: each one's worst of a problem.
struct SeverityAgreement {
  std::size_t raters = 0;
  std::optional<double> nominal, ordinal, interval;  ///< Krippendorff's alpha
  std::optional<ValueRange> ordinal_interval;        ///< by samples from `seed`
  std::optional<IntraclassCorrelation> intraclass;   ///< where each rated all
  static constexpr std::uint64_t kSeed = 1;
};

struct StudyResult {
  std::string title, source, published_note;
  std::size_t participants = 0;
  std::vector<std::string> groups, sessions;
  std::vector<AnswerRow> items, categories, scores;
  std::vector<SaidAnswer> said;
  std::vector<Difference> differences;
  std::vector<TaskRow> tasks;
  std::vector<ProblemRow> problems;    ///< the heaviest first
  std::optional<Discovery> discovery;  ///< of problems
  SeverityAgreement agreement;
  std::vector<std::string> awaited;  ///< raters who have not rated all: severities are hidden until then
};

struct StudyInput {
  std::optional<Questionnaire> questionnaire;
  std::vector<AnswerSheet> answers;
  std::vector<TaskRun> tasks;
  std::vector<ProblemSeen> problems;
  MergedProblems merged;
  std::vector<Rating> ratings;   ///< beside those of the evidence
  std::size_t participants = 0;  ///< as many took part, at least; who met no problem is in no table of problems
};

StudyResult studyResult(const StudyInput& given);

}  // namespace app
