// What people said and did in a study, from tables that a spreadsheet writes: answers to a questionnaire, tasks, and
// problems that were seen. People are codes. Every wrong cell is refused with file, line, and column. Any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/study/csv.h"
#include "app/study/questionnaire.h"

namespace app {

/// One participant's sheet.
struct AnswerSheet {
  std::string participant, group, session;    ///< group and session: empty where there is no such column
  std::vector<std::optional<double>> values;  ///< one an item; none: not answered
  std::vector<std::string> words;             ///< the same of a questionnaire of words; empty: not answered
};

enum class TaskResult { success, partly, failed };

struct TaskRun {
  std::string participant, task;
  TaskResult result = TaskResult::success;
  std::optional<double> time_s;
  int helps = 0;
};

/// A problem that one participant met, as one rater judges it.
struct ProblemSeen {
  std::string problem, title, participant, task, rater;
  std::optional<int> severity;  ///< 0 none, 1 cosmetic, 2 minor, 3 major, 4 catastrophe
  std::string moment;           ///< session and time, for the link
  std::string merged_into;      ///< the problem that it is; empty: itself
};

/// Columns: participant, [group], [session], and any of the items; empty: not answered. Throws LoadError.
std::vector<AnswerSheet> answersFrom(const CsvTable& table, const Questionnaire& questionnaire);
/// Columns: participant, task, result (success, partly, failed), [time_s], [helps].
std::vector<TaskRun> tasksFrom(const CsvTable& table);
/// Columns: problem, title, participant, [task], [rater], [severity], [moment], [merged_into].
std::vector<ProblemSeen> problemsFrom(const CsvTable& table);

/// The heads of such a table, with a line to write over.
std::string blankAnswers(const Questionnaire& questionnaire);
std::string blankTasks();
std::string blankProblems();

}  // namespace app
