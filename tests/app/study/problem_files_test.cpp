#include "app/study/problem_files.h"

#include <fstream>

#include <gtest/gtest.h>

#include "app/study/study_page.h"
#include "app/study/study_result.h"
#include "app/text/usage_error.h"
#include "assets/load_error.h"
#include "tests/mutants.h"
#include "tests/refusal.h"
#include "tests/scratch_folder.h"

namespace app {
namespace {

class ProblemFiles : public testing::Test {
 protected:
  StudyResult result() const {
    StudyInput input;
    input.problems = problemsFrom(csvTableFrom(
        "problem,title,participant,task,rater,severity\npedal,The pedal is not found,P1,open,E1,3\npedal,The pedal is "
        "not found,P2,open,E1,2\nfoot,It does not start,P3,widen,E1,4\ndepth,No depth is seen,P1,open,E1,1\n",
        "P"));
    input.participants = 4;
    input.merged = mergedIn(study_);
    input.ratings = ratingsIn(study_);
    return studyResult(input);
  }
  void put(const std::string& name, const std::string& text) const { std::ofstream(folder_.file(name)) << text; }

  const tests::ScratchFolder folder_;
  const std::string study_ = folder_.file("");
};

TEST_F(ProblemFiles, MergedCountsOnceAndComesApartAgain) {
  ASSERT_EQ(result().problems.size(), 3u);
  mergeProblem(study_, "foot", "pedal");
  const StudyResult merged = result();
  ASSERT_EQ(merged.problems.size(), 2u);
  const ProblemRow& pedal = merged.problems.front();
  EXPECT_EQ(pedal.title, "The pedal is not found");
  EXPECT_EQ(pedal.met_by, 3u);
  EXPECT_EQ(pedal.participants, (std::vector<std::string>{"P1", "P2", "P3"}));
  EXPECT_EQ(pedal.also, std::vector<std::string>{"foot"});
  EXPECT_EQ(*pedal.severity, 4.0) << "the worst that the rater saw";
  ASSERT_EQ(pedal.tasks.size(), 2u);
  EXPECT_EQ(pedal.tasks[0].task, "open");
  EXPECT_EQ(pedal.tasks[0].met_by, 2u);
  EXPECT_EQ(pedal.tasks[1].met_by, 1u);
  // Adjusted Wald of 3 in 4: (3 + 1.92) / (4 + 3.84) = 0.628, half 0.338.
  EXPECT_NEAR(pedal.share->low, 0.2892, 1e-3);
  EXPECT_NEAR(pedal.share->high, 0.9664, 1e-3);
  EXPECT_NE(studyPage(merged).find("(also foot)"), std::string::npos);
  unmergeProblem(study_, "foot");
  EXPECT_EQ(result().problems.size(), 3u);
}

TEST_F(ProblemFiles, ChainsAreFollowedAndCirclesRefused) {
  mergeProblem(study_, "a", "b");
  mergeProblem(study_, "b", "c");
  EXPECT_EQ(lastOf(mergedIn(study_), "a"), "c");
  EXPECT_THROW(mergeProblem(study_, "c", "a"), UsageError);
  EXPECT_THROW(mergeProblem(study_, "d", "d"), UsageError);
  EXPECT_THROW(mergeProblem(study_, "a", "d"), UsageError) << "it is merged already";
  EXPECT_THROW(unmergeProblem(study_, "c"), UsageError);
  put("merged.csv", "problem,merged_into\na,b\nb,a\n");
  EXPECT_NE(tests::refusalOf<assets::LoadError>([&] { mergedIn(study_); }).find("line 3, merged_into"),
            std::string::npos);
}

TEST_F(ProblemFiles, ATableMayMergeByItself) {
  StudyInput input;
  input.problems = problemsFrom(csvTableFrom("problem,title,participant,merged_into\n1,One,P1,\n2,Two,P2,1\n", "P"));
  const StudyResult merged = studyResult(input);
  ASSERT_EQ(merged.problems.size(), 1u);
  EXPECT_EQ(merged.problems[0].met_by, 2u);
}

TEST_F(ProblemFiles, RatersSeeEachOtherOnceBothHaveRated) {
  EXPECT_EQ(*result().problems.front().severity, 3.0) << "the pedal: 3 times two of four";
  const std::string sheet =
      writeRatingSheet(study_, "E2", {{"depth", "No depth", "open"}, {"foot", "It does not", ""}, {"pedal", "P", ""}});
  const StudyResult asked = result();
  EXPECT_EQ(asked.awaited, std::vector<std::string>{"E2"});
  for (const ProblemRow& row : asked.problems) EXPECT_EQ(row.severity, std::nullopt);
  EXPECT_EQ(asked.agreement.ordinal, std::nullopt);
  EXPECT_NE(studyLines(asked).find("E2: not all problems are rated yet"), std::string::npos);
  put("ratings-E2.csv", "problem,title,tasks,rater,severity\ndepth,No depth,open,E2,1\nfoot,x,,E2,\npedal,P,,E2,2\n");
  EXPECT_EQ(result().awaited.size(), 1u) << "one is missing";
  // What stands in the sheet is kept when it is written again.
  writeRatingSheet(study_, "E2", {{"depth", "No depth", ""}, {"foot", "It", ""}, {"pedal", "P", ""}});
  EXPECT_EQ(ratingsIn(study_)[0].severity, 1);
  put("ratings-E2.csv", "problem,title,tasks,rater,severity\ndepth,,,E2,1\nfoot,,,E2,2\npedal,,,E2,3\n");
  const StudyResult both = result();
  EXPECT_TRUE(both.awaited.empty());
  EXPECT_EQ(*both.problems[0].severity, 3.0) << "the pedal: 3 and 3";
  // E1: 1, 4, 3; E2: 1, 2, 3. Means 1, 3, 3; BMS 8/3, JMS 2/3, EMS 2/3: ICC(3,1) = 2 / (10/3), ICC(2,1) the same.
  ASSERT_TRUE(both.agreement.intraclass);
  EXPECT_NEAR(both.agreement.intraclass->consistency, 0.6, 1e-12);
  EXPECT_NEAR(both.agreement.intraclass->agreement, 0.6, 1e-12);
  EXPECT_TRUE(both.agreement.ordinal && both.agreement.nominal && both.agreement.interval);
  put("ratings-E2.csv", "problem,title,tasks,rater,severity\ndepth,,,Anna,1\n");
  EXPECT_NE(tests::refusalOf<assets::LoadError>([&] { ratingsIn(study_); }).find("never a name"), std::string::npos);
}

TEST_F(ProblemFiles, MutantsOfBothTablesAreReadOrRefused) {
  const std::vector<std::string> good{
      "problem,merged_into\nfoot,pedal\ndepth,light\n",
      "problem,title,tasks,rater,severity\ndepth,No depth,open,E2,1\nfoot,\"It, too\",,E2,\n"};
  mutants::forEachMutant(good, 2000, [&](const std::string& mutant, std::size_t which, std::uint64_t) {
    put(which == 0 ? "merged.csv" : "ratings-E2.csv", mutant);
    tests::refusalOf<assets::LoadError>([&] {
      if (which == 0) {
        const MergedProblems merged = mergedIn(study_);
        for (const auto& [problem, into] : merged) EXPECT_NE(lastOf(merged, into), problem);
      } else {
        ratingsIn(study_);
      }
    });
  });
}

}  // namespace
}  // namespace app
