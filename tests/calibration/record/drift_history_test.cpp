#include "calibration/record/drift_history.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <random>
#include <sstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace calibration {
namespace {

namespace fs = std::filesystem;

class History : public testing::Test {
 protected:
  fs::path folder_ = fs::path(testing::TempDir()) /
                     (std::string("drift_") + testing::UnitTest::GetInstance()->current_test_info()->name());
  fs::path path_ = folder_ / "history.csv";
  void SetUp() override { fs::remove_all(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const std::string& text) {
    fs::create_directories(folder_);
    std::ofstream(path_, std::ios::binary) << text;
  }
  std::string text() {
    std::ostringstream bytes;
    bytes << std::ifstream(path_).rdbuf();
    return bytes.str();
  }
};

const DriftEntry kCheck{"2026-11-21T08:20:00Z", DriftKind::check, 4, 0.1 + 0.2, {{-0.1, 1.0 / 3.0, 0.0}}};
const std::string kHead = "utc,kind,n,rms_mm,bias_x_mm,bias_y_mm,bias_z_mm\n";
const std::string kLine = "2026-11-21T08:20:00Z,check,4,0.5,0.1,0.2,-0.3\n";

TEST_F(History, ReadsBackWhatWasAppended) {
  EXPECT_TRUE(readHistory(path_).empty());
  appendHistory(path_, kCheck);
  appendHistory(path_, {"2026-11-22T08:20:00Z", DriftKind::rezero, 5, 1.25, {}});
  appendHistory(path_, {"2026-11-23T08:20:00Z", DriftKind::calibration, 16, 0.25, {}});
  const auto history = readHistory(path_);
  ASSERT_EQ(history.size(), 3u);
  EXPECT_EQ(history[0].utc, kCheck.utc);
  EXPECT_EQ(history[0].rms_mm, kCheck.rms_mm);
  EXPECT_EQ(history[0].bias_mm.xyz, kCheck.bias_mm.xyz);
  EXPECT_EQ(history[1].kind, DriftKind::rezero);
  EXPECT_EQ(history[2].n, 16);
}

TEST_F(History, IgnoresAnIncompleteLineAndRemovesItAtTheNextAppend) {
  const std::string whole = kHead + kLine;
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    write(whole.substr(0, size));
    EXPECT_EQ(readHistory(path_).size(), size == whole.size() ? 1u : 0u) << size;
    appendHistory(path_, kCheck);
    EXPECT_EQ(readHistory(path_).back().rms_mm, kCheck.rms_mm) << size;
    EXPECT_EQ(readHistory(path_).size(), size == whole.size() ? 2u : 1u) << size;
  }
}

TEST_F(History, RefusesAnInvalidLine) {
  for (const char* line :
       {"", "x", "2026-11-21T08:20:00Z,check,4,0.5,0.1,0.2", "2026-11-21T08:20:00Z,check,4,0.5,0.1,0.2,0,0",
        "yesterday,check,4,0.5,0.1,0.2,0", "2026-11-21T08:20:00Z,guess,4,0.5,0.1,0.2,0",
        "2026-11-21T08:20:00Z,check,0,0.5,0.1,0.2,0", "2026-11-21T08:20:00Z,check,4,-0.5,0.1,0.2,0",
        "2026-11-21T08:20:00Z,check,4,nan,0.1,0.2,0", "2026-11-21T08:20:00Z,check,4,0.5,inf,0.2,0",
        "2026-11-21T08:20:00Z,check,4,0.5,1e9,0.2,0", "2026-11-21T08:20:00Z,check,4,0.5 ,0.1,0.2,0"}) {
    write(kHead + kLine + line + "\n" + kLine);
    try {
      readHistory(path_);
      ADD_FAILURE() << line;
    } catch (const CalibrationError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("line 3")) << line;
    }
  }
  write("something else\n");
  EXPECT_THROW(readHistory(path_), CalibrationError);
  EXPECT_THROW(appendHistory(path_, kCheck), CalibrationError);
  EXPECT_EQ(text(), "something else\n");
}

TEST_F(History, RefusesAnEntryThatCouldNotBeRead) {
  DriftEntry bad = kCheck;
  bad.rms_mm = std::nan("");
  EXPECT_THROW(appendHistory(path_, bad), CalibrationError);
  bad = kCheck;
  bad.utc = "now";
  EXPECT_THROW(appendHistory(path_, bad), CalibrationError);
  EXPECT_FALSE(fs::exists(path_));
}

TEST_F(History, LosesNoLineWheneverItIsKilled) {
  std::mt19937 rng(5);
  std::size_t known = 0;
  for (int round = 0; round < 20; ++round) {
    int pipe_ends[2];
    ASSERT_EQ(::pipe(pipe_ends), 0);
    const pid_t child = ::fork();
    if (child == 0) {
      for (;;) {
        appendHistory(path_, kCheck);
        if (::write(pipe_ends[1], "x", 1) != 1) ::_exit(1);
      }
    }
    ::close(pipe_ends[1]);
    char told[4096];
    if (round % 2 == 1 && ::read(pipe_ends[0], told, 1) == 1) ++known;
    std::this_thread::sleep_for(std::chrono::microseconds(200 + rng() % 8000));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    for (ssize_t n = 0; (n = ::read(pipe_ends[0], told, sizeof told)) > 0;) known += static_cast<std::size_t>(n);
    ::close(pipe_ends[0]);
    const std::size_t kept = readHistory(path_).size();
    EXPECT_GE(kept, known);
    EXPECT_LE(kept, known + 1);
    known = kept;
  }
  EXPECT_GT(known, 0u);
}

}  // namespace
}  // namespace calibration
