#include "app/study/study_folder.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "app/study/session_log.h"
#include "app/text/usage_error.h"
#include "assets/load_error.h"
#include "tests/refusal.h"
#include "tests/scratch_folder.h"

namespace app {
namespace {

class StudyFolderTest : public testing::Test {
 protected:
  void session(const std::string& name, bool closed, const std::string& tasks = "", const std::string& answers = "") {
    const std::filesystem::path place = study_.file(name);
    std::filesystem::create_directory(place);
    SessionLogWriter log((place / kSessionLogName).string());
    log.add({1, {}, "system", "session.start", {}});
    if (closed) log.add({2, {}, "system", "session.stop", {}});
    if (!tasks.empty()) std::ofstream(place / "tasks.csv") << "participant,task,result,time_s,helps\n" << tasks;
    if (!answers.empty()) std::ofstream(place / "answers-sus.csv") << "participant,group,session,S1\n" << answers;
  }
  std::string path() const { return study_.file("."); }

  tests::ScratchFolder study_;
};

TEST_F(StudyFolderTest, NamesTheNextSession) {
  EXPECT_EQ(nextSession({}, "P07").folder, "P07-1");
  session("P07-1", true), session("P08-1", false), session("P-09-1", false), session("notes", true);
  const auto sessions = sessionsIn(path());
  ASSERT_EQ(sessions.size(), 3u);
  EXPECT_EQ(nextSession(sessions, "P07").folder, "P07-2");
  EXPECT_EQ(nextSession(sessions, "P08").folder, "P08-1-2");
  EXPECT_EQ(nextSession(sessions, "P-09").folder, "P-09-1-2");
  EXPECT_EQ(nextSession(sessions, "P01").folder, "P01-1");
}

TEST_F(StudyFolderTest, CountsTheLastAttemptAndTellsOfTheInterruptedOnes) {
  session("P01-1", false, "P01,cut,failed,3,0\n", "P01,,1,1\n");
  session("P01-1-2", true, "P01,cut,success,9,0\n", "P01,,1,4\n");
  session("P02-1", false, "P02,cut,partly,5,1\n");
  session("P01-2", true, "P01,cut,success,7,0\n", "P01,,2,5\n");
  const StudyFolder folder = readStudyFolder(path(), "");
  ASSERT_EQ(folder.input.tasks.size(), 3u);
  EXPECT_EQ(folder.input.tasks[0].time_s, 9.0);
  EXPECT_EQ(folder.input.tasks[1].task, "cut (session 2)") << "sessions are never pooled";
  ASSERT_EQ(folder.input.answers.size(), 2u);
  EXPECT_EQ(folder.input.answers[0].values[0], 4.0);
  EXPECT_EQ(folder.input.participants, 2u);
  ASSERT_EQ(folder.remarks.size(), 2u);
  EXPECT_EQ(folder.remarks[0], "P01-1 was interrupted, or goes on; it was begun anew and does not count");
  EXPECT_EQ(folder.remarks[1], "P02-1 was interrupted, or goes on: what it holds so far counts");
}

TEST_F(StudyFolderTest, RefusesWithTheTableItself) {
  session("P01-1", true, "P01,cut,success,9,0\n");
  session("P02-1", true, "P02,cut,success,9,0\nP02,turn,so so,9,0\n");
  const std::string refusal = tests::refusalOf<assets::LoadError>([&] { readStudyFolder(path(), ""); });
  EXPECT_NE(refusal.find("P02-1/tasks.csv line 3, result"), std::string::npos) << refusal;
  EXPECT_NE(tests::refusalOf<assets::LoadError>([&] { readStudyFolder(study_.file("none"), ""); }), "accepted");
  const tests::ScratchFolder empty;
  EXPECT_NE(tests::refusalOf<assets::LoadError>([&] { readStudyFolder(empty.file("."), ""); }), "accepted");
}

TEST_F(StudyFolderTest, RefusesAQuestionnaireThatNobodyAnswered) {
  session("P01-1", true, "", "P01,,1,1\n");
  EXPECT_NE(tests::refusalOf<UsageError>([&] { readStudyFolder(path(), "vhu-7"); }).find("give one of sus"),
            std::string::npos);
}

}  // namespace
}  // namespace app
