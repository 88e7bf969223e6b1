#include "app/study/session_log.h"

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "calibration/calibration_error.h"
#include "tests/scratch_folder.h"

namespace app {
namespace {

std::string bytesOf(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

TEST(SessionLog, IsReadAsItWasWritten) {
  const tests::ScratchFolder folder;
  const std::string path = folder.file("events.jsonl");
  {
    SessionLogWriter log(path);
    log.add({5,
             7,
             "evaluator",
             "note",
             {{"text", std::string("a \"b\"\n\xff")}, {"severity", std::int64_t{3}}, {"x", 0.1}}});
    log.add({3, {}, "system", "session.stop", {{"ok", true}}});
    EXPECT_EQ(log.trouble(), std::nullopt);
  }
  const SessionLog log = readSessionLog(path);
  ASSERT_EQ(log.events.size(), 2u);
  EXPECT_EQ(log.damage, std::nullopt);
  EXPECT_TRUE(log.is_closed);
  EXPECT_EQ(log.events[0].tick, 7u);
  EXPECT_TRUE(log.events[0].text("text")->starts_with("a \"b\"\n"));
  EXPECT_EQ(log.events[0].number("severity"), 3.0);
  EXPECT_EQ(log.events[0].number("x"), 0.1);
  EXPECT_EQ(log.events[1].t_ns, 3) << "what was begun before keeps its time";
  EXPECT_EQ(log.events[1].flag("ok"), true);
  EXPECT_THROW(SessionLogWriter again(path), calibration::CalibrationError);
}

TEST(SessionLog, FindsEveryChangedLine) {
  const tests::ScratchFolder folder;
  const std::string path = folder.file("events.jsonl");
  {
    SessionLogWriter log(path);
    for (int n = 0; n < 5; ++n) log.add({n, {}, "system", "mark", {{"n", std::int64_t{n}}}});
  }
  const std::string good = bytesOf(path);
  for (std::size_t at = 0; at < good.size(); at += 7) {
    std::string changed = good;
    if (changed[at] == '\n') continue;
    changed[at] = changed[at] == '1' ? '2' : '1';
    std::ofstream(path) << changed;
    EXPECT_TRUE(readSessionLog(path).damage.has_value()) << at;
  }
  // A line that is missing, and lines that changed places.
  const std::size_t first = good.find('\n') + 1, second = good.find('\n', first) + 1;
  std::ofstream(path) << good.substr(first);
  EXPECT_TRUE(readSessionLog(path).damage.has_value());
  std::ofstream(path) << good.substr(first, second - first) + good.substr(0, first) + good.substr(second);
  EXPECT_TRUE(readSessionLog(path).damage.has_value());
}

TEST(SessionLog, LeavesOutWhatWasCutOffInWriting) {
  const tests::ScratchFolder folder;
  const std::string path = folder.file("events.jsonl");
  {
    SessionLogWriter log(path);
    for (int n = 0; n < 5; ++n) log.add({n, {}, "system", "mark", {}});
  }
  const std::string good = bytesOf(path);
  for (std::size_t length = 0; length <= good.size(); ++length) {
    std::ofstream(path) << good.substr(0, length);
    const SessionLog log = readSessionLog(path);
    EXPECT_EQ(log.damage, std::nullopt) << length;
    EXPECT_EQ(log.events.size(), static_cast<std::size_t>(std::count(
                                     good.begin(), good.begin() + static_cast<std::ptrdiff_t>(length), '\n')));
    EXPECT_FALSE(log.is_closed);
  }
}

TEST(SessionLog, AKilledProgramLosesNothingThatWasAdded) {
  const tests::ScratchFolder folder;
  for (int moment = 0; moment < 10; ++moment) {
    const std::string path = folder.file("killed" + std::to_string(moment));
    int told[2];
    ASSERT_EQ(pipe(told), 0);
    const pid_t child = fork();
    if (child == 0) {
      SessionLogWriter log(path);
      for (std::int64_t n = 0;; ++n) {
        log.add({n, {}, "system", "mark", {}});
        if (write(told[1], &n, sizeof n) != sizeof n) _exit(1);
      }
    }
    close(told[1]);
    std::int64_t newest = -1;
    for (int n = 0; n <= 50 * moment; ++n) ASSERT_EQ(read(told[0], &newest, sizeof newest), ssize_t{sizeof newest});
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    for (std::int64_t more = 0; read(told[0], &more, sizeof more) == ssize_t{sizeof more};) newest = more;
    close(told[0]);
    const SessionLog log = readSessionLog(path);
    EXPECT_EQ(log.damage, std::nullopt);
    ASSERT_GE(static_cast<std::int64_t>(log.events.size()), newest + 1);
  }
}

}  // namespace
}  // namespace app
