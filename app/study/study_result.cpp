#include "app/study/study_result.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <set>

namespace app {
namespace {

using ValueOf = std::function<std::optional<double>(const AnswerSheet&)>;

std::optional<double> meanGiven(const Questionnaire& questionnaire, const AnswerSheet& sheet,
                                const std::string& category) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t n = 0; n < questionnaire.items.size(); ++n)
    if (questionnaire.items[n].category == category && sheet.values[n]) sum += *sheet.values[n], ++count;
  return count == 0 ? std::nullopt : std::optional(sum / count);
}

template <class Kept>
std::vector<std::string> namesOf(const std::vector<AnswerSheet>& sheets, const Kept& kept) {
  std::set<std::string> names;
  for (const AnswerSheet& sheet : sheets)
    if (!kept(sheet).empty()) names.insert(kept(sheet));
  return {names.begin(), names.end()};
}

/// Rows, and comparisons, of the answers to one questionnaire.
class AnswerTables {
 public:
  AnswerTables(const Questionnaire& questionnaire, const std::vector<AnswerSheet>& sheets, StudyResult& result)
      : questionnaire_(questionnaire), sheets_(sheets), result_(result) {}

  void fill() {
    result_.groups = namesOf(sheets_, std::mem_fn(&AnswerSheet::group));
    result_.sessions = namesOf(sheets_, std::mem_fn(&AnswerSheet::session));
    if (questionnaire_.isOfWords()) return list();
    for (std::size_t n = 0; n < questionnaire_.items.size(); ++n) {
      const QuestionItem& item = questionnaire_.items[n];
      if (!item.choices.empty()) continue;
      AnswerRow row{item.id, item.says, item.category, "", "", {}, 0, {}, {}, {}};
      row.published = item.published;
      row.can_be_answered = !row.published || canBeAnswered(*row.published, questionnaire_.low, questionnaire_.high);
      add(row, result_.items, [n](const AnswerSheet& sheet) { return sheet.values[n]; });
    }
    if (questionnaire_.scoring == Scoring::weighted) addWeights();
    for (const std::string& category : questionnaire_.categories())
      add({category, category, category, "", "", {}, 0, {}, {}, {}}, result_.categories,
          [&](const AnswerSheet& sheet) { return meanGiven(questionnaire_, sheet, category); });
    if (questionnaire_.scoring != Scoring::categories)
      add({questionnaire_.id, questionnaire_.title, "", "", "", {}, 0, {}, {}, {}}, result_.scores,
          [&](const AnswerSheet& sheet) { return scoreOf(questionnaire_, sheet.values); });
    adjust();
  }

 private:
  /// What the comparisons made of each scale.
  void addWeights() {
    for (std::size_t n = 0; n < questionnaire_.items.size(); ++n) {
      const QuestionItem& item = questionnaire_.items[n];
      if (!item.choices.empty()) continue;
      add({item.id + ".weight", item.name + ", how often chosen", "Weights", "", "", {}, 0, {}, {}, {}}, result_.items,
          [this, n](const AnswerSheet& sheet) -> std::optional<double> {
            const auto weights = weightsOf(questionnaire_, sheet.values);
            return weights ? std::optional((*weights)[n]) : std::nullopt;
          });
    }
  }

  void list() {
    for (std::size_t n = 0; n < questionnaire_.items.size(); ++n)
      for (const AnswerSheet& sheet : sheets_)
        if (!sheet.words[n].empty())
          result_.said.push_back({questionnaire_.items[n].says, sheet.participant, sheet.words[n]});
  }

  void add(const AnswerRow& names, std::vector<AnswerRow>& rows, const ValueOf& value_of) {
    // Sessions are never pooled: a participant counts once in a row.
    const std::vector<std::string> sessions =
        result_.sessions.empty() ? std::vector<std::string>{""} : result_.sessions;
    for (const std::string& session : sessions) {
      rows.push_back(rowOf(names, "", session, value_of));
      if (result_.groups.size() > 1)
        for (const std::string& group : result_.groups) rows.push_back(rowOf(names, group, session, value_of));
    }
    if (sessions.size() == 1 && result_.groups.size() == 2) compareGroups(names.id, value_of);
    if (sessions.size() == 2) compareSessions(names.id, value_of);
  }

  AnswerRow rowOf(AnswerRow row, const std::string& group, const std::string& session, const ValueOf& value_of) const {
    row.group = group.empty() ? "all" : group;
    if (!group.empty()) row.published.reset();
    row.session = session;
    for (const AnswerSheet& sheet : sheets_) {
      if ((!group.empty() && sheet.group != group) || sheet.session != session) continue;
      if (const auto value = value_of(sheet))
        row.values.push_back(*value);
      else
        ++row.missing;
    }
    std::ranges::sort(row.values);
    row.summary = summaryOf(row.values);
    if (row.values.size() >= kFewestForDeviation) row.mean_interval = meanInterval(row.values);
    row.median_interval = medianInterval(row.values);
    return row;
  }

  void compareGroups(const std::string& id, const ValueOf& value_of) {
    std::map<std::string, std::vector<double>> of_group;
    for (const AnswerSheet& sheet : sheets_)
      if (const auto value = value_of(sheet)) of_group[sheet.group].push_back(*value);
    const std::vector<double>&first = of_group[result_.groups[0]], &second = of_group[result_.groups[1]];
    if (std::min(first.size(), second.size()) < kFewestForDeviation) return;
    if (const auto test = rankSumTest(first, second))
      result_.differences.push_back(
          {id, result_.groups[1], result_.groups[0], false, first.size() + second.size(), *test, 1.0});
  }

  void compareSessions(const std::string& id, const ValueOf& value_of) {
    std::map<std::string, std::map<std::string, double>> by_participant;
    for (const AnswerSheet& sheet : sheets_)
      if (const auto value = value_of(sheet)) by_participant[sheet.participant][sheet.session] = *value;
    std::vector<double> differences;
    for (const auto& [participant, values] : by_participant)
      if (values.size() == 2) differences.push_back(values.at(result_.sessions[1]) - values.at(result_.sessions[0]));
    if (differences.size() < kFewestForDeviation) return;
    if (const auto test = signedRankTest(differences))
      result_.differences.push_back(
          {id, result_.sessions[1], result_.sessions[0], true, differences.size(), *test, 1.0});
  }

  void adjust() {
    std::vector<double> p;
    for (const Difference& difference : result_.differences) p.push_back(difference.test.p);
    p = holmAdjusted(std::move(p));
    for (std::size_t n = 0; n < p.size(); ++n) result_.differences[n].holm_p = p[n];
  }

  const Questionnaire& questionnaire_;
  const std::vector<AnswerSheet>& sheets_;
  StudyResult& result_;
};

std::vector<TaskRow> taskRows(const std::vector<TaskRun>& runs) {
  std::vector<TaskRow> rows;
  std::map<std::string, std::vector<double>> times_s;
  for (const TaskRun& run : runs) {
    auto row = std::ranges::find(rows, run.task, &TaskRow::task);
    if (row == rows.end()) row = rows.insert(rows.end(), TaskRow{run.task, 0, 0, 0, 0, 0, {}, {}, {}});
    ++row->count;
    ++(run.result == TaskResult::success ? row->success : run.result == TaskResult::partly ? row->partly : row->failed);
    row->helps += run.helps;
    if (run.time_s && run.result == TaskResult::success) times_s[run.task].push_back(*run.time_s);
  }
  for (TaskRow& row : rows) {
    row.success_share = shareInterval(row.success, row.count);
    row.time_s = geometricMean(times_s[row.task]);
    if (times_s[row.task].size() >= kFewestForDeviation) row.time_interval_s = geometricMeanInterval(times_s[row.task]);
  }
  return rows;
}

/// Participants who did one of its tasks; all, where tasks are not known.
std::size_t couldMeet(const ProblemRow& problem, const StudyInput& input, std::size_t participants) {
  std::set<std::string> met_the_task;
  for (const TaskRun& run : input.tasks)
    if (std::ranges::find(problem.tasks, run.task, &MetInTask::task) != problem.tasks.end())
      met_the_task.insert(run.participant);
  return std::max(met_the_task.empty() ? participants : met_the_task.size(), problem.met_by);
}

/// The worst that each rater gave each problem, evidence and sheets alike.
using WorstByRater = std::map<std::string, std::map<std::string, int>>;
WorstByRater worstByRater(const StudyInput& input) {
  WorstByRater worst;
  const auto add = [&](const std::string& problem, const std::string& rater, const std::optional<int>& severity) {
    if (!severity) return;
    int& kept = worst[lastOf(input.merged, problem)].try_emplace(rater, *severity).first->second;
    kept = std::max(kept, *severity);
  };
  for (const ProblemSeen& one : input.problems) add(one.problem, one.rater, one.severity);
  for (const Rating& one : input.ratings) add(one.problem, one.rater, one.severity);
  return worst;
}

/// Two raters see each other only after both have rated.
std::vector<std::string> awaitedRaters(const std::vector<Rating>& ratings) {
  std::set<std::string> awaited;
  for (const Rating& one : ratings)
    if (!one.severity) awaited.insert(one.rater);
  return {awaited.begin(), awaited.end()};
}

void addOnce(std::vector<std::string>& list, const std::string& one) {
  if (!one.empty() && std::ranges::find(list, one) == list.end()) list.push_back(one);
}

std::vector<ProblemRow> problemRows(const StudyInput& input, std::size_t participants, const WorstByRater& rated) {
  std::vector<ProblemRow> rows;
  std::map<std::string, std::map<std::string, std::set<std::string>>> met_in;  // problem, task: participants
  for (const ProblemSeen& one : input.problems) {
    const std::string problem = lastOf(input.merged, one.problem);
    auto row = std::ranges::find(rows, problem, &ProblemRow::problem);
    if (row == rows.end()) {
      row = rows.insert(rows.end(), ProblemRow());
      row->problem = problem, row->title = one.title;
    }
    if (one.problem == problem)
      row->title = one.title;
    else
      addOnce(row->also, one.problem);
    addOnce(row->participants, one.participant);
    addOnce(row->moments, one.moment);
    if (!one.task.empty()) met_in[problem][one.task].insert(one.participant);
  }
  for (ProblemRow& row : rows) {
    for (const auto& [task, people] : met_in[row.problem]) row.tasks.push_back({task, people.size()});
    std::ranges::sort(row.participants);
    row.met_by = row.participants.size();
    row.could_meet = couldMeet(row, input, participants);
    row.share = shareInterval(row.met_by, row.could_meet);
    std::vector<double> severities;
    if (const auto found = rated.find(row.problem); found != rated.end())
      for (const auto& [rater, severity] : found->second) severities.push_back(severity);
    row.severity = summaryOf(severities).median;
    row.weight = row.severity.value_or(1.0) * static_cast<double>(row.met_by) / static_cast<double>(row.could_meet);
  }
  std::ranges::stable_sort(rows, std::greater(), &ProblemRow::weight);
  return rows;
}

SeverityAgreement agreementOf(const WorstByRater& rated) {
  std::set<std::string> raters;
  for (const auto& [problem, by_rater] : rated)
    for (const auto& [rater, severity] : by_rater)
      if (!rater.empty()) raters.insert(rater);
  SeverityAgreement found;
  found.raters = raters.size();
  if (raters.size() < 2) return found;
  Ratings ratings;
  for (const std::string& rater : raters) {
    std::vector<std::optional<int>>& row = ratings.emplace_back();
    for (const auto& [problem, by_rater] : rated) {
      const auto one = by_rater.find(rater);
      row.push_back(one == by_rater.end() ? std::nullopt : std::optional(one->second));
    }
  }
  found.nominal = krippendorffAlpha(ratings, RatingScale::nominal);
  found.ordinal = krippendorffAlpha(ratings, RatingScale::ordinal);
  found.interval = krippendorffAlpha(ratings, RatingScale::interval);
  if (found.ordinal) found.ordinal_interval = alphaInterval(ratings, RatingScale::ordinal, SeverityAgreement::kSeed);
  found.intraclass = intraclassCorrelation(ratings);
  return found;
}

}  // namespace

StudyResult studyResult(const StudyInput& given) {
  StudyInput input = given;
  for (const ProblemSeen& one : given.problems)
    if (!one.merged_into.empty()) input.merged.try_emplace(one.problem, one.merged_into);
  StudyResult result;
  std::set<std::string> participants;
  for (const AnswerSheet& sheet : input.answers) participants.insert(sheet.participant);
  for (const TaskRun& run : input.tasks) participants.insert(run.participant);
  for (const ProblemSeen& one : input.problems) participants.insert(one.participant);
  result.participants = std::max(participants.size(), input.participants);
  if (input.questionnaire) {
    result.title = input.questionnaire->title, result.source = input.questionnaire->source;
    result.published_note = input.questionnaire->published_note;
    AnswerTables(*input.questionnaire, input.answers, result).fill();
  }
  result.tasks = taskRows(input.tasks);
  result.awaited = awaitedRaters(input.ratings);
  const WorstByRater rated = result.awaited.empty() ? worstByRater(input) : WorstByRater();
  result.problems = problemRows(input, result.participants, rated);
  std::vector<std::size_t> met_by;
  for (const ProblemRow& row : result.problems) met_by.push_back(row.met_by);
  result.discovery = discoveryOf(met_by, result.participants);
  result.agreement = agreementOf(rated);
  return result;
}

}  // namespace app
