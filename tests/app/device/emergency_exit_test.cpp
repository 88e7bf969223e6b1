// Whatever ends the program, the last thing a motor is told is: no force, off.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>

namespace {

struct End {
  const char* way;
  int signal;  ///< 0: by exit
};

/// Force in N and motors on, as told last; and how the program ended.
struct Told {
  double force_N = -1.0, motors_on = -1.0;
  int status = 0;
};

Told endedBy(const char* way) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("molar_end_" + std::string(way) + std::to_string(getpid()));
  std::filesystem::remove(file);
  Told told;
  const pid_t child = fork();
  if (child == 0) {
    if (freopen("/dev/null", "w", stderr) == nullptr) _exit(9);
    execl(MOLAR_END_BADLY, MOLAR_END_BADLY, way, file.c_str(), nullptr);
    _exit(9);
  }
  waitpid(child, &told.status, 0);
  std::ifstream in(file, std::ios::binary);
  std::array<double, 2> values{-1.0, -1.0};
  in.read(reinterpret_cast<char*>(values.data()), sizeof values);
  std::filesystem::remove(file);
  told.force_N = values[0];
  told.motors_on = values[1];
  return told;
}

class EndsBadly : public testing::TestWithParam<End> {};

TEST_P(EndsBadly, WithTheMotorsOff) {
  const Told told = endedBy(GetParam().way);
  EXPECT_EQ(told.force_N, 0.0);
  EXPECT_EQ(told.motors_on, 0.0);
  if (GetParam().signal != 0) {
    ASSERT_TRUE(WIFSIGNALED(told.status));
    EXPECT_EQ(WTERMSIG(told.status), GetParam().signal);
  } else {
    EXPECT_TRUE(WIFEXITED(told.status));
  }
}

INSTANTIATE_TEST_SUITE_P(EmergencyExit, EndsBadly,
                         testing::Values(End{"segv", SIGSEGV}, End{"abort", SIGABRT}, End{"throw", SIGABRT},
                                         End{"two-crashes", SIGSEGV}, End{"handler-of-before", 0},
                                         End{"segv-in-tick", SIGSEGV}, End{"user-signal", SIGUSR1},
                                         End{"alarm", SIGALRM}, End{"cpu-limit", SIGXCPU}, End{"hang-in-tick", 0},
                                         End{"exit", 0}),
                         [](const auto& end) {
                           std::string name = end.param.way;
                           for (char& c : name)
                             if (c == '-') c = '_';
                           return name;
                         });

TEST(EmergencyExit, RestoresThePreviousHandlers) {
  const Told told = endedBy("handler-comes-back");
  ASSERT_TRUE(WIFEXITED(told.status));
  EXPECT_EQ(WEXITSTATUS(told.status), 7);
}

TEST(EmergencyExit, LetsIgnoredSignalsBe) {
  const Told told = endedBy("ignored");
  ASSERT_TRUE(WIFEXITED(told.status));
  EXPECT_EQ(WEXITSTATUS(told.status), 8);
  EXPECT_EQ(told.force_N, 1.0);
}

/// The test can fail: nobody hears of SIGKILL, and the device is left pushing.
TEST(EmergencyExit, IsWhatSwitchesThemOff) {
  const Told told = endedBy("kill-without-guard");
  EXPECT_EQ(told.force_N, 1.0);
  EXPECT_EQ(told.motors_on, 1.0);
}

}  // namespace
