// `molar study`: what a cooperative evaluation found, from its folder, or from tables of answers, tasks and problems.

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include <fmt/core.h>

#include "app/commands/command.h"
#include "app/commands/study_key.h"
#include "app/commands/study_owner.h"
#include "app/study/questionnaire.h"
#include "app/study/study_data.h"
#include "app/study/study_export.h"
#include "app/study/study_folder.h"
#include "app/study/study_page.h"
#include "app/study/study_result.h"
#include "app/text/command_line.h"
#include "app/text/message.h"
#include "app/text/usage_error.h"
#include "calibration/output_file.h"

namespace app {
namespace {

struct StudyOptions {
  std::string folder, questionnaire, answers, tasks, problems, html, csv, json, blank, sheet;
  int participants = 0;
  StudyKeyOption key;
  bool force = false;
};

int listQuestionnaires() {
  for (const std::string& name : shippedQuestionnaires()) {
    const Questionnaire questionnaire = questionnaireNamed(name);
    std::printf("%-12s  %2zu items  %s\n", name.c_str(), questionnaire.items.size(), questionnaire.title.c_str());
  }
  std::printf(
      "\nmolar study --questionnaire %s --sheet SHEET.html   to print\n"
      "molar study --questionnaire %s --blank answers.csv  to type answers into\n",
      shippedQuestionnaires().front().c_str(), shippedQuestionnaires().front().c_str());
  return 0;
}

void writeStudyFile(const std::string& option, const std::string& file, const std::string& ending, bool force,
                    const std::string& text) {
  if (file.empty()) return;
  if (!file.ends_with(ending)) throw UsageError(option + " " + file + ": name it " + ending);
  calibration::OutputFile out(file, force);
  out.commit(text);
}

/// A table to type into, by what its name says.
std::string blankTable(const StudyOptions& options) {
  const std::string name = std::filesystem::path(options.blank).filename().string();
  if (name.starts_with("tasks")) return blankTasks();
  if (name.starts_with("problems")) return blankProblems();
  if (!name.starts_with("answers"))
    throw UsageError("--blank " + options.blank + ": begin the file's name with answers, tasks or problems");
  if (options.questionnaire.empty()) throw UsageError("--blank " + options.blank + ": to which --questionnaire?");
  return blankAnswers(questionnaireNamed(options.questionnaire));
}

/// Of the folder, where one is named; a table that is named replaces the folder's.
StudyInput inputOf(const StudyOptions& options) {
  StudyInput input;
  if (!options.folder.empty()) {
    const auto owner = options.key.openedFor(options.folder);
    StudyFolder folder = readStudyFolder(options.folder, options.answers.empty() ? options.questionnaire : "",
                                         owner ? &*owner : nullptr);
    for (const std::string& remark : folder.remarks) printMessage(remark);
    input = std::move(folder.input);
  }
  if (!options.answers.empty()) {
    if (options.questionnaire.empty()) throw UsageError("--answers " + options.answers + ": to which --questionnaire?");
    input.questionnaire = questionnaireNamed(options.questionnaire);
    input.answers = answersFrom(csvTableOf(options.answers), *input.questionnaire);
  }
  if (!options.tasks.empty()) input.tasks = tasksFrom(csvTableOf(options.tasks));
  if (!options.problems.empty()) input.problems = problemsFrom(csvTableOf(options.problems));
  input.participants = std::max(input.participants, static_cast<std::size_t>(options.participants));
  return input;
}

int runStudy(const StudyOptions& options) {
  const bool has_tables =
      !options.folder.empty() || !options.answers.empty() || !options.tasks.empty() || !options.problems.empty();
  if (!options.sheet.empty()) {
    if (options.questionnaire.empty()) throw UsageError("--sheet " + options.sheet + ": of which --questionnaire?");
    writeStudyFile("--sheet", options.sheet, ".html", options.force,
                   questionnaireSheet(questionnaireNamed(options.questionnaire)));
  }
  if (!options.blank.empty()) writeStudyFile("--blank", options.blank, ".csv", options.force, blankTable(options));
  if (!has_tables) {
    if (!options.sheet.empty() || !options.blank.empty()) return 0;
    if (!options.questionnaire.empty()) {
      const std::string text = shippedQuestionnaireText(options.questionnaire);
      if (text.empty()) questionnaireNamed(options.questionnaire);  // says what is wrong with it
      std::fputs(text.c_str(), stdout);
      return 0;
    }
    if (!options.html.empty() || !options.csv.empty() || !options.json.empty())
      throw UsageError("study: of what, give STUDY, --answers, --tasks or --problems");
    return listQuestionnaires();
  }
  const StudyResult result = studyResult(inputOf(options));
  writeStudyFile("--html", options.html, ".html", options.force, studyPage(result));
  writeStudyFile("--csv", options.csv, ".csv", options.force, studyCsv(result));
  if (options.json == "-")
    std::fputs(studyJson(result).c_str(), stdout);
  else
    writeStudyFile("--json", options.json, ".json", options.force, studyJson(result));
  if (options.json != "-") std::fputs(studyLines(result).c_str(), stdout);
  return 0;
}

}  // namespace

void addStudy(CommandLine& molar) {
  auto options = std::make_shared<StudyOptions>();
  CommandLine& command = molar.command("study", "What an evaluation found: answers, tasks, problems, as tables");
  command.option(
      "STUDY", options->folder,
      "Folder that molar evaluate filled: its tasks, problems and answers; a table named below replaces its");
  command
      .option("--questionnaire", options->questionnaire,
              "Shipped, see molar study, or your own FILE.toml; alone: its file is printed, to be copied and edited")
      .valueNamed("NAME");
  command.option("--answers", options->answers, "Table: participant, group, session, and a column for each item")
      .valueNamed("FILE.csv");
  command.option("--tasks", options->tasks, "Table: participant, task, result, time_s, helps").valueNamed("FILE.csv");
  command
      .option("--problems", options->problems,
              "Table: problem, title, participant, task, rater, severity (0 to 4), moment; a row for each time that a "
              "participant met it")
      .valueNamed("FILE.csv");
  command.option("--participants", options->participants, "How many took part, if some are in no table")
      .wholeFrom(0, 10'000);
  command.option("--html", options->html, "Page to write").valueNamed("FILE.html");
  command.option("--csv", options->csv, "All numbers as one long table").valueNamed("FILE.csv");
  command.option("--json", options->json, "All numbers; - : on the terminal").valueNamed("FILE.json");
  command.option("--blank", options->blank, "Writes a table to type into: answers….csv, tasks….csv or problems….csv")
      .valueNamed("FILE.csv");
  command.option("--sheet", options->sheet, "Writes the questionnaire to be printed and filled in by hand")
      .valueNamed("FILE.html");
  options->key.addTo(command, "Private key of the study: opens words and answers that are sealed (molar study keys)");
  command.flag("--force", options->force, "Replace outputs that exist");
  command.footer(
      "Participants and raters are codes, P07 or E1, never names. Without options: the shipped questionnaires. Below "
      "five answers there is no standard deviation; two groups, or two sessions of the same participants, are compared "
      "by exact rank tests.");
  command.does([options] { return runStudy(*options); });
  addStudyOwnerCommands(command);
}

}  // namespace app
