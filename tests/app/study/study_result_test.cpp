#include "app/study/study_result.h"

#include <algorithm>
#include <clocale>
#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/study/study_export.h"
#include "app/study/study_page.h"
#include "assets/load_error.h"
#include "tests/refusal.h"

namespace app {
namespace {

/// Ten whole answers from 1 to 7 with this printed mean and deviation; empty: there are none.
std::vector<int> tenAnswers(double mean, double deviation) {
  const int sum = static_cast<int>(std::lround(10.0 * mean));
  std::vector<int> answers(10, 1);
  std::vector<int> found;
  const auto matches = [&](const std::vector<int>& some) {
    double squares = 0.0;
    for (const int a : some) squares += (a - mean) * (a - mean);
    return std::abs(std::round(100.0 * std::sqrt(squares / 9.0)) / 100.0 - deviation) < 1e-9;
  };
  const auto fill = [&](const auto& self, std::size_t at, int least, int left) -> void {
    if (!found.empty()) return;
    if (at == 10) {
      if (left == 0 && matches(answers)) found = answers;
      return;
    }
    const int more = static_cast<int>(9 - at);
    for (int answer = least; answer <= 7 && answer + more * answer <= left; ++answer) {
      if (left - answer > 7 * more) continue;
      answers[at] = answer;
      self(self, at + 1, answer, left - answer);
    }
  };
  fill(fill, 0, 1, sum);
  return found;
}

StudyResult resultOf(const std::string& questionnaire, const std::string& csv) {
  StudyInput input;
  input.questionnaire = questionnaireNamed(questionnaire);
  input.answers = answersFrom(csvTableFrom(csv, "answers.csv"), *input.questionnaire);
  return studyResult(input);
}

const AnswerRow& rowNamed(const std::vector<AnswerRow>& rows, const std::string& id, const std::string& group = "all") {
  return *std::ranges::find_if(rows, [&](const AnswerRow& row) { return row.id == id && row.group == group; });
}

// The published table of ten dentists, as far as whole answers can have its means and deviations.
TEST(StudyResult, GivesThePublishedTableOfTenDentists) {
  struct Published {
    const char *item, *mean, *deviation;
  };
  const std::vector<Published> table{{"VT1", "4.80", "1.32"}, {"VT2", "5.20", "0.92"}, {"VI1", "5.30", "0.82"},
                                     {"VI2", "5.20", "0.63"}, {"VI3", "5.10", "0.88"}, {"VI4", "5.10", "0.74"},
                                     {"HI1", "4.80", "1.14"}, {"HI3", "4.70", "1.06"}, {"U3", "5.60", "0.52"},
                                     {"E1", "4.40", "1.07"},  {"E2", "4.60", "0.84"},  {"E3", "4.90", "0.99"}};
  std::vector<std::vector<int>> answers;
  std::string csv = "participant";
  for (const Published& one : table) {
    answers.push_back(tenAnswers(std::stod(one.mean), std::stod(one.deviation)));
    ASSERT_FALSE(answers.back().empty()) << one.item;
    csv += std::string(",") + one.item;
  }
  for (std::size_t n = 0; n < 10; ++n) {
    csv += "\nP" + std::to_string(n + 1);
    for (const std::vector<int>& item : answers) csv += "," + std::to_string(item[n]);
  }
  const StudyResult result = resultOf("gajananan", csv + "\n");
  const std::string page = studyPage(result);
  for (const Published& one : table) {
    const AnswerRow& row = rowNamed(result.items, one.item);
    EXPECT_EQ(row.summary.count, 10u);
    // Ours, and in grey what was printed.
    const std::string cells = "<td>" + row.says + "</td><td>10</td><td>" + one.mean + "</td><td>" + one.deviation +
                              "</td><td><span class=\"quiet\">10:\u00a0" + one.mean + "\u00a0±\u00a0" + one.deviation +
                              "</span></td>";
    EXPECT_NE(page.find(cells), std::string::npos) << cells;
  }
  EXPECT_NE(page.find("10:\u00a04.40\u00a0±\u00a01.32†"), std::string::npos);
  EXPECT_NE(page.find("† No 10 whole answers on this scale"), std::string::npos);
  EXPECT_NE(page.find("repeat those of the tooth model"), std::string::npos);
  const auto json = nlohmann::json::parse(studyJson(result))["items"];
  std::vector<std::string> impossible;
  for (const auto& item : json)
    if (!item["published"]["possible"]) impossible.push_back(item["id"]);
  EXPECT_EQ(impossible, (std::vector<std::string>{"HT1", "HT2", "HT3", "U1", "U2"}));
  // What no ten whole answers can have.
  EXPECT_TRUE(tenAnswers(4.8, 0.84).empty());
  EXPECT_EQ(rowNamed(result.items, "VT3").summary.count, 0u) << "a column that is not there";
}

// Every list of answers, counted out.
TEST(PublishedSummary, IsPossibleWhereSomeAnswersHaveIt) {
  for (int mean_hundredths = 100; mean_hundredths <= 400; mean_hundredths += 5)
    for (int deviation_hundredths = 0; deviation_hundredths <= 180; deviation_hundredths += 3) {
      const double mean = mean_hundredths / 100.0, deviation = deviation_hundredths / 100.0;
      bool is_found = false;
      for (int code = 0; code < 4 * 4 * 4 * 4 * 4 && !is_found; ++code) {
        double sum = 0.0, squares = 0.0;
        for (int n = 0, left = code; n < 5; ++n, left /= 4)
          sum += 1 + left % 4, squares += (1 + left % 4) * (1 + left % 4);
        is_found = std::abs(sum / 5.0 - mean) < 0.005 + 1e-9 &&
                   std::abs(std::sqrt((squares - sum * sum / 5.0) / 4.0) - deviation) < 0.005 + 1e-9;
      }
      EXPECT_EQ(canBeAnswered({5, mean, deviation}, 1, 4), is_found) << mean << " " << deviation;
    }
}

TEST(PublishedSummary, WhatWasNotLegibleIsNotAskedFor) {
  EXPECT_TRUE(canBeAnswered({10, {}, 0.84}, 1, 7));
  EXPECT_FALSE(canBeAnswered({10, 4.8, 0.84}, 1, 7));
  EXPECT_TRUE(canBeAnswered({10, 4.8, {}}, 1, 7));
  EXPECT_FALSE(canBeAnswered({10, 4.85, {}}, 1, 7));
  EXPECT_FALSE(canBeAnswered({10, {}, 0.72}, 1, 7)) << "of no ten answers at all";
}

TEST(StudyResult, MissingAnswersLowerTheNumberOfTheirItem) {
  const StudyResult result = resultOf("vhu-7", "participant,group,V1,V2\nP1,a,7,1\nP2,a,,3\nP3,b,5,5\n");
  EXPECT_EQ(result.participants, 3u);
  const AnswerRow& v1 = rowNamed(result.items, "V1");
  EXPECT_EQ(v1.summary.count, 2u);
  EXPECT_EQ(v1.missing, 1u);
  EXPECT_EQ(*v1.summary.mean, 6.0);
  EXPECT_EQ(*rowNamed(result.items, "V2", "a").summary.mean, 2.0);
  // A participant's mean of what was answered.
  EXPECT_EQ(rowNamed(result.categories, "Realism of visual display").values, (std::vector<double>{3.0, 4.0, 5.0}));
  EXPECT_TRUE(result.differences.empty()) << "too few to compare";
  const std::string page = studyPage(result);
  EXPECT_NE(page.find("<td>5, 7</td>"), std::string::npos) << "answers instead of a deviation";
  EXPECT_TRUE(nlohmann::json::parse(studyJson(result))["items"][0]["sd"].is_null());
}

TEST(StudyResult, ComparesTwoGroupsAndTwoSessions) {
  std::string groups = "participant,group,V1\n", sessions = "participant,session,V1\n";
  for (int n = 1; n <= 6; ++n) {
    groups += "P" + std::to_string(n) + ",student," + std::to_string(1 + n % 3) + "\n";
    groups += "P" + std::to_string(n + 6) + ",surgeon," + std::to_string(5 + n % 3) + "\n";
    sessions += "P" + std::to_string(n) + ",1," + std::to_string(1 + n % 3) + "\n";
    sessions += "P" + std::to_string(n) + ",2," + std::to_string(3 + n % 3) + "\n";
  }
  const StudyResult of_groups = resultOf("vhu-7", groups);
  ASSERT_EQ(of_groups.differences.size(), 2u) << "the item, and its category";
  const Difference& apart = of_groups.differences.front();
  EXPECT_EQ(apart.words(), "surgeon against student");
  EXPECT_EQ(apart.test.shift, 4.0);
  EXPECT_NEAR(apart.test.p, 2.0 / 924.0, 1e-12) << "all of six above all of six: 2 of 12 over 6";
  EXPECT_NEAR(apart.holm_p, 4.0 / 924.0, 1e-12);
  const StudyResult of_sessions = resultOf("vhu-7", sessions);
  EXPECT_EQ(of_sessions.participants, 6u);
  ASSERT_EQ(of_sessions.differences.size(), 2u);
  EXPECT_TRUE(of_sessions.differences.front().is_paired);
  EXPECT_EQ(of_sessions.differences.front().test.shift, 2.0);
  EXPECT_NEAR(of_sessions.differences.front().test.p, 2.0 / 64.0, 1e-12);
}

TEST(StudyResult, TheWeightedLoadIndexHasWeightsAndAScore) {
  std::string heads = "participant", first = "P1", second = "P2";
  for (const QuestionItem& item : questionnaireNamed("tlx-weighted").items) {
    heads += "," + item.id;
    first += item.choices.empty() ? ",30" : ",1", second += item.choices.empty() ? ",50" : ",2";
  }
  const StudyResult result = resultOf("tlx-weighted", heads + "\n" + first + "\n" + second + "\n");
  ASSERT_EQ(result.items.size(), 12u) << "six scales and their weights; comparisons alone say nothing";
  EXPECT_EQ(result.items[6].id, "mental.weight");
  EXPECT_EQ(result.items[6].values, (std::vector<double>{0, 5}));
  ASSERT_EQ(result.scores.size(), 1u);
  EXPECT_NEAR(*result.scores[0].summary.mean, 40.0, 1e-12) << "equal ratings have the same index whatever the weights";
}

TEST(StudyResult, TasksAndProblemsByHowBadAndHowCommon) {
  StudyInput input;
  input.tasks =
      tasksFrom(csvTableFrom("participant,task,result,time_s,helps\nP1,trough,success,100,1\nP2,trough,success,"
                             "400,0\nP3,trough,failed,90,2\nP4,trough,partly,,0\nP1,split,success,30,0\n",
                             "tasks.csv"));
  input.problems = problemsFrom(csvTableFrom(
      "problem,title,participant,task,rater,severity,moment\n1,Small but common,P1,trough,E1,1,\n1,Small but "
      "common,P2,trough,E1,1,\n1,Small but common,P3,trough,E2,2,S2 1:00\n2,Rare and grave,P4,trough,E1,4,\n2,Rare and "
      "grave,P4,trough,E2,4,\n3,Of one task,P1,split,E1,3,\n",
      "problems.csv"));
  const StudyResult result = studyResult(input);
  EXPECT_EQ(result.participants, 4u);
  const TaskRow& trough = result.tasks.front();
  EXPECT_EQ(trough.success, 2u);
  EXPECT_EQ(trough.helps, 3);
  EXPECT_NEAR(*trough.time_s, 200.0, 1e-9) << "of those who succeeded";
  ASSERT_EQ(result.problems.size(), 3u);
  EXPECT_EQ(result.problems[0].title, "Of one task") << "severity 3, the one who did the task";
  EXPECT_EQ(result.problems[0].could_meet, 1u);
  EXPECT_EQ(result.problems[1].title, "Small but common");
  EXPECT_EQ(*result.problems[1].severity, 1.5);
  EXPECT_NEAR(result.problems[1].weight, 1.5 * 0.75, 1e-12);
  EXPECT_NEAR(result.problems[2].weight, 1.0, 1e-12);
  ASSERT_TRUE(result.agreement.ordinal);
  ASSERT_TRUE(result.discovery);
  input.participants = 9;
  EXPECT_EQ(studyResult(input).participants, 9u);
  EXPECT_LT(studyResult(input).discovery->chance, result.discovery->chance);
}

/// Nobody, one, all alike, all missing, in one group and in two, in one session and in two.
TEST(StudyResult, OfTooLittleItSaysSoAndNeverNoNumber) {
  for (const std::string& name : shippedQuestionnaires()) {
    const Questionnaire questionnaire = questionnaireNamed(name);
    for (const char* answer : {"", "1"})
      for (const int people : {0, 1, 2, 6, 12})
        for (const bool has_groups : {false, true})
          for (const bool has_sessions : {false, true}) {
            std::string csv = "participant,group,session";
            for (const QuestionItem& item : questionnaire.items) csv += "," + item.id;
            csv += "\n";
            for (int n = 0; n < people; ++n)
              for (int session = 1; session <= (has_sessions ? 2 : 1); ++session) {
                csv += "P" + std::to_string(n) + "," + (has_groups && n % 2 == 0 ? "a" : "b") + "," +
                       (has_sessions ? std::to_string(session) : "");
                for (std::size_t item = 0; item < questionnaire.items.size(); ++item) csv += std::string(",") + answer;
                csv += "\n";
              }
            const StudyResult result = resultOf(name, csv);
            const std::string page = studyPage(result), json = studyJson(result),
                              all = page + json + studyCsv(result) + studyLines(result);
            for (const char* word : {"nan", "NaN", "inf,", ": inf", "Infinity"})
              EXPECT_EQ(all.find(word), std::string::npos) << name << " " << answer << people << word;
            EXPECT_FALSE(nlohmann::json::parse(json).is_discarded());
            if (people > 0 && *answer == '\0' && !questionnaire.isOfWords()) {
              EXPECT_NE(page.find("no answer"), std::string::npos);
            }
            if (has_sessions && people > 0 && !questionnaire.isOfWords()) {
              EXPECT_NE(page.find("Nothing is compared"), std::string::npos) << "no pair differs";
            }
          }
  }
}

TEST(StudyData, RefusesWithFileLineAndColumn) {
  const Questionnaire questionnaire = questionnaireNamed("vhu-7");
  const auto answers = [&](const std::string& csv) {
    return tests::refusalOf<assets::LoadError>([&] { answersFrom(csvTableFrom(csv, "A"), questionnaire); });
  };
  EXPECT_EQ(answers("participant,V1\nP1,8\n"), "A line 2, V1: \"8\" is no number from 1 to 7");
  EXPECT_EQ(answers("participant,V1\nP1,nan\n"), "A line 2, V1: \"nan\" is no number from 1 to 7");
  EXPECT_EQ(answers("participant,V1\nP1,\"3,5\"\n"), "A line 2, V1: \"3,5\" is no number from 1 to 7");
  EXPECT_EQ(answers("participant,V1\nAnna Smith,3\n"), "A line 2, participant: give a code as P07, never a name");
  EXPECT_NE(answers("participant,V1\nP1,3\nP1,4\n").find("A line 3, participant"), std::string::npos);
  EXPECT_NE(answers("participant,group,session,V1\nP1,a,1,3\nP1,b,2,4\n").find("A line 3, group"), std::string::npos);
  EXPECT_EQ(answers("participant,session,V1\nP1,1,3\nP2,,4\n"),
            "A line 3, session: name the session in every row, or in none");
  EXPECT_NE(answers("participant,V99\nP1,3\n").find("column \"V99\" is not known"), std::string::npos);
  EXPECT_NE(answers("participant,group\nP1,a\n").find("no column is an item"), std::string::npos);
  EXPECT_NE(answers("V1\n3\n").find("there is no column \"participant\""), std::string::npos);
  const auto tasks = [&](const std::string& csv) {
    return tests::refusalOf<assets::LoadError>([&] { tasksFrom(csvTableFrom(csv, "T")); });
  };
  EXPECT_EQ(tasks("participant,task,result\nP1,trough,ok\n"), "T line 2, result: give one of success, partly, failed");
  EXPECT_EQ(tasks("participant,task,result,time_s\nP1,a,failed,0\n"), "T line 2, time_s: a task takes longer than 0 s");
  EXPECT_EQ(tasks("participant,task,result,helps\nP1,a,failed,1.5\n"), "T line 2, helps: give a whole number");
  const auto problems = [&](const std::string& csv) {
    return tests::refusalOf<assets::LoadError>([&] { problemsFrom(csvTableFrom(csv, "P")); });
  };
  EXPECT_EQ(problems("problem,title,participant,rater\n1,x,P1,Bob\n"),
            "P line 2, rater: give a code as E1, never a name");
  EXPECT_NE(problems("problem,title,participant,severity\n1,x,P1,5\n").find("from 0 to 4"), std::string::npos);
  EXPECT_NE(problems("problem,title,participant\n1,x,P1\n1,y,P2\n").find("another title"), std::string::npos);
}

TEST(StudyData, BlankTablesAreReadAsTheyAre) {
  for (const std::string& name : shippedQuestionnaires()) {
    const Questionnaire questionnaire = questionnaireNamed(name);
    EXPECT_EQ(answersFrom(csvTableFrom(blankAnswers(questionnaire), "A"), questionnaire).size(), 1u);
    EXPECT_NE(questionnaireSheet(questionnaire).find(questionnaire.items.back().says.substr(0, 12)), std::string::npos);
  }
  EXPECT_EQ(tasksFrom(csvTableFrom(blankTasks(), "T")).size(), 1u);
  EXPECT_EQ(problemsFrom(csvTableFrom(blankProblems(), "P")).size(), 1u);
}

TEST(StudyExport, IsTheSameInEveryLocaleAndWithNothingInIt) {
  const auto whole = [] {
    const StudyResult result = resultOf("tlx-raw",
                                        "participant,mental,physical,temporal,performance,effort,frustration\n"
                                        "P1,10.5,20,30,40,50,60\n");
    return studyCsv(result) + studyJson(result) + studyPage(result) + studyLines(result);
  };
  const std::string plain = whole();
  EXPECT_NE(plain.find("score,tlx-raw,all,,mean,35.08333"), std::string::npos) << plain.substr(0, 1500);
  for (const char* locale : {"de_DE.UTF-8", "sv_SE.UTF-8"})
    if (std::setlocale(LC_ALL, locale) != nullptr) {
      EXPECT_EQ(whole(), plain);
    }
  std::setlocale(LC_ALL, "C");
  const StudyResult nothing = studyResult({});
  EXPECT_EQ(studyLines(nothing), "0 participants\n");
  EXPECT_EQ(nlohmann::json::parse(studyJson(nothing))["participants"], 0);
  EXPECT_EQ((studyPage(nothing) + studyCsv(nothing)).find("nan"), std::string::npos);
}

TEST(StudyPage, ListsAnswersInWords) {
  const StudyResult result = resultOf("debrief-5", "participant,D1,D2\nP1,The feel,\"<b>Noise</b>\"\nP2,,\n");
  EXPECT_EQ(result.said.size(), 2u);
  EXPECT_NE(studyPage(result).find("&lt;b&gt;Noise"), std::string::npos);
}

}  // namespace
}  // namespace app
